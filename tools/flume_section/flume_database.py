"""Compute the section of the flume in its depth: ``python tools/flume_section/flume_database.py``.

Writes `benchmarks/measured/ntnu_lewis_section.nc`, which the comparison with the flume takes, with the mean
drift of the section held still. Sizes are those of the paper (Sundsdal, Greco, Hanssen, Lugni 2025). Needs
nothing but the package.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from panels_in_flume import SectionInFlume, section_in_flume
from section_model import RHO, G, SectionModel

from seacrane.hydro import Hull, OffsetTable

__all__ = ["RHO", "G", "SectionInFlume", "drift_of", "outline", "section_in_flume"]

FloatArray = NDArray[np.float64]
BREADTH, DRAUGHT, BILGE_RADIUS, LENGTH = 0.40, 0.20, 0.0512, 0.586
MASS, HEIGHT_OF_GRAVITY, GYRATION = 46.8, 0.106, 0.360 * 0.40  # kg, m above the keel as measured, m
DEPTH = 1.0
OF_THE_TANK = (4.143, 4.952, 5.075, 5.194, 5.311, 5.425, 5.646, 5.86, 6.065, 7.004, 7.83, 8.578, 9.265, 9.905)
OMEGA = np.unique(np.round([*np.arange(0.5, 4.0, 0.25), *np.arange(4.0, 14.01, 0.125), *OF_THE_TANK], 10))
FINENESS = 1.6
PLACE = Path(__file__).resolve().parents[2] / "benchmarks" / "measured" / "ntnu_lewis_section.nc"


def outline(fineness: float = FINENESS) -> FloatArray:
    """From the keel to the waterline; panels grow away from the bilge and the waterline."""
    flat, turn, wall = (round(count * fineness) for count in (24, 16, 24))
    half, r = 0.5 * BREADTH, BILGE_RADIUS
    bottom = (half - r) * np.sin(0.5 * np.pi * np.arange(flat + 1) / flat)
    angle = np.linspace(-0.5 * np.pi, 0.0, turn + 1)[1:]
    up = 0.5 * (1.0 - np.cos(np.pi * np.arange(1, wall + 1) / wall))
    return np.vstack(
        [
            np.column_stack([bottom, np.full(flat + 1, -DRAUGHT)]),
            np.column_stack([half - r + r * np.cos(angle), -DRAUGHT + r + r * np.sin(angle)]),
            np.column_stack([np.full(wall, half), (-DRAUGHT + r) * (1.0 - up)]),
        ]
    )


def flume_hull() -> Hull:
    """The section along its length across the flume, with 0.05 m of wall above the water."""
    section = [(0.5 * BREADTH, 0.05), *map(tuple, outline()[::-1])]
    table = OffsetTable(x=[-0.5 * LENGTH, 0.5 * LENGTH], sections=(section, section), name="flume section")
    return Hull.from_offsets(table)


def model() -> SectionModel:
    """As the tank had it."""
    return SectionModel(
        name="flume section", outline=outline(), hull=flume_hull(), length=LENGTH, depth=DEPTH, mass=MASS,
        center=HEIGHT_OF_GRAVITY - DRAUGHT, gyration=GYRATION, fineness=FINENESS,
    )  # fmt: skip


def drift_of(at: SectionInFlume) -> float:
    """Mean sway force of the held section over the squared wave amplitude, N/m2."""
    return model().drift(at)


if __name__ == "__main__":
    model().save(OMEGA, PLACE)
