"""Counts the pieces that Blender's Export Paper Model makes of the OBJ files of a folder.

Run by Blender: blender -b --factory-startup -P nets.py -- FOLDER. A line for each file: pieces, seconds
and its name.
"""

import pathlib
import sys
import time

import addon_utils
import bpy

addon_utils.enable("io_export_paper_model")
import io_export_paper_model as paper  # noqa: E402

for file in sorted(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).glob("*.obj")):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("io_export_paper_model")
    points, faces = [], []
    for line in file.read_text().splitlines():
        words = line.split()
        if words[0] == "v":
            points.append([float(word) / 1000 for word in words[1:]])
        else:
            faces.append([int(word) - 1 for word in words[1:]])
    mesh = bpy.data.meshes.new(file.stem)
    mesh.from_pydata(points, [], faces)
    thing = bpy.data.objects.new(file.stem, mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    start = time.process_time()
    unfolder = paper.Unfolder(thing)
    unfolder.prepare()
    pieces = len(unfolder.mesh.islands)
    print(f"PIECES\t{pieces}\t{time.process_time() - start:.3f}\t{file.stem}", flush=True)
    bpy.ops.object.mode_set(mode="OBJECT")
