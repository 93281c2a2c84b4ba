"""Developable surfaces from boundary curves, flat patterns and a verdict.

Lengths are millimetres, angles degrees. Arrays are NumPy's, with one row a point. The results are
those of the command ``sheetwright``, to the last bit.

>>> import pysheetwright as sw
>>> made = sw.make(sw.template("cone", bottom=400, top=200, height=300))
>>> [part.verdict for part in made.parts]
['bends']
"""

from pysheetwright._native import (
    Edge,
    Finding,
    FlatMesh,
    Layout,
    Made,
    Material,
    Part,
    __version__,
)
from pysheetwright.catalogue import formats, materials, presets, template, templates, trades
from pysheetwright.errors import SheetwrightError
from pysheetwright.making import flatten, make, make_mesh, nest, solve, solve_many

__all__ = [
    "Edge",
    "Finding",
    "FlatMesh",
    "Layout",
    "Made",
    "Material",
    "Part",
    "SheetwrightError",
    "__version__",
    "flatten",
    "formats",
    "make",
    "make_mesh",
    "materials",
    "nest",
    "presets",
    "solve",
    "solve_many",
    "template",
    "templates",
    "trades",
]
