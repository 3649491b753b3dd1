"""Tables of text for terminals."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence


def text_table(
    head: Sequence[str], rows: Iterable[Sequence[str]], *, right: Collection[int] = frozenset()
) -> str:
    """Columns two spaces apart, aligned to the left, or to the right those whose numbers are given."""
    lines = [list(head), *map(list, rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    return "\n".join(
        "  ".join(
            cell.rjust(width) if i in right else cell.ljust(width)
            for i, (cell, width) in enumerate(zip(line, widths, strict=True))
        ).rstrip()
        for line in lines
    )
