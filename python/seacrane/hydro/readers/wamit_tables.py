"""Numeric output files of WAMIT, non-dimensional as they are, every row accounted for: ``.1 .2 .3 .4 .hst``,
and mean drift in ``.9`` (pressures), ``.8`` (momentum) and ``.12d .11d .10d`` (difference frequencies).

Rows of ``.8`` and ``.9``: period, two headings, i, modulus, phase, real and imaginary part; of ``.12d`` and
its like two periods first. The mean load of one wave is that of equal headings and equal periods (WAMIT
manual, 3.8).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.errors import FileFormatError
from seacrane.hydro.readers.format import sibling
from seacrane.hydro.readers.text_records import is_number, number_at, text_of
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import PartialSetWarning

IntArray = NDArray[np.int64]
Files = dict[str, Path | None]  # by suffix

ZERO_FREQUENCY_PERIOD = -1.0
INFINITE_FREQUENCY_PERIOD = 0.0
PHASE_TOLERANCE = 1e-4  # files hold seven digits of modulus, phase, real and imaginary part
ROUND_OFF = 1e-6  # of the largest force or moment: beyond single precision
LIMITS = {
    "zero_frequency_added_mass": ZERO_FREQUENCY_PERIOD,
    "infinite_frequency_added_mass": INFINITE_FREQUENCY_PERIOD,
}
BODY_AXES = (-6.0, -5.0, -4.0)  # rows of mean moments in the axes of the body, beside those of space

MOMENTUM, PRESSURES, SECOND_ORDER = ".8", ".9", (".12d", ".11d", ".10d")
BY_PREFERENCE = (PRESSURES, MOMENTUM, *SECOND_ORDER)  # all six loads first
SUFFIXES = (".1", ".2", ".3", ".4", ".hst", ".frc", ".out", ".cfg", ".pot", *BY_PREFERENCE)
QUADRATIC = (*SECOND_ORDER, ".12s", ".11s", ".10s")
NEEDED = (".1", ".hst")
LOADS = {
    ".3": "forces by diffraction",
    ".2": "forces by Haskind's relation",
    ".4": "motions",
}  # by preference
RADIATION, WAVES = (4, 5), (7,)  # numbers in a line of .1, and of .2, .3 and .4
NO_PERIOD = "ends without a positive period; the file is truncated, or of limits alone"
REAL_TOLERANCE = 1e-3  # of the largest of its motion: a mean load has no imaginary part


@dataclass(frozen=True, eq=False)
class Table:
    """Rows of numbers (rows, columns), NaN where a row is shorter, and the line of the file of each."""

    path: Path
    values: Array
    lines: IntArray

    def only(self, rows: NDArray[np.intp]) -> Table:
        """Some of the rows."""
        return Table(self.path, self.values[rows], self.lines[rows])

    def error(self, row: int, message: str) -> FileFormatError:
        return FileFormatError(f"{self.path}, line {int(self.lines[row])}: {message}")


@dataclass(frozen=True, eq=False)
class Radiation:
    """Contents of a ``.1`` file: periods (n,) in s, rising; A and B (n, 6 k, 6 k) of k bodies, and those
    limits of A, by name, that it holds."""

    period: Array
    added_mass: Array
    damping: Array
    limits: dict[str, Array]


@dataclass(frozen=True, eq=False)
class WaveTable:
    """Periods (n,) in s and headings (m,) in degrees, both rising; values (m, n, 6 k): complex of a ``.2``,
    ``.3`` or ``.4`` file, real of mean drift; non-dimensional."""

    path: Path
    period: Array
    heading_deg: Array
    values: NDArray[Any]


def require_set(stem: Path, files: Files) -> None:
    """Raise unless one body's matrices, stiffness and loads are there; told is what is there instead."""
    lacking = [suffix for suffix in NEEDED if files[suffix] is None]
    if not any(files[suffix] for suffix in LOADS):
        lacking.append(".3")
    if not lacking:
        return
    there = [suffix for suffix in dict.fromkeys((*files, *QUADRATIC)) if sibling(stem, suffix)]
    hint = ""
    if set(there) & set(QUADRATIC):
        hint = (
            ". Files .10, .11, .12 are of second order, loads of pairs of waves at their difference (d) or "
            "sum (s): mean drift is read of the former, beside such a set"
        )
    raise FileFormatError(
        f"{stem}{lacking[0]}: no such file; WAMIT needs {', '.join(NEEDED)} and one of "
        f"{', '.join(f'{suffix} ({what})' for suffix, what in LOADS.items())} of the same stem; there are "
        f"{', '.join(there)}, and no {', '.join(lacking)}{hint}"
    )


