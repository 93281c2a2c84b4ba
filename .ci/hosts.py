"""Compares what the add-ons made in FreeCAD and Blender with what the command makes of their designs.

    hosts.py PROGRAM FREECAD BLENDER

Both folders have what .ci/freecad_addon.py and .ci/blender_addon.py wrote. Ends with a line
`N passed, N failed`.
"""

import json
import math
import subprocess
import sys
from pathlib import Path

program, folder, blender = sys.argv[1], *map(Path, sys.argv[2:])
told = json.loads((folder / "told.json").read_text())
passed = failed = 0


def check(what, holds, *, said=""):
    """Count a check, and say it if it does not hold."""
    global passed, failed
    if holds:
        passed += 1
    else:
        failed += 1
        print(f"failed: {what} {said}")


def by_command(name, file, out, *options):
    """The panels of the report that the command makes of a file."""
    call = [program, "make", file, "--out", out, "--quiet", *options]
    done = subprocess.run(call, check=False, stdout=subprocess.DEVNULL)
    check(f"{name}: the command makes it", done.returncode in (0, 1))
    return json.loads((out / "report.json").read_text())["panels"]


for name, file, material in [
    ("side", "side.sheet.json", "plywood-4mm"),
    ("lower", "lower.sheet.json", "plywood-4mm"),
    ("again", "lower.sheet.json", "plywood-4mm"),
    ("skin", "skin.obj", "paper"),
]:
    out = folder / f"{name}-by-command"
    [panel] = by_command(name, folder / file, out, "--material", material)
    it = told[name]
    check(f"{name}: no feature is in error", it["errors"] == [], said=it["errors"])
    check(f"{name}: verdict", it["verdict"] == panel["verdict"], said=(it["verdict"], panel["verdict"]))
    check(f"{name}: surface", it["is_valid"])
    if name == "skin":
        # FreeCAD writes OBJ with fewer digits.
        same = abs(it["area"] / panel["area_flat_mm2"] - 1) < 1e-6
        check(f"{name}: faces", it["faces"] == panel["triangles"])
    else:
        same = (it["area"], it["warp"]) == (panel["area_flat_mm2"], panel["warp_max_deg"])
        check(f"{name}: smooth faces", 1 <= it["faces"] < 50, said=it["faces"])
        check(f"{name}: lines of the sketch", it["lines"] == panel["samples"])
    check(f"{name}: numbers to the last bit", same, said=(it, panel["area_flat_mm2"]))
    # Smooth faces lie a little off the triangles that the report measures.
    near = abs(it["area_space"] / panel["area_space_mm2"] - 1) < 2e-3
    check(f"{name}: area in space", near, said=it["area_space"])
    size = [panel["flat_width_mm"], panel["flat_height_mm"]]
    fits = all(abs(a - b) < 1e-6 for a, b in zip(it["sketch"], size, strict=True))
    check(f"{name}: size of the sketch", fits, said=(it["sketch"], size))
    if name == "side":
        written = [path.read_bytes() for path in (folder / "Side.dxf", out / "Side.dxf")]
        check("side: the DXF has the bytes of the command's", written[0] == written[1])
# Faces, whose patterns theory knows: chords are shorter than arcs, by about twice their distance
# from them round a full turn.
turn = 2 * math.pi
for name, width, height in [
    ("quarter", turn / 4 * 500, 200),
    ("tube", turn * 300, 400),
    ("plate", 300, 200),
    ("wall", told["wall"]["true_length"], 250),
    ("bow", 300 + turn / 4 * 400, 250),
    # A sector: the slant lengths are 500 and 1000, the angle is 120° · 300 / 500.
    ("cone", 2 * 1000 * math.sin(turn / 10), 1000 - 500 * math.cos(turn / 10)),
    ("drilled", turn / 4 * 500, 200),
]:
    it = told[name]
    size = sorted(it["sketch"], reverse=True)
    off = max(abs(a - b) for a, b in zip(size, (width, height), strict=True))
    within = 2.2 * it["tolerance"]
    check(f"{name}: size by theory", off < within, said=(size, (width, height)))
    off = abs(it["area"] - it["true_area"])
    check(f"{name}: area", off < within * (width + height), said=(it["area"], it["true_area"]))
    check(f"{name}: it bends", it["verdict"] in ("bends", "roll"), said=it["verdict"])
