"""ShipX/VERES files in their own axes and numbers: ``.re7``, ``.re8``, ``.re1`` and ``.re2``, all speeds."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.text_records import TextRecords
from seacrane.inputs.shown import shown

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

HEADER_LINES = 6
RADIATION = [0, 2, 4]  # places of A, B, C among A, A_add, B, B_add, C, C_add
SPEED_DIGITS = 6e-4  # m/s; the coarsest file of a set (.re2) is still finer


@dataclass(frozen=True)
class VeresHeader:
    """What the first lines of all files share; centre of gravity aft of midship and above the baseline."""

    rho: float
    g: float
    length: float
    breadth: float
    draught: float
    lcg_aft: float | None = None
    vcg: float | None = None


@dataclass(frozen=True, eq=False)
class MatricesAtSpeed:
    """``blocks`` (headings, frequencies, 6 kinds, 6, 6) of A, A_add, B, B_add, C, C_add; ``roll`` (.., 3)."""

    speed: float
    motion_point: tuple[float, float]
    heading: FloatArray
    omega: FloatArray
    blocks: FloatArray
    roll: FloatArray


@dataclass(frozen=True, eq=False)
class TransferAtSpeed:
    """Transfer functions (headings, frequencies, 6)."""

    speed: float
    motion_point: tuple[float, float]
    heading: FloatArray
    omega: FloatArray
    values: ComplexArray


@dataclass(frozen=True, eq=False)
class DriftAtSpeed:
    """Drift coefficients (headings, frequencies, 3) of surge, sway, yaw as the file gives them."""

    speed: float
    heading: FloatArray
    omega: FloatArray
    values: FloatArray


Case = TypeVar("Case", MatricesAtSpeed, TransferAtSpeed, DriftAtSpeed)


@dataclass(frozen=True, eq=False)
class MatricesFile:
    """A ``.re7`` file; ``version`` 1 or 2."""

    path: Path
    title: str
    version: int
    header: VeresHeader
    mass: FloatArray
    cases: tuple[MatricesAtSpeed, ...]


@dataclass(frozen=True, eq=False)
class TransferFile:
    """A ``.re1`` or ``.re8`` file."""

    path: Path
    header: VeresHeader
    cases: tuple[TransferAtSpeed, ...]


@dataclass(frozen=True, eq=False)
class DriftFile:
    """A ``.re2`` file."""

    path: Path
    header: VeresHeader
    cases: tuple[DriftAtSpeed, ...]


def read_matrices(path: Path) -> MatricesFile:
    """Read a ``.re7`` file of version 1 (no version line, no additional blocks) or 2."""
    records = TextRecords(path)
    title, header = _header(records, with_gravity=True)
    version = _version(records)
    speeds, m, n = _counts(records, with_motions=True)
    rows = 36 if version == 2 else 18
    records.expect(6 + speeds * (1 + m * (1 + n * (1 + rows + 1))), "the counts in its header")
    mass = np.array([records.numbers(6, "mass matrix") for _ in range(6)])
    cases = []
    for _ in range(speeds):
        speed, point = _speed_line(records)
        heading, omega = np.empty(m), np.empty((m, n))
        blocks, roll = np.zeros((m, n, 6, 6, 6)), np.empty((m, n, 3))
        for h in range(m):
            (heading[h],) = records.numbers(1, "heading")
            for k in range(n):
                (omega[h, k],) = records.numbers(1, "frequency")
                if version == 2:
                    table = records.table(36, 6, "A, A_add, B, B_add, C, C_add")
                    blocks[h, k] = table.reshape(6, 6, 6)
                else:
                    blocks[h, k, RADIATION] = records.table(18, 6, "A, B, C").reshape(3, 6, 6)
                roll[h, k] = records.numbers(3, "roll damping")
        cases.append(MatricesAtSpeed(speed, point, heading, _one_omega(records, omega), blocks, roll))
    records.finish()
    return MatricesFile(path, title, version, header, mass, _distinct(path, cases))


def read_transfer(path: Path) -> TransferFile:
    """Read a ``.re1`` or ``.re8`` file."""
    records = TextRecords(path)
    _, header = _header(records, with_gravity=True)
    speeds, m, n = _counts(records, with_motions=True)
    records.expect(speeds * (1 + m * (1 + n * 7)), "the counts in its header")
    cases = []
    for _ in range(speeds):
        speed, point = _speed_line(records)
        heading, omega = np.empty(m), np.empty((m, n))
        values = np.empty((m, n, 6), dtype=complex)
        for h in range(m):
            (heading[h],) = records.numbers(1, "heading")
            for k in range(n):
                (omega[h, k],) = records.numbers(1, "frequency")
                rows = records.table(6, 3, "motion, real, imaginary part")
                if not np.array_equal(rows[:, 0], np.arange(1, 7)):
                    raise records.error(f"motions {rows[:, 0].tolist()} where 1 to 6 are expected")
                values[h, k] = rows[:, 1] + 1j * rows[:, 2]
        cases.append(TransferAtSpeed(speed, point, heading, _one_omega(records, omega), values))
    records.finish()
    return TransferFile(path, header, _distinct(path, cases))


def read_drift(path: Path) -> DriftFile:
    """Read a ``.re2`` file."""
    records = TextRecords(path)
    _, header = _header(records, with_gravity=False)
    speeds, m, n = _counts(records, with_motions=False)
    records.expect(speeds * m * (1 + n), "the counts in its header")
    cases = []
    for _ in range(speeds):
        speed, heading = np.empty(m), np.empty(m)
        table = np.empty((m, n, 4))
        for h in range(m):
            speed[h], heading[h] = records.numbers(2, "speed and heading")
            table[h] = records.table(n, 4, "frequency and three drift coefficients")
        if np.any(speed != speed[0]):
            raise records.error(
                f"speeds {shown(np.unique(speed).tolist())} m/s where {m} headings of one are due"
            )
        omega = _one_omega(records, table[:, :, 0])
        cases.append(DriftAtSpeed(float(speed[0]), heading, omega, table[:, :, 1:].copy()))
    records.finish()
    return DriftFile(path, header, _distinct(path, cases))


def same_speed(a: float, b: float) -> bool:
    """Whether two files mean the same speed, the digits they are printed with allowed for."""
    return abs(a - b) <= SPEED_DIGITS


def _header(records: TextRecords, *, with_gravity: bool) -> tuple[str, VeresHeader]:
    title = [records.text() for _ in range(HEADER_LINES)]
    rho, g = records.numbers(2, "density and gravity")
    length, breadth, draught = records.numbers(3, "length, breadth, draught")
    lcg, vcg = records.numbers(2, "LCG and VCG") if with_gravity else (None, None)
    name = title[0].strip() + "; ship " + title[2].split(":", 1)[-1].strip()
    return name, VeresHeader(rho, g, length, breadth, draught, lcg, vcg)


def _version(records: TextRecords) -> int:
    """Version 2 announces itself with a line ``-1 2``; version 1 has the counts in that place."""
    words = records.peek()
    if len(words) == 4:
        return 1
    marker, version = records.integers(2, "version line or counts")
    if marker != -1 or version != 2:
        raise records.error(
            f"version line '{marker} {version}': '-1 2' is version 2 of .re7, no such line version 1, and no "
            "other is known; export it again"
        )
    return version


def _counts(records: TextRecords, *, with_motions: bool) -> tuple[int, int, int]:
    what = "numbers of speeds, headings, frequencies" + (", motions" if with_motions else "")
    counts = records.integers(4 if with_motions else 3, what)
    if min(counts) < 1 or (with_motions and counts[3] != 6):
        raise records.error(
            f"counts {' '.join(map(str, counts))}: at least one speed, heading and frequency, and six "
            "motions are needed"
        )
    return counts[0], counts[1], counts[2]


def _speed_line(records: TextRecords) -> tuple[float, tuple[float, float]]:
    speed, _, _, x_aft, z = records.numbers(5, "speed, sinkage, trim, motion point")
    return speed, (x_aft, z)


def _one_omega(records: TextRecords, omega: FloatArray) -> FloatArray:
    """The frequencies, which every heading has to repeat."""
    if np.any(omega != omega[0]):
        heading = int(np.argwhere(np.any(omega != omega[0], axis=1))[0, 0])
        raise FileFormatError(
            f"{records.path}: frequencies of heading number {heading + 1} differ from those of the first"
        )
    return np.array(omega[0])


def _distinct(path: Path, cases: list[Case]) -> tuple[Case, ...]:
    """The cases, none of whose speeds may occur twice."""
    for case, other in pairwise(sorted(cases, key=lambda case: case.speed)):
        if same_speed(case.speed, other.speed):
            raise FileFormatError(f"{path}: speed {other.speed:g} m/s is given twice; export the file again")
    return tuple(cases)
