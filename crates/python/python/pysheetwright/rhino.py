"""Rhino's files: curves or meshes of a 3DM to a design, patterns and surfaces back to a 3DM.

:func:`make` hands the curves to the reader of drawings, as a DXF of NURBS, lines and polylines on
the layers that they lie on, so what bounds a panel is decided as for every drawing; meshes go as an
OBJ. :func:`write` puts the lines of our own DXF files on their layers, and the surfaces as meshes
beside them. Needs the package ``rhino3dm`` (``pip install 'pysheetwright[rhino]'``), and no Rhino.

As a program, ``python -m pysheetwright.rhino IN.3dm OUT.3dm --material steel-1mm``.
"""

from __future__ import annotations

import argparse
import math
import os
import re
import sys
import unicodedata
import warnings
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import rhino3dm

from pysheetwright import making
from pysheetwright.errors import SheetwrightError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from pysheetwright._native import Made

_UNITS_MM = {
    "None": 1.0,
    "Millimeters": 1.0,
    "Centimeters": 10.0,
    "Decimeters": 100.0,
    "Meters": 1000.0,
    "Inches": 25.4,
    "Feet": 304.8,
    "Yards": 914.4,
}
"""The length of the units of files, in mm; a file without a unit counts in mm, as all others do."""

_GAP_MM = 20.0
_VERSION = 7

# A name that says what its curve is for, as the reader of drawings has it (roles.rs): it begins
# with one of these words, and no letter follows.
_TELLS = re.compile(
    r"\s*((rail|outline|hole|note|mark|dim|dimension|guide)s?"
    r"|score|engrave|construction|text|defpoints|reference)(?![^\W\d_])",
    re.IGNORECASE,
)


def make(
    path: str | os.PathLike[str],
    *,
    rails: Sequence[str] | None = None,
    **settings: Unpack[making.Settings],
) -> Made:
    """Make the panels that the curves of a 3DM bound, or, where it has no curves, its meshes.

    Curves whose name, or else the name of whose layer, begins with ``rail``, ``outline`` or
    ``hole`` are that, and ``note``, ``dim``, ``construction`` and the like bound nothing; without
    such names, closed curves are outlines and their holes, as in every drawing. ``rails`` names
    the curves or layers that are rails. Layers that are off and hidden objects are not used. The
    file says its unit, so ``units`` is not for it.

    Surfaces and solids are not used, and a warning counts them: mesh them in Rhino, or duplicate
    their edges.
    """
    if "units" in settings:
        raise SheetwrightError("a 3DM file says its unit itself", "Leave `units` out.")
    model, things = _read(path)
    unit_mm = _unit_mm(model)
    curves = [(names, it) for names, it in things if isinstance(it, rhino3dm.Curve)]
    meshes = [(names, it) for names, it in things if isinstance(it, rhino3dm.Mesh)]
    used = curves or meshes
    unused = Counter(_kind(it) for _, it in things) - Counter(_kind(it) for _, it in used)
    if not used:
        found = ", ".join(f"{count} {kind}" for kind, count in unused.items()) or "nothing"
        message = f"{os.fspath(path)}: there are no curves and no meshes; there is {found}"
        raise SheetwrightError(message, "Mesh the surfaces in Rhino, or duplicate their edges.")
    if unused:
        said = ", ".join(f"{count} {kind}" for kind, count in unused.items())
        warnings.warn(f"{os.fspath(path)}: not used: {said}", stacklevel=2)
    name = Path(path).stem
    if curves:
        data = _dxf(curves, unit_mm, rails)
        return making.make(data, format="dxf", name=name, rails=rails, **settings)
    if rails is not None:
        raise SheetwrightError("the file has meshes and no rails", "Leave `rails` out.")
    return making.make(
        _obj(meshes, unit_mm), format="obj", name=name, **(settings | {"units": "mm"})
    )


