"""Developable parts in FreeCAD: two edges, faces or a mesh become a sheet with verdict and pattern.

A part is a feature with links to what it is made of, so it follows when that changes; its flat
pattern is a sketch that follows it. All of it is computed by the Python package `pysheetwright`,
which FreeCAD's Python must find.
"""

import json
import os
import tempfile

import FreeCAD
import Part
import pysheetwright as sw

# Points on an edge that go to the spline that is sampled: enough for what FreeCAD draws.
POINTS = 60
# How near the triangles of faces stay to them: this share of their size, and no less in mm. Where
# faces need no points inside, a finer one costs little.
OF_SIZE, OF_SIZE_PLAIN, LEAST_MM = 1e-4, 1e-5, 0.01
PLAIN = (Part.Plane, Part.Cylinder, Part.SurfaceOfExtrusion)


def between(document, first, second, material="", name="Sheet"):
    """A part between two edges, each `(object, "Edge1")`; returns it and its pattern, a sketch."""

    def link(it):
        _linked(it, "First", first)
        _linked(it, "Second", second)

    return _added(document, name, material, link)


def of_faces(document, of, faces, material="", name="Sheet"):
    """A part of faces of an object, such as `["Face1"]`: holes stay, and faces that meet are one.

    The faces are divided into triangles, which stay to them within its property `Tolerance`.
    """

    def link(it):
        about = "The faces that are laid flat"
        it.addProperty("App::PropertyLinkSubGlobal", "Faces", "Sheetwright", about)
        it.Faces = (of, list(faces))
        about = "How near its triangles stay to the faces"
        it.addProperty("App::PropertyLength", "Tolerance", "Sheetwright", about)
        shape = _faces(it)
        is_plain = all(isinstance(face.Surface, PLAIN) for face in shape.Faces)
        share = OF_SIZE_PLAIN if is_plain else OF_SIZE
        it.Tolerance = max(LEAST_MM, share * shape.BoundBox.DiagonalLength)

    return _added(document, name, material, link)


def of_mesh(document, mesh, material="", name="Sheet"):
    """A part of a mesh object, which is laid flat as the command does."""

    def link(it):
        it.addProperty("App::PropertyLinkGlobal", "Mesh", "Sheetwright", "The mesh that is laid flat")
        it.Mesh = mesh

    return _added(document, name, material, link)


def write(part, folder, formats=("dxf",)):
    """Write files of a part as the command does, and return their names."""
    return part.Proxy.made(part).write(folder, list(formats))


def _linked(part, role, edge):
    about = f"The {role.lower()} of the edges that it lies between"
    part.addProperty("App::PropertyLinkSubGlobal", role, "Sheetwright", about)
    setattr(part, role, edge)


def _added(document, name, material, link):
    part = document.addObject("Part::FeaturePython", name)
    link(part)
    part.addProperty("App::PropertyString", "Material", "Sheetwright", "The material, by its name")
    part.Material = material
    for kind, of, about in [
        ("String", "Verdict", "Whether the sheet bends into the shape"),
        ("StringList", "Findings", "What was found, the worst first"),
        ("Float", "LargestWarp", "The largest warp angle, degrees; 0 of faces and meshes"),
        ("Float", "FlatArea", "The area of the pattern, mm²"),
    ]:
        part.addProperty(f"App::Property{kind}", of, "Answer", about)
        part.setEditorMode(of, 1)
    SheetPart(part)
    flat = document.addObject("Sketcher::SketchObjectPython", f"{name}Flat")
    flat.addProperty("App::PropertyLink", "Sheet", "Sheetwright", "The part that it is cut for")
    flat.Sheet = part
    FlatPattern(flat)
    if FreeCAD.GuiUp:
        part.ViewObject.Proxy = 0
        flat.ViewObject.Proxy = 0
    document.recompute()
    return part, flat


