"""The kinds of records, told by what they look like; a file of no kind is read as columns with a header."""

from __future__ import annotations

from collections.abc import Sequence

from seacrane.sea.records import ndbc, nmea, scatter, spotter
from seacrane.sea.records.kind import Kind

KINDS: tuple[Kind, ...] = (*ndbc.KINDS, *spotter.KINDS, *nmea.KINDS, *scatter.KINDS)


def kind_of(lines: Sequence[str]) -> Kind | None:
    """The first kind that the first lines of a file are of; None: columns of no known kind."""
    return next((one for one in KINDS if one.is_it(lines)), None)
