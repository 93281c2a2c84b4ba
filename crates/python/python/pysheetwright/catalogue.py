"""What there is to choose from."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from pysheetwright import _native

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike

    from pysheetwright._native import Material


def materials() -> dict[str, Material]:
    """Return the materials of the catalogue, by their names."""
    return {material.name: material for material in _native.materials()}


def templates() -> dict[str, dict[str, Any]]:
    """Return the templates by their names.

    Each is a dict with its ``title``, ``who`` uses it, and its ``parameters``: name, meaning, kind,
    default, least and most.
    """
    catalogue = json.loads(_native.templates())
    return {template["name"]: template for template in catalogue["templates"]}


def template(
    name: str,
    /,
    *,
    trade: str | None = None,
    folder: str | os.PathLike[str] | None = None,
    **settings: ArrayLike | None,
) -> dict[str, Any]:
    """Return the design that a template draws, as a dict for :func:`pysheetwright.make`.

    ``settings`` are the parameters of the template, with ``_`` where their names have ``-``:
    numbers in millimetres or degrees, texts with a unit such as ``"15 3/4in"``, lists of numbers
    (None is as left out); and ``material`` and ``dimensions``, which every template has. ``trade``
    adds what a trade does along edges. A parameter that is a table names a file in ``folder``.
    """
    given = {key.replace("_", "-"): value for key, value in settings.items() if value is not None}
    texts = [f"{key}={_text(value)}" for key, value in given.items()]
    read: dict[str, Any] = json.loads(_native.template(name, texts, trade, folder))
    return read


def _text(value: Any) -> str:  # noqa: ANN401
    if isinstance(value, (np.generic, np.ndarray)):
        # Python's own numbers, whose texts name no type.
        value = value.tolist()
    if isinstance(value, str):
        return value
    if isinstance(value, (int, float)):
        return repr(value)
    return ", ".join(repr(float(number)) for number in value)


def trades() -> dict[str, str]:
    """Return the trades, each with what it is for."""
    return dict(_native.trades())


def formats() -> dict[str, str]:
    """Return the formats of files, each with what it is for."""
    return dict(_native.formats())


def presets() -> dict[str, str]:
    """Return the presets of machines that files are written for, each with what it is for."""
    return dict(_native.presets())
