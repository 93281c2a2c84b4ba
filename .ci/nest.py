"""Layouts on sheets, seen by other programs.

  nest.py sets FILE                 random sets, as crates/kernel/tests/nest.rs writes them
  nest.py made FOLDER GAP MARGIN    sheets.svg of a made design
  nest.py rival FOLDER WIDTH        how long a roll others need for the parts of FOLDER
  nest.py pick DESIGN FOLDER...     a design of 60 outlines of made designs, each of another size

Shapely looks for overlaps, gaps and margins that are too small, parts that are lost and parts that
lie against their grain. Spyrrow lays the parts out in the time that we took, three times; its median
length may be at most 3 % shorter than ours.
"""

import csv
import json
import math
import random
import re
import statistics
import sys
import time
import xml.etree.ElementTree as xml
from pathlib import Path

SVG = "{http://www.w3.org/2000/svg}"
# Rounding, and what parts may lie nearer to the edge of a sheet, mm.
OFF_MM = 2e-3


def polygon(loops):
    from shapely.geometry import Polygon

    return Polygon(loops[0], loops[1:])


def check_sheet(outline, parts, gap, margin, place):
    """Complains if parts on a sheet are too near to one another or to its edge."""
    from shapely.strtree import STRtree

    sheet = polygon([outline])
    for part in parts:
        assert sheet.covers(part.buffer(-OFF_MM)), f"{place}: a part leaves its sheet"
        off = sheet.exterior.distance(part)
        assert off >= margin - OFF_MM, f"{place}: {off} mm from the edge, not {margin}"
    tree = STRtree(parts)
    for n, part in enumerate(parts):
        for k in tree.query(part.buffer(gap + 1)):
            if k <= n:
                continue
            common = part.intersection(parts[k]).area
            assert common < 1e-6, f"{place}: parts overlap by {common} mm²"
            off = part.distance(parts[k])
            assert off >= gap - 1e-6, f"{place}: {off} mm between parts, not {gap}"


def sets(file):
    lines = Path(file).read_text().splitlines()
    laid = 0
    for number, line in enumerate(lines):
        it = json.loads(line)
        place = f"set {number}"
        for n, sheet in enumerate(it["sheets"]):
            parts = [polygon(p["loops"]) for p in it["placed"] if p["sheet"] == n]
            check_sheet(sheet["outline"], parts, it["gap"], it["margin"], place)
        for n, part in enumerate(it["parts"]):
            placed = [p for p in it["placed"] if p["part"] == n]
            laid += len(placed)
            if n not in it["refused"]:
                assert len(placed) == part["count"], f"{place}: part {n} is lost"
            area = polygon(part["loops"]).area
            for p in placed:
                assert abs(polygon(p["loops"]).area - area) < 1e-6 * area + 1e-6, f"{place}: bent"
                grain = math.pi / 2 if it["sheets"][p["sheet"]]["upright"] else 0
                turn = p["turn"] - grain
                turn = -turn if p["over"] else turn
                away = [abs(math.remainder(turn - a, math.tau)) for a in part["angles"]] or [0]
                assert min(away) <= part["tolerance"] + 1e-9, f"{place}: against the grain"
                assert part["over"] or not p["over"], f"{place}: turned over"
    print(f"{len(lines)} sets, {laid} parts laid: no overlap, gaps and margins kept, none lost")


def closed_paths(file, kind):
    """The closed paths of a class in an SVG of ours, y upwards, each with its place in the file."""
    found = []
    for path in xml.parse(file).getroot().iter(f"{SVG}path"):
        if path.get("class") == kind:
            numbers = re.findall(r"-?[\d.]+(?:e-?\d+)?,-?[\d.]+(?:e-?\d+)?", path.get("d"))
            found.append([(float(x), -float(y)) for x, y in (n.split(",") for n in numbers)])
    return found


