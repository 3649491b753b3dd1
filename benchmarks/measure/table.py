"""A table of texts: its file, and how a document shows it."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from seacrane.inputs.atomic import atomic_write

from .sources import record


def read(path: Path) -> tuple[list[str], list[list[str]]]:
    """Head and rows of a CSV file."""
    with path.open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    return head, rows


def write(path: Path, head: Sequence[str], rows: Sequence[Sequence[str]], **about: Any) -> None:
    """A CSV file, complete or not at all, with what measured it noted beside it (see `record`)."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with atomic_write(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
    record(path, **about)


def markdown(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table; columns that hold nothing but numbers are right-aligned."""
    numeric = [all(_is_number(row[k]) for row in rows) for k in range(len(head))]
    rule = ["---:" if right else "---" for right in numeric]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (head, rule, *rows))


def _is_number(cell: str) -> bool:
    return re.fullmatch(r"([-+]?[\d.,]+(e[-+]?\d+)?)?", cell) is not None
