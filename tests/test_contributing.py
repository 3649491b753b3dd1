"""The worked examples of docs/contributing.md fit the code as it is."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
DOCUMENT = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"<summary>(.*?)</summary>\n\n```diff\n(.*?)```", DOCUMENT, re.DOTALL)


def test_every_kind_has_an_example() -> None:
    assert len(EXAMPLES) == DOCUMENT.count("```diff") >= 5


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not there to apply a diff")
@pytest.mark.parametrize(("name", "diff"), EXAMPLES, ids=[name for name, _ in EXAMPLES])
def test_an_example_applies(name: str, diff: str) -> None:
    command = ["git", "apply", "--check", "-"]
    done = subprocess.run(command, cwd=ROOT, input=diff, capture_output=True, text=True)
    assert done.returncode == 0, f"{name}: {done.stderr}"


@pytest.mark.parametrize(("name", "diff"), EXAMPLES, ids=[name for name, _ in EXAMPLES])
def test_an_addition_takes_at_most_three_files(name: str, diff: str) -> None:
    assert 1 <= len(re.findall(r"^diff --git ", diff, re.MULTILINE)) <= 3
