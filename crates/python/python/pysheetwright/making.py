"""The functions, with their keywords: they hand arrays and settings to the Rust half."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Mapping
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypedDict, Unpack

import numpy as np

from pysheetwright import _native
from pysheetwright.errors import SheetwrightError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import ArrayLike, NDArray

    from pysheetwright._native import FlatMesh, Layout, Made, Part

Sheet: TypeAlias = "str | tuple[float, float]"
"""A sheet: its width and height in mm, or a text such as ``"3x1220x2440mm"``, three of that size,
``"4x8ft"`` or ``"roll:1370mm"``."""

Kind: TypeAlias = Literal["samples", "polyline", "spline", "bspline"]
"""How points make a curve."""


class Settings(TypedDict, total=False):
    """The settings of :func:`make`, :func:`solve`, :func:`make_mesh` and :func:`solve_many`.

    They are called as the options of the command are, which explains each in ``sheetwright make
    --help``, and replace what a design says itself. Lengths are mm, angles degrees.
    """

    samples: int
    """Samples of each outer loop or rail."""
    tolerance: float
    """How near the polygon through the samples stays to the curves, in place of their number."""
    fold: float
    """The price of folds, 0 to 10."""
    effort: float
    """How much work searches may do, as a multiple of the default."""
    verdict: Literal["exact", "quick"]
    """Whether verdicts come from an elastic sheet or from a formula."""
    method: Literal["optimal", "bridge", "rails"]
    """Which triangulations are searched."""
    side: Literal["cheapest", "other"]
    """Which surface, where two fit the boundary about as well."""
    plane: Literal["auto", "none"] | tuple[float, float, float]
    """The supporting plane, or its normal."""
    slide: bool
    """Whether edges slide along the boundary while the sheet is bent."""
    units: Literal["mm", "cm", "m", "in", "ft"]
    """The unit of a table, a drawing or a mesh."""
    material: str
    """The material by its name; :func:`materials` has them."""
    thickness: float
    """How thick the sheet is."""
    dimensions: Literal["inside", "mean", "outside"]
    """The face of the sheet that the curves lie on."""
    bend_radius: float
    """The inner radius of the tool that makes sharp folds."""
    trade: str
    """The trade that it is made for, which has trims and formats of its own."""
    allowance: float
    """The width of a strip along all edges."""
    bends: str
    """How many bend lines: ``"24"``, ``"5deg"``, ``"pitch=20mm"`` or ``"chord=0.5mm"``."""
    bend_marks: Literal["ticks", "lines", "rulings", "none"]
    """How bend lines are drawn."""
    vary_limit: float
    """How far each sample may move so that the sheet bends better."""
    vary_budget: float
    """How far all samples together may move."""
    vary_warp: float
    """The largest warp angle that moving should reach."""
    vary_strain: float
    """The largest strain that moving should reach, as a share of what the sheet takes."""
    aim: Literal["mean", "max", "seams"]
    """The length error of a mesh that is made small."""
    split_creases: float
    """Divide a mesh along creases above this angle."""
    darts: bool
    """Cut a mesh to the points that stretch most."""
    skin: Literal["outer", "inner"]
    """The skin that is laid flat of a plate with two."""
    facets: bool
    """Whether a mesh is folded between its facets."""
    pieces_within: tuple[float, float]
    """The size that no piece of facets exceeds."""
    sheets: Sheet | Sequence[Sheet]
    """The sheet or the sheets that parts are laid out on."""
    gap: float
    """The least distance between two parts on a sheet."""
    margin: float
    """The least distance of a part from the edge of its sheet."""
    kerf: float
    """The width that a cut takes away."""
    common_lines: bool
    """Whether equal parts lie side by side so that one cut parts two."""
    sheet_files: Literal["all", "each"]
    """One file of all sheets, or one each."""
    divide: Literal["scarf", "butt", "puzzle", "overlap", "none"]
    """What joins the pieces of parts that are larger than every sheet."""


class FileSettings(TypedDict, total=False):
    """How files are written, by :meth:`Made.files` and :meth:`Made.write`.

    They are called as the options of ``sheetwright make`` are. Lengths are mm.
    """

    preset: str
    dxf: Literal["r12", "r2000"]
    arcs: float
    paper: str
    max_sheets: int
    report: Literal["auto", "short", "long"]
    each_part: bool
    stations: float
    feet: bool
    die: float
    brake_length: float
    rolls: bool


def make(
    design: str | os.PathLike[str] | bytes | Mapping[str, Any],
    *,
    format: str | None = None,  # noqa: A002
    name: str = "design",
    folder: str | os.PathLike[str] | None = None,
    rails: Sequence[str] | None = None,
    **settings: Unpack[Settings],
) -> Made:
    """Make a design, a curve table, a drawing or a mesh: what ``sheetwright make`` does.

    ``design`` is the path of a file, a design as a dict or as JSON text (a text that begins with
    ``{``), or the bytes of a file. ``format`` is that of bytes: ``json``, ``csv``, ``xlsx``,
    ``svg``, ``dxf``, ``obj``, ``stl``, ``ply`` or ``glb``; left out, they show it themselves.
    ``name`` is the name of what has none of its own, and tables and meshes that a design refers to
    lie in ``folder``. ``rails`` names the two curves or layers of a drawing that are rails.

    Raises :class:`SheetwrightError`, with a hint, where it can't be made. A part that will not bend
    is no error: its verdict says so.
    """
    given = _given(settings)
    if rails is not None:
        given["rails"] = list(rails)
    if isinstance(design, bytes):
        return _native.make_bytes(design, format, name, folder, given)
    if isinstance(design, (str, os.PathLike)):
        if isinstance(design, str) and design.lstrip().startswith("{"):
            return _native.make_bytes(design.encode(), "json", name, folder, given)
        return _native.make_file(design, given)
    text = json.dumps(design)
    return _native.make_bytes(text.encode(), "json", name, folder, given)


def solve(
    boundary: ArrayLike | None = None,
    *,
    rails: tuple[ArrayLike, ArrayLike] | None = None,
    holes: Sequence[ArrayLike] | None = None,
    kind: Kind | None = None,
    name: str = "panel",
    **settings: Unpack[Settings],
) -> Part:
    """Find the developable surface inside a boundary or between two rails, and lay it flat.

    ``boundary`` is a closed curve, of shape (N, 3), whose last point need not repeat the first;
    ``holes`` are closed curves, each of shape (M, 3). In their place, ``rails`` are two open curves
    of shapes (N, 3) and (M, 3). Points are samples of the surface themselves, as the rows of a
    curve table are, unless ``kind``, ``samples`` or ``tolerance`` is given, or there are rails:
    then a spline, or what ``kind`` says, runs through them and is sampled.
    """
    bounds = _bounds(boundary, rails, holes, kind, settings)
    return _native.make_points(bounds, name, _given(settings)).parts[0]


def make_mesh(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    seams: ArrayLike | None = None,
    name: str = "mesh",
    **settings: Unpack[Settings],
) -> Made:
    """Make a mesh as the command does: heal it, cut it open, divide it, lay its parts flat.

    ``vertices`` has the shape (V, 3), in mm unless ``units`` says otherwise, ``faces`` the shape
    (F, 3), with vertices counted from 0. ``seams``, of the shape (S, 2), are sides of faces along
    which it is cut, each by the vertices at its ends; where they do not let it lie flat, it is cut
    on. For one position for each vertex there is :func:`flatten`.
    """
    sides = np.empty((0, 2), dtype=np.int64)
    if seams is not None and np.size(seams) > 0:
        sides = _numbers("seams", seams, 2)
    given = _given(settings)
    return _native.make_mesh(_rows(vertices), _faces(faces), sides, name, given)


def flatten(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    aim: Literal["mean", "max", "seams"] = "mean",
) -> FlatMesh:
    """Lay a mesh of one piece flat as it stands.

    ``vertices`` has the shape (V, 3), ``faces`` the shape (F, 3), with vertices counted from 0. The
    result has ``flat``, of shape (V, 2), a position for each vertex, and ``strain``, of shape (F,).
    ``aim`` is the length error that is made small: the mean, the largest, or that of the border.
    Holes stay open; a closed mesh or one with handles raises :class:`SheetwrightError`.
    """
    return _native.flatten(_rows(vertices), _faces(faces), aim)


def nest(
    outlines: Iterable[ArrayLike | Sequence[ArrayLike]],
    sheets: Sheet | Sequence[Sheet],
    *,
    counts: Sequence[int] | None = None,
    gap: float = 3.0,
    margin: float = 5.0,
    turns: Sequence[float] | None = None,
    turn_over: bool = False,
    effort: float = 1.0,
) -> Layout:
    """Lay outlines out on sheets with little waste.

    ``outlines`` are arrays of shape (N, 2), or lists of such arrays: an outline and its holes.
    ``sheets`` is a sheet or several, each a width and a height in mm, or a text such as
    ``"3x1220x2440mm"`` or ``"roll:1370mm"``. ``counts`` says how often each outline is cut,
    ``turns`` by which angles they may be turned, in degrees (any, unless given), ``turn_over``
    whether they may be turned over. Two parts are ``gap`` mm apart at least, and ``margin`` mm from
    the edge.
    """
    parts = [_loops(outline) for outline in outlines]
    numbers = [1] * len(parts) if counts is None else _whole(counts)
    if len(numbers) != len(parts):
        message = f"there are {len(parts)} outlines and {len(numbers)} counts"
        raise SheetwrightError(message, "Give one count for each outline.")
    texts = _sheets(sheets)
    angles = None if turns is None else [float(turn) for turn in turns]
    given = [{"loops": loops, "count": count} for loops, count in zip(parts, numbers, strict=True)]
    return _native.nest(given, texts, (float(gap), float(margin)), angles, turn_over, float(effort))


def solve_many(
    panels: ArrayLike | Iterable[ArrayLike | Mapping[str, Any]],
    *,
    kind: Kind | None = None,
    threads: int = 0,
    outlines: bool = False,
    **settings: Unpack[Settings],
) -> dict[str, NDArray[Any]]:
    """Find the surfaces of many panels, by several threads.

    ``panels`` is an array of shape (P, N, 3), or each is a closed boundary of shape (N, 3), or a
    dict with what :func:`solve` takes: ``boundary`` and ``holes``, or ``rails``. ``threads`` is
    their number, 0 for as many as there are cores, 256 at most; it changes no bit. While they work,
    other threads of Python run.

    The result has a column for each quantity, an array of shape (P,): ``verdict``, ``findings``
    (codes, the worst first, with blanks between them), ``area_space_mm2``, ``area_flat_mm2``,
    ``flat_width_mm``, ``flat_height_mm``, ``outline_length_mm``, ``warp_max_deg``,
    ``bend_radius_min_mm`` (NaN of a flat panel), ``strain_p95``, ``strain_limit``, ``error`` and
    ``hint``. A panel that can't be made raises nothing: its ``error`` says why, its numbers are
    NaN. With ``outlines``, the column ``outline`` has arrays of shape (M, 2), mm.

    Verdicts come from a formula, true within a factor of two, unless ``verdict="exact"``.
    """
    bounds, refused = [], {}
    for number, panel in enumerate(_each(panels)):
        try:
            bounds.append(_panel(panel, kind, settings))
        except SheetwrightError as error:
            # Its row says so.
            refused[number] = error
            bounds.append({"is_rails": False, "kind": "samples", "curves": []})
    given = {"verdict": "quick"} | _given(settings)
    columns = _native.solve_many(bounds, threads, outlines, given)
    for number, why in refused.items():
        columns["error"][number], columns["hint"][number] = why.message, why.hint
    return {name: _column(values) for name, values in columns.items()}


def _panel(panel: Any, kind: Kind | None, settings: Mapping[str, Any]) -> dict[str, Any]:  # noqa: ANN401
    if not isinstance(panel, Mapping):
        return _bounds(panel, None, None, kind, settings)
    known: dict[str, Any] = {"boundary": None, "rails": None, "holes": None} | dict(panel)
    return _bounds(known["boundary"], known["rails"], known["holes"], kind, settings)


def _each(panels: Any) -> Iterable[Any]:  # noqa: ANN401
    if isinstance(panels, np.ndarray) and panels.ndim != 3 and panels.dtype != object:  # noqa: PLR2004
        message = f"panels: the array has the shape {panels.shape}"
        raise SheetwrightError(message, "Give an array of shape (P, N, 3), or a list of arrays.")
    each: Iterable[Any] = panels
    return each


def _column(values: Any) -> NDArray[Any]:  # noqa: ANN401
    if isinstance(values, np.ndarray):
        return values
    if values and isinstance(values[0], np.ndarray):
        # Of different lengths, so it is an array of arrays.
        column = np.empty(len(values), dtype=object)
        column[:] = values
        return column
    return np.array(values, dtype=str)


def _given(settings: Mapping[str, Any]) -> dict[str, Any]:
    unknown = [name for name in settings if name not in Settings.__annotations__]
    if unknown:
        message = f"unexpected keyword argument {unknown[0]!r}"
        raise TypeError(message)
    given = {name: value for name, value in settings.items() if value is not None}
    if "sheets" in given:
        given["sheets"] = _sheets(given["sheets"])
    return given


def _sheets(sheets: Sheet | Sequence[Sheet]) -> list[str]:
    """Return the texts of sheets; one alone need not be in a list."""
    try:
        given = [sheets] if isinstance(sheets, str) else list(sheets)
    except TypeError:
        raise _no_sheet(sheets) from None
    is_size = len(given) == 2 and all(isinstance(side, Real) for side in given)  # noqa: PLR2004
    return [_sheet(sheet) for sheet in ([given] if is_size else given)]


def _sheet(sheet: Any) -> str:  # noqa: ANN401
    if isinstance(sheet, str):
        return sheet
    try:
        width, height = (float(side) for side in sheet)
    except (TypeError, ValueError):
        raise _no_sheet(sheet) from None
    return f"{width!r}x{height!r}mm"


def _no_sheet(given: Any) -> SheetwrightError:  # noqa: ANN401
    hint = 'Give a width and a height in mm, such as (1220, 2440), or a text such as "4x8ft".'
    return SheetwrightError(f"sheets: {given!r} is no sheet", hint)


def _whole(counts: Sequence[int]) -> list[int]:
    try:
        return [operator.index(count) for count in counts]
    except TypeError as error:
        raise SheetwrightError(f"counts: {error}", "Give a whole number for each.") from error


def _bounds(
    boundary: ArrayLike | None,
    rails: tuple[ArrayLike, ArrayLike] | None,
    holes: Sequence[ArrayLike] | None,
    kind: Kind | None,
    settings: Mapping[str, Any],
) -> dict[str, Any]:
    if (boundary is None) == (rails is None):
        raise SheetwrightError("a panel has a boundary or two rails", "Give one of them.")
    sampling = (settings.get(name) for name in ("samples", "tolerance"))
    is_sampled = rails is not None or any(given is not None for given in sampling)
    how = kind or ("spline" if is_sampled else "samples")
    curves = (
        [_rows(boundary), *_each_curve("holes", () if holes is None else holes)]
        if rails is None
        else _each_curve("rails", rails)
    )
    return {"is_rails": rails is not None, "kind": how, "curves": curves}


def _each_curve(what: str, curves: Any) -> list[NDArray[np.float64]]:  # noqa: ANN401
    try:
        each = list(curves)
    except TypeError as error:
        message = f"{what}: {error}"
        raise SheetwrightError(message, "Give arrays of shape (N, 3) in a list.") from error
    return [_rows(curve) for curve in each]


def _loops(outline: Any) -> list[NDArray[np.float64]]:  # noqa: ANN401
    if isinstance(outline, np.ndarray) and outline.ndim == 2:  # noqa: PLR2004
        return [_rows(outline)]
    hint = "Give an array of shape (N, 2), or a list of such arrays."
    try:
        loops = list(outline)
        first = list(loops[0])
    except (TypeError, IndexError):
        raise SheetwrightError(f"outlines: {outline!r} is no outline", hint) from None
    is_point = len(first) == 2 and all(np.isscalar(number) for number in first)  # noqa: PLR2004
    return [_rows(loops)] if is_point else [_rows(loop) for loop in loops]


def _rows(points: Any) -> NDArray[np.float64]:  # noqa: ANN401
    try:
        # In one piece and aligned, as the Rust half reads it: fields of packed records are neither.
        rows = np.require(points, np.float64, ["C", "A", "E"])
    except (TypeError, ValueError, OverflowError) as error:
        # A column of lists, as Arrow has them.
        try:
            rows = np.stack([np.asarray(row, dtype=np.float64) for row in points])
        except (TypeError, ValueError, OverflowError):
            raise SheetwrightError(f"points: {error}", "Give rows of numbers.") from error
    if rows.ndim != 2:  # noqa: PLR2004
        message = f"points: the array has the shape {rows.shape}"
        raise SheetwrightError(message, "Give one point a row.")
    return rows


def _faces(faces: ArrayLike) -> NDArray[np.int64]:
    return _numbers("faces", faces, 3)


def _numbers(what: str, given: ArrayLike, columns: int) -> NDArray[np.int64]:
    rows = np.asarray(given)
    if rows.ndim != 2 or not np.issubdtype(rows.dtype, np.integer):  # noqa: PLR2004
        message = f"{what}: the array has the shape {rows.shape} and the type {rows.dtype}"
        hint = f"Give an array of integers of shape ({what[0].upper()}, {columns})."
        raise SheetwrightError(message, hint)
    return rows.astype(np.int64)
