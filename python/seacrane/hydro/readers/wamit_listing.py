"""Listing (``.out``) and control files (``.frc``, ``.cfg``) of a WAMIT run: water, bodies, tables."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro.readers.text_records import NUMBER as WORD
from seacrane.hydro.readers.text_records import TextRecords, is_number, number_at, text_of
from seacrane.hydro.readers.wamit_tables import INFINITE_FREQUENCY_PERIOD, ZERO_FREQUENCY_PERIOD, Table

NUMBER = rf"({WORD}|\*+)"
TRIPLE = rf"\s*:?\s+{NUMBER}\s+{NUMBER}\s+{NUMBER}"
BODY = re.compile(r"Body number: N=\s*(\d+)")
FILE = re.compile(r"N=\s*(\d+)\s+(\S+)\.gdf", re.IGNORECASE)
PERIOD = re.compile(r"Wave period\s*(?:\(sec\))?\s*=\s*(\S+)")
HEADING = re.compile(r"Wave Heading \(deg\)\s*:\s*(\S+)")
NAMED_PERIODS = {"infinite": ZERO_FREQUENCY_PERIOD, "zero": INFINITE_FREQUENCY_PERIOD}
PLACE = rf"XBODY =\s*{NUMBER}\s+YBODY =\s*{NUMBER}\s+ZBODY =\s*{NUMBER}\s+PHIBODY =\s*{NUMBER}"
RESTORING = (
    (r"C\(3,3\),C\(3,4\),C\(3,5\):", ((2, 2), (2, 3), (2, 4))),
    (r"C\(4,4\),C\(4,5\),C\(4,6\):", ((3, 3), (3, 4), (3, 5))),
    (r"C\(5,5\),C\(5,6\):", ((4, 4), (4, 5))),
)
ROTATIONS = np.array([0, 0, 0, 1, 1, 1])
IOPTN_MOTIONS = 3  # the fourth option of the second line


@dataclass(frozen=True, eq=False)
class _Part:
    """What a listing says from one character to another, of all bodies or of one (``whose``)."""

    path: Path
    text: str
    start: int
    end: int
    whose: str = ""

    def maybe(self, pattern: str) -> list[float] | None:
        """The numbers of the first place like that, if there is one."""
        found = re.compile(pattern).search(self.text, self.start, self.end)
        if found is None:
            return None
        return [number_at(self.path, self.line(found.start()), word) for word in found.groups()]

    def line(self, place: int) -> int:
        """The line of a character, counted from 1."""
        return self.text.count("\n", 0, place) + 1

    def find(self, pattern: str, what: str) -> list[float]:
        found = self.maybe(pattern)
        if found is None:
            raise self.error(what)
        return found

    def error(self, what: str) -> FileFormatError:
        return FileFormatError(
            f"{self.path}, line {self.line(self.end)}: the listing ends without {what}{self.whose}; it is "
            "truncated, or no WAMIT listing"
        )


@dataclass(frozen=True, eq=False)
class ListedBody:
    """One body of the listing, in its own axes.

    ``position`` (3,) m and ``heading`` rad of its axes, ``volume`` m3, ``gravity`` (3,) m its centre of mass
    from its origin, that of buoyancy where the listing does not tell it.
    """

    name: str
    position: Array
    heading: float
    volume: float
    gravity: Array
    lid_panels: int = 0
    part: _Part | None = None

    def restoring(self, scale: float) -> Array:
        """(6, 6) over rho g."""
        assert self.part is not None
        restoring = np.zeros((6, 6))
        for label, entries in RESTORING:
            values = self.part.find(label + rf"\s+{NUMBER}" * len(entries), "restoring coefficients")
            for (i, j), value in zip(entries, values, strict=True):
                restoring[i, j] = value
                if j < 5:
                    restoring[j, i] = value
        return np.asarray(restoring * scale ** (2 + np.add.outer(ROTATIONS, ROTATIONS)))


@dataclass(frozen=True, eq=False)
class Listing:
    """Head of a ``.out`` file; ``rho`` is None where it holds none (or the placeholder 1).

    ``period`` holds the positive periods in s that it goes through.
    """

    path: Path
    version: str
    title: str
    g: float
    length_scale: float
    depth: float
    rho: float | None
    bodies: tuple[ListedBody, ...]
    symmetric: bool | None = None
    panels: int | None = None
    period: tuple[float, ...] = ()
    lines: tuple[str, ...] = ()


def count_bodies(path: Path) -> int:
    """Bodies of a listing; 1 where it does not number them."""
    return max((int(number) for number in BODY.findall(text_of(path))), default=1)


def read_listing(path: Path) -> Listing:
    """Read the head of the listing and the periods it goes through.

    Raises FileFormatError: something needed is missing, or the one body is placed away from the origin.
    """
    text = text_of(path).rstrip("\n")
    whole = _Part(path, text, 0, len(text))
    g, scale = whole.find(rf"Gravity:\s+{NUMBER}\s+Length scale:\s+{NUMBER}", "gravity and length scale")
    if min(g, scale) <= 0.0:
        raise FileFormatError(f"{path}: gravity {g:g} and length scale {scale:g} must be positive")
    density = whole.maybe(rf"Water density:\s+{NUMBER}")
    version = re.search(r"WAMIT\s+Version\s+(\S+)", text)
    title = re.search(r"Geometric Data File[^\n]*\n([^\n]*)", text)  # the line under its name
    symmetry = re.search(r"Symmetry:[^\n]*", text)
    depth = re.search(r"Water depth:\s+(\S+)", text)
    if depth is None:
        raise whole.error("the water depth")
    deep = depth.group(1).lower().startswith("inf")
    panels = whole.maybe(r"Total panels:\s+(\d+)")
    periods = [
        number_at(path, whole.line(found.start()), found[1])
        for found in re.finditer(rf"Wave period \(sec\) =\s*{NUMBER}\s", text)
    ]
    return Listing(
        path=path, version=version.group(1) if version else "of unknown version",
        title=title.group(1).strip() if title else "", g=g, length_scale=scale,
        depth=math.inf if deep else number_at(path, whole.line(depth.start()), depth.group(1)),
        rho=density[0] if density and density[0] > 1.0 else None, bodies=tuple(_bodies(whole)),
        symmetric=None if symmetry is None else "Y=0" in symmetry.group(0).replace(" ", ""),
        panels=int(panels[0]) if panels and panels[0] >= 1.0 else None,
        period=tuple(periods), lines=tuple(text.split("\n")),
    )  # fmt: skip


def _bodies(whole: _Part) -> list[ListedBody]:
    starts = [found.start() for found in BODY.finditer(whole.text)]
    if len(starts) < 2:
        return [_body(whole, whole.path.stem, alone=True)]
    files = {int(found.group(1)): found.group(2) for found in FILE.finditer(whole.text)}
    names = [files.get(i, f"body{i}") for i in range(1, len(starts) + 1)]
    if len(set(names)) < len(names):
        names = [f"{name}_{i}" for i, name in enumerate(names, start=1)]
    parts = zip(names, starts, [*starts[1:], whole.end], strict=True)
    return [
        _body(_Part(whole.path, whole.text, start, end, f" of {name}"), name, alone=False)
        for name, start, end in parts
    ]


def _body(part: _Part, name: str, *, alone: bool) -> ListedBody:
    place = part.maybe(PLACE)
    if place is None and not alone:
        raise part.error("XBODY, YBODY, ZBODY, PHIBODY")
    x, y, z, angle = place or (0.0, 0.0, 0.0, 0.0)
    if alone and (x != 0.0 or y != 0.0 or angle != 0.0):  # its forces and phases would have to be moved
        raise FileFormatError(
            f"{part.path}: XBODY, YBODY, PHIBODY are {x:g}, {y:g}, {angle:g}; only a body at the origin of "
            "the waves is read: set them to zero and run WAMIT again"
        )
    volumes = part.find(rf"Volumes \(VOLX,VOLY,VOLZ\){TRIPLE}", "the displaced volumes")
    buoyancy = part.find(r"Center of Buoyancy \(Xb,Yb,Zb\)" + TRIPLE, "the centre of buoyancy")
    if np.mean(volumes) <= 0.0:
        raise FileFormatError(f"{part.path}: volumes {volumes}{part.whose} must be positive")
    free = part.maybe(r"Free surface panels:\s*(\d+)")
    gravity = part.maybe(r"Center of Gravity\s+\(Xg,Yg,Zg\)" + TRIPLE) or buoyancy
    return ListedBody(
        name=name, position=np.array([x, y, z]), heading=float(np.radians(angle)), part=part,
        volume=float(np.mean(volumes)), gravity=np.array(gravity), lid_panels=int(free[0]) if free else 0,
    )  # fmt: skip


def listed_tables(listing: Listing) -> tuple[Table, Table]:
    """Rows of period, i, j, A, B and of period, heading, i, modulus, phase, real, imaginary.

    Diffraction forces are taken before those by Haskind's relation, which are taken where there are no
    others.
    """
    path, lines = listing.path, listing.lines
    rows: dict[str, list[tuple[int, list[float]]]] = {"ADDED": [], "DIFFRACTION": [], "HASKIND": []}
    period = heading = np.nan
    table = ""
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not words:
            continue
        if table and words[0].lstrip("-").isdigit():
            values = [number_at(path, number, word) for word in words]
            if np.isnan(period) or (table != "ADDED" and np.isnan(heading)):
                raise FileFormatError(f"{path}, line {number}: a row before any wave period or heading")
            if table == "ADDED" and len(values) in (3, 4):
                rows[table].append((number, [period, *values, *[np.nan] * (4 - len(values))]))
            elif table != "ADDED" and len(values) == 3:
                i, modulus, phase = values
                turned = modulus * np.exp(1j * np.radians(phase))
                row = [period, heading, abs(i), modulus, phase, turned.real, turned.imag]
                rows[table].append((number, row))
        elif found := PERIOD.search(line):
            word, table = found.group(1), ""
            period = NAMED_PERIODS[word] if word in NAMED_PERIODS else number_at(path, number, word)
        elif found := HEADING.search(line):
            heading = number_at(path, number, found.group(1))
        elif words[0][0].isalpha() and words[0] != "I":
            table = next((kind for kind in rows if kind in line), "")
    found_rows = {"added mass": rows["ADDED"], "exciting forces": rows["DIFFRACTION"] or rows["HASKIND"]}
    for what, each in found_rows.items():
        if not each:
            raise FileFormatError(
                f"{path}, line {len(lines)}: the listing ends without {what}; it is truncated"
            )
    matrices, forces = (
        Table(path, np.array([values for _, values in each]), np.array([number for number, _ in each]))
        for each in found_rows.values()
    )
    return matrices, forces


@dataclass(frozen=True, eq=False)
class ForceControl:
    """A ``.frc`` file of either form; what its form does not hold is None.

    Form 1 (IALTFRC=1): ``height_of_gravity`` and ``radii`` (3, 3) of gyration, m. Form 2 (IALTFRC=2):
    ``rho``, ``mass``, ``damping``, ``stiffness`` (6, 6), all dimensional.
    ``motions_option`` is 1 for motions from Haskind forces, 2 from diffraction forces, 0 for none.
    """

    path: Path
    motions_option: int
    height_of_gravity: float | None = None
    radii: Array | None = None
    rho: float | None = None
    mass: Array | None = None
    damping: Array | None = None
    stiffness: Array | None = None


def read_force_control(path: Path) -> ForceControl:
    """Read a ``.frc`` file of form 1 or 2, told apart by its fifth line (three radii, or the flag IMASS)."""
    reader = _ListDirected(path)
    reader.text("the heading")
    options = reader.take(9, "the nine options")
    motions = abs(int(options[IOPTN_MOTIONS]))
    first = reader.take(1, "VCG or the density")[0]
    row = reader.take(3, "the first radii of gyration or the centre of gravity")
    numbers = takewhile(is_number, reader.peek("IMASS or radii of gyration"))
    second_form = len(list(numbers)) < 3
    if second_form and not first > 0.0:
        raise FileFormatError(f"{path}, line 3: density {first:g}; give a positive one")
    if not second_form:
        radii = np.array([row, *(reader.take(3, "radii of gyration") for _ in range(2))])
        reader.take(1, "NBETAH")
        return ForceControl(path, motions, height_of_gravity=first, radii=radii)
    names = ("mass", "damping", "stiffness")
    matrices: dict[str, Any] = {name: reader.matrix(f"external {name}") for name in names}
    reader.take(1, "NBETAH")
    return ForceControl(path, motions, rho=first, **matrices)


def check_period_output(path: Path) -> None:
    """Raise if a ``.cfg`` file makes the numeric files list something else than periods."""
    for number, line in enumerate(text_of(path).split("\n"), start=1):
        match = re.match(r"\s*(IPEROUT|IPERIO)\s*=\s*(-?\d+)", line, re.IGNORECASE)
        if match and match.group(2) != "1":
            raise FileFormatError(
                f"{path}, line {number}: {match.group(1)}={match.group(2)[:20]}: the files list frequencies "
                "or wave numbers; run WAMIT with periods (1)"
            )


class _ListDirected(TextRecords):
    """Numbers as Fortran's list-directed input takes them: over several lines, rest of a line dropped."""

    def take(self, count: int, what: str, *, over_lines: bool = False) -> list[float]:
        """The next ``count`` numbers, from the start of the next line."""
        values: list[float] = []
        while len(values) < count:
            if values and not over_lines:
                raise self.error(f"{what}: {count} numbers are expected, found {len(values)}")
            words = self.text(what).replace(",", " ").split()
            values += [self.number(word, what) for word in words[: count - len(values)]]
        return values

    def matrix(self, what: str) -> Array | None:
        """A flag, and a matrix (6, 6) if it is 1."""
        flag = self.take(1, f"the flag of the {what}")[0]
        if flag not in (0.0, 1.0):
            raise self.error(f"flag {flag:g} of the {what}: 0 or 1 is expected")
        if flag == 0.0:
            return None
        return np.array(self.take(36, f"the {what} matrix", over_lines=True)).reshape(6, 6)
