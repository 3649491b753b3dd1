"""`Kind`: one kind of records in text, as the readers of motions, sea states and scatter tables know it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

MOST_ABOVE, LONGEST = 100, 2000  # lines that may stand above what tells a kind, and characters of it
MOTIONS, SEA_STATES, SCATTER = "MeasuredSeries.load", "WaveHindcast.load", "ScatterDiagram.load"


class Columns(NamedTuple):
    """A record as columns: a header with units, and for each line of the file its row, or no text.

    `line` is that of the file's own header, from 1 on; a `fix` says what the record needs where it holds too
    little to be one.
    """

    header: str
    rows: Sequence[str]
    line: int = 1
    fix: str = ""


@dataclass(frozen=True, kw_only=True)
class Kind:
    """One kind of records.

    Attributes
    ----------
    name : for messages.
    looks : what a file of it looks like, in words.
    layout : where its layout is told.
    reader : what reads it, such as "WaveHindcast.load".
    is_it : whether the first lines of a file are of this kind.
    columns : its lines as columns, rearranged and not yet read; `rate_hz` where it has no clock (None: not
        given). None: it has another reader.
    """

    name: str
    looks: str
    layout: str
    reader: str
    is_it: Callable[[Sequence[str]], bool]
    columns: Callable[[Sequence[str], float | None], Columns] | None = None


def place_of(lines: Sequence[str], *patterns: re.Pattern[str]) -> int:
    """The first line that holds one of the patterns, from 0 on; -1: none of the first lines does."""
    near = enumerate(line[:LONGEST] for line in lines[:MOST_ABOVE])
    return next((place for place, line in near if any(one.search(line) for one in patterns)), -1)


def has(*patterns: re.Pattern[str]) -> Callable[[Sequence[str]], bool]:
    """Whether one of the first lines holds one of the patterns."""
    return lambda lines: place_of(lines, *patterns) >= 0
