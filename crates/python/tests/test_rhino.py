"""Files of Rhino: read as the same curves and meshes from elsewhere are, and read back."""

from __future__ import annotations

import math
import re
import runpy
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import rhino3dm as r

import pysheetwright as sw
from pysheetwright import rhino

if TYPE_CHECKING:
    from collections.abc import Sequence


def file_of(
    path: Path,
    things: list[tuple[str, str, Any]],
    unit: Any = r.UnitSystem.Millimeters,  # noqa: ANN401
    hidden: Sequence[str] = (),
) -> Path:
    """A 3DM of (layer, name, geometry), with these layers off."""
    model = r.File3dm()
    model.Settings.ModelUnitSystem = unit
    layers = {}
    for layer, name, geometry in things:
        if layer not in layers:
            new = r.Layer()
            new.Name, new.Visible = layer, layer not in hidden
            layers[layer] = model.Layers.Add(new)
        about = r.ObjectAttributes()
        about.LayerIndex, about.Name = layers[layer], name
        add = model.Objects.AddMesh if isinstance(geometry, r.Mesh) else model.Objects.AddCurve
        add(geometry, about)
    assert model.Write(str(path), 7)
    return path


def points(rows: list[tuple[float, ...]]) -> list[Any]:
    return [r.Point3d(*map(float, row)) for row in rows]


def half(radius: float, z: float) -> Any:  # noqa: ANN401
    """Half a circle at a height, as Rhino has it: a rational curve."""
    circle = r.Circle(r.Point3d(0, 0, z), radius)
    return r.NurbsCurve.CreateFromArc(r.Arc(circle, math.pi))


def test_rails_with_weights_make_half_a_cylinder(tmp_path: Path) -> None:
    things = [("rail", "low", half(50, 0)), ("rail", "high", half(50, 200))]
    made = rhino.make(file_of(tmp_path / "half.3dm", things), material="paper")
    [part] = made.parts
    assert part.area_flat_mm2 == pytest.approx(math.pi * 50 * 200, rel=2e-5)
    size = sorted([part.flat_width_mm, part.flat_height_mm])
    assert size == pytest.approx([math.pi * 50, 200], rel=2e-5)


@pytest.mark.parametrize(
    ("unit", "mm"),
    [
        (r.UnitSystem.Inches, 25.4),
        (r.UnitSystem.Meters, 1000.0),
        (r.UnitSystem.Decimeters, 100.0),
        (r.UnitSystem.Yards, 914.4),
    ],
)
def test_the_file_says_its_unit(tmp_path: Path, unit: Any, mm: float) -> None:  # noqa: ANN401
    square = points([(0, 0, 0), (3, 0, 0), (3, 2, 0), (0, 2, 0), (0, 0, 0)])
    things = [("outline", "", r.PolylineCurve(square))]
    [part] = rhino.make(file_of(tmp_path / "a.3dm", things, unit)).parts
    assert part.area_flat_mm2 == pytest.approx(6 * mm * mm, rel=1e-9)


@pytest.mark.parametrize("rails", [["keel", "Chine"], ["A", "b"], ["keel", "b"]])
def test_rails_name_curves_or_layers(tmp_path: Path, rails: list[str]) -> None:
    # A curve of another name and layer is there as well, and one that says to be no rail.
    things = [
        ("keel", "a", half(50, 0)),
        ("chine", "b", half(50, 200)),
        ("deck", "c", half(70, 300)),
        ("rail", "notes", half(90, 400)),
    ]
    made = rhino.make(file_of(tmp_path / "half.3dm", things), rails=rails, material="paper")
    [part] = made.parts
    assert part.area_flat_mm2 == pytest.approx(math.pi * 50 * 200, rel=2e-5)


@pytest.mark.parametrize("rails", [["hull"], ["low", "high"]])
def test_named_curves_of_a_layer_of_rails(tmp_path: Path, rails: list[str]) -> None:
    # Names that tell a role give way to the names of rails.
    things = [("Hull", "low", half(50, 0)), ("Hull", "high", half(50, 200))]
    things.append(("rail", "deck", half(70, 300)))
    [part] = rhino.make(file_of(tmp_path / "half.3dm", things), rails=rails).parts
    assert part.area_flat_mm2 == pytest.approx(math.pi * 50 * 200, rel=2e-5)


