"""A part of the benchmark document: what was measured, how, and the numbers as a Markdown table."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .table import markdown, write


@dataclass(frozen=True, kw_only=True)
class Section:
    """One table with its heading and the sentences that say how it was measured."""

    title: str
    text: str
    head: Sequence[str]
    rows: Sequence[Sequence[Any]]
    folder: str = "benchmarks/results"  # of its published file

    @property
    def name(self) -> str:
        """Of its file: the title in lower-case words joined by hyphens."""
        return re.sub(r"[^a-z0-9]+", "-", self.title.lower()).strip("-")

    @property
    def cells(self) -> list[list[str]]:
        """The rows as they are published, numbers to three significant digits."""
        return [[_cell(value) for value in row] for row in self.rows]

    def save(self, folder: Path) -> None:
        """Write the table to a file of the section's name."""
        write(folder / f"{self.name}.csv", self.head, self.cells)

    def markdown(self) -> str:
        """Heading, text and table."""
        return f"## {self.title}\n\n{self.text}\n\n{markdown(self.head, self.cells)}"

    def marked(self, *, shown: bool = True) -> str:
        """Heading, text, and a mark that `benchmarks/documents.py` fills with the table or its place."""
        word = "table" if shown else "place"
        mark = f"<!-- {word} {self.folder}/{self.name}.csv -->\n<!-- end of {word} -->"
        return f"## {self.title}\n\n{self.text}\n\n{mark}"


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return significant(value)
    return str(value)


def significant(value: float, digits: int = 3) -> str:
    """A number with so many significant digits, without an exponent where it stays short."""
    text = f"{value:.{digits}g}"
    if "e" in text and 1.0 <= abs(value) < 1e7:
        return f"{value:.0f}"
    return text