def write(made: Made, path: str | os.PathLike[str]) -> None:
    """Write the patterns and the surfaces of a made design as a 3DM, in mm.

    The lines of a pattern lie on the layers of its DXF (``cut``, ``score``, ``engrave``, ``note``),
    part beside part; the surfaces are meshes on the layer ``surface``, where they are in space.
    Every object has the name of its part, or of the sheet on which parts are laid out. Circles and
    arcs stay what they are. The file is written whole or not at all.
    """
    model = rhino3dm.File3dm()
    model.Settings.ModelUnitSystem = rhino3dm.UnitSystem.Millimeters
    layers: dict[str, int] = {}
    # The layers are those of every design, whatever machine it is for.
    drawings = made.files(["dxf"], dxf="r12", preset="generic")
    left = 0.0
    for name, data in drawings.items():
        right = left
        for drawn in _drawn(data.decode()):
            curve, reach = drawn.placed(left)
            model.Objects.AddCurve(curve, _attributes(model, layers, drawn.layer, Path(name).stem))
            right = max(right, reach)
        left = right + _GAP_MM
    for part in made.parts:
        mesh = rhino3dm.Mesh()
        for x, y, z in part.vertices.tolist():
            mesh.Vertices.Add(x, y, z)
        for a, b, c in part.faces.tolist():
            mesh.Faces.AddFace(a, b, c)
        mesh.Normals.ComputeNormals()
        model.Objects.AddMesh(mesh, _attributes(model, layers, "surface", part.name))
    beside = Path(f"{os.fspath(path)}.part")
    try:
        if not model.Write(str(beside), _VERSION):
            raise OSError(f"{os.fspath(path)}: could not be written")
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def _read(path: str | os.PathLike[str]) -> tuple[Any, list[tuple[list[str], Any]]]:
    """Return the model and what is shown of it, with its names: its own, then those of layers."""
    # Opening it raises what is wrong with the path, in words.
    with Path(path).open("rb"):
        model = rhino3dm.File3dm.Read(os.fspath(path))
    if model is None:
        raise SheetwrightError(f"{os.fspath(path)}: it is no 3DM file", "Save it from Rhino again.")
    layers = {layer.Index: layer for layer in model.Layers}
    paths = {layer.FullPath: layer for layer in layers.values()}
    things = []
    for thing in model.Objects:
        about = thing.Attributes
        if about.IsInstanceDefinitionObject or not about.Visible:
            continue
        layer = layers.get(about.LayerIndex)
        steps = layer.FullPath.split("::") if layer else []
        above = [paths.get("::".join(steps[: n + 1])) for n in range(len(steps))]
        if any(it is not None and not it.Visible for it in above):
            continue
        things.append(([it for it in [about.Name, *reversed(steps)] if it], thing.Geometry))
    return model, things


def _unit_mm(model: Any) -> float:  # noqa: ANN401
    unit = str(model.Settings.ModelUnitSystem).rsplit(".", 1)[-1]
    if unit not in _UNITS_MM:
        known = ", ".join(_UNITS_MM)
        raise SheetwrightError(f"the unit of the file is {unit}", f"Known here: {known}.")
    return _UNITS_MM[unit]


def _kind(thing: Any) -> str:  # noqa: ANN401
    return str(type(thing).__name__)


