"""Compares what the add-on made in FreeCAD with what the command makes of the same design or mesh.

    hosts.py PROGRAM FOLDER

FOLDER has what .ci/freecad_addon.py wrote. Ends with a line `N passed, N failed`.
"""

import json
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
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


for name, file, material in [
    ("side", "side.sheet.json", "plywood-4mm"),
    ("lower", "lower.sheet.json", "plywood-4mm"),
    ("again", "lower.sheet.json", "plywood-4mm"),
    ("skin", "skin.obj", "paper"),
]:
    out = folder / f"{name}-by-command"
    call = [program, "make", folder / file, "--out", out, "--quiet", "--material", material]
    done = subprocess.run(call, check=False, stdout=subprocess.DEVNULL)
    check(f"{name}: the command makes it", done.returncode in (0, 1))
    [panel] = json.loads((out / "report.json").read_text())["panels"]
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
far = max(abs(a - b) for way in told["moved"] for a, b in zip(way, (0, 700, 0), strict=True))
check("an edge lies where its assembly does", far < 1e-9, said=far)
check("a part that can't be made keeps no old one", not told["left"])
check("the part follows its edge", told["side"]["area"] != told["lower"]["area"])
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0 or passed == 0)
