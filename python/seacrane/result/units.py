"""The units of a channel's curves, and of tables that people read."""

from __future__ import annotations

import re

import numpy as np

from seacrane.description.channels import CHANNELS

READ: dict[str, tuple[float, str]] = {
    "rad": (float(np.degrees(1.0)), "deg"),
    "rad/s": (float(np.degrees(1.0)), "deg/s"),
    "N": (1e-3, "kN"),
    "N m": (1e-3, "kN m"),
    "Pa": (1e-5, "bar"),
}


def units_of(channel: str) -> list[str]:
    """All units that curves of a channel may have."""
    listed = [unit.strip() for unit, _ in re.findall(r"([^,()]+) \(([^)]*)\)", CHANNELS[channel].unit)]
    return listed or CHANNELS[channel].unit.split(" or ")


def read_as(unit: str) -> tuple[float, str]:
    """Factor and unit in which an SI unit is read: kN, kN m, deg; others as they are."""
    return READ.get(unit, (1.0, unit))