ROLES = Path(__file__).parents[2] / "files/src/linework/roles.rs"
MARKS = re.findall(r'\("(\w+)", Role::Mark\)', ROLES.read_text())


@pytest.mark.parametrize("mark", ["Notes", *MARKS])
def test_marks_bound_nothing(tmp_path: Path, mark: str) -> None:
    def square(size: float, at: float) -> Any:  # noqa: ANN401
        corners = [(at, 0), (at + size, 0), (at + size, size), (at, size), (at, 0)]
        return r.PolylineCurve(points([(x, y, 0) for x, y in corners]))

    # Without its name, the box would be an outline as the plate is one.
    things = [("0", "plate", square(60, 0)), (mark, "title box", square(30, 100))]
    [part] = rhino.make(file_of(tmp_path / "a.3dm", things)).parts
    assert part.area_flat_mm2 == pytest.approx(3600)
    # The name of a curve comes before that of its layer.
    things = [("outline", mark, square(20, 200)), (mark, "outline", square(10, 300))]
    [part] = rhino.make(file_of(tmp_path / "b.3dm", things)).parts
    assert part.area_flat_mm2 == pytest.approx(100)
    # Words that only begin so tell nothing.
    things = [(f"{mark}é", "", square(60, 0))]
    [part] = rhino.make(file_of(tmp_path / "c.3dm", things)).parts
    assert part.area_flat_mm2 == pytest.approx(3600)


def test_a_polycurve_keeps_its_corners_and_its_hole(tmp_path: Path) -> None:
    outline = r.PolyCurve()
    outline.Append(r.Line(r.Point3d(0, 0, 0), r.Point3d(100, 0, 0)))
    outline.Append(r.Line(r.Point3d(100, 0, 0), r.Point3d(100, 60, 0)))
    # Half a circle from the one corner to the other.
    bow = r.Arc(r.Point3d(100, 60, 0), r.Point3d(50, 110, 0), r.Point3d(0, 60, 0))
    outline.Append(bow)
    outline.Append(r.Line(r.Point3d(0, 60, 0), r.Point3d(0, 0, 0)))
    hole = r.NurbsCurve.CreateFromCircle(r.Circle(r.Point3d(50, 40, 0), 20))
    things = [("outline", "plate", outline), ("hole", "", hole)]
    [part] = rhino.make(file_of(tmp_path / "plate.3dm", things)).parts
    assert part.area_flat_mm2 == pytest.approx(6000 + math.pi * 1250 - math.pi * 400, rel=2e-4)
    # Where the bow begins and ends, the outline is smooth.
    corners = np.array([(0, 0), (100, 0)], dtype=float)
    space = part.vertices[:, :2]
    gaps = [np.linalg.norm(space - corner, axis=1).min() for corner in corners]
    assert max(gaps) < 1e-9
    assert len(part.holes) == 1


def test_a_free_curve_is_that_of_a_dxf_with_its_knots(tmp_path: Path) -> None:
    # A cubic with uneven knots: its points are those of De Boor's algorithm in Rhino.
    low = r.NurbsCurve.Create(
        False,  # noqa: FBT003
        3,
        points([(0, 0, 0), (10, 30, 0), (90, 40, 5), (100, 0, 0), (150, 0, 9)]),
    )
    high = low.Duplicate()
    high.Translate(r.Vector3d(0, 0, 80))
    [part] = rhino.make(
        file_of(tmp_path / "free.3dm", [("rail", "a", low), ("rail", "b", high)]), samples=40
    ).parts
    domain = low.Domain
    on_curve = [low.PointAt(t) for t in np.linspace(domain.T0, domain.T1, 4000)]
    curve = np.array([(p.X, p.Y, p.Z) for p in on_curve])
    below = part.vertices[:40] if part.vertices[0][2] < 40 else part.vertices[40:]
    gaps = [np.linalg.norm(curve - p, axis=1).min() for p in below]
    assert max(gaps) < 0.05


