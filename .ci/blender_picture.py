"""Makes docs/pictures/blender.png, on a screen that may be virtual; from the root of the checkout:

    xvfb-run -s "-screen 0 1280x900x24" blender --factory-startup EMPTY.blend \
        --window-geometry 0 0 1280 900 -P .ci/blender_picture.py -- SITE OUT.png

SITE has the package, EMPTY.blend keeps Blender's greeting away. Crop the 750 by 727 pixels from (280, 85) on.
"""

import math
import os
import sys

site, out = sys.argv[-2:]
sys.path[:0] = [os.path.join(os.getcwd(), "addons/blender"), site]

import bpy
import sheetwright_blender
from sheetwright_blender import panel

# The tab of a sidebar can't be chosen by a script, and this is the first.
panel.SHEETWRIGHT_PT_panel.bl_category = "Item"
sheetwright_blender.register()
for old in list(bpy.data.objects):
    bpy.data.objects.remove(old)
scene, n = bpy.context.scene, 48
scene.unit_settings.scale_length = 0.1
scene.sheetwright.material = "steel-1mm"
ring = [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]
points = [(4 * x, 4 * y, 0) for x, y in ring] + [(2 * x, 2 * y, 4) for x, y in ring]
mesh = bpy.data.meshes.new("hopper")
mesh.from_pydata(points, [], [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)])
for edge in mesh.edges:
    edge.use_seam = tuple(sorted(edge.vertices)) == (12, 12 + n)
thing = bpy.data.objects.new("hopper", mesh)
scene.collection.objects.link(thing)
bpy.context.view_layer.objects.active = thing
bpy.ops.sheetwright.unfold()


def look():
    """Turn the view and open the sidebar, once there is a window."""
    window = bpy.context.window_manager.windows[0]
    area = next(it for it in window.screen.areas if it.type == "VIEW_3D")
    space = area.spaces.active
    space.show_region_ui = True
    region = next(it for it in area.regions if it.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        for it in bpy.data.objects:
            it.select_set(True)
        bpy.ops.view3d.view_axis(type="TOP")
        space.region_3d.view_rotation = (0.86, 0.36, 0.14, 0.33)
        bpy.ops.view3d.view_selected()
    bpy.app.timers.register(shoot, first_interval=3)


def shoot():
    """Keep the picture, and end."""
    bpy.ops.screen.screenshot(filepath=out)
    bpy.ops.wm.quit_blender()


bpy.app.timers.register(look, first_interval=2)