def _folded(name: str) -> str:
    """Return a name for comparison, as the reader of drawings compares them."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name.strip()).lower())


def _name(names: Iterable[str], rails: Sequence[str] | None) -> str:
    """Return the name of a curve that matters: one of a rail, else one that tells, else the first.

    Its own names come before those of its layers.
    """
    # A line break would end the name in a DXF, and what follows would be read as a code.
    each = [" ".join(it.splitlines()) for it in names]
    wanted = {_folded(it) for it in rails or ()}
    given = [it for it in each if _folded(it) in wanted]
    telling = [it for it in each if _TELLS.match(it)]
    return next(iter(given or telling or each), "0")


def _dxf(
    curves: Iterable[tuple[list[str], Any]], unit_mm: float, rails: Sequence[str] | None
) -> bytes:
    """Return curves as a DXF in mm."""
    out: list[tuple[int, Any]] = [
        (0, "SECTION"),
        (2, "HEADER"),
        (9, "$ACADVER"),
        (1, "AC1015"),
        (9, "$INSUNITS"),
        (70, 4),
        (0, "ENDSEC"),
        (0, "SECTION"),
        (2, "ENTITIES"),
    ]
    for names, curve in curves:
        layer = _name(names, rails)
        for piece in _pieces(curve):
            out += _entity(piece, layer, unit_mm)
    out += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{value}\n" for code, value in out).encode()


def _pieces(curve: Any) -> Iterator[Any]:  # noqa: ANN401
    """Give the pieces of a curve, which meet in its corners."""
    if isinstance(curve, rhino3dm.PolyCurve):
        for n in range(curve.SegmentCount):
            yield from _pieces(curve.SegmentCurve(n))
    else:
        yield curve


def _point(x: float, y: float, z: float) -> list[tuple[int, Any]]:
    return [(10, repr(x)), (20, repr(y)), (30, repr(z))]


def _entity(curve: Any, layer: str, unit_mm: float) -> list[tuple[int, Any]]:  # noqa: ANN401
    if isinstance(curve, rhino3dm.PolylineCurve):
        points = [curve.Point(n) for n in range(curve.PointCount)]
        out: list[tuple[int, Any]] = [(0, "POLYLINE"), (8, layer), (66, 1), (70, 8)]
        for p in points:
            out += [(0, "VERTEX"), (8, layer), (70, 32)]
            out += _point(p.X * unit_mm, p.Y * unit_mm, p.Z * unit_mm)
        return [*out, (0, "SEQEND"), (8, layer)]
    # Lines and arcs are NURBS too, exactly.
    nurbs = curve.ToNurbsCurve()
    if nurbs is None:
        kind = _kind(curve)
        raise SheetwrightError(f"a {kind} on layer {layer} is no NURBS", "Rebuild it in Rhino.")
    # Rhino leaves out the first and the last knot, which no point depends on.
    knots = list(nurbs.Knots)
    knots = [knots[0], *knots, knots[-1]]
    points = list(nurbs.Points)
    if not all(0.0 < p.W < math.inf for p in points):
        what = f"a {_kind(curve)} on layer {layer} has a point whose weight is not above 0"
        raise SheetwrightError(what, "Rebuild it in Rhino.")
    out = [(0, "SPLINE"), (8, layer), (100, "AcDbSpline")]
    out += [(70, 8 + (4 if nurbs.IsRational else 0)), (71, nurbs.Degree)]
    out += [(72, len(knots)), (73, len(points)), (74, 0)]
    out += [(40, repr(knot)) for knot in knots]
    if nurbs.IsRational:
        out += [(41, repr(p.W)) for p in points]
    for p in points:
        # Homogeneous: its coordinates are multiplied by its weight.
        weight = p.W / unit_mm
        out += _point(p.X / weight, p.Y / weight, p.Z / weight)
    return out


def _obj(meshes: Iterable[tuple[list[str], Any]], unit_mm: float) -> bytes:
    """Return meshes as an OBJ in mm, a group each."""
    lines: list[str] = []
    before = 1
    for names, mesh in meshes:
        # A line that ends in a backslash goes on in the next.
        name = " ".join((names[0] if names else "mesh").replace("\\", "/").split())
        lines.append(f"o {name}")
        for k in range(len(mesh.Vertices)):
            p = mesh.Vertices[k]
            lines.append(f"v {p.X * unit_mm!r} {p.Y * unit_mm!r} {p.Z * unit_mm!r}")
        for k in range(mesh.Faces.Count):
            corners = list(mesh.Faces[k])
            # A triangle has its third corner twice.
            corners = corners[:3] if corners[2] == corners[3] else corners
            lines.append("f " + " ".join(str(before + corner) for corner in corners))
        before += len(mesh.Vertices)
    return "\n".join([*lines, ""]).encode()


@dataclass
class _Drawn:
    """A polyline or a circle of a DXF of ours."""

    layer: str = "0"
    closed: bool = False
    points: list[tuple[float, float]] = field(default_factory=list)
    """Its points, or the middle of a circle."""
    bulges: list[float] = field(default_factory=list)
    """Of the step from each point to the next, as DXF has it: 0 where it is straight."""
    radius: float | None = None

    def placed(self, left: float) -> tuple[Any, float]:
        """Return the curve, moved to the right by ``left``, and the largest x of it."""
        at = [rhino3dm.Point3d(left + x, y, 0.0) for x, y in self.points]
        if self.radius is not None:
            return rhino3dm.ArcCurve.CreateFromCircle(rhino3dm.Circle(at[0], self.radius)), at[
                0
            ].X + self.radius
        if self.closed:
            at.append(at[0])
        reach = max(p.X for p in at)
        if not any(self.bulges):
            line = rhino3dm.Polyline()
            for p in at:
                line.Add(p.X, p.Y, p.Z)
            return line.ToPolylineCurve(), reach
        joined = rhino3dm.PolyCurve()
        for p, q, bulge in zip(at, at[1:], self.bulges, strict=False):
            if bulge == 0.0:
                joined.Append(rhino3dm.Line(p, q))
                continue
            # The middle of the arc lies to the right of its chord where the bulge is above 0.
            across = (q.Y - p.Y, p.X - q.X)
            x, y = (
                (a + b + bulge * c) / 2
                for a, b, c in zip((p.X, p.Y), (q.X, q.Y), across, strict=True)
            )
            joined.Append(rhino3dm.Arc(p, rhino3dm.Point3d(x, y, 0.0), q))
            reach = max(reach, x)
        return joined, reach


def _records(text: str) -> Iterator[tuple[str, dict[str, str]]]:
    """Give the kind of each record of a DXF, and its values by their codes."""
    lines = [line.strip() for line in text.splitlines()]
    kind, values = "", dict[str, str]()
    for code, value in zip(lines[::2], lines[1::2], strict=False):
        if code == "0":
            yield kind, values
            kind, values = value, {}
        values[code] = value
    yield kind, values


def _drawn(text: str) -> Iterator[_Drawn]:
    """Give the polylines and circles of a DXF of ours."""
    now = _Drawn()
    for kind, values in _records(text):
        if kind in ("POLYLINE", "CIRCLE"):
            now = _Drawn(values["8"], closed=bool(int(values.get("70", "0")) & 1))
        if kind in ("VERTEX", "CIRCLE"):
            now.points.append((float(values["10"]), float(values["20"])))
            now.bulges.append(float(values.get("42", "0")))
        if kind == "CIRCLE":
            now.radius = float(values["40"])
        if kind == "CIRCLE" or (kind == "SEQEND" and len(now.points) > 1):
            yield now


def _attributes(model: Any, layers: dict[str, int], layer: str, name: str) -> Any:  # noqa: ANN401
    if layer not in layers:
        new = rhino3dm.Layer()
        new.Name = layer
        layers[layer] = model.Layers.Add(new)
    about = rhino3dm.ObjectAttributes()
    about.LayerIndex, about.Name = layers[layer], name
    return about


def main() -> int:
    """Run the program; returns its exit status, which is that of the command."""
    parser = argparse.ArgumentParser(prog="python -m pysheetwright.rhino")
    parser.add_argument("input", help="a 3DM with curves or meshes")
    parser.add_argument("output", help="the 3DM for the patterns and surfaces")
    parser.add_argument("--material", help="the material, such as steel-1mm")
    parser.add_argument("--rails", help="the curves or layers that are rails, with commas")
    given = parser.parse_args()
    try:
        rails = given.rails.split(",") if given.rails else None
        settings: making.Settings = {"material": given.material} if given.material else {}
        made = make(given.input, rails=rails, **settings)
        write(made, given.output)
    except (SheetwrightError, OSError) as error:
        sys.stderr.write(f"error: {error}\n")
        return 2
    for part in made.parts:
        sys.stdout.write(f"{part.name}: {part.verdict}\n")
        for finding in part.findings:
            sys.stdout.write(f"  {finding.severity}: {finding.text}\n")
    return 0 if made.ok else 1


if __name__ == "__main__":
    sys.exit(main())