class SheetPart:
    """The proxy of a part: makes it anew when what it is made of changes."""

    def __init__(self, part):
        self._made = None
        part.Proxy = self

    def __getstate__(self):
        """Nothing is kept in the document: a part is made from its links."""
        return None

    def __setstate__(self, state):
        self._made = None

    # What newer releases of FreeCAD call them.
    dumps, loads = __getstate__, __setstate__

    def made(self, part):
        """The made design of a part."""
        if self._made is None:
            self.execute(part)
        return self._made

    def execute(self, part):
        """Make the part; FreeCAD calls it."""
        # Where it can't be made, nothing is left of what it was before.
        self._made = None
        if hasattr(part, "First"):
            self._made = sw.make(design_of(part))
        elif hasattr(part, "Faces"):
            self._made = _made_of(part, *_faces(part).tessellate(part.Tolerance.Value))
        else:
            self._made = _made_of(part, *part.Mesh.Mesh.Topology)
        parts = self._made.parts
        part.Verdict = ", ".join(piece.verdict for piece in parts)
        part.Findings = [f"{f.severity}: {f.text}" for piece in parts for f in piece.findings]
        part.LargestWarp = max(piece.warp_max_deg or 0.0 for piece in parts)
        part.FlatArea = sum(piece.area_flat_mm2 for piece in parts)
        part.Label2 = part.Verdict
        part.Shape = _faces(part) if hasattr(part, "Faces") else _shape(self._made)


class FlatPattern:
    """The proxy of a sketch that is the pattern of a part."""

    def __init__(self, flat):
        flat.Proxy = self

    def __getstate__(self):
        """It has no state but its link."""
        return None

    def __setstate__(self, state):
        pass

    dumps, loads = __getstate__, __setstate__

    def execute(self, flat):
        """Draw the pattern; FreeCAD calls it, and since it returns False, the sketch's own code."""
        lines, left = [], 0.0
        for piece in flat.Sheet.Proxy.made(flat.Sheet).parts:
            for loop in [piece.outline, *piece.holes]:
                at = [FreeCAD.Vector(x + left, y, 0) for x, y in loop.tolist()]
                lines += [Part.LineSegment(a, b) for a, b in zip(at, at[1:] + at[:1])]
            left += piece.flat_width_mm + 20
        flat.deleteAllGeometry()
        flat.addGeometry(lines, False)
        return False


def design_of(part):
    """The design of a part between two edges, as the command reads it from a file."""
    curves = {}
    for name, role in (("first", "First"), ("second", "Second")):
        of, [edge] = getattr(part, role)
        line = of.Shape.getElement(edge).discretize(Number=POINTS)
        to_global = _to_global(of)
        if to_global is not None:
            line = [to_global.multVec(point) for point in line]
        curves[name] = {"kind": "spline", "points": [[p.x, p.y, p.z] for p in line]}
    design = {"sheetwright": 1, "name": part.Name, "units": "mm", "curves": curves}
    if part.Material:
        design["material"] = part.Material
    return design | {"panels": [{"name": part.Name, "rails": list(curves)}]}


def _to_global(of):
    """From where the shape of an object lies to where it lies in assemblies; None if that is there.

    The shape lies where its own placement says, and not those of the parts that hold it.
    """
    if of.getGlobalPlacement() == of.Placement:
        return None
    return of.getGlobalPlacement() * of.Placement.inverse()


def _faces(part):
    """The faces of a part as they lie, as one shape: they share the points of edges they share."""
    of, names = part.Faces
    faces = [of.Shape.getElement(name) for name in names]
    to_global = _to_global(of)
    if to_global is not None:
        # Each by itself: a feature sets its own placement in the place of its shape's.
        faces = [face.transformed(to_global.toMatrix()) for face in faces]
    return Part.makeCompound(faces)


def _made_of(part, points, faces):
    settings = {"material": part.Material} if part.Material else {}
    return sw.make_mesh([[p.x, p.y, p.z] for p in points], faces, name=part.Name, **settings)


def _shape(made):
    """The surface: smooth faces where it was found, the triangles of a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        if all(piece.method != "mesh" for piece in made.parts):
            made.write(folder, ["step"])
            return Part.read(os.path.join(folder, "surface.step"))
    faces = []
    for piece in made.parts:
        at = [FreeCAD.Vector(*p) for p in piece.vertices.tolist()]
        corners = ([at[n] for n in face] for face in piece.faces.tolist())
        faces += [Part.Face(Part.makePolygon([*three, three[0]])) for three in corners]
    return Part.makeCompound(faces)


def saved(part, path):
    """Write the design of a part, which the command and the editor open."""
    is_between = hasattr(part, "First")
    design = design_of(part) if is_between else part.Proxy.made(part).design
    with open(path, "w", encoding="utf-8") as file:
        json.dump(design, file, indent=1)
