"""Runs in Blender without a screen: unfolds meshes by the add-on, and tells what came of them.

SHEETWRIGHT_HOSTS names the folder for files, that of the add-on and that of the wheel. .ci/hosts.py
compares what it tells with the command.
"""

import json
import math
import os
import sys
import traceback

folder, addon, packages = os.environ["SHEETWRIGHT_HOSTS"].split(os.pathsep)
sys.path[:0] = [addon, packages]

import bpy
import sheetwright_blender
from mathutils import Matrix
from sheetwright_blender import panel, sheet


def thing_of(name, points, faces, seams=()):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    sides = {tuple(sorted(side)) for side in seams}
    for edge in mesh.edges:
        edge.use_seam = tuple(sorted(edge.vertices)) in sides
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    return thing


def told_of(thing, material="", facets="AUTO", seams=True, thickness=0.0):
    """Unfold it by the panel's operators, and tell the objects, the files and the design."""
    given = bpy.context.scene.sheetwright
    given.material, given.facets, given.seams = material, facets, seams
    given.thickness = thickness
    given.folder = os.path.join(folder, thing.name)
    bpy.context.view_layer.objects.active = thing
    assert bpy.ops.sheetwright.unfold() == {"FINISHED"}
    assert bpy.ops.sheetwright.write(formats="svg,pdf,dxf") == {"FINISHED"}
    cuts, settings = panel.settings_of(bpy.context.scene)
    shape, made = sheet.made_of(bpy.context, thing, seams=cuts, **settings)
    with open(os.path.join(folder, f"{thing.name}.sheet.json"), "w") as file:
        json.dump(made.design, file)
    patterns = [it for it in bpy.data.objects if it.get(sheet.OF) == thing.name]
    unit = sheet.mm_per_unit(bpy.context.scene)
    layer = thing.data.uv_layers.get(sheet.NAME)
    uv = [list(it.uv) for it in layer.data] if layer else []
    return {
        "verdict": thing.sheetwright.verdict,
        "said": [line.text for line in thing.sheetwright.lines],
        "area": [part.area_flat_mm2 for part in made.parts],
        "space": [part.area_space_mm2 for part in made.parts],
        "patterns": [sum(face.area for face in it.data.polygons) * unit**2 for it in patterns],
        "bent": [bent_area(it) * unit**2 for it in patterns],
        "uv": uv,
        "apart": all(it.location.x > max((thing.matrix_world @ v.co).x for v in thing.data.vertices)
                     for it in patterns),
        "seams": len(shape.seams),
        "thickness": settings["thickness"],
        "edges": [[e.name, e.length_flat_mm, e.mates] for part in made.parts for e in part.edges],
    }


def bent_area(pattern):
    """The area of a pattern that its shape key bends, as Blender sees it, in its units."""
    pattern.data.shape_keys.key_blocks["In space"].value = 1.0
    bpy.context.view_layer.update()
    evaluated = pattern.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    area = sum(face.area for face in mesh.polygons)
    evaluated.to_mesh_clear()
    pattern.data.shape_keys.key_blocks["In space"].value = 0.0
    return area


def refusal(act):
    """The words of an operator that refuses."""
    try:
        act()
    except RuntimeError as error:
        return str(error)
    return ""


