"""Reads the `surface.step` that `sheetwright make --formats step,obj,report` wrote with OpenCASCADE.

    python .ci/step.py DIR...

Each DIR holds surface.step, surface.obj and report.json. Every panel must be a body of its own under
its name, a valid shell whose strips are B-spline surfaces, with the area that the report has to 0.1 %.
Prints the largest distance from a sample of surface.obj to the body. Ends with a line
`N passed, N failed`, and with status 1 if anything failed or nothing could be checked.
"""

import json
import sys
from pathlib import Path

import numpy as np
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.collections import Sequence_TDF_Label
from OCP.GeomAbs import GeomAbs_BSplineSurface, GeomAbs_Plane
from OCP.gp import gp_Pnt
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_SHELL
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.XCAFDoc import XCAFDoc_DocumentTool

# Samples of a panel whose distance is looked for, evenly chosen: each takes some milliseconds.
MOST_SAMPLES = 200


def bodies(path):
    """The bodies of a file, by their names."""
    document = TDocStd_Document(TCollection_ExtendedString("step"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    if reader.ReadFile(str(path)) != IFSelect_RetDone or not reader.Transfer(document):
        return {}
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    labels = Sequence_TDF_Label()
    tool.GetFreeShapes(labels)
    found = {}
    for n in range(1, labels.Length() + 1):
        label = labels.Value(n)
        name = TDataStd_Name()
        label.FindAttribute(TDataStd_Name.GetID_s(), name)
        found[name.Get().ToExtString()] = tool.GetShape_s(label)
    return found


def parts(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def groups(path):
    """The samples of each group of an OBJ file, in order."""
    found = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("g "):
            found.append([])
        elif line.startswith("v "):
            found[-1].append([float(x) for x in line.split()[1:]])
    return [np.array(points) for points in found]


def distance(shape, point):
    vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(*point)).Vertex()
    return BRepExtrema_DistShapeShape(vertex, shape).Value()


def check_folder(folder):
    """The passed and the failed checks of a folder."""
    passed = failed = 0

    def that(what, holds, found=""):
        nonlocal passed, failed
        passed, failed = passed + bool(holds), failed + (not holds)
        if not holds:
            print(f"FAILED {folder.name}, {what}: {found}")

    panels = json.loads((folder / "report.json").read_text(encoding="utf-8"))["panels"]
    shapes = bodies(folder / "surface.step")
    that("a body a panel", list(shapes) == [panel["name"] for panel in panels], list(shapes))
    for panel, samples in zip(panels, groups(folder / "surface.obj")):
        name = panel["name"]
        shape = shapes.get(name)
        if shape is None:
            continue
        that(f"{name}: valid", BRepCheck_Analyzer(shape).IsValid())
        that(f"{name}: one shell", len(list(parts(shape, TopAbs_SHELL))) == 1)
        faces = list(parts(shape, TopAbs_FACE))
        kinds = [BRepAdaptor_Surface(TopoDS.Face(face)).GetType() for face in faces]
        strips = kinds.count(GeomAbs_BSplineSurface)
        that(f"{name}: B-spline strips", strips == panel["quads"]["strips"] > 0, strips)
        that(f"{name}: planes besides", strips + kinds.count(GeomAbs_Plane) == len(kinds), kinds)
        # Faces hang together as a tree, and in a ring round each hole.
        edges = [edge for face in faces for edge in parts(face, TopAbs_EDGE)]
        sewn = sum(a.IsSame(b) for n, a in enumerate(edges) for b in edges[:n])
        that(f"{name}: sewn", sewn >= len(faces) - 1, (sewn, len(faces)))
        properties = GProp_GProps()
        # To a millionth: without it, long splines are integrated by too few points.
        BRepGProp.SurfaceProperties_s(shape, properties, 1e-6, False)
        area, wanted = properties.Mass(), panel["area_space_mm2"]
        that(f"{name}: area", abs(area - wanted) <= 1e-3 * wanted, (area, wanted))
        every = max(1, len(samples) // MOST_SAMPLES)
        far = max(distance(shape, point) for point in samples[::every])
        size = np.linalg.norm(np.ptp(samples, axis=0))
        print(
            f"{folder.name}, {name}: {strips} strips, {len(faces) - strips} planes, area off by "
            f"{abs(area / wanted - 1):.1e}, samples within {far:.2e} mm ({far / size:.1e} of the size)"
        )
    return passed, failed


def main(folders):
    results = [check_folder(Path(folder)) for folder in folders]
    passed, failed = (sum(counts) for counts in zip(*results)) if results else (0, 0)
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
