"""Installs the extension for Blender from its zip, in Blender without a screen, and unfolds a cone.

    python .ci/blender_extension.py EXTENSION.zip FOLDER

The package is that of the zip: the Python that runs this must not have it. FOLDER gets the pattern.
"""

import os
import sys

import bpy  # first: it brings the other along
import addon_utils

extension, folder = sys.argv[1:]
try:
    import pysheetwright

    sys.exit(f"{pysheetwright.__file__} is there already")
except ImportError:
    pass
assert addon_utils.enable("bl_pkg"), "Blender's own add-on for extensions"
installed = bpy.ops.extensions.package_install_files(
    repo="user_default", filepath=extension, enable_on_install=True
)
assert installed == {"FINISHED"}, installed
bpy.ops.mesh.primitive_cone_add(vertices=12, end_fill_type="NOTHING")
given = bpy.context.scene.sheetwright
given.facets, given.folder = "FOLD", folder
assert bpy.ops.sheetwright.unfold() == {"FINISHED"}
assert bpy.context.object.sheetwright.verdict == "bends-and-folds", bpy.context.object.sheetwright.verdict
assert bpy.ops.sheetwright.write(formats="svg,pdf") == {"FINISHED"}
assert "pattern.pdf" in os.listdir(folder), os.listdir(folder)
