"""Pictures by Matplotlib, which is installed with ``pip install pysheetwright[plot]``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysheetwright._native import Part

SHEET = "#9db8d6"
INK = "#1f2d3d"


def plot(part: Part, axes: Any = None, warp: bool = True) -> Any:  # noqa: ANN401, FBT001, FBT002
    """Draw a part in space beside its flat pattern, and return the figure.

    With ``axes``, of two dimensions, the flat pattern alone is drawn there. Rungs are coloured by
    their warp angle if ``warp`` is set.
    """
    if axes is not None:
        _flat(part, axes, warp=warp)
        return axes.figure
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure = plt.figure(figsize=(10, 4.5), layout="constrained")
    space = figure.add_subplot(1, 2, 1, projection="3d")
    _space(part, space)
    _flat(part, figure.add_subplot(1, 2, 2), warp=warp)
    figure.suptitle(f"{part.name}: {part.verdict}")
    return figure


def _space(part: Part, axes: Any) -> None:  # noqa: ANN401
    from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # noqa: PLC0415

    vertices = part.vertices
    triangles = vertices[part.faces]
    axes.add_collection3d(Poly3DCollection(triangles, facecolor=SHEET, edgecolor="none"))
    axes.add_collection3d(Line3DCollection(part.rulings[::8], colors=INK, linewidths=0.3))
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect([max(size, 1e-3 * (high - low).max()) for size in high - low])
    axes.set_axis_off()


def _flat(part: Part, axes: Any, *, warp: bool) -> None:  # noqa: ANN401
    import numpy as np  # noqa: PLC0415
    from matplotlib.collections import LineCollection, PolyCollection  # noqa: PLC0415

    flat = part.flat
    axes.add_collection(PolyCollection(list(flat[part.faces]), facecolor=SHEET, edgecolor="face"))
    if warp and len(part.rungs) and len(part.rungs) == len(part.warp_deg):
        rungs = LineCollection(
            list(flat[part.rungs]), array=part.warp_deg, cmap="magma", linewidths=0.6
        )
        axes.add_collection(rungs)
        axes.figure.colorbar(rungs, ax=axes, label="warp angle, °", shrink=0.7)
    for loop in [part.outline, *part.holes]:
        closed = np.vstack([loop, loop[:1]])
        axes.plot(closed[:, 0], closed[:, 1], color=INK, linewidth=1)
    axes.set_aspect("equal")
    axes.set_xlabel("mm")
