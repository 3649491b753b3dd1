"""A result as a table for notebooks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from seacrane.description.channels import CHANNELS
from seacrane.plotting.html import notebook_table


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
