"""A text file of columns, as loggers and spreadsheets write it, whose errors name line and column."""

from __future__ import annotations

import re
from array import array
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime
from math import pi
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.inputs.looks_like import looks_like
from seacrane.inputs.shown import listed, shown
from seacrane.inputs.units import UNITS, unit_text
from seacrane.inputs.whole_file import decoded, read_whole

MISSING = frozenset(["", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "nodata"])
COMMENTS = ("#", "%", "//")
DELIMITERS = "\t;,"
OTHERS = frozenset(
    ["rate", "velocity", "speed", "vel", "acc", "accel", "acceleration", "std", "max", "min", "mean"]
)
STAMP = " and no time stamp of ISO 8601 like the first one, as 2026-03-01T12:00:00.100"
MOST_ABOVE = 100  # lines that may stand above the header
LARGEST, LONGEST_CLOCK = 1e15, 1e19  # of any number, and of nanoseconds since 1970
G = 9.80665  # m/s2, standard: tonnes and kilograms of a load are its weight
TIMES = frozenset(
    ["time", "t", "timestamp", "time stamp", "datetime", "date time", "date/time", "utc", "utc time",
     "gps time", "elapsed time", "clock", "seconds"]
)  # fmt: skip
LONGEST = 200  # characters of a cell of a header
IN_BRACKETS = re.compile(r"([^\[\]()]*)[\[(]([^\[\]()]*)[\])]\s*")
_WORDS = {
    "°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "metre": "m",
    "metres": "m", "meter": "m", "meters": "m", "sec": "s", "second": "s", "seconds": "s", "-": "1", "%": "%",
    "KN": "kN", "kNm": "kN m", "Nm": "N m", "MNm": "MN m", "te": "t", "tf": "t", "kgf": "kg", "tonnes": "t",
    "°/s": "deg/s", "rpm": "rpm",
}  # fmt: skip
SPELLED: Mapping[str, tuple[float, str]] = MappingProxyType(
    {  # factor to SI, and the SI unit
        **{text: (factor, unit_text(dimension)) for text, (factor, dimension) in UNITS.items()},
        "t": (1e3 * G, "N"), "kg": (G, "N"), "MN": (1e6, "N"), "MN m": (1e6, "N m"), "%": (0.01, "1"),
        "cm": (0.01, "m"), "km": (1e3, "m"), "ft": (0.3048, "m"), "mm/s": (1e-3, "m/s"),
        "cm/s": (0.01, "m/s"), "g": (G, "m/s2"), "mrad": (1e-3, "rad"), "deg/s2": (pi / 180.0, "rad/s2"),
        "rpm": (pi / 30.0, "rad/s"), "ms": (1e-3, "s"), "us": (1e-6, "s"), "min": (60.0, "s"),
        "h": (3600.0, "s"), "kPa": (1e3, "Pa"), "MPa": (1e6, "Pa"), "kW": (1e3, "W"), "MW": (1e6, "W"),
    }
)  # fmt: skip