def test_meshes_are_those_of_an_obj(tmp_path: Path) -> None:
    mesh = r.Mesh()
    corners = [(0, 0, 50), (100, 0, 50), (0, 80, 0), (100, 80, 0), (0, -80, 0), (100, -80, 0)]
    for corner in corners:
        mesh.Vertices.Add(*map(float, corner))
    mesh.Faces.AddFace(0, 2, 3, 1)
    mesh.Faces.AddFace(0, 1, 5, 4)
    path = file_of(tmp_path / "roof.3dm", [("any", "roof", mesh)])
    [part] = rhino.make(path, material="steel-1mm").parts
    faces = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4)]
    [other] = sw.make_mesh(corners, faces, material="steel-1mm").parts
    assert (part.name, part.verdict) == ("roof", other.verdict)
    assert part.area_flat_mm2 == pytest.approx(other.area_flat_mm2, rel=1e-12)


def test_patterns_lie_on_the_layers_of_the_dxf_and_surfaces_in_space(tmp_path: Path) -> None:
    made = sw.make(sw.template("cone", bottom=400, top=180, height=300, material="steel-1mm"))
    path = tmp_path / "cone-out.3dm"
    rhino.write(made, path)
    assert [it.name for it in tmp_path.iterdir()] == ["cone-out.3dm"]
    model = r.File3dm.Read(str(path))
    assert model.Settings.ModelUnitSystem == r.UnitSystem.Millimeters
    names = {layer.Index: layer.Name for layer in model.Layers}
    by_layer: dict[str, list[Any]] = {}
    for it in model.Objects:
        assert it.Attributes.Name == "cone"
        by_layer.setdefault(names[it.Attributes.LayerIndex], []).append(it.Geometry)
    assert {"cut", "engrave", "note", "surface"} <= set(by_layer)
    [part] = made.parts
    [outline] = by_layer["cut"]
    at = [outline.Point(n) for n in range(outline.PointCount)]
    back = np.array([(p.X, p.Y) for p in at])
    # As the DXF has them, to the bit; closed.
    assert np.array_equal(back[:-1] - back[0], part.outline - part.outline[0])
    assert np.array_equal(back[0], back[-1])
    [surface] = by_layer["surface"]
    assert surface.Faces.Count == len(part.faces)
    # Rhino's meshes have single precision.
    space = np.array(
        [(p.X, p.Y, p.Z) for p in (surface.Vertices[n] for n in range(len(part.vertices)))]
    )
    assert np.allclose(space, part.vertices, rtol=0, atol=1e-4)


def test_drilled_holes_and_arcs_stay_what_they_are(tmp_path: Path) -> None:
    path = tmp_path / "out.3dm"
    holed = sw.make(sw.template("dinghy"), trade="boat")
    rhino.write(holed, path)
    curves = [it.Geometry for it in r.File3dm.Read(str(path)).Objects]
    circles = [it for it in curves if isinstance(it, r.ArcCurve)]
    drawn = sum(data.count(b"\nCIRCLE\r\n") for data in holed.files(["dxf"], dxf="r12").values())
    assert len(circles) == drawn > 0
    assert {round(it.Radius, 6) for it in circles} == {0.75}
    # A card machine's layers have other names in its own files.
    bowed = sw.make(sw.template("cone", bottom=400, top=180, height=300), trade="card")
    straight = tmp_path / "straight.3dm"
    rhino.write(bowed, straight)
    names = {layer.Name for layer in r.File3dm.Read(str(straight)).Layers}
    assert "cut" in names
    assert names <= {"cut", "score", "engrave", "note", "net", "surface"}


def test_arcs_pass_through_what_they_stand_for() -> None:
    text = "0\nPOLYLINE\n8\ncut\n70\n1\n"
    for x, y, bulge in [(0, 0, 0), (20, 0, 1.0), (20, 10, 0), (0, 10, -1.0)]:
        text += f"0\nVERTEX\n8\ncut\n10\n{x}\n20\n{y}\n42\n{bulge}\n"
    [drawn] = rhino._drawn(text + "0\nSEQEND\n0\nENDSEC\n")  # noqa: SLF001
    curve, reach = drawn.placed(100.0)
    assert reach == 125.0
    outline = r.PolyCurve.ToNurbsCurve(curve)
    at = [
        outline.PointAt(outline.Domain.T0 + (outline.Domain.T1 - outline.Domain.T0) * k / 400)
        for k in range(400)
    ]
    # Half a circle outwards on the right, one inwards on the left.
    assert max(p.X for p in at) == pytest.approx(125, abs=0.01)
    assert any(abs(p.X - 105) < 0.05 and abs(p.Y - 5) < 0.3 for p in at)


