"""Curves of a result as columns of a table, each under the text that picks it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import unit_of
from seacrane.description.pick import Pick, column_name
from seacrane.plotting.table import Column, Table

Array = NDArray[np.float64]


def curves_of(
    time: Array,
    picks: Sequence[Pick],
    channels: Mapping[str, Array],
    dims: Mapping[str, Sequence[str]],
    coords: Mapping[str, Sequence[str]],
    part: slice,
) -> Table:
    """A column for each curve of each selector, by the times of a part."""
    found: dict[str, Column] = {}
    for pick in picks:
        for names, curve in pick.curves(channels[pick.channel], dims[pick.channel], coords):
            name, unit = (
                column_name(pick.channel, list(names.values())),
                unit_of(pick.channel, names.values()),
            )
            found[name] = Column(name=name, values=curve[part], unit=unit)
    return Table(axes=[Column(name="time", values=time[part], unit="s")], columns=list(found.values()))
