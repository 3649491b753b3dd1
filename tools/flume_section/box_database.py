"""Compute a floating box across its flume: ``python tools/flume_section/box_database.py``.

Writes `benchmarks/measured/ren_floating_box.nc`, which the comparison with the flume takes. Sizes are of
Ren, He, Dong, Wen (2015); mass, centre and inertia are those of a computation by others (the case
`freeBoxInRegularWaves` of FloatStepper). Needs nothing but the package.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from section_model import SectionModel

from seacrane.hydro import Hull, OffsetTable

FloatArray = NDArray[np.float64]
BREADTH, HEIGHT, DRAUGHT, DEPTH = 0.30, 0.20, 0.10, 0.40
LENGTH, MASS, ROLL_INERTIA = 0.40, 12.0, 0.15106368  # m across the flume, kg, kg m2 about its centre
WAVE = 2.0 * np.pi / 1.2  # rad/s
OMEGA = np.unique(np.round([*np.arange(0.75, 4.0, 0.25), *np.arange(4.0, 8.0, 0.125), WAVE,
                            *np.arange(8.0, 22.01, 0.5)], 10))  # fmt: skip
FINENESS = 1.6
PLACE = Path(__file__).resolve().parents[2] / "benchmarks" / "measured" / "ren_floating_box.nc"


def outline(fineness: float = FINENESS) -> FloatArray:
    """From the keel to the waterline; panels are finest at the corner and the waterline."""
    flat, wall = (round(count * fineness) for count in (32, 28))
    bottom = 0.5 * BREADTH * np.sin(0.5 * np.pi * np.arange(flat + 1) / flat)
    up = 0.5 * (1.0 - np.cos(np.pi * np.arange(1, wall + 1) / wall))
    return np.vstack(
        [
            np.column_stack([bottom, np.full(flat + 1, -DRAUGHT)]),
            np.column_stack([np.full(wall, 0.5 * BREADTH), -DRAUGHT * (1.0 - up)]),
        ]
    )


def model() -> SectionModel:
    """The box, half of whose height is under water."""
    section = [(0.5 * BREADTH, HEIGHT - DRAUGHT), *map(tuple, outline()[::-1])]
    table = OffsetTable(x=[-0.5 * LENGTH, 0.5 * LENGTH], sections=(section, section), name="floating box")
    return SectionModel(
        name="floating box", outline=outline(), hull=Hull.from_offsets(table), length=LENGTH, depth=DEPTH,
        mass=MASS, center=0.5 * HEIGHT - DRAUGHT, gyration=float(np.sqrt(ROLL_INERTIA / MASS)),
        fineness=FINENESS,
    )  # fmt: skip


if __name__ == "__main__":
    model().save(OMEGA, PLACE)
