"""What decides reads fields, never a text that is written for people."""

from __future__ import annotations

import re
from pathlib import Path

READS_AN_ERROR = r"in (str|repr)\((error|e|exc|caught|refused)\)"
READS_A_STAT = r"json\.loads\(str\("


def found(repository: Path, pattern: str) -> list[str]:
    package = repository / "python" / "seacrane"
    return [
        f"{path.relative_to(package)}: {line.strip()}"
        for path in sorted(package.rglob("*.py"))
        for line in path.read_text("utf-8").splitlines()
        if re.search(pattern, line)
    ]


def test_no_decision_reads_the_text_of_an_error(repository: Path) -> None:
    known = [line for line in found(repository, READS_AN_ERROR) if "quasi-static" not in line]
    assert known == []


def test_what_is_structured_is_not_text_in_the_stats(repository: Path) -> None:
    assert found(repository, READS_A_STAT) == []
