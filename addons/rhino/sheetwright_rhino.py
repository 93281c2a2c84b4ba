#! python3
"""For Rhino's Python editor: select curves or meshes and run it; patterns come back on layers.

Rhino's own Python (3.9) is older than what pysheetwright takes, so the script exports the selection
and calls another Python, which has the package: set SHEETWRIGHT_PYTHON to it. docs/rhino.md has more.
"""

import os
import subprocess
import tempfile

import rhinoscriptsyntax as rs

PYTHON = os.environ.get("SHEETWRIGHT_PYTHON", "python3")


def unfold(material):
    """Export the selection, make it, and import what came of it; returns what was said."""
    with tempfile.TemporaryDirectory() as folder:
        given, made = (os.path.join(folder, name) for name in ("selection.3dm", "pattern.3dm"))
        rs.Command('_-Export "{}" _Enter'.format(given), False)
        if not os.path.exists(given):
            return "Nothing was exported: select curves or meshes first."
        call = [PYTHON, "-m", "pysheetwright.rhino", given, made]
        if material:
            call += ["--material", material]
        # Rhino sets variables for its own Python, which would lead another one astray.
        clean = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        # Elsewhere than on Windows it is so anyway.
        clean["PYTHONIOENCODING"] = "utf-8"
        done = subprocess.run(
            call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=clean, encoding="utf-8"
        )
        if os.path.exists(made):
            rs.Command('_-Import "{}" _Enter'.format(made), False)
        return done.stdout + done.stderr


if __name__ == "__main__":
    chosen = rs.SelectedObjects() or rs.GetObjects("Curves or meshes", preselect=True)
    if chosen:
        rs.SelectObjects(chosen)
        name = rs.GetString("Material, such as steel-1mm; Enter for none")
        # Esc gives None.
        if name is not None:
            print(unfold(name))
