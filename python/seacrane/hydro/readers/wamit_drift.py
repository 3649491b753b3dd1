"""Mean drift in WAMIT's files: ``.9`` (pressures), ``.8`` (momentum), ``.12d`` (difference frequencies).

Rows of ``.8`` and ``.9``: period, two headings, i, modulus, phase, real and imaginary part; of ``.12d`` two
periods first. The mean load of one wave is that of equal headings and equal periods. WAMIT manual, 3.8:
rho g L^k of a squared amplitude, k = 1 for forces and 2 for moments.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.wamit_tables import (
    BODY_AXES,
    ROUND_OFF,
    Table,
    check_complete,
    largest_of_kind,
    motion_of,
    read_table,
)
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import PartialSetWarning

FloatArray = NDArray[np.float64]

MOMENTUM, PRESSURES, SECOND_ORDER = ".8", ".9", ".12d"
BY_PREFERENCE = (PRESSURES, MOMENTUM, SECOND_ORDER)  # all six loads first
REAL_TOLERANCE = 1e-3  # of the largest of its motion: a mean load has no imaginary part


@dataclass(frozen=True, eq=False)
class MeanDrift:
    """Periods (n,) in s and headings (m,) in degrees, both rising; loads (m, n, 6), non-dimensional."""

    path: Path
    period: FloatArray
    heading_deg: FloatArray
    values: FloatArray


def read_mean_drift(path: Path) -> MeanDrift:
    """The mean loads of single waves in one of these files.

    Raises FileFormatError: truncated or damaged, with the line; or no row of one wave alone.
    """
    first = 2 if path.suffix.lower() == SECOND_ORDER else 1  # columns of periods
    table = read_table(path, (first + 7,))
    one_wave = (table.values[:, 0] == table.values[:, first - 1]) & (
        table.values[:, first] == table.values[:, first + 1]
    )
    rows = np.flatnonzero(one_wave & (table.values[:, 0] > 0.0))
    if rows.size == 0:
        raise FileFormatError(f"{path}: no row of one period and one heading; it holds no mean drift")
    table = _of_space_axes(table.only(rows), first + 2)
    rows = np.arange(len(table.lines))
    motion = motion_of(table, first + 2)
    real, imaginary = table.values[:, first + 5], table.values[:, first + 6]
    size = np.hypot(real, imaginary)
    largest = np.zeros(6)
    np.maximum.at(largest, motion, size)
    allowed = REAL_TOLERANCE * largest[motion] + ROUND_OFF * largest_of_kind(size, motion)
    bad = np.flatnonzero(np.abs(imaginary) > allowed)
    if bad.size:
        raise table.error(
            int(bad[0]), f"a mean load with an imaginary part of {imaginary[bad[0]]:g}; the line is damaged"
        )
    periods, in_period = np.unique(table.values[:, 0], return_inverse=True)
    headings, in_heading = np.unique(table.values[:, first], return_inverse=True)
    if len(periods) * len(headings) > len(rows):
        raise table.error(len(rows) - 1, "not every heading has every period; the file is truncated")
    group = in_period * len(headings) + in_heading
    check_complete(table, group, motion, len(periods) * len(headings), 6, "motion")
    values = np.zeros((len(headings), len(periods), 6))
    values[in_heading, in_period, motion] = real
    return MeanDrift(path, periods, headings, values)


def _of_space_axes(table: Table, column: int) -> Table:
    """Without the mean moments about axes of the body, which stand beside those about axes in space."""
    aside = np.isin(table.values[:, column], BODY_AXES)
    if not aside.any():
        return table
    if aside.all():
        raise table.error(0, "holds moments in axes of the body alone; write mean drift in axes of space")
    warn_caller(
        f"{table.path}, line {table.lines[aside][0]} on: {aside.sum()} rows of mean moments in axes of the "
        "body (-4, -5, -6) are left out; those in axes of space are read",
        PartialSetWarning,
    )
    return table.only(np.flatnonzero(~aside))
