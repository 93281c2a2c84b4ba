"""Shapes and meanings of arrays, errors, threads."""

from __future__ import annotations

import json
import pickle
import threading
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pysheetwright as sw

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray


def saddle(height: float, count: int = 80) -> NDArray[np.float64]:
    """Return a loop whose height changes four times as it goes round, of shape (N, 3)."""
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.column_stack([300 * np.cos(t), 200 * np.sin(t), height * np.cos(2 * t)])


def rails() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    chine = np.array([[0, 0, 0], [900, 310, 40], [1800, 420, 60]], dtype=float)
    sheer = np.array([[-80, 0, 300], [900, 450, 320], [1800, 560, 330]], dtype=float)
    return chine, sheer


def test_shapes_are_those_of_the_docs() -> None:
    part = sw.solve(rails=rails())
    vertices, faces, rungs = len(part.vertices), len(part.faces), len(part.rungs)
    assert part.vertices.shape == (vertices, 3)
    assert part.flat.shape == (vertices, 2)
    assert part.origin.shape == (vertices,)
    assert part.faces.shape == (faces, 3)
    assert part.stretches.shape == (faces, 2)
    assert part.rungs.shape == (rungs, 2)
    assert part.rulings.shape == (rungs, 2, 3)
    assert part.warp_deg.shape == part.crease_deg.shape == (rungs,)
    assert part.outline.shape[1] == 2
    assert part.holes == []
    assert (vertices, faces, rungs) == (400, 398, 397)
    assert np.array_equal(part.rulings, part.vertices[part.rungs])
    assert part.warp_deg.max() == part.warp_max_deg
    assert part.verdict == "bends"
    # Laid flat, no side of a triangle changes its length.
    sides = part.faces[:, [0, 1, 2, 0]]
    space = np.linalg.norm(np.diff(part.vertices[sides], axis=1), axis=2)
    flat = np.linalg.norm(np.diff(part.flat[sides], axis=1), axis=2)
    assert np.allclose(space, flat, rtol=1e-9)
    # The outline lies where its vertices do, and its area is that of the part.
    x, y = part.outline.T
    area = 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
    assert area == pytest.approx(part.area_flat_mm2, rel=1e-9)


def test_holes_stay_holes() -> None:
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    rim = np.column_stack([300 * np.cos(t), 200 * np.sin(t), 0 * t])
    hatch = np.column_stack([40 * np.cos(t), 40 * np.sin(t), 0 * t])
    part = sw.solve(rim, holes=[hatch[::-1]])
    assert len(part.holes) == 1
    assert part.holes[0].shape == (60, 2)
    assert part.area_flat_mm2 == pytest.approx(np.pi * (300 * 200 - 40 * 40), rel=0.01)


def test_other_arrays_are_copied_as_they_are() -> None:
    loop = saddle(20)
    want = sw.solve(loop)
    for other in (loop.tolist(), loop.astype(np.float64, order="F"), np.repeat(loop, 2, 0)[::2]):
        assert np.array_equal(sw.solve(other).flat, want.flat)
    assert sw.solve(loop.astype(np.float32)).verdict == want.verdict


def test_arrays_that_lie_oddly_in_memory_are_read_right() -> None:
    loop = saddle(20)
    want = sw.solve(loop).flat
    # Fields of packed records: rows are 28 bytes apart.
    records = np.zeros(80, dtype=[("id", "i4"), ("p", "f8", 3)])
    records["p"] = loop
    # Numbers that begin in the middle of a word.
    shifted = np.frombuffer(b"head" + loop.tobytes(), "<f8", offset=4).reshape(80, 3)
    big_ended = loop.astype(">f8")
    for odd in (records["p"], shifted, big_ended, loop[::-1][::-1]):
        assert np.array_equal(sw.solve(odd).flat, want)
    rows = sw.solve_many([records["p"], shifted], outlines=True)
    assert np.array_equal(rows["outline"][0], rows["outline"][1])
    assert rows["area_flat_mm2"][0] == sw.solve_many([loop])["area_flat_mm2"][0]