check("a ball does not bend", told["ball"]["verdict"] == "will-not-bend")
check("a face lies where its assembly does", abs(told["quarter"]["low"] - 300) < 1e-6)
for name in ("quarter", "tube", "drilled", "cone", "wall", "bow", "ball"):
    [panel] = by_command(name, folder / f"{name}.sheet.json", folder / f"{name}-by-command")
    same = told[name]["area"] == panel["area_flat_mm2"]
    check(f"{name}: numbers to the last bit", same, said=(told[name]["area"], panel))
far = max(abs(a - b) for way in told["moved"] for a, b in zip(way, (0, 700, 0), strict=True))
check("an edge lies where its assembly does", far < 1e-9, said=far)
check("a part that can't be made keeps no old one", not told["left"])
check("the part follows its edge", told["side"]["area"] != told["lower"]["area"])

# Blender.
told = json.loads((blender / "told.json").read_text())
for name in ("box", "lid", "plain", "tent", "cone"):
    it, out = told[name], blender / f"{name}-by-command"
    panels = by_command(name, blender / f"{name}.sheet.json", out)
    mine = (it["verdict"], it["area"], it["space"])
    theirs = (
        ", ".join(panel["verdict"] for panel in panels),
        [panel["area_flat_mm2"] for panel in panels],
        [panel["area_space_mm2"] for panel in panels],
    )
    check(f"{name}: numbers to the last bit", mine == theirs, said=(mine, theirs))
    said = [f["text"] for panel in panels for f in panel["findings"]]
    check(f"{name}: the same findings", set(said) <= set(it["said"]), said=(said, it["said"]))
    files = list((blender / name).iterdir())
    check(f"{name}: files", {file.suffix for file in files} == {".svg", ".pdf", ".dxf"})
    for file in files:
        same = file.read_bytes() == (out / file.name).read_bytes()
        check(f"{name}: {file.name} has the bytes of the command's", same)
    # Blender has single precision.
    for what in ("patterns", "bent"):
        flat = zip(it[what], it["area"], strict=True)
        near = all(abs(a / b - 1) < 1e-6 for a, b in flat)
        check(f"{name}: {what} in true size", near, said=(it[what], it["area"]))
    check(f"{name}: beside the object", it["apart"])
    check(f"{name}: no line is told as unused", not any("beside the faces" in text for text in it["said"]))
check("box: its area", abs(told["box"]["area"][0] / (2 * (60 * 40 + 60 * 20 + 40 * 20)) - 1) < 1e-9)
lengths = sorted(round(edge[1]) for edge in told["box"]["edges"])
# The seven seams that are marked, each on both its sides.
check("box: cut at its seams", lengths == sorted(2 * [40, 60, 40, 20, 20, 20, 20]), said=lengths)
check("without its seams, the box is cut elsewhere", told["plain"]["edges"] != told["box"]["edges"])
check("seams round the lid part it", [round(a) for a in told["lid"]["area"]] == [6400, 2400])
for name, corners in (("box", 24), ("lid", 24), ("cone", 192)):
    check(f"{name}: UV map", len(told[name]["uv"]) == corners)
    inside = all(-1e-6 <= c <= 1 + 1e-6 for uv in told[name]["uv"] for c in uv)
    check(f"{name}: UV map within the square", inside)
check("tent: no UV map where a modifier makes half of it", told["tent"]["uv"] == [])
# Two slopes of 0.75 m × 1.25 m in all: scaled to half.
slopes = 2 * 1250 * 1500
check("tent: modifiers, scale and units", abs(told["tent"]["area"][0] / slopes - 1) < 1e-6)
check("one seam opens the cone", told["cone"]["seams"] == 1)
check("a thickness is as it was typed", told["plain"]["thickness"] == 0.8, said=told["plain"]["thickness"])
check("without one, it is that of the material", told["cone"]["thickness"] is None)
check("patterns that people changed are replaced", told["patterns"] == ["MESH"], said=told["patterns"])
check("a copy of a pattern keeps the mesh", told["copy"] > 0)
check("an unknown format is refused in words", "stl9" in told["format"], said=told["format"])
check("it leaves the patterns", told["kept"] == ["MESH"] and told["verdict"] == told["cone"]["verdict"])
check("off leaves nothing", told["is_gone"])
check("unfolded again, it replaces what was there", told["again"] == 0)
check("out of edit mode and back", told["mode"] == "EDIT")
check("a Möbius strip is refused in words", "one side only" in told["moebius"])
check("a mesh without faces is refused in words", "no triangle" in told["bare"])
check("an unknown material is refused in words", "is not known" in told["unknown"])
check("a folder beside no file is refused", "Save the Blender file" in told["unsaved"])
check("what can't be made leaves no old pattern", told["left"] == [])
check("without a mesh there is nothing to press", "poll" in told["none"])
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0 or passed == 0)
