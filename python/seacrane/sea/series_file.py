"""A record as columns, as loggers, buoys and spreadsheets write it, whose errors name line and column."""

from __future__ import annotations

import re
from array import array
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.looks_like import looks_like
from seacrane.inputs.shown import listed, shown
from seacrane.inputs.units import UNITS, G, unit_text
from seacrane.inputs.whole_file import decoded, read_whole
from seacrane.sea.records.kind import MOST_ABOVE, MOTIONS, Columns
from seacrane.sea.records.kinds import kind_of

MISSING = frozenset(["", "nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "nodata"])
COMMENTS = ("#", "%", "//")
DELIMITERS = "\t;,"
OTHERS = frozenset(
    ["rate", "velocity", "speed", "vel", "acc", "accel", "acceleration", "std", "max", "min", "mean"]
)
STAMP = " and no time stamp like the first one, as 2026-03-01T12:00:00.100 or 01.03.2026 12:00"
LARGEST, LONGEST_CLOCK = 1e15, 1e19  # of any number, and of nanoseconds since 1970
TIMES = frozenset(
    ["time", "t", "timestamp", "time stamp", "datetime", "date time", "date/time", "utc", "utc time",
     "gps time", "elapsed time", "clock", "seconds", "date", "valid time", "epoch time"]
)  # fmt: skip
PARTS = ("year", "month", "day", "hour", "minute", "second", "millisecond")
PART_OF = {
    "yyyy": "year", "min": "minute", "sec": "second", "milisec": "millisecond", "msec": "millisecond",
    "datum": "date", "uhrzeit": "time", "zeit": "time",
}  # fmt: skip
ZONES = ("utc", "gmt", "iso")
DATES = {"dd/mm/yyyy": True, "mm/dd/yyyy": False}  # whether the day comes first
_STAMP = re.compile(
    r"(?:(?P<year>\d{4})[-/.](?P<month>\d{1,2})[-/.](?P<day>\d{1,2})"
    r"|(?P<one>\d{1,2})(?P<by>[-/.])(?P<two>\d{1,2})(?P=by)(?P<last>\d{4}))"
    r"(?:[T ]+(?P<hour>\d{1,2}):(?P<minute>\d{1,2})(?::(?P<second>\d{1,2})(?:[.,](?P<part>\d{1,6}))?)?)?"
    r" *(?P<zone>Z|UTC|GMT)?",
    re.IGNORECASE,
)
LONGEST, MONTHS = 200, 12  # characters of a cell of a header; numbers that may be a month
IN_BRACKETS = re.compile(r"([^\[\]()]*)[\[(]([^\[\]()]*)[\])]\s*")
_WORDS = {
    "°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "metre": "m",
    "metres": "m", "meter": "m", "meters": "m", "sec": "s", "second": "s", "seconds": "s", "-": "1", "%": "%",
    "KN": "kN", "kNm": "kN m", "Nm": "N m", "MNm": "MN m", "te": "t", "kgf": "kg", "tonnes": "t",
    "°/s": "deg/s", "rpm": "rpm",
}  # fmt: skip
SPELLED: Mapping[str, tuple[float, str]] = MappingProxyType(
    {  # factor to SI, and the SI unit; tonnes and kilograms of a load are its weight, "_l" is left or low
        **{text: (factor, unit_text(of)) for text, (factor, of) in UNITS.items() if text != "l"},
        "t": (1e3 * G, "N"), "kg": (G, "N"), "%": (0.01, "1"), "cm": (0.01, "m"), "km": (1e3, "m"),
        "ft": (0.3048, "m"), "mm/s": (1e-3, "m/s"), "cm/s": (0.01, "m/s"), "g": (G, "m/s2"),
        "mrad": (1e-3, "rad"), "ms": (1e-3, "s"), "us": (1e-6, "s"), "MW": (1e6, "W"),
    }
)  # fmt: skip


class SeriesFile:
    """The header of a file, and its columns as numbers when they are asked for.

    A file of a known kind is rearranged into columns (`records`). Of others the header is the first line with
    a column of time and another one. Its delimiter is a tab, a semicolon, a comma or blanks; where it is no
    comma, numbers may have one. A second line may hold the units. Date and time may stand in several columns.

    `reader` is the one that asks; `rate_hz` gives samples without a clock their times; `dates` says which of
    01/02/2026 is the day.
    """

    def __init__(
        self, path: Path, *, time: str | None = None, rate_hz: float | None = None, dates: str | None = None,
        reader: str = MOTIONS,
    ) -> None:  # fmt: skip
        if dates is not None and dates not in DATES:
            raise SceneError(f"units of date is {shown(dates)}; give {' or '.join(map(repr, DATES))}")
        self.path, self.fix, self._day_first = path, "", DATES.get(dates or "")
        data = read_whole(path, fix="cut the record into several files")
        text = decoded(data)
        if "\0" in text or not text.strip():
            what = looks_like(path, data)
            raise FileFormatError(f"{path}: is {what}; give a text file of columns (CSV, TSV)")
        self._lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        self._time = None if time is None else plain_words(time)
        self.kind = kind_of(self._lines)
        if self.kind is None:
            self._find_header()
        elif self.kind.columns is None or self.kind.reader != reader:
            raise FileFormatError(f"{path}: is of the kind {self.kind.name}, which {self.kind.reader} reads")
        else:
            self._take(self.kind.columns(self._lines, rate_hz))
        self._cells = len(self.headings)
        self._join_clock()
        if not self.clocks():
            raise FileFormatError(f"{path}, line {self.header}: names no column of time; complete it")

    def _take(self, columns: Columns) -> None:
        """The columns of a kind in the place of what the file holds."""
        self.header, self._first, self._lines, self.fix = columns.line, 0, list(columns.rows), columns.fix
        self.delimiter, cells = _cells_of_header(columns.header)
        self.headings = tuple(heading_of(i, cell) for i, cell in enumerate(cells))

    def _find_header(self) -> None:
        path, time = self.path, self._time
        for at, line in enumerate(self._lines[:MOST_ABOVE], start=1):
            self.header = self._first = at
            self.delimiter, cells = _cells_of_header(line)
            self.headings = tuple(heading_of(i, cell[: LONGEST + 1]) for i, cell in enumerate(cells))
            if any(map(self.is_named_clock, self.headings)):
                break
            words = {PART_OF.get(one.name, one.name) for one in self.headings}
            if time is None and len(cells) > 1 and ({*PARTS[:4]} <= words or words & TIMES):
                break
        else:
            first = next((line for line in self._lines if line.strip()), "")
            raise FileFormatError(
                f"{path}: no line names columns, with one of time, as in 'time [s];roll [deg]'; it begins "
                f"with {shown(first)}: write such a line above the numbers, or give columns={{'time': ...}}; "
                "records of buoys and sensors are told by what docs/operability.md lists"
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

    def _join_clock(self) -> None:
        """One column of time in the place of several, such as of date and time, or of year, month and day."""
        parts: dict[str, Heading] = {}
        for one in self.headings:
            parts.setdefault(PART_OF.get(one.name, one.name), one)
        times = [one for one in self.headings if one.is_time and not one.is_date]
        if self._time is not None:
            return
        if parts.keys() >= {*PARTS[:4]}:
            joined = [parts[name] for name in PARTS if name in parts]
        elif "date" in parts and times and (times[0].unit or ZONES[0]).lower() in ZONES:
            joined = [parts["date"], times[0]]
        else:
            return
        clock = Heading(
            place=joined[0].place, text=" + ".join(one.text for one in joined), name="time",
            unit=next((one.unit for one in joined if one.unit), None),
            places=tuple(one.place for one in joined),
        )  # fmt: skip
        self.headings = (clock, *(one for one in self.headings if one not in joined))

    def refused(self, line: int, heading: Heading, words: str) -> FileFormatError:
        """An error at a line and a column."""
        return FileFormatError(f"{self.path}, line {line}, column {shown(heading.text)}: {words}")

    def is_named_clock(self, heading: Heading) -> bool:
        """Whether it is the column of time that was named."""
        return self._time is not None and self._time in (plain_words(heading.text), heading.name)

    def clocks(self) -> list[Heading]:
        """The columns of time, first the one that was named."""
        times = [one for one in self.headings if one.is_time or self.is_named_clock(one)]
        return sorted(times, key=lambda one: (not self.is_named_clock(one), one.is_date))

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
            if len(cells) == self._cells + 1 and not cells[-1].strip():
                cells.pop()
            if len(cells) != self._cells:
                raise FileFormatError(
                    f"{self.path}, line {line}: has {len(cells)} cells, and the header "
                    f"{self._cells} ({listed([one.text for one in self.headings])}); complete the "
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
        cell = _clock_text(cells, one)
        value, largest, kind = plain_number(cell, comma=self.delimiter != ","), LARGEST, ""
        if one in clocks:
            largest = LONGEST_CLOCK
            if value is None:
                try:
                    stamp = self._stamp(line, one, cell)
                    return (stamp - stamps.setdefault(one.place, stamp)).total_seconds()
                except FileFormatError:
                    raise
                except (ValueError, TypeError, OverflowError):  # no stamp, or one of both has no zone
                    pass
                value, kind = (None, STAMP) if one is clocks[0] else (float("nan"), "")
        if value is None or abs(value) > largest:
            raise self.refused(
                line, one, f"{shown(cell)} is no number of up to {LARGEST:g}{kind}; correct it, or leave the "
                "cell empty where the value is missing",
            )  # fmt: skip
        return value

    def _stamp(self, line: int, one: Heading, text: str) -> datetime:
        """A time stamp; ValueError where it is none."""
        with suppress(ValueError):
            return datetime.fromisoformat(text)
        found = _STAMP.fullmatch(text[:LONGEST])
        if found is None:
            raise ValueError
        year, month, day = found["year"] or found["last"], found["month"], found["day"]
        if found["one"]:
            first = found["by"] == "." or self._is_day_first(line, one)
            day, month = (found["one"], found["two"]) if first else (found["two"], found["one"])
        hour, minute, second = (int(found[part] or 0) for part in ("hour", "minute", "second"))
        part = int((found["part"] or "0").ljust(6, "0"))
        zone = UTC if found["zone"] else None
        return datetime(int(year), int(month), int(day), hour, minute, second, part, zone)

    def _is_day_first(self, line: int, one: Heading) -> bool:
        """Of dates such as 01/02/2026, by what is given or by a number above twelve in one of the lines."""
        if self._day_first is None:
            rows = (text.split(self.delimiter) for text in self._lines[self._first :])
            texts = (_clock_text(cells, one) for cells in rows if len(cells) >= self._cells)
            found = [m for m in (_STAMP.match(text[:LONGEST]) for text in texts) if m and m["one"]]
            above = {name: any(int(m[name]) > MONTHS for m in found) for name in ("one", "two")}
            if above["one"] == above["two"]:
                raise self.refused(
                    line, one, "dates do not say which number is the day; give units={'date': "
                    "'dd/mm/yyyy'} or 'mm/dd/yyyy'",
                )  # fmt: skip
            self._day_first = above["one"]
        return self._day_first


def _clock_text(cells: Sequence[str], one: Heading) -> str:
    """What a column holds; of a clock in several columns all of it, as one stamp."""
    if not one.places:
        return cells[one.place].strip().strip("\"'")
    texts = [cells[place].strip().strip("\"'") for place in one.places]
    if len(texts) < len(PARTS[:4]):
        return " ".join(texts)
    hour, *rest = texts[3:]
    clock = ":".join([hour, *(rest[:2] or ["0"])])
    return f"{'-'.join(texts[:3])} {clock}" + (f".{rest[2].rjust(3, '0')}" if len(rest) > 2 else "")


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
    """A cell of a header: its place in the line, its text, its name in plain words, its unit as written.

    `places` are those of a clock that stands in several columns.
    """

    place: int
    text: str
    name: str
    unit: str | None
    places: tuple[int, ...] = ()

    @property
    def is_time(self) -> bool:
        return PART_OF.get(self.name, self.name) in TIMES

    @property
    def is_date(self) -> bool:
        return PART_OF.get(self.name, self.name) == "date"


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