def test_what_can_not_be_used_is_said(tmp_path: Path) -> None:
    text = tmp_path / "text.3dm"
    text.write_text("no model")
    with pytest.raises(sw.SheetwrightError, match="no 3DM file"):
        rhino.make(text)
    with pytest.raises(FileNotFoundError):
        rhino.make(tmp_path / "none.3dm")
    bare = r.File3dm()
    bare.Objects.AddPoint(0, 0, 0)
    bare.Write(str(tmp_path / "bare.3dm"), 7)
    with pytest.raises(sw.SheetwrightError, match=r"no curves and no meshes; there is 1 Point"):
        rhino.make(tmp_path / "bare.3dm")
    square = points([(0, 0, 0), (3, 0, 0), (3, 2, 0), (0, 2, 0), (0, 0, 0)])
    things = [("outline", "", r.PolylineCurve(square))]
    with pytest.raises(sw.SheetwrightError, match="says its unit itself"):
        rhino.make(file_of(tmp_path / "a.3dm", things), units="m")
    with pytest.raises(sw.SheetwrightError, match="unit of the file is LightYears"):
        rhino.make(file_of(tmp_path / "a.3dm", things, r.UnitSystem.LightYears))
    for weight in (0.0, -1.0, math.inf, math.nan):
        bow = half(50, 0)
        bow.Points[1] = r.Point4d(0, 1, 0, weight)
        with pytest.raises(sw.SheetwrightError, match="layer rail has a point whose weight"):
            rhino.make(file_of(tmp_path / "weight.3dm", [("rail", "", bow)]))
    with pytest.raises(sw.SheetwrightError, match="no curves"):
        rhino.make(file_of(tmp_path / "off.3dm", things, hidden=["outline"]))


def test_the_program_answers_as_the_command_does(tmp_path: Path) -> None:
    things = [("rail", "low", half(50, 0)), ("rail", "high", half(50, 200))]
    path = file_of(tmp_path / "half.3dm", things)
    call = [sys.executable, "-m", "pysheetwright.rhino", str(path), str(tmp_path / "out.3dm")]
    done = subprocess.run(
        [*call, "--material", "paper"], check=False, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "bends" in done.stdout
    assert (tmp_path / "out.3dm").exists()
    done = subprocess.run(
        [*call, "--material", "stone"], check=False, capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "the material 'stone' is not known" in done.stderr


def test_the_script_for_the_editor_exports_makes_and_imports(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # A stand-in for Rhino, which can't be run here: it keeps the commands, and exports a file.
    commands: list[str] = []
    things = [("rail", "low", half(50, 0)), ("rail", "high", half(50, 200))]

    def command(text: str, _echo: bool) -> None:  # noqa: FBT001
        commands.append(text)
        path = Path(text.split('"')[1])
        if text.startswith("_-Export"):
            file_of(path, things)
        else:
            # What is imported is there, and is a model.
            assert len(r.File3dm.Read(str(path)).Objects) > 1

    monkeypatch.setitem(sys.modules, "rhinoscriptsyntax", SimpleNamespace(Command=command))
    monkeypatch.setenv("SHEETWRIGHT_PYTHON", sys.executable)
    script = Path(__file__).parents[3] / "addons/rhino/sheetwright_rhino.py"
    unfold = runpy.run_path(str(script))["unfold"]
    assert "bends" in unfold("paper")
    assert [text.split()[0] for text in commands] == ["_-Export", "_-Import"]
    commands.clear()
    assert "is not known" in unfold("stone")
    assert [text.split()[0] for text in commands] == ["_-Export"]
    things.clear()
    assert "no curves" in unfold("")


@pytest.mark.parametrize(("typed", "calls"), [(None, 0), ("", 1)])
def test_esc_ends_the_script_for_the_editor(
    monkeypatch: pytest.MonkeyPatch, typed: str | None, calls: int
) -> None:
    commands: list[str] = []
    stand_in = SimpleNamespace(
        Command=lambda text, _echo: commands.append(text),
        SelectedObjects=lambda: ["a curve"],
        SelectObjects=lambda _chosen: 1,
        GetString=lambda _prompt: typed,
    )
    monkeypatch.setitem(sys.modules, "rhinoscriptsyntax", stand_in)
    script = Path(__file__).parents[3] / "addons/rhino/sheetwright_rhino.py"
    runpy.run_path(str(script), run_name="__main__")
    assert len(commands) == calls
