"""Files of NOAA's National Data Buoy Center: standard meteorological data, and spectral wave densities.

Layouts: https://www.ndbc.noaa.gov/faq/measdes.shtml and https://www.ndbc.noaa.gov/faq/mods.shtml. Times are
UTC. What is missing is "MM" in files of today, and nines alone in those of past years.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from math import sqrt

import numpy as np

from seacrane.sea.records.kind import SEA_STATES, Columns, Kind, has, place_of

DATE = ("MM", "DD", "hh")
WAVES = {"WVHT": "hs [m]", "DPD": "tp [s]", "MWD": "direction [deg]"}
MISSING = 999.0  # m2/Hz
NINES = re.compile(r"MM|9{2,}(\.0*)?")
HEAD = r"^\s*#?\s*(YY|YYYY)\s+MM\s+DD\s+hh\s"
MET, SUMMARY = re.compile(HEAD + r".*\bWVHT\b.*\bDPD\b"), re.compile(HEAD + r".*\bSwH\b")
PAST, TODAY = re.compile(HEAD + r"+(mm\s+)?0?\.\d+\s"), re.compile(HEAD + r".*\bspec_1\b")
NO_PERIOD = (
    "a summary has no dominant period; give the station's standard meteorological data (.txt), or its "
    "spectral densities (.data_spec, or swden of past years)"
)


def _rows(lines: Sequence[str], at: int) -> list[tuple[str, list[str]]]:
    """Of each line its time and all its cells; no cells where it holds no data."""
    names = lines[at].replace("#", " ").split()
    minutes = names[4:5] == ["mm"]
    found = []
    for place, line in enumerate(lines):
        cells = line.split() if place > at and not line.lstrip().startswith("#") else []
        time = ""
        if len(cells) > len(DATE) + 1:
            year, month, day, hour = cells[:4]
            century = "" if len(year) > 2 else "19" if year >= "70" else "20"
            time = f"{century}{year}-{month}-{day} {hour}:{cells[4] if minutes else '00'}"
        found.append((time, cells))
    return found


def meteorological(lines: Sequence[str], _: float | None) -> Columns:
    """Height, period and direction of the rows that have waves: wind is reported more often."""
    at = place_of(lines, MET)
    names = lines[at].replace("#", " ").split()
    held = [one for one in WAVES if one in names]
    places = [names.index(one) for one in held]
    rows = []
    for time, cells in _rows(lines, at):
        if cells and len(cells) != len(names):
            rows.append(f"{time};{' '.join(cells)}")  # as it is, to be refused by its line
            continue
        values = ["" if NINES.fullmatch(cells[i]) else cells[i] for i in places] if cells else []
        rows.append(";".join([time, *values]) if any(values[:2]) else "")
    header = ";".join(["time [UTC]", *(WAVES[one] for one in held)])
    return Columns(header, rows, at + 1, "no row has waves: WVHT and DPD are missing in all")


def spectral(lines: Sequence[str], _: float | None) -> Columns:
    """Height 4 sqrt(m0) and peak period of each spectrum, m2/Hz; m0 by trapezes."""
    at = place_of(lines, PAST, TODAY)
    names = lines[at].replace("#", " ").split()
    first = 5 if names[4] == "mm" else 4
    rows = []
    for time, cells in _rows(lines, at):
        frequencies, densities = names[first:], cells[first:]
        if "spec_1" in names:  # the frequency between wind sea and swell, then pairs: density (frequency)
            frequencies, densities = [one.strip("()") for one in cells[first + 2 :: 2]], cells[first + 1 :: 2]
        missing = bool(densities) and all(map(NINES.fullmatch, densities))
        values = ";" if missing else _height_and_period(frequencies, densities)
        rows.append(f"{time};{values}" if cells else "")
    return Columns("time [UTC];hs [m];tp [s]", rows, at + 1, "no row has a spectrum")


def _height_and_period(frequencies: Sequence[str], densities: Sequence[str]) -> str:
    with suppress(ValueError):
        f, density = np.array(frequencies, dtype=float), np.array(densities, dtype=float)
        known = np.all((density >= 0.0) & (density < MISSING))
        if f.size == density.size > 1 and f[0] > 0.0 and np.all(np.diff(f) > 0.0) and known:
            m0 = float(np.sum(0.5 * (density[1:] + density[:-1]) * np.diff(f)))
            return f"{4.0 * sqrt(m0)!r};{1.0 / f[density.argmax()] if m0 > 0.0 else ''}"
    return f"no spectrum: {len(densities)} densities of {len(frequencies)} frequencies;"


def summary(lines: Sequence[str], _: float | None) -> Columns:
    """Nothing: it has no peak period."""
    return Columns("time [UTC];hs [m];tp [s]", [], place_of(lines, SUMMARY) + 1, NO_PERIOD)


LAYOUT = "https://www.ndbc.noaa.gov/faq/measdes.shtml"
KINDS = (
    Kind(
        name="NDBC standard meteorological data", looks="`#YY MM DD hh mm WDIR ... WVHT DPD APD MWD ...`",
        layout=LAYOUT, reader=SEA_STATES, is_it=has(MET), columns=meteorological,
    ),
    Kind(
        name="NDBC spectral wave density",
        looks="`#YY MM DD hh mm .0200 .0325 ...`, or `... spec_1 (freq_1) ...`",
        layout=LAYOUT, reader=SEA_STATES, is_it=has(PAST, TODAY), columns=spectral,
    ),
    Kind(
        name="NDBC spectral wave summary",
        looks="`#YY MM DD hh mm WVHT SwH SwP ...`: refused, it has no peak period",
        layout=LAYOUT, reader=SEA_STATES, is_it=has(SUMMARY), columns=summary,
    ),
)  # fmt: skip
