"""Reads every DXF that `sheetwright make --out DIR` wrote with FreeCAD, which says nothing of good ones.

    python3 .ci/freecad.py DIR...

Needs Debian's `freecad`, and no screen. What FreeCAD prints while it reads a file is a failure, and so
is a drawing that is not as large as the report says. Ends with a line `N passed, N failed`, and with
status 1 if anything failed or nothing was read.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# How far FreeCAD has come, which it says of every file.
PROGRESS = re.compile(r"\s*(Recompute\.+|\(\d+ %\))?\s*")
# Runs inside FreeCAD. Each file is announced, and after it stands the box around its lines.
READER = """
import FreeCAD, Import, json
for number, path in enumerate(json.loads({paths!r})):
    print("FILE", path, flush=True)
    document = FreeCAD.newDocument("d%d" % number)
    Import.readDXF(path, document.Name)
    boxes = [o.Shape.BoundBox for o in document.Objects if not o.Shape.isNull()]
    box = FreeCAD.BoundBox()
    for other in boxes:
        box.add(other)
    print("BOX", json.dumps([len(boxes), box.XMin, box.YMin, box.XMax, box.YMax]), flush=True)
    FreeCAD.closeDocument(document.Name)
print("END", flush=True)
"""


def told(paths):
    """What FreeCAD says of each file, and the box that it found."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "read.py"
        script.write_text(READER.format(paths=json.dumps([str(path) for path in paths])))
        run = subprocess.run(
            ["freecadcmd", str(script)],
            env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "HOME": folder},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=600,
            check=True,
        )
    found = {}
    said = None
    for line in run.stdout.splitlines():
        if line.startswith("FILE "):
            said = found.setdefault(line[5:], {"said": [], "box": None})
        elif line.startswith("BOX ") and said:
            said["box"] = json.loads(line[4:])
            said = None
        elif said and not PROGRESS.fullmatch(line):
            said["said"].append(line)
    return found


def main(folders):
    passed = failed = 0
    for folder in map(Path, folders):
        panels = json.loads((folder / "report.json").read_text(encoding="utf-8"))["panels"]
        paths = {folder / f"{panel['name']}.dxf": panel for panel in panels}
        paths = {path: panel for path, panel in paths.items() if path.exists()}
        found = told(paths)
        for path, panel in paths.items():
            answer = found.get(str(path), {"said": ["it was not read"], "box": None})
            wrong = list(answer["said"])
            count, left, below, right, above = answer["box"] or [0, 0, 0, 0, 0]
            size = panel["flat_width_mm"], panel["flat_height_mm"]
            # Beside the piece stand its dimensions and the reference square, where there are notes.
            has_notes = re.search(r"^(note|pen)\r?$", path.read_text(encoding="utf-8"), re.MULTILINE)
            across = size[0] + (100 if has_notes else -1e-3)
            if count == 0 or right - left < across or above - below < size[1] - 1e-3:
                wrong.append(f"{count} lines, {right - left} × {above - below} mm of {size}")
            for what in wrong:
                print(f"FAILED {path.name}: {what}")
            failed += bool(wrong)
            passed += not wrong
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
