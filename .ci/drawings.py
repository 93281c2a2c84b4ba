"""Drawings by other programs' writers, read by the command.

  drawings.py SHEETWRIGHT FOLDER

Writes drawings into FOLDER with ezdxf, svgwrite, svgpathtools, Inkscape and FreeCAD, makes each, and
compares the number of panels, their areas and the lengths of their edges with what was drawn.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

# What chords lose of areas and lengths with the usual tolerance.
SHARE = 3e-4
CASES = []


def case(panels=1, area=None, edges=None, args=()):
    """A drawing: its function writes a file of this stem and returns the path."""

    def add(function):
        CASES.append((function, panels, area, edges, list(args)))
        return function

    return add


def dxf(version="R2010", units=4):
    import ezdxf

    doc = ezdxf.new(version)
    doc.units = units
    return doc, doc.modelspace()


def saved(doc, stem):
    path = stem.with_suffix(".dxf")
    doc.saveas(path)
    return path


DISC = math.pi * 50**2


def circle_in(version, units, unit_mm):
    def write(stem):
        doc, space = dxf(version, units)
        space.add_circle((10, 20), 50 / unit_mm)
        return saved(doc, stem)

    write.__name__ = f"ezdxf_circle_{version}_{units}"
    return write


for version in ["R12", "R2000", "R2004", "R2007", "R2013", "R2018"]:
    case(area=DISC)(circle_in(version, 4 if version != "R12" else 0, 1))
for units, unit_mm in [(1, 25.4), (5, 10), (6, 1000)]:
    case(area=DISC)(circle_in("R2010", units, unit_mm))


@case(area=100 * 60 + math.pi * 30**2)
def ezdxf_slot_of_bulges(stem):
    doc, space = dxf()
    corners = [(0, 0, 0), (100, 0, 1), (100, 60, 0), (0, 60, 1)]
    space.add_lwpolyline(corners, format="xyb", close=True)
    return saved(doc, stem)


@case(area=100 * 60 + math.pi * 30**2)
def ezdxf_slot_of_old_polylines(stem):
    doc, space = dxf("R12", 0)
    corners = [(0, 0, 0), (100, 0, 1), (100, 60, 0), (0, 60, 1)]
    space.add_polyline2d(corners, format="xyb", close=True)
    return saved(doc, stem)


@case(area=100 * 60 + math.pi * 30**2)
def ezdxf_slot_of_loose_pieces(stem):
    doc, space = dxf()
    space.add_arc((0, 30), 30, 90, 270)
    space.add_line((100, 60), (0, 60))
    space.add_arc((100, 30), 30, 270, 90)
    space.add_line((0, 0), (100, 0))
    return saved(doc, stem)


@case(area=math.pi * 80 * 30)
def ezdxf_ellipse(stem):
    doc, space = dxf()
    space.add_ellipse((5, 5), major_axis=(48, 64), ratio=30 / 80)
    return saved(doc, stem)


@case(area=DISC)
def ezdxf_circle_of_rational_splines(stem):
    from ezdxf.math import ConstructionArc, rational_bspline_from_arc

    doc, space = dxf()
    for start, end in [(0, 140), (140, 360)]:
        spline = rational_bspline_from_arc((3, 4), 50, start, end)
        space.add_spline().apply_construction_tool(spline)
    return saved(doc, stem)


def spline_points():
    return [(0, 0), (60, 90), (150, 40), (220, 120), (300, 0)]


def area_below(points):
    return sum(0.5 * (b[0] - a[0]) * (a[1] + b[1]) for a, b in zip(points, points[1:]))


def below_spline():
    from ezdxf.math import BSpline

    spline = BSpline([(x, y, 0) for x, y in spline_points()])
    return area_below([(p.x, p.y) for p in spline.approximate(20000)])


@case(area=below_spline)
def ezdxf_spline_of_control_points(stem):
    doc, space = dxf()
    space.add_open_spline([(x, y, 0) for x, y in spline_points()])
    space.add_line((300, 0), (0, 0))
    return saved(doc, stem)


@case(panels=6, area=6 * 4 * 900)
def ezdxf_grid_of_a_block(stem):
    doc, space = dxf()
    block = doc.blocks.new("plate", base_point=(15, 15))
    block.add_lwpolyline([(0, 0), (30, 0), (30, 30), (0, 30)], close=True)
    insert = space.add_blockref("plate", (500, 100), {"xscale": 2, "yscale": -2, "rotation": 25})
    insert.dxf.column_count, insert.dxf.row_count = 3, 2
    insert.dxf.column_spacing, insert.dxf.row_spacing = 100, 120
    return saved(doc, stem)


@case(area=100 * 100 - math.pi * 10**2)
def ezdxf_layers_of_outlines_and_holes(stem):
    doc, space = dxf()
    for layer in ["OUTLINE", "HOLES", "Notes", "off"]:
        doc.layers.add(layer)
    doc.layers.get("off").off()
    space.add_lwpolyline(
        [(0, 0), (100, 0), (100, 100), (0, 100)], close=True, dxfattribs={"layer": "OUTLINE"}
    )
    space.add_circle((30, 30), 10, dxfattribs={"layer": "HOLES"})
    space.add_circle((70, 30), 10, dxfattribs={"layer": "Notes"})
    space.add_circle((70, 70), 10, dxfattribs={"layer": "off"})
    space.add_text("lid")
    space.add_linear_dim((0, -20), (0, 0), (100, 0)).render()
    hatch = space.add_hatch()
    hatch.paths.add_polyline_path([(0, 0), (9, 0), (9, 9)])
    return saved(doc, stem)


@case(area=DISC)
def ezdxf_seen_from_below(stem):
    doc, space = dxf()
    space.add_circle((10, 20), 50, dxfattribs={"extrusion": (0, 0, -1)})
    return saved(doc, stem)


@case(area=math.pi / 2 * 100 * 300, edges=[math.pi / 2 * 100] * 2)
def ezdxf_rails_of_arcs(stem):
    doc, space = dxf()
    for y in [0, -300]:
        # Standing arcs: those of a quarter of a cylinder along y.
        space.add_arc((0, 0, y), 100, 0, 90, dxfattribs={"extrusion": (0, 1, 0)})
    return saved(doc, stem)


def cylinder(points, z):
    turn = [math.pi / 2 * n / points for n in range(points + 1)]
    return [(100 * math.cos(t), 100 * math.sin(t), z) for t in turn]


@case(area=math.pi / 2 * 100 * 300, edges=[math.pi / 2 * 100] * 2, args=["--rails", "keel,SHEER"])
def ezdxf_rails_of_polylines_in_space(stem):
    doc, space = dxf()
    space.add_polyline3d(cylinder(40, 0), dxfattribs={"layer": "Keel"})
    space.add_polyline3d(cylinder(40, 300), dxfattribs={"layer": "Sheer"})
    space.add_line((0, 0, 0), (5, 0, 0), dxfattribs={"layer": "axis"})
    return saved(doc, stem)


@case(area=math.pi / 2 * 100 * 300, edges=[math.pi / 2 * 100] * 2)
def ezdxf_rails_through_points(stem):
    doc, space = dxf()
    for z in [0, 300]:
        space.add_spline(fit_points=cylinder(40, z))
    return saved(doc, stem)


def slant(r, top, height):
    return math.sqrt((r - top) ** 2 + height**2)


@case(area=math.pi * (150 + 50) * slant(150, 50, 200))
def ezdxf_rings_of_a_lampshade(stem):
    doc, space = dxf()
    space.add_circle((0, 0, 0), 150)
    space.add_circle((0, 0, 200), 50)
    return saved(doc, stem)


def svgdoc(stem, size=("200mm", "300mm"), box="0 0 200 300"):
    import svgwrite

    path = stem.with_suffix(".svg")
    return svgwrite.Drawing(str(path), size=size, viewBox=box), path


def svg_case(area, panels=1, **page):
    def add(function):
        def write(stem):
            drawing, path = svgdoc(stem, **page)
            function(drawing)
            drawing.save()
            return path

        write.__name__ = function.__name__
        return case(panels=panels, area=area)(write)

    return add


@svg_case(100 * 60 - (4 - math.pi) * 100)
def svgwrite_rounded(drawing):
    drawing.add(drawing.rect((10, 10), (100, 60), rx=10, ry=10))


@svg_case(math.pi * 40 * 20)
def svgwrite_ellipse(drawing):
    drawing.add(drawing.ellipse((100, 100), (40, 20), transform="rotate(30 100 100)"))


@svg_case(0.5 * 100 * 80)
def svgwrite_polygon(drawing):
    drawing.add(drawing.polygon([(0, 0), (100, 0), (30, 80)]))


@svg_case(DISC / 2)
def svgwrite_arc(drawing):
    drawing.add(drawing.path("M50 150a50 50 0 1 0 100 0z", id="half"))


@svg_case(25.4**2 * 6, size=("4in", "6in"), box="0 0 4 6")
def svgwrite_inches(drawing):
    drawing.add(drawing.rect((0.5, 0.5), (2, 3)))


@svg_case(2 * 4 * math.pi * 15**2, panels=2)
def svgwrite_copies_in_groups(drawing):
    disc = drawing.defs.add(drawing.circle((0, 0), 15, id="disc"))
    group = drawing.add(drawing.g(transform="translate(40,50) scale(2)"))
    group.add(drawing.use(disc, insert=(0, 0)))
    group.add(drawing.use(disc, insert=(40, 40)))


@svg_case(50 * 50)
def svgwrite_symbol(drawing):
    symbol = drawing.defs.add(drawing.symbol(id="tile"))
    symbol.viewbox(0, 0, 10, 10)
    symbol.add(drawing.rect((0, 0), (10, 10)))
    drawing.add(drawing.use(symbol, insert=(20, 20), size=(50, 50)))


@svg_case((25.4 / 96) ** 2 * 300 * 200, size=("960px", "960px"), box="0 0 960 960")
def svgwrite_pixels(drawing):
    drawing.add(drawing.polyline([(0, 0), (300, 0), (300, 200), (0, 200), (0, 0)]))


def blob():
    from svgpathtools import Arc, CubicBezier, Line, Path as Curve, QuadraticBezier

    return Curve(
        CubicBezier(10 + 10j, 60 - 30j, 120 + 30j, 150 + 10j),
        Arc(150 + 10j, 60 + 40j, 20, 0, 1, 150 + 100j),
        QuadraticBezier(150 + 100j, 80 + 160j, 40 + 110j),
        Line(40 + 110j, 10 + 10j),
    )


def blob_area():
    points = [blob().point(n / 20000) for n in range(20000)]
    pairs = zip(points, points[1:] + points[:1])
    return abs(sum(0.5 * (a.real * b.imag - a.imag * b.real) for a, b in pairs))


@case(area=blob_area, edges=lambda: [blob().length()])
def svgpathtools_blob(stem):
    from svgpathtools import wsvg

    path = stem.with_suffix(".svg")
    page = {"width": "200mm", "height": "200mm", "viewBox": "0 0 200 200"}
    wsvg([blob()], filename=str(path), svg_attributes=page)
    return path


@case(area=lambda: 4 * blob_area(), edges=lambda: [2 * blob().length()])
def svgelements_blob(stem):
    from svgelements import Matrix, Path as Curve

    path = stem.with_suffix(".svg")
    data = (Curve(blob().d()) * Matrix("rotate(40) scale(2)")).d()
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="40cm" height="40cm" viewBox="0 0 400 400">'
        f'<path d="{data}"/></svg>'
    )
    return path


SHAPES = """<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">
<rect id="plate" x="20" y="20" width="120" height="80" rx="10"/>
<circle id="hatch" cx="60" cy="60" r="20"/></svg>"""
PLATE = 120 * 80 - (4 - math.pi) * 100
HATCH = math.pi * 400


def inkscape_case(name, actions, area, panels=1, ending=".svg", options=()):
    def write(stem):
        source = stem.with_name(stem.name + "-source.svg")
        source.write_text(SHAPES)
        path = stem.with_suffix(ending)
        call = ["inkscape", str(source), f"--export-filename={path}", *options]
        if actions:
            call.append(f"--actions={actions}")
        subprocess.run(call, check=True, capture_output=True, timeout=120)
        return path

    write.__name__ = f"inkscape_{name}"
    case(panels=panels, area=area)(write)


inkscape_case("svg", "", PLATE - HATCH, options=["--export-type=svg"])
inkscape_case("plain", "", PLATE - HATCH, options=["--export-plain-svg"])
inkscape_case("paths", "select-all;object-to-path", PLATE - HATCH)
inkscape_case("turned", "select-all;transform-rotate:30", PLATE - HATCH)
inkscape_case("difference", "select-all;path-difference", PLATE - HATCH)
inkscape_case("group", "select-all;selection-group;transform-scale:2", 4 * (PLATE - HATCH))
inkscape_case("clone", "select-by-id:plate;clone;transform-translate:0,100", 2 * PLATE - HATCH, panels=2)

FREECAD = """
import FreeCAD, Part, Import, importSVG
from FreeCAD import Vector
doc = FreeCAD.newDocument()
edges = [Part.LineSegment(Vector(0, 0, 0), Vector(100, 0, 0)).toShape(),
         Part.Arc(Vector(100, 0, 0), Vector(130, 30, 0), Vector(100, 60, 0)).toShape(),
         Part.LineSegment(Vector(100, 60, 0), Vector(0, 60, 0)).toShape(),
         Part.Arc(Vector(0, 60, 0), Vector(-30, 30, 0), Vector(0, 0, 0)).toShape()]
