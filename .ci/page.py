"""Runs the Python of a page as a notebook does, compares what it prints, and makes its pictures.

    page.py PAGE [--write]

Blocks ```python run one after the other in one namespace, in a folder of their own that has the
examples; what a block prints stands in the block ```text after it. With --write, outputs and
pictures of the page are brought up to date; without, outputs that differ, pictures that are not
made and pictures of ours (SVG) with other bytes fail.
"""

import contextlib
import io
import os
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", re.DOTALL)


def main(page: Path, write: bool) -> int:
    """Run the page; the number of faults."""
    text = page.read_text()
    home = Path.cwd()
    faults, namespace = 0, {"__name__": "__main__"}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        Path("examples").symlink_to(ROOT / "examples")
        Path("pictures").mkdir()

        def run(match: re.Match[str]) -> str:
            nonlocal faults
            code, told = match.groups()
            line = text.count("\n", 0, match.start(1)) + 1
            with contextlib.redirect_stdout(io.StringIO()) as said:
                # Lines before it, so that a traceback names the line of the page.
                exec(compile("\n" * (line - 1) + code, str(page), "exec"), namespace)  # noqa: S102
            printed = said.getvalue()
            if printed != (told or "") and not write:
                print(f"{page}:{line}: printed\n{printed}and the page has\n{told}")
                faults += 1
            after = f"\n```text\n{printed}```\n" if printed else ""
            return f"```python\n{code}```\n{after}"

        new = BLOCK.sub(run, text)
        if "```python" not in text:
            print(f"{page}: no block of Python")
            faults += 1
        shown = set(re.findall(r"\]\(pictures/(python-[^)]+)\)", text))
        made = {path.name for path in Path("pictures").iterdir()}
        if shown != made:
            print(f"{page}: shows {sorted(shown)} and makes {sorted(made)}")
            faults += 1
        for name in sorted(made):
            kept, bytes_now = page.parent / "pictures" / name, Path("pictures", name).read_bytes()
            if write:
                kept.write_bytes(bytes_now)
            elif not kept.exists() or (name.endswith(".svg") and kept.read_bytes() != bytes_now):
                print(f"{kept}: has other bytes; run .ci/page.py {page} --write")
                faults += 1
        os.chdir(home)
    if write:
        page.write_text(new)
    print(f"{page}: {len(BLOCK.findall(text))} blocks ran, {faults} faults")
    return faults


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).absolute(), "--write" in sys.argv[2:]) > 0)
