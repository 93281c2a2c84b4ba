"""Reads what `sheetwright make --preset NAME --out DIR` wrote with readers that are not ours.

    python .ci/presets.py NAME=DIR...

The layers, colours and order below are those that the machines' makers name; each SVG is read with
svgelements, each DXF, pattern-astm.dxf too, with ezdxf, whose audit must find nothing. Ends with a
line `N passed, N failed`, and with status 1 if anything failed or nothing was read.
"""

import json
import re
import sys
from pathlib import Path

import ezdxf
import ezdxf.path
import numpy as np
import svgelements

# Colours of the lines to cut, and of all layers in the order in which machines run them.
CUT = {
    "generic": ["#ff0000"],
    "lightburn": ["#ff0000", "#00e000"],
    "glowforge": ["#ff0000", "#00a000"],
    "cricut": ["#ff0000"],
    "silhouette": ["#ff0000", "#00ff00"],
    "plotter": ["#ff0000"],
    "wazer": ["#000000"],
}
ORDER = {
    "generic": ["#ff0000", "#0000ff", "#000000", "#999999"],
    "lightburn": ["#000000", "#0000ff", "#00e000", "#ff0000", "#f36926"],
    "glowforge": ["#000000", "#0000ff", "#00a000", "#ff0000"],
    "cricut": ["#ff0000", "#0000ff", "#000000"],
    "silhouette": ["#000000", "#0000ff", "#00ff00", "#ff0000"],
    "plotter": ["#000000", "#0000ff", "#ff0000"],
    "wazer": ["#000000"],
}
# An outline has this class in an SVG, whatever the preset.
OUTLINE = "outline"
# How far arcs may lie from the pattern in folders whose name says that they have arcs.
ARCS_MM = 0.05
RELEASES = {"AC1009": 0, "AC1015": 4}


class Checks:
    def __init__(self):
        self.passed = self.failed = 0

    def that(self, what, holds, found=""):
        self.passed += bool(holds)
        self.failed += not holds
        if not holds:
            print(f"FAILED {what}: {found}")


def colour(element):
    shown = element.fill if element.fill.value is not None else element.stroke
    return shown.hexrgb


def check_svg(checks, name, path, panel):
    # At 25.4 units per inch, a unit of svgelements is 1 mm.
    parsed = svgelements.SVG.parse(str(path), ppi=25.4)
    shapes = [e for e in parsed.elements() if isinstance(e, (svgelements.Path, svgelements.Circle))]
    order = list(dict.fromkeys(colour(shape) for shape in shapes))
    expected = [c for c in ORDER[name] if c in order]
    checks.that(f"{path}: colours in order", order == expected, order)
    outline = [shape for shape in shapes if shape.values.get("class") == OUTLINE]
    checks.that(f"{path}: one outline", len(outline) == 1, len(outline))
    checks.that(f"{path}: the outline is cut", colour(outline[0]) == CUT[name][0], colour(outline[0]))
    cut = [shape for shape in shapes if colour(shape) in CUT[name]]
    last = shapes.index(outline[0]) == len(shapes) - 1 or name in ("generic", "cricut", "lightburn")
    checks.that(f"{path}: the outline is cut last", last)
    if name == "lightburn":
        after = {colour(shape) for shape in shapes[shapes.index(outline[0]) + 1 :]}
        checks.that(f"{path}: nothing burns after the outline", after <= {"#f36926"}, after)
    if name == "wazer":
        checks.that(f"{path}: one layer", len(cut) == len(shapes), len(shapes))
    filled = {colour(shape) for shape in shapes if shape.fill.value is not None}
    checks.that(f"{path}: filled", filled <= ({"#000000"} if name == "glowforge" else set()), filled)
    left, top, right, bottom = outline[0].bbox()
    size = np.array([right - left, bottom - top])
    told = np.array([panel["flat_width_mm"], panel["flat_height_mm"]])
    checks.that(f"{path}: mm", np.allclose(size, told, rtol=1e-6), (size, told))


def audited(checks, path):
    drawing = ezdxf.readfile(path)
    audit = drawing.audit()
    checks.that(f"{path}: audit", not audit.errors and not audit.fixes, audit.errors + audit.fixes)
    return drawing


