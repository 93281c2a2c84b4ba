"""Ray Data on two workers of this machine: what comes out is what one call gives."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pysheetwright as sw

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

ray = pytest.importorskip("ray")
pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")

PANELS = 300
BAD = 7


@pytest.fixture(scope="module", autouse=True)
def _cluster() -> Iterator[None]:
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    ray.data.DataContext.get_current().enable_progress_bars = False
    yield
    ray.shutdown()


def loops() -> list[Any]:
    t = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    plan = np.column_stack([300 * np.cos(t), 200 * np.sin(t), 0 * t])
    lift = np.column_stack([0 * t, 0 * t, np.cos(2 * t)])
    panels: list[Any] = [plan + height * lift for height in np.linspace(0, 80, PANELS)]
    panels[BAD] = panels[BAD][:2]
    return panels


def table(panels: list[Any]) -> Any:  # noqa: ANN401
    ids = [f"panel-{n}" for n in range(len(panels))]
    return pa.table({"id": ids, "boundary": [panel.tolist() for panel in panels]})


def agrees(rows: Any, want: dict[str, Any]) -> None:  # noqa: ANN401
    for name, values in want.items():
        told = np.asarray(rows.column(name).to_pylist())
        equal_nan = values.dtype == np.float64
        assert np.array_equal(told.astype(values.dtype), values, equal_nan=equal_nan), name


def test_a_dataset_gets_the_columns_of_solve_many(tmp_path: Path) -> None:
    from pysheetwright.ray import solve_dataset  # noqa: PLC0415

    panels = loops()
    pq.write_table(table(panels), tmp_path / "in.parquet", row_group_size=64)
    solved = solve_dataset(
        ray.data.read_parquet(str(tmp_path / "in.parquet")), batch_size=64, outlines=True
    )
    solved.write_parquet(str(tmp_path / "out"))
    rows = pa.concat_tables([pq.read_table(path) for path in sorted((tmp_path / "out").iterdir())])
    order = np.argsort([int(name.split("-")[1]) for name in rows.column("id").to_pylist()])
    rows = rows.take(order)
    want = sw.solve_many(panels, outlines=True)
    outlines = want.pop("outline")
    agrees(rows, want)
    assert rows.column("error").to_pylist()[BAD]
    for told, outline in zip(rows.column("outline").to_pylist(), outlines, strict=True):
        assert np.array_equal(np.reshape(told, (-1, 2)), outline)


def test_shards_go_on_where_they_ended(tmp_path: Path) -> None:
    from pysheetwright.ray import solve_parquet  # noqa: PLC0415

    panels = loops()
    # Written as one list of numbers, and in groups of rows that are no shards.
    flat = table(panels).set_column(1, "boundary", pa.array([p.ravel().tolist() for p in panels]))
    pq.write_table(flat, tmp_path / "facade.parquet", row_group_size=70)
    out = tmp_path / "solved"
    first = solve_parquet(tmp_path / "facade.parquet", out, shard_rows=50, material="paper")
    assert first == {"shards": 6, "made": 6, "rows": PANELS}
    shards = sorted(out.glob("*.parquet"))
    whole = [shard.read_bytes() for shard in shards]
    agrees(
        pa.concat_tables([pq.read_table(shard) for shard in shards]),
        sw.solve_many(panels, material="paper"),
    )
    # A run that was ended: two shards are missing, and one was being written.
    shards[1].unlink()
    shards[4].unlink()
    again = solve_parquet(tmp_path / "facade.parquet", out, shard_rows=50, material="paper")
    assert again == {"shards": 6, "made": 2, "rows": 100}
    assert [shard.read_bytes() for shard in shards] == whole
    assert solve_parquet(tmp_path / "facade.parquet", out, shard_rows=50, material="paper") == {
        "shards": 6,
        "made": 0,
        "rows": 0,
    }
    names = {path.name for path in out.iterdir()}
    assert names == {"settings.json", *(shard.name for shard in shards)}
    assert json.loads((out / "settings.json").read_text())["settings"] == {"material": "paper"}
    with pytest.raises(sw.SheetwrightError, match="other settings"):
        solve_parquet(tmp_path / "facade.parquet", out, shard_rows=50, material="steel-1mm")
    # Other panels in a file of the same name.
    pq.write_table(flat.slice(0, 120), tmp_path / "facade.parquet")
    with pytest.raises(sw.SheetwrightError, match="or files"):
        solve_parquet(tmp_path / "facade.parquet", out, shard_rows=50, material="paper")
    assert [shard.read_bytes() for shard in shards] == whole


def test_a_folder_without_shards_takes_other_settings(tmp_path: Path) -> None:
    from pysheetwright.ray import SETTINGS, solve_parquet  # noqa: PLC0415

    pq.write_table(table(loops()[:4]), tmp_path / "few.parquet")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / SETTINGS).write_text("{}\n")
    made = solve_parquet(tmp_path / "few.parquet", tmp_path / "out")
    assert made == {"shards": 1, "made": 1, "rows": 4}
    # Neither a missing file nor a wrong column leaves settings behind.
    with pytest.raises(FileNotFoundError):
        solve_parquet(tmp_path / "none.parquet", tmp_path / "other")
    with pytest.raises(sw.SheetwrightError, match="no column 'edge'"):
        solve_parquet(tmp_path / "few.parquet", tmp_path / "other", boundary="edge")
    assert not list((tmp_path / "other").iterdir())


def test_columns_of_the_result_must_be_free(tmp_path: Path) -> None:
    from pysheetwright.ray import solve_dataset, solve_parquet  # noqa: PLC0415

    rows = table(loops()[:4])
    rows = rows.append_column("verdict", rows.column("id"))
    with pytest.raises(Exception, match="'verdict' is there already"):
        solve_dataset(ray.data.from_arrow(rows)).take_all()
    pq.write_table(rows, tmp_path / "few.parquet")
    with pytest.raises(sw.SheetwrightError, match="'verdict' is there already") as raised:
        solve_parquet(tmp_path / "few.parquet", tmp_path / "out")
    assert "rename" in raised.value.hint


@pytest.mark.parametrize("group", [1, 7, 40, 3000, 10_000])
def test_rows_of_a_shard_are_those_of_the_file(group: int, tmp_path: Path) -> None:
    from pysheetwright.ray import _rows  # noqa: PLC0415

    count = 300 if group < 100 else 9000
    whole = pa.table({"n": range(count)})
    pq.write_table(whole, tmp_path / "n.parquet", row_group_size=group)
    for start, size in ((0, 50), (41, 50), (count - 20, 50), (0, count), (count // 2, 2500)):
        told = _rows(pq.ParquetFile(tmp_path / "n.parquet"), start, size)
        assert told.column("n").to_pylist() == list(range(start, min(start + size, count)))


def test_a_wrong_column_is_said() -> None:
    from pysheetwright.ray import solve_dataset  # noqa: PLC0415

    solved = solve_dataset(ray.data.from_items([{"edge": [0.0, 0.0, 0.0]}]))
    with pytest.raises(Exception, match="no column 'boundary'"):
        solved.take_all()


def test_points_of_any_form_are_read() -> None:
    from pysheetwright.ray import _boundaries  # noqa: PLC0415

    points = [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0], [6.0, 7.0, 8.0]]
    nested = pa.array([points, points[:2]])
    fixed = nested.cast(pa.list_(pa.list_(pa.float64(), 3)))
    flat = pa.array([np.ravel(points).tolist(), np.ravel(points[:2]).tolist()])
    whole = pa.array([[0, 1, 2, 3, 4, 5, 6, 7, 8], [0, 1, 2, 3, 4, 5]])
    for array in (nested, fixed, flat, whole):
        a, b = _boundaries(pa.chunked_array([array]))
        assert np.array_equal(a, points)
        assert np.array_equal(b, points[:2])
    # Points whose numbers add up to two points, but none is one.
    torn = _boundaries(pa.chunked_array([pa.array([[[0.0, 1.0], [2.0, 3.0, 4.0, 5.0]]])]))
    assert torn == [[[0.0, 1.0], [2.0, 3.0, 4.0, 5.0]]]
    flat_pairs = pa.array([[[0.0, 1.0]] * 3]).cast(pa.list_(pa.list_(pa.float64(), 2)))
    assert _boundaries(pa.chunked_array([flat_pairs])) == [[[0.0, 1.0]] * 3]
    assert all(sw.solve_many([*torn, [[0.0, 1.0]] * 3])["error"])
    # Two rows whose numbers fit together only by accident, and a row without any.
    odd = _boundaries(pa.chunked_array([pa.array([[1.0, 2.0], [3.0, 4.0, 5.0, 6.0], None])]))
    assert odd == [[1.0, 2.0], [3.0, 4.0, 5.0, 6.0], None]
    rows = sw.solve_many(odd)
    assert all(rows["error"])
