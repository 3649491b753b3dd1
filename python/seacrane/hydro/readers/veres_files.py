"""ShipX/VERES files in their own axes and numbers: ``.re7``, ``.re8``, ``.re1`` and ``.re2``, all speeds.

And those of one stem: which there are, whether they are of one run, which speeds they hold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import nan
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.errors import FileFormatError
from seacrane.hydro.readers.format import sibling, stem_of
from seacrane.hydro.readers.text_records import TextRecords
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import shown
from seacrane.warnings import PartialSetWarning, SeveralSpeedsWarning

HEADER_LINES = 6
RADIATION = [0, 2, 4]  # places of A, B, C among A, A_add, B, B_add, C, C_add
SPEED_DIGITS = 6e-4  # m/s; the coarsest file of a set (.re2) is still finer
LOST = {  # with a file that need not be there
    ".re8": "wave forces are solved from the motions",
    ".re1": "motions are not compared",
    ".re2": "no drift",
    ".hyd": "hydrostatics are not compared",
}
MATRICES_AND_FORCE = (".re7", ".re8")


class VeresHeader(NamedTuple):
    """What the first lines of all files share; centre of gravity aft of midship and above the baseline."""

    rho: float
    g: float
    length: float
    breadth: float
    draught: float
    lcg_aft: float = nan
    vcg: float = nan


@dataclass(frozen=True, eq=False)
class Case:
    """What a file holds at one speed.

    ``values`` (headings, frequencies, ...) are transfer functions of six motions, or drift coefficients of
    surge, sway and yaw as the file gives them, or what `blocks` and `roll` take apart.
    """

    speed: float
    heading: Array
    omega: Array
    values: NDArray[Any]
    motion_point: tuple[float, float] = (0.0, 0.0)

    @property
    def blocks(self) -> Array:
        """A, A_add, B, B_add, C, C_add of a ``.re7`` file (headings, frequencies, 6 kinds, 6, 6)."""
        return np.asarray(self.values[:, :, :-3].reshape(*self.values.shape[:2], 6, 6, 6))

    @property
    def roll(self) -> Array:
        """Roll damping (headings, frequencies, 3) of a ``.re7`` file."""
        return np.asarray(self.values[:, :, -3:])


@dataclass(frozen=True, eq=False)
class VeresFile:
    """A file with all its speeds; ``title`` and ``mass`` are of ``.re7`` alone."""

    path: Path
    header: VeresHeader
    cases: tuple[Case, ...]
    title: str = ""
    mass: Array = field(default_factory=lambda: np.zeros((6, 6)))

    @property
    def speeds(self) -> list[float]:
        """m/s, in the order of the file."""
        return [case.speed for case in self.cases]


def read_matrices(path: Path) -> VeresFile:
    """Read a ``.re7`` file of version 1 (no version line, no additional blocks) or 2."""
    records = TextRecords(path)
    title, header = _header(records)
    kinds, what = RADIATION, "A, B, C"
    if len(records.peek("the version line or counts")) != 4:  # of version 1, which has no such line
        marker, version = records.integers(2, "version line or counts")
        if marker != -1 or version != 2:
            raise records.error(
                f"version line '{marker} {version}': '-1 2' is version 2 of .re7, no such line version "
                "1, and no other is known; export it again"
            )
        kinds, what = [*range(6)], "A, A_add, B, B_add, C, C_add"
    counts = _counts(records, before=6, each=6 * len(kinds) + 1)
    mass = np.array([records.numbers(6, "mass matrix") for _ in range(6)])

    def row() -> Array:
        blocks = np.zeros((6, 6, 6))
        blocks[kinds] = records.table(6 * len(kinds), 6, what).reshape(-1, 6, 6)
        return np.append(blocks, records.numbers(3, "roll damping"))

    return _file(records, header, _cases(records, counts, row), title=title, mass=mass)


def read_transfer(path: Path) -> VeresFile:
    """Read a ``.re1`` or ``.re8`` file."""
    records = TextRecords(path)
    _, header = _header(records)
    counts = _counts(records, before=0, each=6)

    def row() -> Complex:
        rows = records.table(6, 3, "motion, real, imaginary part")
        if not np.array_equal(rows[:, 0], np.arange(1, 7)):
            raise records.error(f"motions {rows[:, 0].tolist()} where 1 to 6 are expected")
        return np.asarray(rows[:, 1] + 1j * rows[:, 2])

    return _file(records, header, _cases(records, counts, row))


def _cases(
    records: TextRecords, counts: tuple[int, int, int], row: Callable[[], NDArray[Any]]
) -> Iterator[Case]:
    """Every speed of a file, whose headings and frequencies have a ``row`` each."""
    speeds, m, n = counts
    for _ in range(speeds):
        speed, _, _, x_aft, z = records.numbers(5, "speed, sinkage, trim, motion point")
        heading, omega, rows = np.empty(m), np.empty((m, n)), []
        for h in range(m):
            (heading[h],) = records.numbers(1, "heading")
            for k in range(n):
                (omega[h, k],) = records.numbers(1, "frequency")
                rows.append(row())
        yield Case(speed, heading, omega, np.array(rows).reshape(m, n, -1), (x_aft, z))


def read_drift(path: Path) -> VeresFile:
    """Read a ``.re2`` file."""
    records = TextRecords(path)
    _, header = _header(records, with_gravity=False)
    speeds, m, n = _counts(records)
    cases = []
    for _ in range(speeds):
        speed, heading, table = np.empty(m), np.empty(m), np.empty((m, n, 4))
        for h in range(m):
            speed[h], heading[h] = records.numbers(2, "speed and heading")
            table[h] = records.table(n, 4, "frequency and three drift coefficients")
        if np.any(speed != speed[0]):
            raise records.error(
                f"speeds {shown(np.unique(speed).tolist())} m/s where {m} headings of one are due"
            )
        cases.append(Case(float(speed[0]), heading, table[:, :, 0], table[:, :, 1:].copy()))
    return _file(records, header, cases)


def _file(records: TextRecords, header: VeresHeader, given: Iterable[Case], **others: Any) -> VeresFile:
    """The file, whose headings have to repeat their frequencies, and which gives each speed once."""
    cases = []
    for case in given:
        other = np.flatnonzero(np.any(case.omega != case.omega[0], axis=1))
        if other.size:
            raise FileFormatError(
                f"{records.path}: frequencies of heading number {other[0] + 1} differ from those of the first"
            )
        cases.append(replace(case, omega=np.array(case.omega[0])))
    records.finish()
    for one, next_one in pairwise(sorted(case.speed for case in cases)):
        if same_speed(one, next_one):
            raise FileFormatError(
                f"{records.path}: speed {next_one:g} m/s is given twice; export the file again"
            )
    return VeresFile(records.path, header, tuple(cases), **others)


READERS = {".re7": read_matrices, ".re8": read_transfer, ".re1": read_transfer, ".re2": read_drift}
SET = ("VERES", (".re7",), (*READERS, ".hyd"))  # as `stem_of` takes it


def same_speed(a: float, b: float) -> bool:
    """Whether two files mean the same speed, the digits they are printed with allowed for."""
    return abs(a - b) <= SPEED_DIGITS


def _header(records: TextRecords, *, with_gravity: bool = True) -> tuple[str, VeresHeader]:
    title = [records.text("the header") for _ in range(HEADER_LINES)]
    water = records.numbers(2, "density and gravity")
    sizes = records.numbers(3, "length, breadth, draught")
    gravity = records.numbers(2, "LCG and VCG") if with_gravity else []
    name = title[0].strip() + "; ship " + title[2].split(":", 1)[-1].strip()
    return name, VeresHeader(*water, *sizes, *gravity)


def _counts(records: TextRecords, *, before: int = 0, each: int | None = None) -> tuple[int, int, int]:
    """Numbers of speeds, headings and frequencies, for which there have to be lines: ``each`` of a frequency.

    None: of drift, where six motions are not counted, and each frequency is a line.
    """
    what = "numbers of speeds, headings, frequencies" + ("" if each is None else ", motions")
    counts = records.integers(3 if each is None else 4, what)
    if min(counts) < 1 or counts[3:] not in ([], [6]):
        raise records.error(
            f"counts {' '.join(map(str, counts))}: at least one speed, heading and frequency, and six "
            "motions are needed"
        )
    speeds, m, n = counts[:3]
    lines = speeds * m * (1 + n) if each is None else before + speeds * (1 + m * (1 + n * (1 + each)))
    records.expect(lines, "the counts in its header")
    return speeds, m, n


@dataclass(frozen=True, eq=False)
class VeresSet:
    """The files of one stem that there are, by suffix."""

    stem: Path
    files: dict[str, VeresFile]

    @property
    def matrices(self) -> VeresFile:
        return self.files[".re7"]

    def case(self, suffix: str, speed: float) -> Case:
        """What a file holds at a speed that all have."""
        return next(case for case in self.files[suffix].cases if same_speed(case.speed, speed))

    def other_run(self, suffix: str, what: str) -> FileFormatError:
        """Error of a file that belongs to another calculation."""
        return FileFormatError(
            f"{self.files[suffix].path}: {what} differ from the .re7 file; use files of one VERES run"
        )

    def common_speeds(self) -> tuple[float, ...]:
        """Forward speeds (m/s) that every file holds, rising."""
        every = [file.speeds for file in self.files.values()]
        common = [
            speed
            for speed in self.matrices.speeds
            if all(any(same_speed(speed, other) for other in speeds) for speeds in every)
        ]
        if not common:
            lists = "; ".join(f"{file.path.name}: {_listed(file.speeds)}" for file in self.files.values())
            raise FileFormatError(
                f"{self.stem}: no speed is in every file ({lists}); use files of one VERES run"
            )
        return tuple(sorted(common))


def is_veres(path: Path) -> bool:
    """Whether ``path`` is a folder, stem or file of a VERES set."""
    if path.is_dir():
        return any(file.suffix.lower() in MATRICES_AND_FORCE for file in path.iterdir())
    stem = stem_of(path, *SET)
    return any(sibling(stem, suffix) is not None for suffix in MATRICES_AND_FORCE)


def read_set(path: Path) -> VeresSet:
    """All files of the set that ``path`` points to, from one calculation."""
    stem = stem_of(path, *SET)
    places = {suffix: place for suffix in READERS if (place := sibling(stem, suffix)) is not None}
    if ".re7" not in places:
        raise FileFormatError(
            f"{stem}.re7: no such file; without it there is no mass, added mass, damping nor restoring. "
            "Motions alone (.re1) move a given ship: seacrane.MotionRaos"
        )
    if not {".re8", ".re1"} & set(places):
        raise FileFormatError(
            f"{stem}.re8: no such file, nor .re1, from whose motions wave forces follow: without both "
            "there is no load of waves"
        )
    found = VeresSet(stem, {suffix: READERS[suffix](place) for suffix, place in places.items()})
    for suffix, file in found.files.items():
        shared = 5 if suffix == ".re2" else 7  # which has no centre of gravity
        if file.header[:shared] != found.matrices.header[:shared]:
            raise found.other_run(suffix, "header (density, gravity, dimensions)")
    return found


def _listed(values: Sequence[float]) -> str:
    return ", ".join(f"{value:g}" for value in values[:8]) + (", ..." if len(values) > 8 else "") + " m/s"


def choose_speed(found: VeresSet, speed: float | None) -> float:
    """The speed to read, with warnings about the others."""
    common = found.common_speeds()
    partial: list[float] = []
    for value in sorted(value for file in found.files.values() for value in file.speeds):
        if not any(same_speed(value, other) for other in (*common, *partial)):
            partial.append(value)
    if partial:
        warn_caller(
            f"{found.stem}: speeds {_listed(partial)} are not in every file of the set; only the common "
            f"ones, {_listed(common)}, can be read, and nothing is known beyond them",
            PartialSetWarning,
        )
    if speed is not None:
        match = [value for value in common if same_speed(value, speed)]
        if not match:
            raise FileFormatError(f"{found.stem}: no speed {speed:g} m/s; the files hold {_listed(common)}")
        return match[0]
    nearest = min(common, key=abs)
    if len(common) > 1:
        warn_caller(
            f"{found.stem}: the files hold speeds {_listed(common)}; {nearest:g} m/s is read, and motions at "
            "another speed differ. Give speed=... to choose",
            SeveralSpeedsWarning,
        )
    return nearest
