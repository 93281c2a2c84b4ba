"""Sheetwright in Blender: unfold the active mesh, with its verdict, its pattern and its files.

The sidebar of the 3D view has the panel (`panel`); `sheet` does the work, and is what scripts call.
All of it is computed by the Python package `pysheetwright`, which Blender's Python must find.
"""

bl_info = {
    "name": "Sheetwright",
    "description": "Unfold a mesh: flat pattern, verdict, SVG, PDF and DXF in true size",
    "author": "The Sheetwright developers",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Sidebar > Sheetwright",
    "category": "Mesh",
}

from . import panel  # noqa: E402


def register():
    """Blender calls it when the add-on is turned on."""
    panel.register()


def unregister():
    """Blender calls it when the add-on is turned off."""
    panel.unregister()