def radiation_of(table: Table, *, bodies: int) -> Radiation:
    """Added mass and damping of rows of period, i, j, A, and B where the period is positive."""
    size = 6 * bodies
    period = table.values[:, 0]
    unknown = np.flatnonzero((period < 0.0) & (period != ZERO_FREQUENCY_PERIOD))
    if unknown.size:
        raise table.error(
            int(unknown[0]),
            f"period {period[unknown[0]]:g} s; below zero there is only -1, the zero frequency",
        )
    bare = np.flatnonzero((period > 0.0) & np.isnan(table.values[:, 4]))
    if bare.size:
        raise table.error(int(bare[0]), "no damping: period, i, j, A, B are expected; the file is truncated")
    motions = size * _motion_of(table, 1, bodies) + _motion_of(table, 2, bodies)
    periods, place = np.unique(period, return_inverse=True)
    _check_complete(table, place, motions, len(periods), size**2, "entry i j")
    both = np.zeros((2, len(periods), size**2))
    both[:, place, motions] = np.nan_to_num(table.values[:, 3:5].T)
    added_mass, damping = both.reshape(2, len(periods), size, size)
    limits = {name: added_mass[periods == limit][0] for name, limit in LIMITS.items() if limit in periods}
    finite = periods > 0.0
    if not np.any(finite):
        raise table.error(-1, NO_PERIOD)
    return Radiation(periods[finite], added_mass[finite], damping[finite], limits)


def waves_of(table: Table, *, bodies: int) -> WaveTable:
    """Forces or motions of rows of period, heading, i, modulus, phase (deg), real and imaginary part."""
    rows = np.flatnonzero(table.values[:, 0] > 0.0)
    if rows.size == 0:
        raise table.error(-1, NO_PERIOD)
    table = table.only(rows)
    motion = _motion_of(table, 2, bodies)
    return _by_wave(table, 1, motion, _checked_complex(table, motion), bodies)


def _by_wave(table: Table, column: int, motion: IntArray, value: NDArray[Any], bodies: int = 1) -> WaveTable:
    """One value of each row by period, heading (degrees, in ``column``) and motion."""
    periods, in_period = np.unique(table.values[:, 0], return_inverse=True)
    headings, in_heading = np.unique(table.values[:, column], return_inverse=True)
    n, m, size = len(periods), len(headings), 6 * bodies
    if n * m > len(value):
        # Each pair has at least one row: this many periods and headings is damage, and not worth the memory.
        raise table.error(
            -1, f"{n} periods and {m} headings, but only {len(value)} rows; the file is truncated or damaged"
        )
    _check_complete(table, in_period * m + in_heading, motion, n * m, size, "motion")
    values = np.zeros((m, n, size), dtype=value.dtype)
    values[in_heading, in_period, motion] = value
    return WaveTable(table.path, periods, headings, values)


def read_restoring(path: Path, *, bodies: int = 1) -> Array:
    """Read the restoring matrix (6 k, 6 k): rows of i, j, C; of several bodies entries may be left out."""
    size = 6 * bodies
    table = read_table(path, (3,))
    first, second = _motion_of(table, 0, bodies), _motion_of(table, 1, bodies)
    motions = size * first + second
    half = bodies == 1 and len(motions) == 21 and (np.all(first <= second) or np.all(first >= second))
    if len(motions) < 36 * bodies and not half:
        raise table.error(-1, f"{len(motions)} of {36 * bodies} entries end here; the file is truncated")
    _check_complete(table, np.zeros(len(motions), dtype=np.int64), motions, 1, size**2, "entry i j")
    restoring = np.zeros(size**2)
    restoring[motions] = table.values[:, 2]
    return restoring.reshape(size, size)


def read_mean_drift(path: Path) -> WaveTable:
    """The mean loads of single waves in one of these files.

    Raises FileFormatError: truncated or damaged, with the line; or no row of one wave alone.
    """
    first = 2 if path.suffix.lower() in SECOND_ORDER else 1  # columns of periods
    table = read_table(path, (first + 7,))
    one_wave = (table.values[:, 0] == table.values[:, first - 1]) & (
        table.values[:, first] == table.values[:, first + 1]
    )
    rows = np.flatnonzero(one_wave & (table.values[:, 0] > 0.0))
    if rows.size == 0:
        raise FileFormatError(f"{path}: no row of one period and one heading; it holds no mean drift")
    table = _of_space_axes(table.only(rows), first + 2)
    motion = _motion_of(table, first + 2)
    real, imaginary = table.values[:, first + 5], table.values[:, first + 6]
    size = np.hypot(real, imaginary)
    largest = np.zeros(6)
    np.maximum.at(largest, motion, size)
    allowed = REAL_TOLERANCE * largest[motion] + ROUND_OFF * _largest_of_kind(size, motion)
    bad = np.flatnonzero(np.abs(imaginary) > allowed)
    if bad.size:
        raise table.error(
            int(bad[0]), f"a mean load with an imaginary part of {imaginary[bad[0]]:g}; the line is damaged"
        )
    return _by_wave(table, first, motion, real)


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


