"""Panels by the million on a Ray cluster, installed with ``pip install pysheetwright[ray]``.

:func:`solve_dataset` is one step of a Ray dataset. :func:`solve_parquet` goes from Parquet files to
Parquet files in shards, each written whole or not at all, and goes on where an earlier run ended.
"""

from __future__ import annotations

import json
import os
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
from ray import data

from pysheetwright import __version__, solve_many
from pysheetwright.errors import SheetwrightError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from numpy.typing import NDArray

    from pysheetwright.making import Settings

SETTINGS = "settings.json"
"""The file of a folder of shards that says how they were made."""


def solve_dataset(
    dataset: data.Dataset,
    *,
    boundary: str = "boundary",
    batch_size: int = 1000,
    outlines: bool = False,
    **settings: Unpack[Settings],
) -> data.Dataset:
    """Return a dataset with the columns of :func:`pysheetwright.solve_many` in place of boundaries.

    The column ``boundary`` has a closed boundary each row: a list of points, each a list of three
    numbers, or one list x, y, z, x, y, z, …. Other columns stay. A row whose panel can't be made
    has its ``error``. Batches of 500 to 2,000 panels keep the cost of Ray far below that of the
    panels.

    With ``outlines``, the column ``outline`` has the points of each pattern as a list of pairs.
    """
    step: Any = _solved
    return dataset.map_batches(
        step,
        batch_size=batch_size,
        batch_format="pyarrow",
        num_cpus=1,
        fn_kwargs={"boundary": boundary, "outlines": outlines, "settings": dict(settings)},
    )


def solve_parquet(
    source: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    folder: str | os.PathLike[str],
    *,
    boundary: str = "boundary",
    shard_rows: int = 2000,
    outlines: bool = False,
    **settings: Unpack[Settings],
) -> dict[str, int]:
    """Solve the panels of Parquet files, and write a Parquet file for every ``shard_rows`` of them.

    ``source`` is a file, a folder of ``*.parquet`` or a list of files, on a disk that all workers
    see, as ``folder`` is. A shard that is there is not made again, so a run that was ended goes on
    when it is called again; a folder whose shards were made with other settings or of other files
    is refused. Returns how many shards there are, how many were made now, and how many rows were.

    A worker reads the groups of rows that its shard is part of, some at a time; write files whose
    groups are no larger than a few shards, else shards read the same rows again and again.
    """
    folder = Path(folder).absolute()
    folder.mkdir(parents=True, exist_ok=True)
    metadata = {file: pq.ParquetFile(file).metadata for file in _files(source)}
    for of_file in metadata.values():
        _refuse_columns(of_file.schema.to_arrow_schema().names, boundary, outlines=outlines)
    counts = {file: of_file.num_rows for file, of_file in metadata.items()}
    shards = list(_shards(counts, folder, shard_rows))
    names = [shard["out"] for shard in shards]
    if len(set(names)) < len(names):
        raise SheetwrightError("two files have one name", "Rename one, or solve them apart.")
    said: dict[str, Any] = {"pysheetwright": __version__, "boundary": boundary}
    said |= {"shard_rows": shard_rows, "outlines": outlines, "settings": dict(settings)}
    said |= {
        "files": [
            {"name": file.name, "rows": rows, "bytes": file.stat().st_size}
            for file, rows in counts.items()
        ]
    }
    _agree(folder / SETTINGS, json.dumps(said, sort_keys=True, indent=1) + "\n")
    missing = [shard for shard in shards if not Path(shard["out"]).exists()]
    rows = 0
    if missing:
        step: Any = _solved_shard
        made = data.from_items(missing, override_num_blocks=len(missing)).map_batches(
            step,
            batch_size=1,
            num_cpus=1,
            fn_kwargs={"boundary": boundary, "outlines": outlines, "settings": dict(settings)},
        )
        rows = sum(row["rows"] for row in made.take_all())
    return {"shards": len(shards), "made": len(missing), "rows": rows}


def _files(source: str | os.PathLike[str] | Sequence[str | os.PathLike[str]]) -> list[Path]:
    if isinstance(source, (str, os.PathLike)):
        path = Path(source)
        return sorted(path.glob("*.parquet")) if path.is_dir() else [path]
    return [Path(path) for path in source]


def _shards(counts: Mapping[Path, int], folder: Path, shard_rows: int) -> Iterable[dict[str, Any]]:
    for file, count in counts.items():
        for start in range(0, count, shard_rows):
            out = folder / f"{file.stem}-{start:09d}.parquet"
            shard = {"file": str(file.absolute()), "start": start, "count": shard_rows}
            yield shard | {"out": str(out)}


def _agree(file: Path, said: str) -> None:
    """Keep what the shards of a folder are made of; refuse shards of other things."""
    kept = file.read_text() if file.exists() else ""
    if kept != said and any(file.parent.glob("*.parquet")):
        message = f"{file.parent} has shards that were made with other settings or files"
        raise SheetwrightError(message, "Name another folder, or remove that one.")
    _write(file, lambda path: path.write_text(said))