def check_dxf(checks, name, path, panel):
    drawing = audited(checks, path)
    units = RELEASES.get(drawing.dxfversion)
    checks.that(f"{path}: unit", drawing.header.get("$INSUNITS", 0) == units, drawing.dxfversion)
    if name == "wazer":
        checks.that(f"{path}: says its unit", units == 4, units)
    entities = list(drawing.modelspace())
    used = {entity.dxf.layer for entity in entities}
    declared = {layer.dxf.name for layer in drawing.layers}
    checks.that(f"{path}: layers are declared", used <= declared, used - declared)
    cut = [e for e in entities if e.dxf.layer in ("cut", "knife", "inner") and e.dxftype() != "CIRCLE"]
    checks.that(f"{path}: closed cuts", all(e.is_closed for e in cut) and cut, len(cut))

    def corners(entity):
        # Arcs as chords that rise by a ten-thousandth of a millimetre.
        if entity.has_arc:
            points = ezdxf.path.make_path(entity).flattening(1e-4)
            return np.array([(point.x, point.y) for point in points])
        if entity.dxftype() == "LWPOLYLINE":
            return np.array(entity.get_points("xy"))
        return np.array([tuple(vertex.dxf.location)[:2] for vertex in entity.vertices])

    def length(points):
        return np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum()

    def area(points):
        x, y = (points - points[0]).T
        return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))

    areas = sorted((area(corners(entity)) for entity in cut), reverse=True)
    inside, told = areas[0] - sum(areas[1:]), panel["area_flat_mm2"]
    lines = [corners(entity) for entity in cut]
    off = ARCS_MM * sum(map(length, lines)) if any(entity.has_arc for entity in cut) else 1e-6 * told
    checks.that(f"{path}: area", abs(inside - told) <= off, (inside, told))
    if "arcs" in path.parts[-2]:
        arcs = sum(entity.has_arc for entity in cut)
        checks.that(f"{path}: arcs", arcs > 0, arcs)


def check_astm(checks, path, panels):
    drawing = audited(checks, path)
    blocks = [block for block in drawing.blocks if not block.name.startswith("*")]
    inserts = [e.dxf.name for e in drawing.modelspace() if e.dxftype() == "INSERT"]
    checks.that(f"{path}: a block a part", len(blocks) == len(panels) == len(inserts), inserts)
    for block in blocks:
        layers = {entity.dxf.layer for entity in block}
        known = {"1", "2", "3", "4", "7", "8", "11", "13", "14", "15"}
        checks.that(f"{path}: {block.name}: layers", layers <= known and {"1", "7"} <= layers, layers)
        boundary = [e for e in block if e.dxf.layer == "1" and e.dxftype() == "POLYLINE"]
        checks.that(f"{path}: {block.name}: one boundary", len(boundary) == 1 and boundary[0].is_closed)
        corners = {tuple(v.dxf.location) for v in boundary[0].vertices}
        points = {tuple(e.dxf.location) for e in block if e.dxf.layer in ("2", "3")}
        checks.that(f"{path}: {block.name}: a point a corner", points == corners, points ^ corners)
        texts = [e.dxf.text for e in block if e.dxf.layer == "1" and e.dxftype() == "TEXT"]
        checks.that(f"{path}: {block.name}: keys", all(re.match(r"[\w ]+: .", t) for t in texts), texts)


def check_offsets(checks, path, panels):
    rows = [row.split(",") for row in path.read_text(encoding="utf-8").splitlines()]
    checks.that(f"{path}: columns", rows[0][:3] == ["part", "station_mm", "lower_mm"], rows[0])
    ends = {}
    for row in rows[1:]:
        ends[row[0].strip('"')] = float(row[1])
    for panel in panels:
        end = ends.get(panel["name"], -1)
        checks.that(f"{path}: {panel['name']}", abs(end - panel["flat_width_mm"]) < 0.006, end)


def main(given):
    checks = Checks()
    for name, folder in (argument.split("=", 1) for argument in given):
        folder = Path(folder)
        panels = json.loads((folder / "report.json").read_text(encoding="utf-8"))["panels"]
        for panel in panels:
            check_svg(checks, name, folder / f"{panel['name']}.svg", panel)
            check_dxf(checks, name, folder / f"{panel['name']}.dxf", panel)
        check_astm(checks, folder / "pattern-astm.dxf", panels)
        check_offsets(checks, folder / "offsets.csv", panels)
    print(f"{checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed or not checks.passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
