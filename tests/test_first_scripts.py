"""Scripts of somebody who has read the README alone run as they stand, each in a fresh interpreter."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parent / "first_scripts"


@pytest.mark.parametrize("script", sorted(SCRIPTS.glob("*.py")), ids=lambda path: path.stem)
def test_a_first_script_runs_and_prints_what_it_says(script: Path, tmp_path: Path) -> None:
    """The last line of each is a comment that begins its last line of output."""
    ran = subprocess.run(
        [sys.executable, "-W", "ignore", script], cwd=tmp_path, capture_output=True, text=True, timeout=300
    )
    assert ran.returncode == 0, ran.stderr
    expected = script.read_text().splitlines()[-1].removeprefix("# ")
    assert expected in ran.stdout, ran.stdout
