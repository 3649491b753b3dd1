"""Scatter tables: how often sea states occur, over classes of height and of period."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import decoded, read_whole
from seacrane.sea.records.kind import LONGEST, MOST_ABOVE, SCATTER, Kind

DELIMITERS = "\t;,"
AXES = {  # what a label calls an axis, and its SI unit
    "hs": (re.compile(r"\b(hs|hm0|hsig|h1/3|significant (wave )?height)\b", re.IGNORECASE), "m"),
    "tp": (re.compile(r"\b(tp|peak (wave )?period)\b", re.IGNORECASE), "s"),
}
MEAN = re.compile(r"\b(t[zem]|t[m0]*[12]|t[m]?0[12]|tm-10|mean period|zero.crossing period)\b", re.IGNORECASE)
TOTAL = re.compile(r"\s*(sum|total|all|summe|gesamt|cum|Σ)", re.IGNORECASE)
UNIT = re.compile(r"[\[(]\s*([^\[\]()]{1,8}?)\s*[\])]")
NUMBER = r"(\d{1,6}(?:[.,]\d{1,6})?)"
RANGE = re.compile(rf"[\[(]?\s*{NUMBER}\s*(?:-|\u2013|\u2014|to|\.\.|<)\s*{NUMBER}\s*[\])]?")
BELOW = re.compile(rf"(?:<|<=|\u2264)\s*{NUMBER}")
ABOVE = re.compile(rf"(?:>|>=|\u2265)\s*{NUMBER}|{NUMBER}\s*\+")
SINGLE = re.compile(NUMBER)
UNITS = {"m": 1.0, "cm": 0.01, "ft": 0.3048, "s": 1.0, "sec": 1.0}  # of heights and periods
ROUNDING = 1e-6  # of a limit
MOST_ENDS = 2  # classes that a line of something else may hold
CLASSES = ("lower", "middle", "upper")
STEEPEST = 9.80665 / (2.0 * np.pi) / 7.0  # m/s2: no wave is higher than a seventh of its length


class Class(NamedTuple):
    """Bounds of a class, or one number for which the table does not say what it is; and its decimals."""

    low: float
    high: float
    single: bool
    decimals: int


def class_of(cell: str) -> Class | None:
    """A cell of an axis such as "0.5-1.0", "<1", ">12" or "4.5"; None for another text."""
    text = cell.strip().strip("\"'").strip()[:40]
    for pattern in (RANGE, BELOW, ABOVE, SINGLE):
        found = pattern.fullmatch(text)
        if found:
            ends = [one.replace(",", ".") for one in found.groups() if one]
            numbers = [float(one) for one in ends]
            decimals = max(len(one.partition(".")[2]) for one in ends)
            low = 0.0 if pattern is BELOW else numbers[0]
            high = float("inf") if pattern is ABOVE else numbers[-1]
            return Class(low, high, pattern is SINGLE, decimals)
    return None


def _cells(line: str) -> list[str]:
    delimiter = next((one for one in DELIMITERS if one in line), None)
    return [] if delimiter is None else line.split(delimiter)


def header_of(lines: Sequence[str]) -> int:
    """The line of classes along the top, under which another begins with a class; -1: there is none."""
    for place, line in enumerate(lines[:MOST_ABOVE]):
        cells = [one for one in _cells(line[:LONGEST])[1:] if one.strip() and not TOTAL.match(one)]
        below = next((one[:LONGEST] for one in lines[place + 1 : MOST_ABOVE + 1] if one.strip()), "")
        label = " ".join(_labels(lines, place))
        known = MEAN.search(label) or any(one.search(label) for one, _ in AXES.values())
        classes = [*cells, (_cells(below) or [""])[0]]
        if len(classes) > MOST_ENDS and known and all(map(class_of, classes)):
            return place
    return -1


def read_scatter(
    path: Path, *, rows: str | None = None, units: Mapping[str, str] | None = None, classes: str | None = None
) -> dict[str, Any]:
    """Bounds of classes, hs (m) and tp (s), and counts (hs, tp), of a table in either direction.

    Parameters
    ----------
    rows : "hs" or "tp", whose classes stand in the first column; default: as the corner says.
    units : of "hs" and "tp", where the table does not say them.
    classes : "lower", "middle" or "upper", where the table has one number for each class.

    Raises FileFormatError for what is no such table, or does not say what it needs.
    """
    if rows not in (None, *AXES) or not set(units or {}) <= set(AXES):
        raise SceneError(
            f"scatter diagram: rows is {rows!r} and units {shown(units)}; give 'hs' or 'tp' of each"
        )
    lines = decoded(read_whole(path)).splitlines()
    at = header_of(lines)
    if at < 0:
        raise FileFormatError(
            f"{path}: is no scatter table: no line has classes of a height or a period, such as "
            "'Hs [m] \\ Tp [s];3-4;4-5', above lines that begin with classes of the other; write such a line"
        )
    top = _cells(lines[at])
    down, along = _axes(path, lines, at, top, rows)
    kept = [i for i, cell in enumerate(top) if i and cell.strip() and not TOTAL.match(cell)]
    numbered = [(n, _cells(line)) for n, line in enumerate(lines[at + 1 :], start=at + 2)]
    body = [(n, cells) for n, cells in numbered if any(map(str.strip, cells)) and not TOTAL.match(cells[0])]
    counts = np.array([[_count(path, n, cells, i) for i in kept] for n, cells in body], dtype=float)
    found = {}
    ends = [(n, cells[0]) for n, cells in body], [(at + 1, top[i]) for i in kept]
    for axis, (name, cells) in enumerate(zip((down, along), ends, strict=True)):
        used = counts.sum(axis=1 - axis) > 0.0
        bounds, order = _bounds(path, name, cells, used, classes)
        counts = np.take(counts, order, axis=axis)
        found[name] = bounds * _factor(path, name, lines, at, units or {})
    counts = counts if down == "hs" else counts.T
    _require_possible(path, found["hs"], found["tp"], counts)
    return {**found, "counts": counts}


def _labels(lines: Sequence[str], at: int) -> list[str]:
    """The corner, then the lines above it, nearest first; not those that name columns."""
    corner, *classes = _cells(lines[at][:LONGEST]) or [""]
    above = [line[:LONGEST] for line in reversed(lines[max(at - 3, 0) : at])]
    return [corner, *(line for line in above if _filled(_cells(line)) <= _filled(classes))]


def _filled(cells: Sequence[str]) -> int:
    return sum(1 for cell in cells if cell.strip())


def _axes(path: Path, lines: Sequence[str], at: int, top: Sequence[str], rows: str | None) -> tuple[str, str]:
    """Which axis runs down and which along the top."""
    if rows is None:
        corner, *above = _labels(lines, at)
        named = sorted((m.start(), name) for name, (one, _) in AXES.items() if (m := one.search(corner)))
        told = " ".join([corner, *above])
        if MEAN.search(told) and not AXES["tp"][0].search(told):
            raise FileFormatError(
                f"{path}, line {at + 1}: its periods are mean ones, and peak periods are needed; turn them "
                "into those by the site's spectrum (Pierson-Moskowitz: tp = 1.408 tz = 1.296 t1), called Tp"
            )
        if not named:
            raise FileFormatError(
                f"{path}, line {at + 1}: {shown(corner)} does not say which axis is which; write "
                "'Hs [m] \\ Tp [s]' there, or give rows='hs' or 'tp', whose classes stand in the first column"
            )
        rows = named[0][1]
    return ("hs", "tp") if rows == "hs" else ("tp", "hs")


def _factor(path: Path, name: str, lines: Sequence[str], at: int, units: Mapping[str, str]) -> float:
    """Of the unit behind an axis' label, or of the one that is given."""
    label, si = AXES[name]
    words = units.get(name)
    for text in _labels(lines, at) if words is None else ():
        found = label.search(text)
        unit = UNIT.match(text[found.end() :].lstrip(" \"'")) if found else None
        if unit:
            words = unit[1]
            break
    if words is None or UNITS.get(words.lower()) is None or (words.lower() in ("s", "sec")) != (si == "s"):
        told = "has no unit" if words is None else f"is in {shown(words)}, which is unknown"
        raise FileFormatError(
            f"{path}, line {at + 1}: {name} {told}; write '{name.capitalize()} [{si}]' there, or give "
            f"units={{{name!r}: {si!r}}}"
        )
    return UNITS[words.lower()]