def test_none_is_as_left_out() -> None:
    loop = saddle(20)
    none = sw.solve(loop, samples=None, tolerance=None, holes=None)  # type: ignore[arg-type]
    assert np.array_equal(none.flat, sw.solve(loop).flat)
    assert sw.template("cone", height=None) == sw.template("cone")
    rows = sw.solve_many([{"boundary": loop, "holes": None}], samples=None)  # type: ignore[arg-type]
    assert rows["area_flat_mm2"][0] == sw.solve_many([loop])["area_flat_mm2"][0]


def test_numbers_of_numpy_are_numbers() -> None:
    want = sw.template("cone", bottom=400.0)
    numbers = (np.float64(400), np.float32(400), np.int64(400), np.array(400.0), 400, "400")
    for number in numbers:
        assert sw.template("cone", bottom=number) == want
    stations = sw.template("cone", bottom=np.float64(410.5))
    assert stations == sw.template("cone", bottom=410.5)


def test_one_sheet_needs_no_list() -> None:
    design = sw.template("cone")

    def used(sheets: Any) -> Any:  # noqa: ANN401
        return sw.make(design, sheets=sheets).report["sheets"]

    feet = used(["4x8ft"])
    assert feet["list"]
    assert used("4x8ft") == feet
    metres = used([(1000, 2000)])
    assert metres["list"]
    for one in ((1000, 2000), [1000.0, 2000.0], np.array([1000, 2000]), np.array([[1000, 2000]])):
        assert used(one) == metres
    assert len(used([(600, 600), (1000, 2000)])["list"]) >= 1
    for bad in ((1000,), [(1000, 2000, 3)], [None], 1000, (np.nan, 1000), [(-1, 1000)]):
        with pytest.raises(sw.SheetwrightError, match="is no sheet") as raised:
            used(bad)
        assert raised.value.hint


OUT_OF_RANGE: list[dict[str, Any]] = [
    {name: number}
    for name, numbers in {
        "thickness": (0, -1, 1001),
        "bend_radius": (-1, 1001),
        "allowance": (0, -3),
        "gap": (-1, 1e10),
        "margin": (-1,),
        "kerf": (-0.1,),
        "split_creases": (0, 180),
        "vary_limit": (-1,),
        "vary_budget": (-1,),
        "vary_warp": (0, 91),
        "vary_strain": (0, 1.1),
        "effort": (0, 1e4),
        "tolerance": (0, -1),
    }.items()
    for number in (*numbers, np.nan, np.inf, -np.inf)
]
OUT_OF_RANGE += [{"pieces_within": (0, 100)}, {"pieces_within": (100, np.nan)}, {"samples": -5}]


@pytest.mark.parametrize("setting", OUT_OF_RANGE, ids=str)
def test_settings_out_of_range_are_refused(setting: Any) -> None:  # noqa: ANN401
    with pytest.raises(sw.SheetwrightError) as raised:
        sw.make(sw.template("cone"), **({"sheets": "4x8ft", "dimensions": "mean"} | setting))
    assert raised.value.hint


def test_settings_of_files_out_of_range_are_refused() -> None:
    made = sw.make(sw.template("cone"))
    for name, numbers in {
        "stations": (0, -1, np.nan, np.inf),
        "arcs": (0, 11, np.nan),
        "die": (0, np.nan),
        "brake_length": (-1, np.inf),
        "max_sheets": (0, -1, 10**9),
    }.items():
        for number in numbers:
            options: Any = {name: number}
            with pytest.raises(sw.SheetwrightError, match=name) as raised:
                made.files(["pdf"], **options)
            assert raised.value.hint


