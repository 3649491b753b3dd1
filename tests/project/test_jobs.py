"""The jobs: short scripts, run as a user would run them, that print what their page shows."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
JOBS = sorted((ROOT / "examples" / "jobs").glob("*.py"))
DOCUMENT = ROOT / "examples" / "jobs" / "README.md"
SECTION = re.compile(
    r"^## [^\n]+\n\n[^`]+\((?P<script>\w+\.py)\)\.\n\n```text\n(?P<printed>[^`]+)```\n", re.MULTILINE
)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")
ROUNDING = 0.01  # in any unit that is printed


def words(text: str) -> list[str]:
    """Without its numbers, and however wide these are."""
    return NUMBER.sub("#", text).split()


def numbers(text: str) -> list[float]:
    return [float(number) for number in NUMBER.findall(text)]


LONG = (
    "feeder_starts", "planning_sheet", "feeder_two_ships", "hypercube", "tip_rao", "load_chart", "mru_record",
    "three_hours",
)  # fmt: skip
BY_NIGHT = pytest.mark.slow("many runs")


@pytest.mark.parametrize(
    "job", [pytest.param(path, marks=BY_NIGHT if path.stem in LONG else [], id=path.stem) for path in JOBS]
)
def test_a_job_prints_what_its_document_shows(job: Path, tmp_path: Path) -> None:
    """Words exactly, numbers within 5 %: `python benchmarks/run.py --only jobs` writes the document anew."""
    done = subprocess.run(
        [sys.executable, str(job)], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "hand" in words(done.stdout) and "nan" not in words(done.stdout)
    assert list(tmp_path.iterdir()) == []
    sections = SECTION.finditer(DOCUMENT.read_text(encoding="utf-8"))
    shown = {section["script"]: section["printed"] for section in sections}
    assert job.name in shown, f"{DOCUMENT} has no {job.name}"
    assert words(done.stdout) == words(shown[job.name])
    assert numbers(done.stdout) == pytest.approx(numbers(shown[job.name]), rel=0.05, abs=ROUNDING)
