"""From a mesh object to its parts, and from parts to objects and a UV map. No screen is needed."""

import bpy
import numpy as np

# The name of the collection for patterns, of their UV map, and of the mark on their objects.
NAME = "Sheetwright"
OF = "sheetwright_of"


def mm_per_unit(scene):
    """The length of Blender's unit in mm: a metre, times the unit scale of the scene."""
    # Blender keeps seven digits of it.
    return 1000.0 * float(f"{scene.unit_settings.scale_length:.7g}")


class Shape:
    """A mesh object as it is seen: modifiers and transforms applied, in mm.

    `vertices` (V, 3), `faces` (F, 3) and `seams` (S, 2) are arrays; `loops` (F, 3) are the corners
    of the faces among those of the mesh, `corners` is how many these are.
    """

    def __init__(self, context, thing):
        if thing.mode == "EDIT":
            thing.update_from_editmode()
        evaluated = thing.evaluated_get(context.evaluated_depsgraph_get())
        mesh = evaluated.to_mesh()
        try:
            mesh.calc_loop_triangles()
            at = _read(mesh.vertices, "co", np.float32, 3).astype(np.float64)
            matrix = np.array(evaluated.matrix_world, dtype=np.float64)
            at = (at @ matrix[:3, :3].T + matrix[:3, 3]) * mm_per_unit(context.scene)
            self.vertices = at
            self.faces = _read(mesh.loop_triangles, "vertices", np.int32, 3)
            self.loops = _read(mesh.loop_triangles, "loops", np.int32, 3)
            self.corners = len(mesh.loops)
            if np.linalg.det(matrix[:3, :3]) < 0:
                # Mirrored: what faced outwards still does.
                self.faces, self.loops = self.faces[:, ::-1], self.loops[:, ::-1]
            # A seam that no face has, as of loose edges, has nothing to cut.
            is_used = np.zeros(len(mesh.edges), dtype=bool)
            is_used[_read(mesh.loops, "edge_index", np.int32, 1)] = True
            is_seam = _read(mesh.edges, "use_seam", np.bool_, 1)
            self.seams = _read(mesh.edges, "vertices", np.int32, 2)[is_seam & is_used]
        finally:
            evaluated.to_mesh_clear()


def _read(things, what, kind, columns):
    flat = np.empty(len(things) * columns, dtype=kind)
    things.foreach_get(what, flat)
    return flat.reshape(-1, columns) if columns > 1 else flat


def made_of(context, thing, *, seams=True, **settings):
    """Make the parts of a mesh object; returns its shape and a `pysheetwright.Made`.

    `seams` says whether it is cut along Blender's seams; `settings` are those of
    `pysheetwright.make_mesh`. Raises `pysheetwright.SheetwrightError`, in words.
    """
    import pysheetwright as sw

    if thing is None or thing.type != "MESH":
        raise sw.SheetwrightError("there is no mesh to unfold", "Make a mesh object the active one.")
    shape = Shape(context, thing)
    given = {name: value for name, value in settings.items() if value is not None}
    cuts = shape.seams if seams else None
    return shape, sw.make_mesh(shape.vertices, shape.faces, seams=cuts, name=thing.name, **given)


def lay_beside(context, thing, shape, made):
    """Lay the patterns beside an object as objects of their own, in true size; returns them.

    Those of an earlier time are replaced. Each has a shape key that bends it into its place.
    """
    forget(thing)
    unit = mm_per_unit(context.scene)
    low, high = shape.vertices.min(axis=0), shape.vertices.max(axis=0)
    gap = 0.05 * float((high - low).max())
    home = bpy.data.collections.get(NAME) or bpy.data.collections.new(NAME)
    if home.name not in context.scene.collection.children:
        context.scene.collection.children.link(home)
    laid, left = [], float(high[0]) + gap
    for part in made.parts:
        corner = np.array([left, low[1], 0.0])
        flat = np.column_stack([part.flat, np.zeros(len(part.flat))])
        mesh = bpy.data.meshes.new(f"{part.name} flat")
        mesh.from_pydata((flat / unit).tolist(), [], part.faces.tolist())
        _uv(mesh, part.flat, _span(made))
        pattern = bpy.data.objects.new(mesh.name, mesh)
        pattern.location = corner / unit
        pattern[OF] = thing.name
        pattern.shape_key_add(name="Flat")
        bent = pattern.shape_key_add(name="In space")
        bent.data.foreach_set("co", ((part.vertices - corner) / unit).astype(np.float32).ravel())
        home.objects.link(pattern)
        laid.append(pattern)
        left += part.flat_width_mm + gap
    return laid


def forget(thing):
    """Remove the patterns of an object."""
    for old in [it for it in bpy.data.objects if it.get(OF) == thing.name]:
        data = old.data
        bpy.data.objects.remove(old)
        # People may have made a curve of it, or copies that share its mesh.
        if isinstance(data, bpy.types.Mesh) and data.users == 0:
            bpy.data.meshes.remove(data)


def _span(made):
    """The side of the square of UV space, mm: all parts have one scale in it."""
    width = sum(part.flat_width_mm for part in made.parts)
    return max(width, *(part.flat_height_mm for part in made.parts))


def _uv(mesh, flat, span):
    layer = mesh.uv_layers.new(name=NAME)
    at = _read(mesh.loops, "vertex_index", np.int32, 1)
    layer.data.foreach_set("uv", (flat[at] / span).astype(np.float32).ravel())


def map_uv(thing, shape, made):
    """Write the pattern into a UV map of the object itself; returns how many corners have none.

    A corner has none where healing changed its face, or where its face is cut across. None at all
    where modifiers change the mesh: then nothing is written, and None is returned.
    """
    mesh = thing.data
    if len(mesh.loops) != shape.corners:
        return None
    keyed = {}
    for face, loops in zip(shape.faces.tolist(), shape.loops.tolist(), strict=True):
        for turn in range(3):
            key = b"".join(shape.vertices[face[(turn + k) % 3]].tobytes() for k in range(3))
            keyed[key] = (loops[turn], loops[(turn + 1) % 3], loops[(turn + 2) % 3])
    span, left = _span(made), 0.0
    uv = np.full((shape.corners, 2), np.nan)
    is_torn = np.zeros(shape.corners, dtype=bool)
    for part in made.parts:
        flat = part.flat + [left, 0.0]
        for face in part.faces.tolist():
            loops = keyed.get(b"".join(part.vertices[v].tobytes() for v in face), ())
            for loop, v in zip(loops, face, strict=False):
                is_torn[loop] |= bool(np.any(np.abs(uv[loop] - flat[v]) > 1e-6))
                uv[loop] = flat[v]
        left += part.flat_width_mm
    lost = np.isnan(uv[:, 0]) | is_torn
    layer = mesh.uv_layers.get(NAME) or mesh.uv_layers.new(name=NAME)
    layer.data.foreach_set("uv", (np.nan_to_num(uv) / span).astype(np.float32).ravel())
    mesh.uv_layers.active = layer
    return int(lost.sum())