def _write(file: Path, write: Any) -> None:  # noqa: ANN401
    """Write a file whole or not at all."""
    waiting = file.with_name(f".{file.name}.{os.getpid()}")
    try:
        write(waiting)
        waiting.replace(file)
    finally:
        waiting.unlink(missing_ok=True)


def _solved_shard(
    shard: dict[str, NDArray[Any]], *, boundary: str, outlines: bool, settings: dict[str, Any]
) -> dict[str, NDArray[np.int64]]:
    [file], [start], [count], [out] = (shard[key] for key in ("file", "start", "count", "out"))
    table = _rows(pq.ParquetFile(file), int(start), int(count))
    solved = _solved(table, boundary=boundary, outlines=outlines, settings=settings)
    _write(Path(out), lambda path: pq.write_table(solved, path))
    return {"rows": np.array([solved.num_rows])}


def _rows(file: pq.ParquetFile, start: int, count: int) -> pa.Table:
    """Read some rows, a batch at a time, and no group of rows that has none of them."""
    wanted, before, skip = [], 0, start
    for group in range(file.num_row_groups):
        after = before + file.metadata.row_group(group).num_rows
        if after <= start:
            skip = start - after
        elif before < start + count:
            wanted.append(group)
        before = after
    kept, left = [], count
    for batch in file.iter_batches(batch_size=min(count, 2000), row_groups=wanted):
        part = batch.slice(min(skip, batch.num_rows), left)
        skip -= min(skip, batch.num_rows)
        left -= part.num_rows
        if part.num_rows:
            kept.append(part)
        if not left:
            break
    return pa.Table.from_batches(kept)


def _refuse_columns(names: Sequence[str], boundary: str, *, outlines: bool) -> None:
    """Refuse a table without boundaries, or one that has a column of the result already."""
    if boundary not in names:
        message = f"there is no column {boundary!r}"
        raise SheetwrightError(message, f"The columns are {', '.join(names)}.")
    result = solve_many([], outlines=outlines)
    taken = [name for name in names if name in result and name != boundary]
    if taken:
        message = f"the column {taken[0]!r} is there already"
        raise SheetwrightError(message, "The result has one of this name: rename it or drop it.")


def _solved(
    table: pa.Table, *, boundary: str, outlines: bool, settings: dict[str, Any]
) -> pa.Table:
    _refuse_columns(table.column_names, boundary, outlines=outlines)
    panels = _boundaries(table.column(boundary))
    columns = solve_many(panels, threads=1, outlines=outlines, **settings)
    kept = table.drop_columns([boundary])
    for name, values in columns.items():
        column = _pairs(values) if name == "outline" else pa.array(values)
        kept = kept.append_column(name, column)
    return kept


def _boundaries(column: pa.ChunkedArray) -> list[Any]:
    """Return the points of each row, of shape (N, 3); what is no list of points, as it is."""
    lists = column.combine_chunks()
    if pa.types.is_list(lists.type) and not lists.null_count:
        offsets, inner = lists.offsets.to_numpy(), lists.values
        # Of points as lists, an offset counts points; else it counts numbers.
        is_nested = pa.types.is_list(inner.type) or pa.types.is_fixed_size_list(inner.type)
        flat = inner.flatten() if is_nested else inner
        starts = offsets if is_nested else offsets // 3
        fits = _are_threes(inner) if is_nested else not (offsets % 3).any()
        if fits and pa.types.is_floating(flat.type) and not flat.null_count:
            points = flat.to_numpy(zero_copy_only=False).reshape(-1, 3)
            return [points[a:b] for a, b in pairwise(starts)]
    return [_points(value) for value in column.to_pylist()]


def _are_threes(points: pa.Array) -> bool:
    """Say whether each point is a list of three numbers."""
    lengths = pc.list_value_length(points)
    return not lengths.null_count and bool(pc.all(pc.equal(lengths, 3), min_count=0).as_py())


def _points(value: Any) -> Any:  # noqa: ANN401
    """Return points that come as one list of numbers, three each, of shape (N, 3)."""
    is_flat = isinstance(value, list) and value and not isinstance(value[0], (list, type(None)))
    if not is_flat or len(value) % 3:
        return value
    return [value[n : n + 3] for n in range(0, len(value), 3)]


def _pairs(outlines: NDArray[Any]) -> pa.Array:
    offsets = np.concatenate([[0], np.cumsum([len(outline) for outline in outlines])])
    flat = np.concatenate([np.empty((0, 2)), *outlines]).ravel()
    pairs = pa.FixedSizeListArray.from_arrays(pa.array(flat), 2)
    return pa.ListArray.from_arrays(pa.array(offsets, type=pa.int32()), pairs)
