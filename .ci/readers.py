"""Reads what `sheetwright make --out DIR` wrote with readers that are not ours.

    python .ci/readers.py DIR...

Each DIR holds report.json and any of the other outputs; what is there is checked against the
report and against docs/outputs.md. Ends with a line `N passed, N failed`, and with status 1 if
anything failed or nothing could be checked.
"""

import json
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import ezdxf
import numpy as np
import pdfplumber
import svgelements
import svgpathtools
import trimesh

ROLES = ["cut", "score", "engrave", "note"]
MM_PER_PT = 25.4 / 72
SVG = "{http://www.w3.org/2000/svg}"
SHEET = re.compile(
    r"This sheet: (?P<piece>.*) (?P<sheet>[A-Z]+\d+|reduced), .*?"
    r"shows x (-?[\d.]+) to (-?[\d.]+) mm, y (-?[\d.]+) to (-?[\d.]+) mm at 1:([\d.]+)"
)


class Checks:
    def __init__(self):
        self.passed = self.failed = 0

    def that(self, what, holds, found=""):
        if holds:
            self.passed += 1
        else:
            self.failed += 1
            print(f"FAILED {what}: {found}")


def area(points):
    """The area within a closed polygon, by Gauss's formula about its first corner."""
    x, y = (points - points[0]).T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def corner_count(panel):
    """Corners of the outline and the holes: every seam makes two samples lie there twice. Of a mesh,
    samples are those corners."""
    if panel["method"] == "mesh":
        return panel["samples"]
    return panel["samples"] + 2 * len(panel["seams"])


def near(a, b, relative):
    return abs(a - b) <= relative * abs(b)


def check_dxf(checks, path, panel):
    """Returns the outline and the holes, y upwards."""
    name = path.name
    drawing = ezdxf.readfile(path)
    audit = drawing.audit()
    checks.that(f"{name}: audit", not audit.errors and not audit.fixes, audit.errors)
    checks.that(f"{name}: release 12", drawing.dxfversion == "AC1009", drawing.dxfversion)
    entities = list(drawing.modelspace())
    kinds = {entity.dxftype() for entity in entities}
    checks.that(f"{name}: polylines only", kinds == {"POLYLINE"}, kinds)
    used = {entity.dxf.layer for entity in entities}
    checks.that(f"{name}: layers by role", used <= set(ROLES), used)
    declared = {layer.dxf.name for layer in drawing.layers}
    checks.that(f"{name}: every role declared", set(ROLES) <= declared, declared)

    def corners(entity):
        return np.array([tuple(vertex.dxf.location)[:2] for vertex in entity.vertices])

    cut = [entity for entity in entities if entity.dxf.layer == "cut"]
    # Holes come first.
    cut = cut[-1:] + cut[:-1]
    lines = 1 + panel["holes_flat"]
    closed = len(cut) == lines and all(entity.is_closed for entity in cut)
    checks.that(f"{name}: closed outline and holes", closed, len(cut))
    loops = [corners(entity) for entity in cut]
    count = sum(len(loop) for loop in loops)
    checks.that(f"{name}: samples", count == corner_count(panel), count)
    report = panel["area_flat_mm2"]
    inside = area(loops[0]) - sum(area(loop) for loop in loops[1:])
    checks.that(f"{name}: area", near(inside, report, 1e-6), (inside, report))
    squares = [
        corners(e) for e in entities if e.dxf.layer == "note" and e.is_closed and len(e.vertices) == 4
    ]
    sides = [np.linalg.norm(s - np.roll(s, 1, axis=0), axis=1) for s in squares]
    exact = any(np.allclose(side, 100, rtol=0, atol=1e-9) for side in sides)
    checks.that(f"{name}: reference square", exact, sides)
    return loops


