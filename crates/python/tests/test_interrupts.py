"""Ctrl-C ends long work soon."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest

LONG = """
import numpy as np, pysheetwright as sw
t = np.linspace(0, 2 * np.pi, {count}, endpoint=False)
loop = np.column_stack([300 * np.cos(t), 200 * np.sin(t), 40 * np.cos(3 * t)])
print("begun", flush=True)
{call}
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends signals to whole consoles")
@pytest.mark.parametrize(
    ("count", "call"),
    [(6000, "sw.solve(loop)"), (300, "sw.solve_many([loop] * 20000)")],
)
def test_a_signal_ends_the_call(count: int, call: str) -> None:
    program = LONG.format(count=count, call=call)
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "begun\n"
        time.sleep(1.0)
        assert child.poll() is None, "the work was done too soon for this test"
        child.send_signal(signal.SIGINT)
        _, said = child.communicate(timeout=20)
    assert "KeyboardInterrupt" in said