def main():
    told = {}
    # On and off, twice: nothing is left.
    for _ in range(2):
        sheetwright_blender.register()
        sheetwright_blender.unregister()
    told["is_gone"] = not hasattr(bpy.types.Scene, "sheetwright")
    sheetwright_blender.register()
    scene = bpy.context.scene
    scene.unit_settings.scale_length = 0.001

    # A box in mm, whose seams open it into a cross.
    corners = [(60 * (n & 1), 40 * (n >> 1 & 1), 20 * (n >> 2)) for n in range(8)]
    walls = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    cross = [(6, 4), (4, 5), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)]
    told["box"] = told_of(thing_of("box", corners, walls, cross), facets="FOLD")
    # Its seams round the lid part it from the rest.
    lid = [(4, 5), (5, 7), (7, 6), (6, 4)]
    told["lid"] = told_of(thing_of("lid", corners, walls, lid), facets="FOLD")
    told["plain"] = told_of(thing_of("plain", corners, walls, cross), facets="FOLD", seams=False, thickness=0.8)

    # A tent in metres, scaled and turned, of which a modifier makes the other half.
    scene.unit_settings.scale_length = 1.0
    tent = thing_of("tent", [(0, 0, 2), (0, 3, 2), (1.5, 0, 0), (1.5, 3, 0)], [(0, 2, 3, 1)])
    tent.modifiers.new("Mirror", "MIRROR")
    tent.matrix_world = Matrix.Rotation(0.5, 4, "Z") @ Matrix.Diagonal((0.5, 0.5, 0.5, 1))
    bpy.context.view_layer.update()
    told["tent"] = told_of(tent, material="aluminium-2mm")

    # The side of a cone of 48 faces with a seam, and mirrored.
    n, low, high, tall = 48, 0.4, 0.2, 0.3
    ring = [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]
    points = [(low * x, low * y, 0) for x, y in ring] + [(high * x, high * y, tall) for x, y in ring]
    sides = [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    cone = thing_of("cone", points, sides, [(12, 12 + n)])
    cone.scale.x = -1
    bpy.context.view_layer.update()
    told["cone"] = told_of(cone, material="steel-1mm")
    # It follows its mesh, and replaces what was laid beside.
    cone.scale = (1, 1, 1)
    bpy.context.view_layer.update()
    before = len(bpy.data.objects)
    assert bpy.ops.sheetwright.unfold() == {"FINISHED"}
    told["again"] = len(bpy.data.objects) - before
    # So it does where people made a curve of a pattern, or a copy that shares its mesh.
    scene.sheetwright.thickness = 0.0
    for change in ("curve", "copy"):
        [pattern] = [it for it in bpy.data.objects if it.get(sheet.OF) == "cone"]
        if change == "copy":
            copy = pattern.copy()
            del copy[sheet.OF]
            scene.collection.objects.link(copy)
        else:
            curve = bpy.data.objects.new("curve", bpy.data.curves.new("curve", "CURVE"))
            curve[sheet.OF] = "cone"
            scene.collection.objects.link(curve)
        bpy.context.view_layer.objects.active = cone
        assert bpy.ops.sheetwright.unfold() == {"FINISHED"}
    told["patterns"] = [it.type for it in bpy.data.objects if it.get(sheet.OF) == "cone"]
    told["copy"] = len(copy.data.polygons)
    # A format that there is not: the patterns and the verdict stay.
    told["format"] = refusal(lambda: bpy.ops.sheetwright.write(formats="svg,stl9"))
    told["kept"] = [it.type for it in bpy.data.objects if it.get(sheet.OF) == "cone"]
    told["verdict"] = cone.sheetwright.verdict
    # Out of edit mode and back.
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.sheetwright.unfold() == {"FINISHED"}
    told["mode"] = cone.mode
    bpy.ops.object.mode_set(mode="OBJECT")

    # A Möbius strip, a mesh without faces, a material that there is not, no mesh at all.
    turn = [2 * math.pi * k / 20 for k in range(20)]
    band = [
        ((1 + s * math.cos(a / 2)) * math.cos(a), (1 + s * math.cos(a / 2)) * math.sin(a), s * math.sin(a / 2))
        for a in turn
        for s in (-0.2, 0.2)
    ]
    strip = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(19)] + [(38, 39, 0, 1)]
    scene.sheetwright.material = ""
    thing_of("moebius", band, strip)
    told["moebius"] = refusal(bpy.ops.sheetwright.unfold)
    thing_of("bare", [(0, 0, 0), (1, 0, 0)], [])
    told["bare"] = refusal(bpy.ops.sheetwright.unfold)
    bpy.context.view_layer.objects.active = cone
    scene.sheetwright.material = "no-such-sheet"
    told["unknown"] = refusal(bpy.ops.sheetwright.unfold)
    told["left"] = [it.name for it in bpy.data.objects if it.get(sheet.OF) == "cone"]
    scene.sheetwright.material = ""
    scene.sheetwright.folder = "//patterns"
    told["unsaved"] = refusal(bpy.ops.sheetwright.write)
    bpy.context.view_layer.objects.active = None
    told["none"] = refusal(bpy.ops.sheetwright.unfold)

    with open(os.path.join(folder, "told.json"), "w") as file:
        json.dump(told, file)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "all.blend"))
    sheetwright_blender.unregister()


try:
    main()
except BaseException:  # noqa: BLE001
    # Blender goes on after an error of a script, and ends as if nothing had happened.
    traceback.print_exc()
    sys.exit(1)
