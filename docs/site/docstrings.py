"""Docstrings and signatures as the site shows them."""

from __future__ import annotations

import re
from typing import Any

from sphinx.util.inspect import TypeAliasForwardRef

LITERAL = re.compile(r"(``.*?``)")
ARRAY = re.compile(
    r"[~.\w]*ndarray\[tuple\[[~.\w]*Any, \.\.\.\], [~.\w]*dtype\[[~.\w]*?(\w+)(?:\[[~.\w]*\])?\]\]"
)


def name_aliases() -> None:
    """Aliases of types by their names within other types too, where Sphinx takes what they print."""
    TypeAliasForwardRef.__repr__ = lambda self: str(self.name)  # type: ignore[method-assign]


def keep_bars(app: Any, kind: str, name: str, value: Any, options: Any, lines: list[str]) -> None:
    """Bars of a formula, |x|, are bars: docstrings know no substitutions."""
    for at, line in enumerate(lines):
        parts = LITERAL.split(line)
        parts[::2] = [part.replace("|", r"\|") for part in parts[::2]]
        lines[at] = "".join(parts)


def shorten(
    app: Any, kind: str, name: str, value: Any, options: Any, arguments: str | None, answer: str | None
) -> tuple[str | None, str | None]:
    """Arrays of any shape as the code writes them, NDArray[float64]; defaults that are made anew as `...`."""
    short = [
        text and ARRAY.sub(r"NDArray[\1]", text).replace("<factory>", "...") for text in (arguments, answer)
    ]
    return short[0], short[1]
