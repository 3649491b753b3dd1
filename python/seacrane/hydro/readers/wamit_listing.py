"""The listing (``.out``) of a WAMIT run of several bodies: what it says of each, and its tables."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.numbers_of_text import number_of_word
from seacrane.hydro.readers.wamit_control import NUMBER, listing_lines, water_depth
from seacrane.hydro.readers.wamit_tables import (
    INFINITE_FREQUENCY_PERIOD,
    ZERO_FREQUENCY_PERIOD,
    Table,
)

FloatArray = NDArray[np.float64]

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


@dataclass(frozen=True, eq=False)
class ListedBody:
    """One body of the listing, in its own axes.

    ``position`` (3,) m and ``heading`` rad of its axes, ``volume`` m3, ``gravity`` (3,) m its centre of mass
    from its origin, ``restoring`` (6, 6) over rho g.
    """

    name: str
    position: FloatArray
    heading: float
    volume: float
    gravity: FloatArray
    restoring: FloatArray
    lid_panels: int


@dataclass(frozen=True, eq=False)
class GroupListing:
    """Head of the listing, and its tables as rows like those of ``.1`` and ``.3`` files."""

    version: str
    g: float
    length_scale: float
    depth: float
    rho: float | None
    bodies: tuple[ListedBody, ...]
    lines: list[str]


def count_bodies(path: Path) -> int:
    """Bodies of a listing; 1 where it does not number them."""
    numbers = [int(found.group(1)) for line in listing_lines(path) if (found := BODY.search(line))]
    return max(numbers, default=1)


def read_group_listing(path: Path) -> GroupListing:
    """Read the head of a listing of several bodies.

    Raises FileFormatError: something needed is missing; the message names the body.
    """
    lines = listing_lines(path)
    text = "\n".join(lines)
    starts = [found.start() for found in BODY.finditer(text)]
    names = _names(text, len(starts))
    first, scale = _numbers(path, text, rf"Gravity:\s+{NUMBER}\s+Length scale:\s+{NUMBER}", "gravity", "file")
    if min(first, scale) <= 0.0:
        raise FileFormatError(f"{path}: gravity {first:g} and length scale {scale:g} must be positive")
    density = re.search(rf"Water density:\s+{NUMBER}", text)
    version = re.search(r"WAMIT\s+Version\s+(\S+)", text)
    ends = [*starts[1:], len(text)]
    rho = number_of_word(density.group(1)) if density else 0.0
    return GroupListing(
        version=version.group(1) if version else "of unknown version",
        g=first,
        length_scale=scale,
        depth=water_depth(path, text, len(lines)),
        rho=rho if rho > 1.0 else None,
        bodies=tuple(
            _body(path, name, text[start:end], scale)
            for name, start, end in zip(names, starts, ends, strict=True)
        ),
        lines=lines,
    )


def _names(text: str, count: int) -> list[str]:
    """Names of the geometry files, each once; numbers where there are none."""
    files = {int(found.group(1)): found.group(2) for found in FILE.finditer(text)}
    names = [files.get(i, f"body{i}") for i in range(1, count + 1)]
    return names if len(set(names)) == count else [f"{name}_{i}" for i, name in enumerate(names, start=1)]


def _body(path: Path, name: str, text: str, scale: float) -> ListedBody:
    triple = rf"\s*:?\s+{NUMBER}\s+{NUMBER}\s+{NUMBER}"
    place = _numbers(path, text, PLACE, "XBODY, YBODY, ZBODY, PHIBODY", name)
    volumes = _numbers(path, text, rf"Volumes \(VOLX,VOLY,VOLZ\){triple}", "volumes", name)
    buoyancy = _numbers(path, text, r"Center of Buoyancy \(Xb,Yb,Zb\)" + triple, "centre of buoyancy", name)
    gravity = re.search(r"Center of Gravity\s+\(Xg,Yg,Zg\)" + triple, text)
    restoring = np.zeros((6, 6))
    for label, entries in RESTORING:
        values = _numbers(path, text, label + rf"\s+{NUMBER}" * len(entries), "restoring coefficients", name)
        for (i, j), value in zip(entries, values, strict=True):
            restoring[i, j] = value
            if j < 5:
                restoring[j, i] = value
    rotations = np.array([0, 0, 0, 1, 1, 1])
    free = re.search(r"Free surface panels:\s*(\d+)", text)
    return ListedBody(
        name=name,
        position=np.array(place[:3]),
        heading=float(np.radians(place[3])),
        volume=float(np.mean(volumes)),
        gravity=np.array([number_of_word(word) for word in gravity.groups()] if gravity else buoyancy),
        restoring=restoring * scale ** (2 + np.add.outer(rotations, rotations)),
        lid_panels=int(free.group(1)) if free else 0,
    )


def _numbers(path: Path, text: str, pattern: str, what: str, name: str) -> list[float]:
    found = re.search(pattern, text)
    if found is None:
        raise FileFormatError(f"{path}: no {what} of {name}; the listing is truncated, or no WAMIT listing")
    try:
        return [number_of_word(word) for word in found.groups()]
    except ValueError as error:
        raise FileFormatError(f"{path}: {what} of {name}, {found.group(0)[:80]!r}: {error}") from None


def listed_tables(path: Path, lines: list[str]) -> tuple[Table, Table]:
    """Rows of period, i, j, A, B and of period, heading, i, modulus, phase, real, imaginary.

    Diffraction forces are taken before those by Haskind's relation, which are taken where there are no
    others.
    """
    matrices: list[tuple[int, list[float]]] = []
    waves: dict[str, list[tuple[int, list[float]]]] = {"DIFFRACTION": [], "HASKIND": []}
    period = heading = np.nan
    table = ""
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not words:
            continue
        if table and _is_row(words):
            values = [_value(path, number, word) for word in words]
            if np.isnan(period) or (table != "ADDED" and np.isnan(heading)):
                raise FileFormatError(f"{path}, line {number}: a row before any wave period or heading")
            if table == "ADDED" and len(values) in (3, 4):
                matrices.append((number, [period, *values, *[np.nan] * (4 - len(values))]))
            elif table in waves and len(values) == 3:
                i, modulus, phase = values
                turned = modulus * np.exp(1j * np.radians(phase))
                row = [period, heading, abs(i), modulus, phase, turned.real, turned.imag]
                waves[table].append((number, row))
        elif found := PERIOD.search(line):
            word, table = found.group(1), ""
            period = NAMED_PERIODS[word] if word in NAMED_PERIODS else _value(path, number, word)
        elif found := HEADING.search(line):
            heading = _value(path, number, found.group(1))
        elif words[0][0].isalpha() and words[0] != "I":
            table = next((kind for kind in ("ADDED", *waves) if kind in line), "")
    forces = waves["DIFFRACTION"] or waves["HASKIND"]
    if not matrices or not forces:
        what = "added mass" if not matrices else "exciting forces"
        raise FileFormatError(f"{path}, line {len(lines)}: the listing ends without {what}; it is truncated")
    return _table(path, matrices), _table(path, forces)


def _table(path: Path, rows: list[tuple[int, list[float]]]) -> Table:
    return Table(path, np.array([values for _, values in rows]), np.array([number for number, _ in rows]))


def _is_row(words: list[str]) -> bool:
    return words[0].lstrip("-").isdigit()


def _value(path: Path, number: int, word: str) -> float:
    try:
        return number_of_word(word)
    except ValueError as error:
        raise FileFormatError(f"{path}, line {number}: {error}") from None