def test_common_lines_replace_what_a_design_says() -> None:
    design = sw.template("cone") | {"sheets": {"sizes": [{"size": [1000, 2000]}]}}
    design["sheets"]["common_lines"] = True
    assert sw.make(design).design["sheets"]["common_lines"]
    assert "common_lines" not in sw.make(design, common_lines=False).design["sheets"]
    # Without common lines, a gap is no contradiction.
    assert sw.make(design, common_lines=False, gap=7).design["sheets"]["gap"] == "7 mm"


def test_kinds_of_curves() -> None:
    corners = [[0, 0, 0], [400, 0, 0], [400, 300, 0], [0, 300, 0]]
    assert sw.solve(corners, kind="polyline").area_flat_mm2 == pytest.approx(120_000)
    assert sw.solve(corners, samples=100).area_flat_mm2 > 125_000
    with pytest.raises(sw.SheetwrightError, match="kind") as raised:
        sw.solve(corners, kind="curvy")  # type: ignore[arg-type]
    assert raised.value.hint == "Give one of samples, polyline, spline, bspline."


def test_errors_have_hints(tmp_path: Path) -> None:
    with pytest.raises(sw.SheetwrightError, match="no such file") as raised:
        sw.make(tmp_path / "missing.csv")
    assert raised.value.hint == "Check the path and the spelling."
    assert raised.value.place == str(tmp_path / "missing.csv")
    assert str(raised.value).endswith("\nhint: Check the path and the spelling.")
    kept = pickle.loads(pickle.dumps(raised.value))  # noqa: S301
    assert (kept.message, kept.hint, kept.place) == raised.value.args
    assert isinstance(kept, ValueError)
    with pytest.raises(sw.SheetwrightError, match="material"):
        sw.solve(saddle(20), material="papper")
    with pytest.raises(sw.SheetwrightError, match="shape"):
        sw.solve(np.zeros((5, 2)))
    with pytest.raises(sw.SheetwrightError, match="needs at least 3"):
        sw.solve(np.zeros((2, 3)))
    with pytest.raises(sw.SheetwrightError, match="boundary or two rails"):
        sw.solve()
    with pytest.raises(TypeError, match="sampels"):
        sw.solve(saddle(20), sampels=20)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="samples"):
        sw.solve(saddle(20), samples="many")  # type: ignore[arg-type]
    made = sw.make(sw.template("cone"))
    with pytest.raises(sw.SheetwrightError, match="wings"):
        made.files(wings=2)  # type: ignore[call-arg]
    with pytest.raises(sw.SheetwrightError, match="formats"):
        made.files(["doc"])


def test_designs_come_as_dicts_texts_and_bytes() -> None:
    design = sw.template("cone", height=250)
    want = sw.make(design)
    assert want.ok
    assert want.design["panels"]
    text = json.dumps(design)
    for other in (text, text.encode()):
        assert sw.make(other).report == want.report
    assert sw.make(want.design).parts[0].area_flat_mm2 == want.parts[0].area_flat_mm2
    table = b"x,y,z\n0,0,0\n100,0,0\n100,50,0\n0,50,0\n"
    assert sw.make(table, name="plate").parts[0].name == "plate"
    with pytest.raises(sw.SheetwrightError, match="show no format"):
        sw.make(b"\x00\x01")


