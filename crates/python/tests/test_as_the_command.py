"""What the package says and writes is what the command says and writes, to the last bit."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pysheetwright as sw

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

# The numbers of a report that a part has under their own names.
NUMBERS = [
    "price_total",
    "twist_total",
    "warp_max_deg",
    "warp_mean_deg",
    "warp_limit_deg",
    "crease_max_deg",
    "bend_radius_min_mm",
    "strain_p95",
    "strain_limit",
    "outer_fibre",
    "outer_fibre_limit",
    "thickness_mm",
    "hold_moment_n",
    "length_error_max",
    "length_error_mean",
    "area_space_mm2",
    "area_flat_mm2",
    "flat_width_mm",
    "flat_height_mm",
    "proven_optimal",
    "overlaps",
    "verdict",
    "name",
    "method",
]

INPUTS = [
    "examples/ubc-fishing-vessel.sheet.json",
    "examples/square-to-round.sheet.json",
    "examples/leaf.csv",
    "corpus/good/lid-with-hatch.csv",
    "corpus/good/mesh-half-tube.obj",
    "corpus/good/mesh-cube.obj",
]


@pytest.mark.parametrize("name", INPUTS)
def test_reports_and_files_are_those_of_the_command(
    name: str, examples: Path, command: Callable[..., Any], tmp_path: Path
) -> None:
    path = examples.parent / name
    command("make", path, "--out", tmp_path, "--quiet")
    made = sw.make(path)
    report = json.loads((tmp_path / "report.json").read_bytes())
    assert made.report == report
    assert made.material == report["material"]
    for part, told in zip(made.parts, report["panels"], strict=True):
        for number in NUMBERS:
            assert getattr(part, number) == told[number], number
        assert part.strain_range is None or list(part.strain_range) == told["strain_range"]
        for edge, of_edge in zip(part.edges, told["edges"], strict=True):
            assert (edge.name, edge.mates) == (of_edge["name"], of_edge["mates"])
            assert edge.length_flat_mm == of_edge["length_flat_mm"]
            assert edge.difference_mm == of_edge["difference_mm"]
    written = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    del written["timing.json"]
    assert made.files() == written


def test_settings_are_the_options_of_the_command(
    examples: Path, command: Callable[..., Any], tmp_path: Path
) -> None:
    design = examples / "square-to-round.sheet.json"
    options = ["--samples", "120", "--material", "steel-1mm", "--bends", "12", "--verdict", "quick"]
    formats = ["--formats", "dxf,brake,report", "--preset", "lightburn", "--dxf", "r2000"]
    sheets = ["--sheet", "1000x2000mm", "--gap", "4mm"]
    command("make", design, "--out", tmp_path / "a", "--quiet", *options, *formats, *sheets)
    made = sw.make(
        design,
        samples=120,
        material="steel-1mm",
        bends="12",
        verdict="quick",
        sheets=[(1000, 2000)],
        gap=4,
    )
    names = made.write(tmp_path / "b", ["report", "brake", "dxf"], preset="lightburn", dxf="r2000")
    written = {path.name: path.read_bytes() for path in (tmp_path / "b").iterdir()}
    assert sorted(names) == sorted(written)
    by_command = {path.name: path.read_bytes() for path in (tmp_path / "a").iterdir()}
    del by_command["timing.json"]
    assert written == by_command


def test_findings_are_those_of_check(examples: Path, command: Callable[..., Any]) -> None:
    design = examples / "ubc-fishing-vessel.sheet.json"
    said = json.loads(command("check", design, "--json").stdout)
    for part, told in zip(sw.make(design).parts, said["panels"], strict=True):
        found = [(f.severity, f.code, f.text, f.place) for f in part.findings]
        assert found == [
            (f["severity"], f["code"], f["text"], f["where"]) for f in told["findings"]
        ]


def test_points_are_the_rows_of_a_table(
    examples: Path, command: Callable[..., Any], tmp_path: Path
) -> None:
    rows = (examples / "leaf.csv").read_text().splitlines()
    columns = rows[0].split(",")
    at = [columns.index(axis) for axis in "xyz"]
    points = np.array([[float(row.split(",")[n]) for n in at] for row in rows[1:]])
    command("make", examples / "leaf.csv", "--out", tmp_path, "--quiet", "--formats", "report")
    told = json.loads((tmp_path / "report.json").read_bytes())["panels"][0]
    part = sw.solve(points)
    for number in NUMBERS:
        assert number == "name" or getattr(part, number) == told[number], number
    # And so are those of a panel among many.
    row = sw.solve_many([points], verdict="exact")
    for number in ("area_flat_mm2", "warp_max_deg", "strain_p95", "strain_limit", "verdict"):
        assert row[number][0] == told[number], number


def test_a_mesh_of_arrays_is_that_of_a_file(
    corpus: Path, command: Callable[..., Any], tmp_path: Path
) -> None:
    lines = (corpus / "good/mesh-half-tube.obj").read_text().splitlines()
    vertices = [[float(x) for x in line.split()[1:4]] for line in lines if line.startswith("v ")]
    faces = [
        [int(corner.split("/")[0]) - 1 for corner in line.split()[1:]]
        for line in lines
        if line.startswith("f ")
    ]
    triangles = [[face[0], face[n], face[n + 1]] for face in faces for n in range(1, len(face) - 1)]
    text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices)
    text += "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)
    (tmp_path / "mesh.obj").write_text(text)
    command("make", tmp_path / "mesh.obj", "--out", tmp_path / "out", "--quiet")
    made = sw.make_mesh(vertices, triangles)
    assert made.report == json.loads((tmp_path / "out/report.json").read_bytes())


def test_a_template_is_that_of_the_command(command: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "cone.sheet.json"
    command("new", "cone", "--set", "bottom=410.5", "--set", "material=paper", "-o", file)
    assert sw.template("cone", bottom=410.5, material="paper") == json.loads(file.read_bytes())
    pattern = sw.make(sw.template("cone", bottom=410.5)).parts[0]
    assert sw.make(file).parts[0].area_flat_mm2 == pattern.area_flat_mm2


def test_seams_are_the_lines_of_an_obj(command: Callable[..., Any], tmp_path: Path) -> None:
    corners = [[10.0 * (n & 1), 10.0 * (n >> 1 & 1), 10.0 * (n >> 2)] for n in range(8)]
    walls = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    faces = [face for a, b, c, d in walls for face in ([a, b, c], [a, c, d])]
    lid = [[4, 5], [5, 7], [7, 6], [6, 4]]
    made = sw.make_mesh(corners, faces, seams=lid, name="cube", facets=True)
    areas = [part.area_flat_mm2 for part in made.parts]
    assert sorted(round(area) for area in areas) == [100, 500]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    lines += [f"l {a + 1} {b + 1}" for a, b in lid]
    path = tmp_path / "cube.obj"
    path.write_text("\n".join(lines))
    command("make", path, "--facets", "--out", tmp_path / "out", "--quiet")
    report = json.loads((tmp_path / "out" / "report.json").read_bytes())
    assert made.report["panels"] == report["panels"]
    for seams in ([[0, 7]], [[0, 9]], [[-1, 0]]):
        with pytest.raises(sw.SheetwrightError, match="no side of a face"):
            sw.make_mesh(corners, faces, seams=seams)
    assert len(sw.make_mesh(corners, faces, seams=[]).parts) == 1