def made(folder, gap, margin):
    folder = Path(folder)
    sheets = closed_paths(folder / "sheets.svg", "sheet")
    outlines = [polygon([line]) for line in closed_paths(folder / "sheets.svg", "outline")]
    holes = [polygon([line]) for line in closed_paths(folder / "sheets.svg", "hole")]
    whole = []
    for outline in outlines:
        own = [hole for hole in holes if outline.contains(hole.representative_point())]
        # A hole of a part that lies in a hole of this one is none of its own.
        inner = [o for o in outlines if o is not outline and outline.contains(o)]
        own = [h for h in own if not any(o.contains(h) for o in inner)]
        for hole in own:
            outline = outline.difference(hole)
        whole.append(outline)
    report = json.loads((folder / "report.json").read_text())
    listed = sum(len(sheet["parts"]) for sheet in report["sheets"]["list"])
    assert listed == len(whole), f"{folder}: {len(whole)} outlines, {listed} in the report"
    assert report["sheets"]["proved"], f"{folder}: not proved"
    counted = 0
    for n, sheet in enumerate(sheets):
        on_it = [p for p in whole if polygon([sheet]).contains(p.representative_point())]
        check_sheet(sheet, on_it, gap, margin, f"{folder.name}, sheet {n + 1}")
        counted += len(on_it)
    assert counted == len(whole), f"{folder}: a part lies on no sheet"
    print(f"{folder.name}: {counted} parts on {len(sheets)} sheets")


def rival(folder, width):
    import spyrrow

    folder = Path(folder)
    items, area = [], 0.0
    for row in csv.DictReader((folder / "parts.csv").open(encoding="utf-8-sig")):
        [outline] = closed_paths(folder / f"{row['part']}.svg", "outline")
        area += polygon([outline]).area * int(row["count"])
        mirrored = int(row["mirrored"])
        image = [(-x, y) for x, y in reversed(outline)]
        for name, line, count in [("", outline, int(row["count"]) - mirrored), ("'", image, mirrored)]:
            if count:
                items.append(spyrrow.Item(row["part"] + name, line, count, None))
    sheets = json.loads((folder / "report.json").read_text())["sheets"]["list"]
    assert len(sheets) == 1, f"{folder}: more than one roll"
    ours = sheets[0]["width_mm"]
    seconds = max(5, round(json.loads((folder / "timing.json").read_text())["total"]))
    theirs = []
    for seed in range(3):
        config = spyrrow.StripPackingConfig(
            early_termination=False, total_computation_time=seconds, num_workers=1, seed=seed
        )
        begun = time.time()
        theirs.append(spyrrow.StripPackingInstance(folder.name, width, items).solve(config).width)
        assert time.time() - begun < 3 * seconds + 10
    median = statistics.median(theirs)
    print(
        f"{folder.name}: {ours:.1f} mm, density {area / ours / width:.4f}; spyrrow in {seconds} s "
        f"{median:.1f} mm, {area / median / width:.4f}: {median / ours:.4f} of theirs"
    )
    assert median / ours >= 0.97, f"{folder}: density below 0.97 of theirs"


def pick(design, *folders):
    from shapely.affinity import scale as scaled

    found = []
    for folder in sorted(folders):
        for file in sorted(Path(folder).glob("*.svg")):
            # Patterns that overlap themselves are no outlines to cut, and needles no parts.
            lines = [polygon([line]) for line in closed_paths(file, "outline") if len(line) > 2]
            found += [line for line in lines if line.is_valid and line.area > 0.02 * line.length**2]
    random.seed(1)
    chosen = random.choices(found, k=60)
    curves, panels = {}, []
    for n, line in enumerate(chosen):
        # As large as a square of 40 to 120 mm; a tenth of a millimetre is enough for a layout.
        scale = random.uniform(40, 120) / math.sqrt(line.area)
        line = scaled(line, scale, scale, origin=(0, 0)).simplify(0.1)
        points = [[x, y, 0] for x, y in line.exterior.coords[:-1]]
        curves[f"c{n}"] = {"kind": "polyline", "closed": True, "points": points}
        panels.append({"name": f"part-{n}", "boundary": [f"c{n}"]})
    whole = {"sheetwright": 1, "units": "mm", "curves": curves, "panels": panels}
    Path(design).write_text(json.dumps(whole))
    print(f"60 of {len(found)} outlines in {design}")


if __name__ == "__main__":
    what, first, *rest = sys.argv[1:]
    if what == "pick":
        pick(first, *rest)
    else:
        {"sets": sets, "made": made, "rival": rival}[what](first, *map(float, rest))