def test_flatten_gives_every_vertex_its_place() -> None:
    # Half a tube, which unrolls without stretch; and a cap of a ball, which does not.
    u, v = np.meshgrid(np.linspace(0, np.pi, 25), np.linspace(0, 1, 9), indexing="ij")
    tube = np.column_stack([f.ravel() for f in (50 * np.cos(u), 50 * np.sin(u), 200 * v)])
    n = np.arange(24 * 9).reshape(24, 9)[:, :8].ravel()
    faces = np.vstack([np.column_stack([n, n + 9, n + 10]), np.column_stack([n, n + 10, n + 1])])
    flat = sw.flatten(tube, faces)
    assert flat.flat.shape == (225, 2)
    assert flat.strain.shape == (len(faces),)
    assert flat.stretches.shape == (len(faces), 2)
    assert flat.ended == "true"
    assert flat.length_error_max < 1e-9
    r, a = np.meshgrid(np.linspace(0.1, 1, 9), np.linspace(0, np.pi, 25), indexing="ij")
    ball = [100 * f for f in (np.sin(r) * np.cos(a), np.sin(r) * np.sin(a), np.cos(r))]
    cap = np.column_stack([f.ravel() for f in ball])
    n = np.arange(8 * 25).reshape(8, 25)[:, :24].ravel()
    faces = np.vstack([np.column_stack([n, n + 25, n + 26]), np.column_stack([n, n + 26, n + 1])])
    assert sw.flatten(cap, faces).strain.max() > 0.01
    with pytest.raises(sw.SheetwrightError, match="belongs to no face"):
        sw.flatten(np.vstack([cap, [[0, 0, 0]]]), faces)
    with pytest.raises(sw.SheetwrightError, match="corner"):
        sw.flatten(cap, faces + 1000)


def test_nest_keeps_parts_apart() -> None:
    square = np.array([[0, 0], [100, 0], [100, 100], [0, 100]], dtype=float)
    layout = sw.nest(
        [square, [[0, 0], [80, 0], [0, 60]]], (330, 230), counts=[4, 2], gap=5, effort=0.02
    )
    assert layout.part.tolist() == [0, 0, 0, 0, 1, 1]
    assert layout.left_over == []
    assert np.array_equal(layout.sheets[0], [330, 230])
    assert layout.maps.shape == (6, 2, 3)
    assert len(layout.used) == len(layout.sheets)
    for part, move, laid in zip(layout.part, layout.maps, layout.outlines, strict=True):
        if part == 0:
            assert np.allclose(square @ move[:, :2].T + move[:, 2], laid)
        assert (laid > 5 - 0.01).all()
        assert (laid < np.array([330, 230]) - 5 + 0.01).all()
    roll = sw.nest([square], "roll:150mm", counts=[2])
    assert roll.sheets[0, 1] == 150
    assert sw.nest([square], (50, 50)).left_over == [0]
    with pytest.raises(sw.SheetwrightError, match="sheet"):
        sw.nest([square], "large")
    assert sw.nest([square, square], (500, 500), counts=[0, 1]).part.tolist() == [1]


def test_outlines_that_can_not_be_laid_out_are_refused() -> None:
    square = np.array([[0, 0], [100, 0], [100, 100], [0, 100]], dtype=float)
    far = square + 2e9
    wrong: list[Any] = [[], [[]], [5, 6], None, square[:2], [square, []], square * np.nan, far]
    for bad in wrong:
        with pytest.raises(sw.SheetwrightError) as raised:
            sw.nest([bad], (500, 500))
        assert raised.value.hint
    for name, values in {
        "gap": (-1, np.nan, np.inf),
        "margin": (-1, np.nan),
        "effort": (0, -1, 1e4, np.nan),
        "turns": ([np.nan], [np.inf]),
        "counts": ([-1], [2.5], [100_001], [1, 2], [2**62]),
    }.items():
        for value in values:
            given: Any = {name: value}
            with pytest.raises(sw.SheetwrightError, match=name) as raised:
                sw.nest([square], (500, 500), **given)
            assert raised.value.hint


