"""From a file of columns to numbers in SI units: which columns, their units, their clock, what is missing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import finite_of, flag_of, not_negative_of, positive_of
from seacrane.inputs.shown import listed, shown
from seacrane.sea.mending import BROKEN, POSIX, filled, outliers, step_of, unit_since_1970
from seacrane.sea.series_file import ZONES, Heading, SeriesFile, plain_words, unit_of_words
from seacrane.warnings import ClockDriftWarning, FilledGapWarning, OutlierWarning

Bools = NDArray[np.bool_]
Columns = Sequence[str] | Mapping[str, str | tuple[str, ...]]
DOUBTFUL = 2.0  # between two samples: a logger's s, or the ms of one at up to 500 Hz
TURNING = {"yaw", "heading", "hdg", "course"}
KINDS = "rad [deg], m [cm], N [kN, t], Pa [bar], m/s"
FEWEST = 8
MOST_NAMED = 5  # outliers that a warning lists
POSSIBLE = {"roll": (0.5 * np.pi, "rad"), "pitch": (0.5 * np.pi, "rad"), "heave": (100.0, "m")}
SHORTEST = 1e-9  # s between two times that differ
ROUNDING = 1e-9  # of a gap
RATE = 0.05  # by which samples may be off the nominal rate before one of both is wrong


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
) -> dict[str, Any]:
    """What `MeasuredSeries.load` makes a series of, without filter and resampling."""
    asked = _asked(columns)
    given = {plain_words(name): unit for name, unit in (units or {}).items()}
    if rate_hz is not None:
        positive_of("rate_hz", rate_hz, "Hz")
    file = SeriesFile(
        path, time=next(iter(asked.pop("time", ())), None), rate_hz=rate_hz, dates=given.get("date")
    )
    clocks = file.clocks()
    wanted = _wanted(file, asked, clocks)
    scales = {name: unit_of(file, one, given.get(name)) for name, one in wanted.items()}
    numbers, lines, start = file.columns([*clocks, *wanted.values()], len(clocks))
    if numbers.shape[0] < FEWEST:
        raise FileFormatError(
            f"{path}: holds {numbers.shape[0]} rows of numbers; at least {FEWEST} are needed"
            f"{f': {file.fix}' if file.fix else ''}"
        )
    clock = numbers[:, : len(clocks)] * [
        _seconds(file, one, given.get("time"), None if start else numbers[:, i])
        for i, one in enumerate(clocks)
    ]
    values = numbers[:, len(clocks) :] * [factor for factor, _ in scales.values()]
    for column, (one, (_, unit)) in enumerate(zip(wanted.values(), scales.values(), strict=True)):
        if unit == "rad" and TURNING & set(one.name.split()):  # where a logger jumps from 360 deg to 0
            known = ~np.isnan(values[:, column])
            values[known, column] = np.unwrap(values[known, column])
    kept = _kept(path, clock[:, 0], after, before)
    rows = Rows(
        file=file, clock=clocks[0], headings=tuple(wanted.values()), time=clock[kept, 0], lines=lines[kept],
        values=values[kept],
    )  # fmt: skip
    _require_increasing(rows)
    _warn_of_drift(rows, clocks[1:], clock[kept, 1:], rate_hz)
    longest = not_negative_of("maximum_gap", maximum_gap, "s")
    values, done = _mended(rows, longest, flag_of("drop_outliers", drop_outliers))
    _require_possible(rows, values, list(wanted))
    return {
        "time": rows.time, "columns": dict(zip(wanted, values.T, strict=True)),
        "units": {name: unit for name, (_, unit) in scales.items()},
        "headers": {name: one.text for name, one in wanted.items()},
        "done": (*((f"times from {start} on",) if start else ()), *done), "source": path.name,
    }  # fmt: skip


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


def unit_of(file: SeriesFile, heading: Heading, given: str | None) -> tuple[float, str]:
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


def _seconds(file: SeriesFile, heading: Heading, given: str | None, times: Array | None) -> float:
    """s of a clock's unit; without one it has seconds, or time stamps (``times`` is None).

    Numbers since 1970 tell it, and whole numbers far apart leave it in doubt.
    """
    named = given or heading.unit
    found = (1.0, "s") if (named or "s").lower() in ZONES else unit_of_words(named or "s")
    if found is None or found[1] != "s":
        words = f"has the unit {shown(named)}; a time is in s, ms, min or h, or a time stamp"
        raise file.refused(file.header, heading, words)
    if times is None:
        return found[0]
    since = unit_since_1970(times)
    step = float(np.nanmedian(np.abs(np.diff(times)))) if times.size > 1 else 0.0
    if since is not None and (named is None or np.isclose(POSIX[since], found[0])):
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
    return found[0]


def _kept(path: Path, time: Array, after: float | None, before: float | None) -> Bools:
    kept = np.ones(time.size, dtype=bool)
    for limit, name, sign in ((after, "after", 1.0), (before, "before", -1.0)):
        if limit is not None:
            kept &= ~(sign * time < sign * finite_of(name, limit, "s"))
    if kept.sum() < FEWEST:
        raise SceneError(
            f"after={after}, before={before}: {kept.sum()} rows of {path} are left, of times from "
            f"{np.nanmin(time):.6g} to {np.nanmax(time):.6g} s; leave at least {FEWEST}"
        )
    return kept


@dataclass(frozen=True, kw_only=True)
class Rows:
    """Columns of a file in SI units, shape (n, columns), their headings, and the line of each row."""

    file: SeriesFile
    clock: Heading
    headings: Sequence[Heading]
    time: Array
    values: Array
    lines: NDArray[np.intp]

    def refused(self, row: int, heading: Heading, words: str) -> FileFormatError:
        return self.file.refused(int(self.lines[row]), heading, words)

    def without(self, missing: Bools) -> Array:
        """The values, with the missing ones from splines. Raises where a column has hardly any left."""
        few = np.flatnonzero((~missing).sum(axis=0) < FEWEST)
        if few.size:
            at = int(few[0])
            raise self.refused(
                int(np.argmax(missing[:, at])), self.headings[at],
                f"the column has {(~missing[:, at]).sum()} values; leave it out by columns=",
            )  # fmt: skip
        columns = zip(self.values.T, missing.T, strict=True)
        return np.stack([filled(self.time, values, gaps) for values, gaps in columns], axis=1)


def _require_increasing(rows: Rows) -> None:
    time = rows.time
    missing = np.flatnonzero(np.isnan(time))
    if missing.size:
        raise rows.refused(int(missing[0]), rows.clock, "has no time; give it, or delete the line")
    steps = np.diff(time)
    wrong = np.flatnonzero(steps < SHORTEST)
    if wrong.size:
        at = int(wrong[0])
        others = f", and {wrong.size - 1} more lines go wrong so" if wrong.size > 1 else ""
        what = "repeats" if steps[at] >= 0.0 else f"is {-steps[at]:.4g} s before"
        raise rows.refused(
            at + 1, rows.clock, f"{time[at + 1]:.10g} s {what} the time of the line above it{others}; a "
            "clock that was set back, or stamps that are too coarse: correct them, or cut the record there "
            "by after= and before=",
        )  # fmt: skip


def _warn_of_drift(rows: Rows, headings: Sequence[Heading], others: Array, rate_hz: float | None) -> None:
    """Against other clocks in the file, and against the number of samples at the nominal rate."""
    time, step = rows.time, step_of(rows.time)
    clocks = {f"column {shown(one.text)}": times for one, times in zip(headings, others.T, strict=True)}
    if rate_hz is not None:
        nominal = 1.0 / positive_of("rate_hz", rate_hz, "Hz")
        if abs(step / nominal - 1.0) > RATE:
            raise SceneError(
                f"rate_hz is {1.0 / nominal:g}, and the samples of {rows.file.path} are {step:.4g} s apart; "
                "correct one of them"
            )
        steps = np.maximum(1.0, np.round(np.diff(time) / step))  # with those that are missing
        clocks[f"samples at {rate_hz:g} Hz"] = np.concatenate([[0.0], np.cumsum(steps)]) * nominal
    duration = float(time[-1] - time[0])
    for name, times in clocks.items():
        if not np.isfinite(times).all() or np.any(np.diff(times) <= 0.0):
            continue  # no clock that could tell anything
        other = times - times.mean()  # the slope of a line, less 1
        drift = float(other @ (time - time.mean() - other) / (other @ other))
        if abs(drift) * duration > step:
            warn_caller(
                f"{rows.file.path}: its clock, column {shown(rows.clock.text)}, gains {drift * 1e6:+.0f} us "
                f"in a second on {name}, {drift * duration:+.3g} s over the record; take the clock that is "
                "right by columns={'time': ...}, or correct the times",
                ClockDriftWarning,
            )


def _mended(rows: Rows, longest: float, drop: bool) -> tuple[Array, tuple[str, ...]]:
    """Values (n, columns) with gaps filled, and what was done."""
    missing = np.isnan(rows.values)
    found = _outlying(rows, rows.without(missing), missing, drop)
    missing |= found & drop
    values = rows.without(missing)
    gaps = _gaps(rows, missing, longest)
    if not gaps:
        return rows.values, ()
    row, length = max(gaps, key=lambda gap: gap[1])
    told = f"{len(gaps)} gaps filled by cubic splines, the longest {length:.4g} s"
    warn_caller(
        f"{rows.file.path}: {told} before line {rows.lines[row]}; look at them, and cut the record where a "
        "gap is longer than an eighth of a period",
        FilledGapWarning,
    )
    return values, (told,)


def _outlying(rows: Rows, values: Array, missing: Bools, drop: bool) -> Bools:
    """Which values are outliers; they are told, whether they are dropped or not."""
    found = np.zeros_like(missing)
    for column in range(values.shape[1]):
        found[outliers(rows.time, values[:, column]), column] = True
    found &= ~missing
    if found.any():
        places = np.argwhere(found).tolist()
        named = [
            f"line {rows.lines[row]}, column {shown(rows.headings[at].text)}: {rows.values[row, at]:.5g}"
            for row, at in places[:MOST_NAMED]
        ]
        more = f", and {len(places) - MOST_NAMED} more" if len(places) > MOST_NAMED else ""
        then = "drop_outliers=True drops them; maximum_gap= fills what is left"
        warn_caller(
            f"{rows.file.path}: {len(places)} outliers in SI units, {'; '.join(named)}{more}: "
            f"{'they are dropped' if drop else then}",
            OutlierWarning,
        )
    return found


def _gaps(rows: Rows, missing: Bools, longest: float) -> list[tuple[int, float]]:
    """Row behind its start and length, s, of each gap in a column, and of the clock."""
    found, time, last = [], rows.time, rows.time.size - 1
    for column, heading in enumerate(rows.headings):
        ends = np.flatnonzero(np.diff(np.concatenate([[0], missing[:, column].astype(int), [0]])))
        for first, end in ends.reshape(-1, 2).tolist():
            what = f"{end - first} values are missing, or dropped as outliers, from here on"
            start, stop = time[max(first - 1, 0)], time[min(end, last)]
            length = float(stop - start)
            if first == 0 or end > last:
                side = f"after={stop:.10g}" if first == 0 else f"before={start:.10g}"
                raise rows.refused(
                    first, heading, f"{what}, at an end of the record; leave them out by {side}"
                )
            if length > longest * (1.0 + ROUNDING):
                raise rows.refused(
                    first, heading,
                    f"{what}: a gap of {length:.4g} s; maximum_gap={length * (1.0 + 1e-3):.4g} fills it",
                )  # fmt: skip
            found.append((first, length))
    step = step_of(time)
    for at in np.flatnonzero(np.diff(time) > BROKEN * step).tolist():
        length = float(time[at + 1] - time[at])
        if length > longest * (1.0 + ROUNDING):
            raise rows.refused(
                at + 1, rows.clock, f"{length:.4g} s after the line above it, with samples of {step:.4g} s: "
                "samples are missing, or the clock jumps and the times from here on are to be corrected; "
                f"maximum_gap={length * (1.0 + 1e-3):.4g} fills it, after= and before= leave it out",
            )  # fmt: skip
        found.append((at + 1, length))
    return found


def _require_possible(rows: Rows, values: Array, names: Sequence[str]) -> None:
    """Refuse motions that no ship has, which are most often in another unit."""
    for column, name in enumerate(names):
        most, unit = POSSIBLE.get(name, (np.inf, ""))
        row = int(np.abs(values[:, column]).argmax())
        if abs(values[row, column]) > most:
            turns = f", {np.degrees(values[row, column]):.4g} deg" if unit == "rad" else ""
            raise rows.refused(
                row, rows.headings[column], f"{values[row, column]:.5g} {unit}{turns}: no ship has a {name} "
                f"beyond {most:.3g} {unit}; give its unit by units={{{name!r}: ...}}, or drop_outliers=True",
            )  # fmt: skip