def _count(path: Path, line: int, cells: Sequence[str], place: int) -> float:
    text = cells[place].strip().strip("\"'").removesuffix("%").strip() if place < len(cells) else ""
    if text in ("", "-", "."):
        return 0.0
    try:
        number = float(text.replace(",", "."))
    except ValueError:
        number = float("nan")
    if not 0.0 <= number <= 1e12:
        raise FileFormatError(
            f"{path}, line {line}: {shown(text)} is no count; give a number of zero or more, or nothing"
        )
    return number


def _bounds(
    path: Path, name: str, cells: Sequence[tuple[int, str]], used: Any, classes: str | None
) -> tuple[Array, list[int]]:
    """Bounds that rise, and the places of the classes; open ones without counts are left out."""
    kept: list[tuple[Class, int, int, str]] = []
    for place, (line, cell) in enumerate(cells):
        one = class_of(cell)
        if one is None:
            raise FileFormatError(
                f"{path}, line {line}: {shown(cell)} is no class of {name}, such as '0.5-1.0'"
            )
        if np.isinf(one.high):
            if used[place]:
                raise FileFormatError(
                    f"{path}, line {line}: {shown(cell)} has no end, and sea states in it; write its bounds"
                )
            continue
        kept.append((one, place, line, cell))
    kept.sort(key=lambda each: each[0].low)
    if len(kept) < 2 or any(b[0].low <= a[0].low for a, b in pairwise(kept)):
        raise FileFormatError(f"{path}: {name} has no two classes that rise; give each of them once")
    order = [place for _, place, *_ in kept]
    if all(one.single for one, *_ in kept):
        return _of_singles(path, name, [one.low for one, *_ in kept], classes), order
    last = 10.0 ** -max(one.decimals for one, *_ in kept)  # of classes such as 0.5-0.9 and 1.0-1.4
    between = last if last < 1.0 and abs(kept[1][0].low - kept[0][0].high - last) < ROUNDING else 0.0
    for (one, _, line, cell), (after, *_) in pairwise(kept):
        if one.single or after.single or abs(one.high + between - after.low) > ROUNDING:
            raise FileFormatError(
                f"{path}, line {line}: the class {shown(cell)} of {name} does not end where the next begins, "
                f"at {after.low:g}; let all classes meet"
            )
    return np.array([*(one.low for one, *_ in kept), kept[-1][0].high + between]), order


