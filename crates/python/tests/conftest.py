from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def examples() -> Path:
    return ROOT / "examples"


@pytest.fixture(scope="session")
def corpus() -> Path:
    return ROOT / "corpus"


@pytest.fixture(scope="session")
def command() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run the command that was built beside the package: SHEETWRIGHT names it."""
    program = Path(os.environ.get("SHEETWRIGHT", ROOT / "target/release/sheetwright"))
    if not program.exists():
        pytest.fail(f"there is no {program}: build the command, or name it in SHEETWRIGHT")

    def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        texts = [str(argument) for argument in arguments]
        done = subprocess.run([program, *texts], capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1), done.stderr
        return done

    return run