def test_many_are_as_each_alone_with_any_number_of_threads() -> None:
    panels = np.stack([saddle(height) for height in np.linspace(0, 60, 24)])
    one = sw.solve_many(panels, threads=1, outlines=True)
    two = sw.solve_many(list(panels), threads=3, outlines=True)
    assert one["verdict"].shape == (24,)
    for name in one:
        if name == "outline":
            assert all(map(np.array_equal, one[name], two[name]))
        else:
            equal_nan = one[name].dtype == np.float64
            assert np.array_equal(one[name], two[name], equal_nan=equal_nan), name
    for n in (0, 11, 23):
        part = sw.solve(panels[n], verdict="quick")
        assert one["verdict"][n] == part.verdict
        assert one["findings"][n].split() == [finding.code for finding in part.findings]
        assert one["area_flat_mm2"][n] == part.area_flat_mm2
        assert one["warp_max_deg"][n] == part.warp_max_deg
        assert np.array_equal(one["outline"][n], part.outline)
        assert one["strain_limit"][n] == part.strain_limit
        edges = np.roll(part.outline, -1, axis=0) - part.outline
        length = np.linalg.norm(edges, axis=1).sum()
        assert one["outline_length_mm"][n] == pytest.approx(length, rel=1e-12)
    # A flat panel has no radius.
    assert np.isnan(one["bend_radius_min_mm"][0])
    assert (one["bend_radius_min_mm"][1:] > 0).all()
    assert np.array_equal(
        sw.solve_many(panels[:4], threads=10_000)["area_flat_mm2"], one["area_flat_mm2"][:4]
    )


def test_a_bad_panel_is_a_row_among_many() -> None:
    bad = np.array([[0, 0, 0], [1, 0, 0], [np.nan, 1, 0]], dtype=float)
    rows = sw.solve_many([saddle(10), bad, {"rails": rails()}, saddle(20)])
    assert rows["error"][0] == rows["error"][2] == rows["error"][3] == ""
    assert rows["error"][1]
    assert rows["hint"][1]
    assert np.isnan(rows["area_flat_mm2"]).tolist() == [False, True, False, False]
    assert rows["verdict"][1] == ""
    others: list[Any] = [{"rails": 5}, {"holes": 5, "boundary": saddle(10)}, {}, None, 5, "loop"]
    rows = sw.solve_many([*others, saddle(10)])
    assert all(rows["error"][:-1])
    assert all(rows["hint"][:-1])
    assert rows["error"][-1] == ""
    empty = sw.solve_many([])
    assert empty["verdict"].shape == empty["area_flat_mm2"].shape == (0,)
    with pytest.raises(sw.SheetwrightError, match="shape"):
        sw.solve_many(np.zeros((3, 4)))


def test_threads_run_while_panels_are_made() -> None:
    """A thread of Python counts on while another is inside one call of the package."""
    panels = [saddle(height, 400) for height in np.linspace(5, 60, 30)]
    inside = threading.Event()
    counted: list[None] = []

    def count() -> None:
        inside.wait()
        while inside.is_set():
            counted.append(None)
            threading.Event().wait(0.0005)

    counter = threading.Thread(target=count)
    counter.start()
    inside.set()
    sw.solve_many(panels, threads=1)
    inside.clear()
    counter.join()
    # With the lock held it would have had no turn but at the ends of the call.
    assert len(counted) > 10


def test_pictures() -> None:
    part = sw.solve(rails=rails())
    assert part.svg().startswith("<?xml") or part.svg().startswith("<svg")
    assert "<svg" in part._repr_svg_()
    made = sw.make(sw.template("cone"))
    assert made._repr_svg_() == made.svg()
    assert made.files(["svg"])[f"{made.parts[0].name}.svg"].decode() == made.parts[0].svg()


def test_plots(tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    figure = sw.solve(rails=rails()).plot()
    figure.savefig(tmp_path / "plot.png")
    assert (tmp_path / "plot.png").stat().st_size > 10_000
    assert len(figure.axes) == 3


def test_catalogues() -> None:
    assert sw.materials()["steel-1mm"].thickness_mm == 1
    assert sw.templates()["cone"]["parameters"]
    assert {"svg", "dxf", "report"} <= set(sw.formats())
    assert "lightburn" in sw.presets()
    assert sw.trades()
    assert sw.__version__.count(".") == 2
