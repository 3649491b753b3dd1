"""From a file of columns to numbers in SI units: which columns, their units, their clock, what is missing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import finite_of, flag_of, not_negative_of
from seacrane.inputs.shown import listed, shown
from seacrane.series.clock_unit import POSIX, unit_since_1970
from seacrane.series.headings import Heading, plain_words, unit_of_words
from seacrane.series.rows import FEWEST, Rows, mended, require_increasing, require_possible, warn_of_drift
from seacrane.series.series_file import SeriesFile

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Columns = Sequence[str] | Mapping[str, str | tuple[str, ...]]
DOUBTFUL = 2.0  # between two samples: a logger's s, or the ms of one at up to 500 Hz
TURNING = {"yaw", "heading", "hdg", "course"}
KINDS = "rad [deg], m [cm], N [kN, t], Pa [bar], m/s"


@dataclass(frozen=True, kw_only=True)
class Read:
    """What a file held: times (n,), columns by name, their SI units, and what was done in words."""

    time: Array
    columns: Mapping[str, Array]
    units: Mapping[str, str]
    headers: Mapping[str, str]
    done: tuple[str, ...]


def read_series(
    path: Path,
    *,
    columns: Columns | None,
    units: Mapping[str, str] | None,
    after: float | None,
    before: float | None,
    maximum_gap: float,
    drop_outliers: bool,
    rate_hz: float | None,
) -> Read:
    """As `MeasuredSeries.load`, without filter and resampling."""
    asked = _asked(columns)
    file = SeriesFile(path, time=next(iter(asked.pop("time", ())), None))
    clocks = file.clocks()
    wanted = _wanted(file, asked, clocks)
    given = {plain_words(name): unit for name, unit in (units or {}).items()}
    scales = {name: _unit(file, one, given.get(name)) for name, one in wanted.items()}
    times = [_time_unit(file, one, given.get("time")) for one in clocks]
    numbers, lines, start = file.columns([*clocks, *wanted.values()], len(clocks))
    if numbers.shape[0] < FEWEST:
        raise FileFormatError(
            f"{path}: holds {numbers.shape[0]} rows of numbers; at least {FEWEST} are needed"
        )
    clock = numbers[:, : len(clocks)] * [
        factor if start else _counted(file, one, given.get("time"), factor, numbers[:, i])
        for i, (one, factor) in enumerate(zip(clocks, times, strict=True))
    ]
    values = numbers[:, len(clocks) :] * [factor for factor, _ in scales.values()]
    rows = Rows(
        file=file, clock=clocks[0], headings=tuple(wanted.values()), time=clock[:, 0], lines=lines,
        values=_unwrapped([*wanted.values()], [unit for _, unit in scales.values()], values),
    )  # fmt: skip
    kept = _kept(rows, after, before)
    rows, others = rows.part(kept), clock[kept, 1:]
    require_increasing(rows)
    warn_of_drift(rows, clocks[1:], others, rate_hz)
    longest = not_negative_of("maximum_gap", maximum_gap, "s")
    values, done = mended(rows, longest, flag_of("drop_outliers", drop_outliers))
    require_possible(rows, values, list(wanted))
    return Read(
        time=rows.time, columns=dict(zip(wanted, values.T, strict=True)),
        units={name: unit for name, (_, unit) in scales.items()},
        headers={name: one.text for name, one in wanted.items()},
        done=(*((f"times from {start} on",) if start else ()), *done),
    )  # fmt: skip


def _asked(columns: Columns | None) -> dict[str, tuple[str, ...]]:
    """Names in the file by the names here; empty: all."""
    if columns is None:
        return {}
    if isinstance(columns, str):
        raise SceneError(f"columns is {shown(columns)}; give a list of names, or a mapping")
    pairs = columns.items() if isinstance(columns, Mapping) else ((one, one) for one in columns)
    found = {}
    for ours, theirs in pairs:
        names = theirs if isinstance(theirs, tuple) else (theirs,)
        if not all(isinstance(one, str) for one in (ours, *names)):
            raise SceneError(f"columns holds {shown(ours)}: {shown(theirs)}; give names")
        found[plain_words(ours)] = names
    return found


def _wanted(
    file: SeriesFile, asked: Mapping[str, tuple[str, ...]], clocks: Sequence[Heading]
) -> dict[str, Heading]:
    if not asked:
        rest = [one for one in file.headings if one not in clocks]
        doubled = next((one for i, one in enumerate(rest) if one.name in [o.name for o in rest[:i]]), None)
        if doubled is not None or not rest:
            what = (
                f"two columns are called {shown(doubled.name)}" if doubled else "there is no column but time"
            )
            raise FileFormatError(f"{file.path}: {what}; give columns= with the names as they are written")
        return {one.name: one for one in rest}
    found = {
        name: next((one for one in map(file.find, theirs) if one is not None), None)
        for name, theirs in asked.items()
    }
    missing = [" or ".join(map(shown, asked[name])) for name, one in found.items() if one is None]
    if missing:
        raise FileFormatError(
            f"{file.path}, line {file.header}: names no column, or several, for {listed(missing)}; there are "
            f"{listed([one.text for one in file.headings])}: say which is meant by columns={{here: there}}"
        )
    return {name: one for name, one in found.items() if one is not None}


def _unwrapped(headings: Sequence[Heading], units: Sequence[str], values: Array) -> Array:
    """Angles about the vertical go on beyond a turn, where a logger jumps from 360 deg to 0."""
    for column, (one, unit) in enumerate(zip(headings, units, strict=True)):
        if unit == "rad" and TURNING & set(one.name.split()):
            known = ~np.isnan(values[:, column])
            values[known, column] = np.unwrap(values[known, column])
    return values


def _unit(file: SeriesFile, heading: Heading, given: str | None) -> tuple[float, str]:
    """Factor to SI and the SI unit."""
    words = heading.unit if given is None else given
    found = None if words is None else unit_of_words(words)
    if found is None:
        has = "has no unit in its name" if words is None else f"has the unit {shown(words)}, which is unknown"
        raise file.refused(
            file.header, heading, f"{has}; write it as '{heading.name[:40]} [deg]' or give units="
            f"{{{shown(heading.name)}: 'deg'}}, of {KINDS}, ..., or leave the column out by columns=",
        )  # fmt: skip
    return found


def _time_unit(file: SeriesFile, heading: Heading, given: str | None) -> float:
    """s of a unit of time; a clock without a unit has seconds, or time stamps."""
    words = given or heading.unit or "s"
    found = (1.0, "s") if words.lower() in ("utc", "iso", "gmt") else unit_of_words(words)
    if found is None or found[1] != "s":
        raise file.refused(
            file.header,
            heading,
            f"has the unit {shown(words)}; a time is in s, ms, min or h, or a time stamp",
        )
    return found[0]


def _counted(file: SeriesFile, heading: Heading, given: str | None, factor: float, times: Array) -> float:
    """s of a clock's unit, which numbers since 1970 tell, and whole numbers far apart leave in doubt."""
    named = given or heading.unit
    since = unit_since_1970(times)
    step = float(np.nanmedian(np.abs(np.diff(times)))) if times.size > 1 else 0.0
    if since is not None and (named is None or np.isclose(POSIX[since], factor)):
        return POSIX[since]
    fix = "name its unit by units={'time': 'ms'} or 's'"
    if since is not None:
        raise file.refused(
            file.header, heading, f"has the unit {shown(named)}, and its numbers, from {times[0]:.10g} on, "
            f"are {since} since 1970; {fix}",
        )  # fmt: skip
    if named is None and step >= DOUBTFUL and np.all(times[np.isfinite(times)] % 1.0 == 0.0):
        raise file.refused(
            file.header, heading, f"has no unit, and its whole numbers are {step:g} apart: s, or ms; {fix}",
        )  # fmt: skip
    return factor


def _kept(rows: Rows, after: float | None, before: float | None) -> Bools:
    kept = np.ones(rows.time.size, dtype=bool)
    for limit, name, sign in ((after, "after", 1.0), (before, "before", -1.0)):
        if limit is not None:
            kept &= ~(sign * rows.time < sign * finite_of(name, limit, "s"))
    if kept.sum() < FEWEST:
        raise SceneError(
            f"after={after}, before={before}: {kept.sum()} rows of {rows.file.path} are left, of times from "
            f"{np.nanmin(rows.time):.6g} to {np.nanmax(rows.time):.6g} s; leave at least {FEWEST}"
        )
    return kept
