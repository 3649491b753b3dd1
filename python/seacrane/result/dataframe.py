"""Curves of a result as columns of a table, each under the text that picks it."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import unit_of
from seacrane.description.pick import Pick, column_name

if TYPE_CHECKING:
    import pandas

Array = NDArray[np.float64]


def dataframe_of(
    time: Array,
    picks: Sequence[tuple[Pick, Array]],
    dims: Mapping[str, Sequence[str]],
    coords: Mapping[str, Sequence[str]],
    part: slice,
) -> pandas.DataFrame:
    """A column for each curve of each (selector, values of `Result.select`), by the times of a part."""
    import pandas

    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for pick, values in picks:
        own = dims[pick.channel][1:]
        left = [dim for dim in own if dim not in pick.names]
        curves = values.reshape(time.size, -1).T
        for curve, rest in zip(curves, itertools.product(*(coords[dim] for dim in left)), strict=True):
            named = {**pick.names, **dict(zip(left, rest, strict=True))}
            name = column_name(pick.channel, [named[dim] for dim in own])
            columns[name], units[name] = curve[part], unit_of(pick.channel, named.values())
    table = pandas.DataFrame(columns, index=pandas.Index(time[part], name="time"))
    table.attrs["units"] = units
    return table