def check_svg(checks, path, panel):
    """Returns the outline and the holes, y upwards."""
    name = path.name
    root = ElementTree.parse(path).getroot()
    view = root.get("viewBox").split()
    size = (f"{view[2]}mm", f"{view[3]}mm")
    sized = (root.get("width"), root.get("height"))
    checks.that(f"{name}: a unit is 1 mm", sized == size, (sized, size))
    groups = [group.get("id") for group in root.findall(f"{SVG}g")]
    checks.that(f"{name}: a group per role", groups == ROLES, groups)
    filled = [e for e in root.iter() if e.get("fill") not in (None, "none")]
    checks.that(f"{name}: nothing filled", not filled, filled)

    document = svgpathtools.Document(str(path))
    cut = [p for p in document.paths() if p.element.get("class") in ("outline", "hole")]
    closed = all(path.isclosed() for path in cut)
    checks.that(f"{name}: closed outline and holes", closed and len(cut) == 1 + panel["holes_flat"], len(cut))
    # A machine cuts what lies inside first.
    checks.that(f"{name}: holes first", cut[-1].element.get("id") == "outline")
    cut = cut[-1:] + cut[:-1]
    report = panel["area_flat_mm2"]
    # Holes run the other way round.
    found = abs(sum(path.area() for path in cut))
    checks.that(f"{name}: area", near(found, report, 1e-6), (found, report))
    in_cut = root.findall(f"{SVG}g[@id='cut']/{SVG}path")
    checks.that(f"{name}: nothing else is cut", len(in_cut) == len(cut), len(in_cut))
    marks = [e.get("data-text") for e in root.iter() if (e.get("data-text") or "").startswith("S")]
    for seam in panel["seams"]:
        checks.that(f"{name}: both sides of {seam['mark']} marked", marks.count(seam["mark"]) == 2, marks)
    loops = [
        np.array([[line.start.real, -line.start.imag] for line in path if line.start != line.end])
        for path in cut
    ]
    count = sum(len(loop) for loop in loops)
    checks.that(f"{name}: samples", count == corner_count(panel), count)
    outline = loops[0]

    # At 25.4 units per inch, a unit of svgelements is 1 mm, whatever the file calls it; but it takes
    # a millimetre for 0.0393701 inch, which is off by 5e-7.
    parsed = svgelements.SVG.parse(str(path), ppi=25.4)
    pieces = {e.id: e for e in parsed.elements() if isinstance(e, svgelements.Path)}
    left, top, right, bottom = pieces["outline"].bbox()
    box = np.array([right - left, bottom - top])
    extent = np.ptp(outline, axis=0)
    checks.that(f"{name}: mm", np.allclose(box, extent, rtol=1e-6), (box, extent))
    left, top, right, bottom = pieces["reference"].bbox()
    square = np.array([right - left, bottom - top])
    checks.that(f"{name}: reference square", np.allclose(square, 100, rtol=1e-6), square)
    return loops