def _of_singles(path: Path, name: str, values: Sequence[float], classes: str | None) -> Array:
    """Bounds of classes by one number each."""
    if classes not in CLASSES:
        raise FileFormatError(
            f"{path}: classes of {name} are single numbers, {values[0]:g}, {values[1]:g} and so on; say what "
            f"they are by classes='lower', 'middle' or 'upper'"
            f"{'' if classes is None else f', not {shown(classes)}'}"
        )
    v = np.array(values)
    if classes == "lower":
        return np.append(v, 2.0 * v[-1] - v[-2])
    first = max(0.0, 2.0 * v[0] - v[1])
    if classes == "upper":
        return np.insert(v, 0, first)
    between = 0.5 * (v[1:] + v[:-1])
    return np.concatenate([[max(0.0, 2.0 * v[0] - between[0])], between, [2.0 * v[-1] - between[-1]]])


def _require_possible(path: Path, hs: Array, tp: Array, counts: Array) -> None:
    """Refuse seas that break in every place of their class: axes that are exchanged, or another unit."""
    wrong = (counts > 0.0) & (hs[:-1, None] > STEEPEST * tp[None, 1:] ** 2)
    if wrong.any():
        i, k = np.argwhere(wrong)[0]
        raise FileFormatError(
            f"{path}: counts seas of hs {hs[i]:g} m and more at tp {tp[k]:g} to {tp[k + 1]:g} s, which no "
            "water bears; are its axes exchanged (rows='hs' or 'tp'), or in other units?"
        )


KINDS = (
    Kind(
        name="scatter table",
        looks="`Hs [m] \\ Tp [s]; 3-4; 4-5; ...` above `0.5-1.0; 12; 30; ...`, or transposed",
        layout="docs/operability.md", reader=SCATTER, is_it=lambda lines: header_of(lines) >= 0,
    ),
)  # fmt: skip