def read_table(path: Path, widths: tuple[int, ...]) -> Table:
    """All rows of a file; a first line of text (option NUMHDR) is passed over."""
    text = text_of(path)
    every = [(number, line) for number, line in enumerate(text.split("\n"), start=1) if line.strip()]
    if every and not is_number(every[0][1].split()[0]):
        del every[0]
    if not every:
        raise FileFormatError(f"{path}, line 1: no numbers; the file is empty or truncated")
    if not text.endswith("\n") and len(every) > 1:  # lines are of one length, and WAMIT ends each
        (_, before), (number, last) = every[-2:]
        if len(last.rstrip()) < len(before.rstrip()):
            raise FileFormatError(
                f"{path}, line {number}: shorter than the line before; the file is truncated"
            )
    values = np.full((len(every), widths[-1]), np.nan)
    for row, (number, line) in enumerate(every):
        words = line.split()
        if len(words) not in widths:
            wanted = " or ".join(str(width) for width in widths)
            raise FileFormatError(f"{path}, line {number}: {wanted} numbers are expected, found {len(words)}")
        values[row, : len(words)] = [number_at(path, number, word) for word in words]
    return Table(path, values, np.array([number for number, _ in every]))


def _motion_of(table: Table, column: int, bodies: int = 1) -> IntArray:
    """Motion indices 0 to 6 k - 1 from a column that counts from 1."""
    values = table.values[:, column]
    bad = np.flatnonzero(~np.isin(values, np.arange(1.0, 6.0 * bodies + 1.0)))
    if bad.size:
        held = "only one rigid body is read" if bodies == 1 else f"{bodies} rigid bodies are read"
        raise table.error(int(bad[0]), f"motion {values[bad[0]]:g} is not one of 1 to {6 * bodies}; {held}")
    return values.astype(np.int64) - 1


def _checked_complex(table: Table, motion: IntArray) -> Complex:
    """Real and imaginary part, which have to agree with modulus and phase of the same row.

    Motions that symmetry forbids are round-off, where WAMIT's four columns do not agree: a share of the
    largest force, or moment, is allowed.
    """
    modulus, phase_deg, real, imaginary = table.values[:, 3:7].T
    value = real + 1j * imaginary
    error = np.abs(value - modulus * np.exp(1j * np.radians(phase_deg)))
    bad = np.flatnonzero(
        error > PHASE_TOLERANCE * np.abs(value) + ROUND_OFF * _largest_of_kind(value, motion)
    )
    if bad.size:
        row = int(bad[0])
        raise table.error(
            row,
            f"modulus {modulus[row]:g} and phase {phase_deg[row]:g} deg are not {value[row]:g}; the line "
            "is damaged",
        )
    return np.asarray(value)


def _largest_of_kind(value: NDArray[Any], motion: IntArray) -> Array:
    """Of each row the largest force of all rows, or the largest moment."""
    turns = motion % 6 > 2
    largest = [float(np.abs(value[rows]).max(initial=0.0)) for rows in (~turns, turns)]
    return np.where(turns, largest[1], largest[0])


def _check_complete(
    table: Table, group: IntArray, entry: IntArray, groups: int, entries: int, what: str
) -> None:
    """Raise unless every group (period, or period and heading) holds the same entries, each once."""
    key = group.astype(np.int64) * entries + entry
    _, first = np.unique(key, return_index=True)
    if len(first) < len(key):
        again = int(np.setdiff1d(np.arange(len(key)), first)[0])
        raise table.error(again, f"this {what} was given before; every line has to be another")
    present = np.zeros(groups * entries, dtype=bool)
    present[key] = True
    there = present.reshape(groups, entries)
    lacking = np.flatnonzero(np.any(there != there.any(axis=0), axis=1))
    if lacking.size:
        rows = np.flatnonzero(group == lacking[0])
        last = int(rows[-1]) if rows.size else len(group) - 1
        raise table.error(
            last, f"a line of another {what} is missing about here; the file is truncated or damaged"
        )
