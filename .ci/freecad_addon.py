"""Runs in FreeCAD without a screen: makes parts of edges, faces and a mesh, and tells their numbers.

SHEETWRIGHT_HOSTS names the folder for files, that of the add-on and that of the wheel. .ci/hosts.py
compares what it tells with the command.
"""

import json
import os
import sys

folder, addon, packages = os.environ["SHEETWRIGHT_HOSTS"].split(os.pathsep)
sys.path[:0] = [addon, packages]

import FreeCAD
import Mesh
import Part
import sheetwright_part as sheets

document = FreeCAD.newDocument("hull")


def curve(name, points):
    line = Part.BSplineCurve()
    line.interpolate([FreeCAD.Vector(*p) for p in points])
    it = document.addObject("Part::Feature", name)
    it.Shape = line.toShape()
    return it


chine = curve("Chine", [(0, 0, 0), (900, 310, 40), (1800, 420, 60)])
sheer = curve("Sheer", [(-80, 0, 300), (900, 450, 320), (1800, 560, 330)])
side, flat = sheets.between(document, (chine, "Edge1"), (sheer, "Edge1"), "plywood-4mm", "Side")


def said(part, flat):
    return {
        "verdict": part.Verdict,
        "warp": part.LargestWarp,
        "area": part.FlatArea,
        "faces": len(part.Shape.Faces),
        "is_valid": part.Shape.isValid(),
        "area_space": part.Shape.Area,
        "lines": flat.GeometryCount,
        "sketch": [flat.Shape.BoundBox.XLength, flat.Shape.BoundBox.YLength],
        "errors": [it.Name for it in document.Objects if "Invalid" in it.State],
    }


told = {"side": said(side, flat)}
sheets.saved(side, os.path.join(folder, "side.sheet.json"))
sheets.write(side, folder, ["dxf"])

# The part follows its edges.
chine.Placement.Base = FreeCAD.Vector(0, 0, -50)
document.recompute()
told["lower"] = said(side, flat)
sheets.saved(side, os.path.join(folder, "lower.sheet.json"))

# Half a tube as a mesh.
tube = document.addObject("Mesh::Feature", "Tube")
half = Part.makeCylinder(50, 200, FreeCAD.Vector(), FreeCAD.Vector(0, 0, 1), 180).Faces[0]
tube.Mesh = Mesh.Mesh(half.tessellate(0.1))
skin, pattern = sheets.of_mesh(document, tube, "paper", "Skin")
told["skin"] = said(skin, pattern)
tube.Mesh.write(os.path.join(folder, "skin.obj"))

# Faces of solids, whose patterns theory knows.


def solid(name, shape):
    it = document.addObject("Part::Feature", name)
    it.Shape = shape
    return it


def face_of(it, kind):
    faces = enumerate(it.Shape.Faces, 1)
    return next(f"Face{n}" for n, face in faces if isinstance(face.Surface, kind))


def faced(name, shape, *kinds, placed=None):
    it = solid(f"{name}Solid", shape)
    if placed is not None:
        assembly = document.addObject("App::Part", f"{name}Assembly")
        assembly.addObject(it)
        assembly.Placement.Base = placed
    names = [face_of(it, kind) for kind in kinds]
    part, flat = sheets.of_faces(document, it, names, "aluminium-1mm", name)
    sheets.saved(part, os.path.join(folder, f"{name}.sheet.json"))
    area = sum(it.Shape.getElement(n).Area for n in names)
    return said(part, flat) | {
        "true_area": area, "low": part.Shape.BoundBox.YMin,
        "tolerance": part.Tolerance.Value}


quarter = Part.makeCylinder(500, 200, FreeCAD.Vector(), FreeCAD.Vector(0, 0, 1), 90)
told["quarter"] = faced("quarter", quarter, Part.Cylinder, placed=FreeCAD.Vector(0, 300, 0))
tube = Part.makeCylinder(300, 400)
told["tube"] = faced("tube", tube, Part.Cylinder)
drill = Part.makeCylinder(60, 1000, FreeCAD.Vector(0, 0, 120), FreeCAD.Vector(1, 1, 0))
told["drilled"] = faced("drilled", quarter.cut(drill), Part.Cylinder)
cone = Part.makeCone(600, 300, 400, FreeCAD.Vector(), FreeCAD.Vector(0, 0, 1), 120)
told["cone"] = faced("cone", cone, Part.Cone)
plate = Part.makeBox(300, 200, 5).cut(Part.makeCylinder(40, 5, FreeCAD.Vector(150, 100, 0)))
at_top = [n for n, face in enumerate(plate.Faces, 1) if face.CenterOfMass.z > 4.99]
top = solid("PlateSolid", plate)
part, flat = sheets.of_faces(document, top, [f"Face{at_top[0]}"], "aluminium-1mm", "plate")
told["plate"] = said(part, flat) | {
    "true_area": plate.Faces[at_top[0] - 1].Area, "tolerance": part.Tolerance.Value}
# A wall that follows a spline, and the round and the flat of a bent sheet as one.
spline = Part.BSplineCurve()
spline.interpolate([FreeCAD.Vector(*p) for p in [(0, 0, 0), (400, 150, 0), (900, 0, 0)]])
wall = spline.toShape().extrude(FreeCAD.Vector(0, 0, 250))
told["wall"] = faced("wall", wall, Part.SurfaceOfExtrusion)
told["wall"]["true_length"] = spline.length()
bow = Part.Wire([
    Part.makeLine(FreeCAD.Vector(0, 0, 0), FreeCAD.Vector(300, 0, 0)),
    Part.Arc(FreeCAD.Vector(300, 0, 0), FreeCAD.Vector(300 + 400 * 0.5**0.5, 400 - 400 * 0.5**0.5, 0),
             FreeCAD.Vector(700, 400, 0)).toShape(),
]).extrude(FreeCAD.Vector(0, 0, 250))
told["bow"] = faced("bow", bow, Part.Plane, Part.Cylinder)
# A ball is no sheet.
told["ball"] = faced("ball", Part.makeSphere(100), Part.Sphere)

# What is saved is opened again, and made again.
path = os.path.join(folder, "hull.FCStd")
document.saveAs(path)
FreeCAD.closeDocument(document.Name)
document = FreeCAD.openDocument(path)
again = document.getObject("Side")
again.touch()
document.recompute()
told["again"] = said(again, document.getObject("SideFlat"))

# Edges in an assembly lie where its placement puts them.
inner = curve("Inner", [(0, 0, 0), (900, 310, 40), (1800, 420, 60)])
inner.Placement.Base = FreeCAD.Vector(30, 0, 0)
outer = document.getObject("Sheer")
alone, _ = sheets.between(document, (inner, "Edge1"), (outer, "Edge1"), "", "Alone")
before = sheets.design_of(alone)["curves"]["first"]["points"]
assembly = document.addObject("App::Part", "Assembly")
assembly.addObject(inner)
assembly.Placement.Base = FreeCAD.Vector(0, 700, 0)
after = sheets.design_of(alone)["curves"]["first"]["points"]
told["moved"] = [[b - a for a, b in zip(p, q)] for p, q in zip(before, after)]

# A part that can no longer be made has nothing left of what it was.
alone.Material = "no-such-material"
document.recompute()
told["left"] = alone.Proxy._made is not None

with open(os.path.join(folder, "told.json"), "w") as file:
    json.dump(told, file)
