"""Python blocks of documents run in order, from the first to the last, as a reader would paste them."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from veres_writer import VeresRun

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
SAMPLE = ("README.md", "docs/getting-started.md", "docs/winches.md", "docs/stages.md", "docs/hydraulics.md")
PATHS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
TEXTS = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8") for path in PATHS}
RUN = [name for name, text in TEXTS.items() if BLOCK.search(text)]


def as_script(text: str) -> str:
    """The blocks alone, each on the lines where the document has it, so that tracebacks name these."""
    out = ["\n"] * (text.count("\n") + 1)
    for found in BLOCK.finditer(text):
        at = text.count("\n", 0, found.start(1))
        lines = found[1].splitlines(keepends=True)
        out[at : at + len(lines)] = lines
    return "".join(out)


TOLD_OF_THE_GIVEN = {
    "docs/frequency-domain.md": {"InfiniteFrequencyWarning", "MemoryFitWarning"},
    "docs/winches.md": {"WinchLimitWarning"},  # a motor and a brake at their bounds are what it shows
    "docs/hydraulics.md": {"BoilingOilWarning"},  # and a hose that bursts
}


def run(name: str, text: str, folder: Path) -> subprocess.CompletedProcess[str]:
    script = folder / f"{Path(name).stem}.py"
    script.write_text(as_script(text), encoding="utf-8")
    command = [sys.executable, script.name]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=900, check=False)


MANY = pytest.mark.slow("all blocks of a document")


@pytest.mark.parametrize("name", [name if name in SAMPLE else pytest.param(name, marks=MANY) for name in RUN])
def test_blocks_of_a_document_run_in_order_without_a_warning(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MPLBACKEND", "agg")
    if name == "docs/frequency-domain.md":
        (tmp_path / "ship").mkdir()
        VeresRun(speeds=(0.0, 5.0), omega=np.linspace(0.2, 2.4, 23)).write(tmp_path / "ship")
    done = run(name, TEXTS[name], tmp_path)
    assert done.returncode == 0, done.stderr
    told = set(re.findall(r"(\w+Warning):", done.stderr))
    assert told <= TOLD_OF_THE_GIVEN.get(name, set()), done.stderr
