"""Tables of text and numbers as HTML; everything that a user may have named is escaped."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from html import escape
from typing import Any

import numpy as np

NOTEBOOK = (
    ".seacrane td, .seacrane th, .seacrane caption { text-align: left; } "
    ".seacrane td:first-child { white-space: nowrap; } .seacrane td.number { text-align: right; } "
    ".seacrane .facts td.number { text-align: left; }"
)


def format_value(value: Any) -> str:
    """A number with five significant digits and no more, integers in full, anything else as it prints."""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (float, np.floating)):
        return f"{float(value):.5g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(format_value(item) for item in value)
    return "" if value is None else str(value)


def cell(value: Any, *, right: bool = False) -> str:
    """One cell, escaped; numbers are aligned to the right."""
    number = isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
    kind = ' class="number"' if number or right else ""
    return f"<td{kind}>{escape(format_value(value))}</td>"


def table(
    head: Sequence[str], rows: Iterable[Sequence[Any]], *, caption: str = "", right: Collection[int] = ()
) -> str:
    """Rows under a head, columns of `right` to the right; where it is empty, names beside values."""
    above = f"<caption>{escape(caption)}</caption>" if caption else ""
    names = "".join(f"<th>{escape(name)}</th>" for name in head)
    top = f"<thead><tr>{names}</tr></thead>" if head else ""
    cells = ("".join(cell(value, right=i in right) for i, value in enumerate(row)) for row in rows)
    lines = "\n".join(f"<tr>{row}</tr>" for row in cells)
    kind = "" if head else ' class="facts"'
    return f"<table{kind}>{above}{top}<tbody>\n{lines}\n</tbody></table>"


def notebook_table(
    head: Sequence[str],
    rows: Iterable[Sequence[Any]],
    *,
    caption: str,
    notes: Iterable[str] = (),
    right: Collection[int] = (),
) -> str:
    """A table for an output cell, whose own style would set texts to the right, and notes, each by itself."""
    below = "".join(f"<p>{escape(one)}</p>" for one in notes)
    shown = table(head, rows, caption=caption, right=right)
    return f'<div class="seacrane"><style>{NOTEBOOK}</style>{shown}{below}</div>'