class SeriesFile:
    """The header of a file, and its columns as numbers when they are asked for.

    The header is the first line with a column of time and another one. Its delimiter is a tab, a semicolon, a
    comma or blanks; where it is no comma, numbers may have one. A second line may hold the units.
    """

    def __init__(self, path: Path, *, time: str | None = None) -> None:
        self.path = path
        data = read_whole(path, fix="cut the record into several files")
        text = decoded(data)
        if "\0" in text or not text.strip():
            what = looks_like(path, data)
            raise FileFormatError(f"{path}: is {what}; give a text file of columns (CSV, TSV)")
        self._lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        self._time = None if time is None else plain_words(time)
        for at, line in enumerate(self._lines[:MOST_ABOVE], start=1):
            self.header = self._first = at
            self.delimiter, cells = _cells_of_header(line)
            self.headings = tuple(heading_of(i, cell[: LONGEST + 1]) for i, cell in enumerate(cells))
            if any(map(self.is_named_clock, self.headings)):
                break
            if time is None and len(cells) > 1 and any(one.is_time for one in self.headings):
                break
        else:
            first = next((line for line in self._lines if line.strip()), "")
            raise FileFormatError(
                f"{path}: no line names columns, with one of time, as in 'time [s];roll [deg]'; it begins "
                f"with {shown(first)}: write such a line above the numbers, or give columns={{'time': ...}}"
            )
        if any(len(cell) > LONGEST for cell in cells):
            raise FileFormatError(f"{path}, line {self.header}: a name has more than {LONGEST} characters")
        self._take_units()

    def _take_units(self) -> None:
        """Units in a line below the header, which holds no numbers, are those of the columns without one."""
        at = next((i for i in range(self._first, len(self._lines)) if self._lines[i].strip()), None)
        texts = [] if at is None else [c.strip().strip("\"'") for c in self._lines[at].split(self.delimiter)]
        known = any(set(texts) - {"", "1"}) and all(not text or unit_of_words(text) for text in texts)
        if at is not None and known and len(texts) == len(self.headings):
            pairs = zip(self.headings, texts, strict=True)
            self.headings = tuple(replace(one, unit=one.unit or text or None) for one, text in pairs)
            self._first = at + 1

    def refused(self, line: int, heading: Heading, words: str) -> FileFormatError:
        """An error at a line and a column."""
        return FileFormatError(f"{self.path}, line {line}, column {shown(heading.text)}: {words}")

    def is_named_clock(self, heading: Heading) -> bool:
        """Whether it is the column of time that was named."""
        return self._time is not None and self._time in (plain_words(heading.text), heading.name)

    def clocks(self) -> list[Heading]:
        """The columns of time, first the one that was named."""
        times = [one for one in self.headings if one.is_time or self.is_named_clock(one)]
        return sorted(times, key=lambda one: not self.is_named_clock(one))

    def find(self, asked: str) -> Heading | None:
        """The column of a name, with or without its unit; else the only one with all its words."""
        words = plain_words(asked)
        exact = [one for one in self.headings if plain_words(one.text) == words]
        named = [one for one in self.headings if one.name == words]
        has = [(one, set(one.name.split())) for one in self.headings]
        about = set(words.split())
        near = [one for one, each in has if about <= each and not (each - about) & OTHERS]
        return next((group[0] for group in (exact, named, near) if len(group) == 1), None)

    def columns(self, wanted: Sequence[Heading], clocks: int) -> tuple[Array, NDArray[np.intp], str]:
        """Numbers of columns, as they are written; missing ones are NaN.

        ``wanted`` begins with so many ``clocks``, which may hold time stamps: they are in s from the first.

        Returns the numbers (n, columns), the line of each row (n,), and that first stamp, or "".
        """
        numbers, lines = array("d"), array("q")
        stamps: dict[int, datetime] = {}
        for line, text in enumerate(self._lines[self._first :], start=self._first + 1):
            if not text.strip() or text.lstrip().startswith(COMMENTS):
                continue
            cells = text.split(self.delimiter)
            if len(cells) == len(self.headings) + 1 and not cells[-1].strip():
                cells.pop()
            if len(cells) != len(self.headings):
                raise FileFormatError(
                    f"{self.path}, line {line}: has {len(cells)} cells, and the header "
                    f"{len(self.headings)} ({listed([one.text for one in self.headings])}); complete the "
                    "line or delete it"
                )
            numbers.extend(self._number(line, cells, one, wanted[:clocks], stamps) for one in wanted)
            lines.append(line)
        rows = np.array(numbers, dtype=float).reshape(-1, len(wanted))
        first = next((one.isoformat(sep=" ") for one in stamps.values()), "")
        return rows, np.array(lines, dtype=np.intp), first

    def _number(
        self,
        line: int,
        cells: Sequence[str],
        one: Heading,
        clocks: Sequence[Heading],
        stamps: dict[int, datetime],
    ) -> float:
        """A cell's number; a time stamp in s from the first of its column. A second clock need not be one."""
        cell = cells[one.place]
        value, largest, kind = plain_number(cell, comma=self.delimiter != ","), LARGEST, ""
        if one in clocks:
            largest = LONGEST_CLOCK
            if value is None:
                with suppress(ValueError, TypeError, OverflowError):  # no stamp, or one of both has no zone
                    stamp = datetime.fromisoformat(cell.strip().strip("\"'"))
                    return (stamp - stamps.setdefault(one.place, stamp)).total_seconds()
                value, kind = (None, STAMP) if one is clocks[0] else (float("nan"), "")
        if value is None or abs(value) > largest:
            raise self.refused(
                line, one, f"{shown(cell)} is no number of up to {LARGEST:g}{kind}; correct it, or leave the "
                "cell empty where the value is missing",
            )  # fmt: skip
        return value


def _cells_of_header(line: str) -> tuple[str | None, list[str]]:
    """The delimiter of a line, None standing for blanks, and its cells; a unit apart belongs to its name."""
    text = line.strip()
    for sign in COMMENTS:
        text = text.removeprefix(sign)
    delimiter = next((one for one in DELIMITERS if one in line), None)
    if delimiter is not None:
        return delimiter, text.split(delimiter)
    cells: list[str] = []
    for word in text.split():
        if cells and word[0] in "[(":
            cells[-1] += f" {word}"
        else:
            cells.append(word)
    return delimiter, cells


def plain_number(cell: str, *, comma: bool) -> float | None:
    """A number, NaN where it is missing, or None for another text."""
    text = cell.strip().strip("\"'")
    if text.lower() in MISSING:
        return float("nan")
    if comma:
        text = text.replace(",", ".")
    try:
        return None if "_" in text else float(text)
    except ValueError:
        return None


@dataclass(frozen=True, kw_only=True)
class Heading:
    """A cell of a header: its place in the line, its text, its name in plain words, its unit as written."""

    place: int
    text: str
    name: str
    unit: str | None

    @property
    def is_time(self) -> bool:
        return self.name in TIMES


def unit_of_words(words: str) -> tuple[float, str] | None:
    """Factor to SI and the SI unit of a unit as loggers write it; None where it is unknown.

    Small and capital letters are told apart where it matters: mN is no MN.
    """
    text = words.strip().strip("[]()").strip()
    text = re.sub(r"_per_", "/", text).replace("²", "2").replace("³", "3").replace("^", "").replace("**", "")
    text = re.sub(r"\s*[·*]\s*", " ", text).replace("°/", "deg/")
    for one in (text, text.lower()):
        found = SPELLED.get(_WORDS.get(one, one))
        if found:
            return found
    return None


def heading_of(place: int, cell: str) -> Heading:
    """A cell of a header taken apart: unit in brackets at its end, or after its last underscore."""
    text = cell.strip().strip("\"'").strip()
    name, unit = text, None
    found = IN_BRACKETS.fullmatch(text)
    if found and found[1].strip():
        name, unit = found[1], found[2]
    elif not found:
        words = text.split("_")
        for count in (3, 1):  # rad_per_s, deg
            tail = "_".join(words[-count:])
            if len(words) > count and not tail.isdecimal() and unit_of_words(tail):
                name, unit = "_".join(words[:-count]), tail
                break
    return Heading(place=place, text=text, name=plain_words(name), unit=unit)


def plain_words(name: str) -> str:
    """A name in small letters, with one space between its words."""
    return " ".join(re.split(r"[\s_]+", name.strip(" _\t\"'").lower()))