shape = doc.addObject("Part::Feature", "slot")
shape.Shape = Part.Wire(edges)
doc.recompute()
{export}
"""


def freecad_case(name, export, ending):
    def write(stem):
        path = stem.with_suffix(ending)
        script = stem.with_suffix(".py")
        script.write_text(FREECAD.format(export=export.format(path=path)))
        environment = {"QT_QPA_PLATFORM": "offscreen", "HOME": str(stem.parent), "PATH": "/usr/bin:/bin"}
        call = ["freecadcmd", str(script)]
        subprocess.run(call, check=True, capture_output=True, timeout=120, env=environment)
        return path

    write.__name__ = f"freecad_{name}"
    case(area=100 * 60 + math.pi * 30**2)(write)


freecad_case("dxf", "Import.writeDXFObject([shape], r'{path}')", ".dxf")
freecad_case("svg", "importSVG.export([shape], r'{path}')", ".svg")


def value(it):
    return it() if callable(it) else it


def check(function, panels, area, edges, args, program, folder):
    stem = folder / function.__name__
    path = function(stem)
    out = folder / f"{function.__name__}-made"
    call = [program, "make", str(path), "--out", str(out), "--formats", "report", "--quiet"]
    done = subprocess.run([*call, "--verdict", "quick", *args], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    made = json.loads((out / "report.json").read_text())["panels"]
    assert len(made) == panels, f"{len(made)} panels, not {panels}"
    found, expected = sum(panel["area_flat_mm2"] for panel in made), value(area)
    assert abs(found - expected) <= SHARE * expected, f"area {found}, not {expected}"
    for length, edge in zip(value(edges) or [], sorted_edges(made)):
        assert abs(edge - length) <= SHARE * length, f"edge {edge}, not {length}"


def sorted_edges(made):
    """The lengths of the edges along curves, of rails without their straight ends."""
    edges = [edge for panel in made for edge in panel["edges"]]
    return [edge["length_space_mm"] for edge in edges if edge["name"] not in ("start", "end")]


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    wrong = []
    for function, *expected in CASES:
        try:
            check(function, *expected, program, folder)
        except Exception as error:  # noqa: BLE001
            wrong.append(f"{function.__name__}: {error}")
    print(f"{len(CASES)} drawings by other programs, {len(wrong)} wrong")
    print("\n".join(wrong))
    sys.exit(1 if wrong else 0)


main()
