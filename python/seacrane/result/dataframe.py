"""Curves of a result as columns of a table, each under the text that picks it."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import unit_of
from seacrane.description.pick import Pick, column_name
from seacrane.errors import SceneError

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.float64]


def dataframe_of(
    time: Array,
    picks: Sequence[tuple[Pick, Array]],
    dims: Mapping[str, Sequence[str]],
    coords: Mapping[str, Sequence[str]],
) -> pandas.DataFrame:
    """A column for each curve of each (selector, values of `Result.select`), by time.

    Raises
    ------
    SceneError
        Where selectors begin at different times.
    """
    import pandas

    begin = {pick.after for pick, _ in picks}
    if len(begin) > 1:
        raise SceneError("table: its columns begin at one time; give every selector the same after=, or none")
    after = next(iter(begin), None)
    late = slice(0 if after is None else int(np.searchsorted(time, after)), None)
    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for pick, values in picks:
        own = dims[pick.channel][1:]
        left = [dim for dim in own if dim not in pick.names]
        curves = values.reshape(time.size, -1).T
        for curve, rest in zip(curves, itertools.product(*(coords[dim] for dim in left)), strict=True):
            named = {**pick.names, **dict(zip(left, rest, strict=True))}
            name = column_name(pick.channel, [named[dim] for dim in own])
            columns[name], units[name] = curve[late], unit_of(pick.channel, named.values())
    table = pandas.DataFrame(columns, index=pandas.Index(time[late], name="time"))
    table.attrs["units"] = units
    return table
