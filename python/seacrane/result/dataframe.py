"""Curves of a result as columns of a table, each under the text that picks it."""

from __future__ import annotations

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
    picks: Sequence[Pick],
    channels: Mapping[str, Array],
    dims: Mapping[str, Sequence[str]],
    coords: Mapping[str, Sequence[str]],
    part: slice,
) -> pandas.DataFrame:
    """A column for each curve of each selector, by the times of a part."""
    import pandas

    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for pick in picks:
        for names, curve in pick.curves(channels[pick.channel], dims[pick.channel], coords):
            name = column_name(pick.channel, list(names.values()))
            columns[name], units[name] = curve[part], unit_of(pick.channel, names.values())
    table = pandas.DataFrame(columns, index=pandas.Index(time[part], name="time"))
    table.attrs["units"] = units
    return table
