"""Runs in FreeCAD without a screen: makes parts of edges and of a mesh, and tells their numbers.

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
