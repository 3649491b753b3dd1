"""Docstrings as reStructuredText."""

from __future__ import annotations

import re
from typing import Any

LITERAL = re.compile(r"(``.*?``)")


def keep_bars(app: Any, kind: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    """Bars of a formula, |x|, are bars: docstrings know no substitutions."""
    for at, line in enumerate(lines):
        parts = LITERAL.split(line)
        parts[::2] = [part.replace("|", r"\|") for part in parts[::2]]
        lines[at] = "".join(parts)
