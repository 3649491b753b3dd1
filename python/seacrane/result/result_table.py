"""A result as a table: for notebooks, and as text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS
from seacrane.plotting.html import notebook_table
from seacrane.plotting.text import text_table
from seacrane.result.extremes import Extremes


def as_html(caption: str, dims: Mapping[str, Sequence[str]], coords: Mapping[str, Sequence[str]]) -> str:
    """The channels that were recorded: dimensions with their sizes, units and meaning."""
    rows = [
        (
            name,
            ", ".join(f"{dim} {len(coords[dim])}" for dim in of[1:]),
            CHANNELS[name].unit,
            CHANNELS[name].long_name,
        )
        for name, of in dims.items()
    ]
    return notebook_table(("channel", "dimensions beside time", "unit", ""), rows, caption=caption)


def as_text(
    caption: str,
    channels: Mapping[str, NDArray[np.float64]],
    extremes: Extremes,
    dims: Mapping[str, Sequence[str]],
) -> str:
    """The channels that were recorded, with the smallest and the largest value of each."""
    rows = [
        (
            name,
            ", ".join(dims[name][1:]),
            *_extremes(np.stack(extremes.get(name, (values, values)))),
            CHANNELS[name].unit,
        )
        for name, values in channels.items()
    ]
    head = ("channel", "along", "smallest", "largest", "unit")
    return f"{caption}\n{text_table(head, rows, right=(2, 3))}" if rows else caption


def _extremes(values: NDArray[np.float64]) -> tuple[str, str]:
    """The extremes of what is finite."""
    finite = values[np.isfinite(values)]
    return (f"{finite.min():.4g}", f"{finite.max():.4g}") if finite.size else ("", "")