def check_obj(checks, path, panels):
    scene = trimesh.load(path, process=False, split_groups=True)
    meshes = scene.geometry if hasattr(scene, "geometry") else {panels[0]["name"]: scene}
    wanted = sorted(re.sub(r"\s", "_", panel["name"]) for panel in panels)
    checks.that("surface.obj: a group per panel", sorted(meshes) == wanted or len(panels) == 1, list(meshes))
    for name, mesh in meshes.items():
        flat = np.asarray(mesh.visual.uv)
        sides = np.vstack([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
        lengths = [np.linalg.norm(p[sides[:, 0]] - p[sides[:, 1]], axis=1) for p in (mesh.vertices, flat)]
        worst = np.max(np.abs(lengths[0] - lengths[1])) / np.max(mesh.extents)
        errors = [p["length_error_max"] for p in panels if re.sub(r"\s", "_", p["name"]) == name]
        most = 1e-9 + max(errors, default=0)
        checks.that(f"surface.obj, {name}: flat lengths are those in space", worst < most, worst)
        for panel in panels:
            if panel["method"] == "mesh" and (len(panels) == 1 or re.sub(r"\s", "_", panel["name"]) == name):
                check_errors(checks, name, panel, sides, lengths)


def check_errors(checks, name, panel, sides, lengths):
    """The length errors of a mesh, from the surface alone, are those of the report."""
    _, once = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    errors = np.abs(lengths[1][once] / lengths[0][once] - 1)
    for what, found, field in (
        ("largest", np.max(errors), "length_error_max"),
        ("mean", np.mean(errors), "length_error_mean"),
    ):
        told = panel[field]
        agree = abs(found - told) <= 1e-9 + 1e-6 * told
        checks.that(f"surface.obj, {name}: {what} length error", agree, (found, told))


def drawn_points(page):
    """The corners of all lines of a page, mm from its lower left corner."""
    # A piece with four right angles comes as a rectangle.
    kinds = (page.lines, page.curves, page.rects)
    found = [pt for kind in kinds for shape in kind for pt in shape["pts"]]
    points = np.array(found, dtype=float).reshape(-1, 2)
    return np.column_stack([points[:, 0], float(page.height) - points[:, 1]]) * MM_PER_PT


def check_sheet(checks, page, match, outline, covered, along):
    """Marks what of the outline a sheet covers, and checks that it draws it in its place."""
    what = f"pattern.pdf, {match['piece']} {match['sheet']}"
    x0, x1, y0, y1, scale = (float(match[n]) for n in range(3, 8))
    frame = max(page.rects, key=lambda rect: rect["width"] * rect["height"])
    corner = np.array([frame["x0"], frame["y0"]]) * MM_PER_PT
    size = np.array([frame["width"], frame["height"]]) * MM_PER_PT
    true = np.array([x1 - x0, y1 - y0]) / scale
    checks.that(f"{what}: frame at scale", np.allclose(size, true, rtol=0, atol=0.01), (size, true))
    low, high = [x0, y0], [x1, y1]
    covered |= np.all((along >= low) & (along <= high), axis=1)
    seen = outline[np.all((outline >= low) & (outline <= high), axis=1)]
    if len(seen):
        drawn = drawn_points(page)
        places = corner + (seen - low) / scale
        gaps = [np.min(np.linalg.norm(drawn - place, axis=1)) for place in places]
        checks.that(f"{what}: outline in place", max(gaps) < 0.02, max(gaps))
    ends = [np.array(line["pts"]) * MM_PER_PT for line in page.lines]
    lengths = np.array([np.linalg.norm(e[1] - e[0]) for e in ends])
    checks.that(f"{what}: bar of 100 mm", np.any(np.abs(lengths - 100) < 0.05))
    if match["sheet"] != "reduced":
        checks.that(f"{what}: crosses", np.sum(np.abs(lengths - 8) < 0.01) >= 8)


def check_pdf(checks, path, panels, outlines):
    with pdfplumber.open(path) as pdf:
        a4, letter = (210, 297), (215.9, 279.4)
        sizes = {tuple(sorted(float(s) * MM_PER_PT for s in (p.width, p.height))) for p in pdf.pages}
        paper = any(all(np.allclose(s, size, atol=0.01) for s in sizes) for size in (a4, letter))
        checks.that("pattern.pdf: paper", paper, sizes)
        squares = [(r["width"] * MM_PER_PT, r["height"] * MM_PER_PT) for r in pdf.pages[0].rects]
        right = any(abs(w - 100) <= 0.05 and abs(h - 100) <= 0.05 for w, h in squares)
        checks.that("pattern.pdf: check square", right, squares)

        # An edge is covered if a hundred points along it are.
        steps = np.linspace(0, 1, 100, endpoint=False)[:, None, None]
        def points_along(loop):
            return (loop + steps * (np.roll(loop, -1, axis=0) - loop)).reshape(-1, 2)

        along = [np.vstack([points_along(loop) for loop in loops]) for loops in outlines]
        covered = [np.zeros(len(points), dtype=bool) for points in along]
        names = [panel["name"] for panel in panels]
        sheets = set()
        shared = []
        for page in pdf.pages:
            text = (page.extract_text() or "").replace("\n", " ")
            match = SHEET.search(text)
            if not match:
                if any(said in text for said in ("This page: ", "below, at 1:1.")):
                    shared.append(drawn_points(page))
                continue
            n = names.index(match["piece"])
            sheet = (match["piece"], match["sheet"])
            checks.that(f"pattern.pdf, {sheet}: only once", sheet not in sheets)
            sheets.add(sheet)
            check_sheet(checks, page, match, np.vstack(outlines[n]), covered[n], along[n])
        tiled = {piece for piece, _ in sheets}
        for panel, loops, points in zip(panels, outlines, covered):
            text = f"pattern.pdf, {panel['name']}"
            if panel["name"] in tiled:
                found = f"{np.sum(~points)} of {len(points)} points"
                checks.that(f"{text}: sheets cover the pattern", points.all(), found)
            else:
                places = sum(is_drawn(drawn, np.vstack(loops)) for drawn in shared)
                checks.that(f"{text}: on a page with others", places >= 1, places)


def is_drawn(drawn, outline):
    """Whether the corners of an outline are among some points, moved by a vector."""

    def gap(place):
        return np.min(np.linalg.norm(drawn - place, axis=1))

    probes = outline[:: max(1, len(outline) // 8)]
    for start in drawn:
        by = start - outline[0]
        if all(gap(probe + by) < 0.02 for probe in probes):
            if max(gap(corner + by) for corner in outline) < 0.02:
                return True
    return False


def check_book(checks, path, panels):
    """The book names every part, numbers its pages, and cuts no word off."""
    with pdfplumber.open(path) as pdf:
        texts = [page.extract_text() or "" for page in pdf.pages]
        count = len(texts)
        numbered = all(f"{n + 1} of {count}" in text for n, text in enumerate(texts))
        checks.that("assembly.pdf: pages numbered", numbered, texts)
        words = [(page, word) for page in pdf.pages for word in page.extract_words()]
        off = [
            word["text"]
            for page, word in words
            if word["x0"] < 20 or word["x1"] > page.width - 20 or word["top"] < 20 or word["bottom"] > page.height - 20
        ]
        checks.that("assembly.pdf: words within the pages", words and not off, off)
        whole = "\n".join(texts)
        for chapter in ("What to buy", "Parts", "Checks to make", "Notes"):
            checks.that(f"assembly.pdf: {chapter}", chapter in whole)
        joined = any(edge["mates"] for panel in panels for edge in panel["edges"])
        checks.that("assembly.pdf: order of joining", ("Order of joining" in whole) == joined)
        for panel in panels:
            if panel["count"]:
                size = panel["count"]
                title = rf"\d+\. {re.escape(panel['name'])}" + ("" if size == 1 else f": cut {size}")
                found = re.findall(title, whole)
                checks.that(f"assembly.pdf, {panel['name']}: once among the parts", found, title)


def check_folder(checks, folder):
    panels = json.loads((folder / "report.json").read_text(encoding="utf-8"))["panels"]
    outlines = []
    for panel in panels:
        found = []
        for check, suffix in ((check_dxf, "dxf"), (check_svg, "svg")):
            path = folder / f"{panel['name']}.{suffix}"
            if path.exists():
                loops = check(checks, path, panel)
                found.append([loop - loops[0].min(axis=0) for loop in loops])
        if len(found) == 2:
            dxf, svg = (np.vstack(loops) for loops in found)
            worst = np.max(np.abs(dxf - svg))
            checks.that(f"{panel['name']}: SVG and DXF agree", worst < 1e-9 * np.max(dxf) + 1e-12, worst)
        outlines.extend(found[:1])
    if (folder / "surface.obj").exists():
        check_obj(checks, folder / "surface.obj", panels)
    if (folder / "assembly.pdf").exists():
        check_book(checks, folder / "assembly.pdf", panels)
    if (folder / "pattern.pdf").exists() and len(outlines) == len(panels):
        check_pdf(checks, folder / "pattern.pdf", panels, outlines)


def main(folders):
    checks = Checks()
    for folder in folders:
        check_folder(checks, Path(folder))
    print(f"{checks.passed} passed, {checks.failed} failed")
    return 1 if checks.failed or not checks.passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
