"""A part of the benchmark document: what was measured, how, and the numbers as a Markdown table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class Section:
    """One table with its heading and the sentences that say how it was measured."""

    title: str
    text: str
    head: Sequence[str]
    rows: Sequence[Sequence[Any]]

    def markdown(self) -> str:
        """The section as Markdown; columns that hold numbers are right-aligned."""
        cells = [[_cell(value) for value in row] for row in self.rows]
        numeric = [all(_is_number(row[i]) for row in self.rows) for i in range(len(self.head))]
        rule = ["---:" if right else "---" for right in numeric]
        lines = [_line(self.head), _line(rule), *map(_line, cells)]
        return "\n".join([f"## {self.title}", "", self.text, "", *lines])


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _is_number(value: Any) -> bool:
    return value is None or (isinstance(value, (int, float)) and not isinstance(value, bool))


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
