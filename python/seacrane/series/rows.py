"""The rows of a file of columns: times that increase, gaps, outliers, and values that can be."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import positive_of
from seacrane.inputs.shown import shown
from seacrane.series.clock import RATE, breaks_of, counted, drift_of, step_of
from seacrane.series.headings import Heading
from seacrane.series.mending import filled, outliers
from seacrane.series.series_file import SeriesFile
from seacrane.warnings import ClockDriftWarning, FilledGapWarning, OutlierWarning

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
FEWEST = 8
MOST_NAMED = 5  # outliers that a warning lists
POSSIBLE = {"roll": (0.5 * np.pi, "rad"), "pitch": (0.5 * np.pi, "rad"), "heave": (100.0, "m")}
SHORTEST = 1e-9  # s between two times that differ
ROUNDING = 1e-9  # of a gap


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

    def part(self, kept: Bools) -> Rows:
        return Rows(
            file=self.file, clock=self.clock, headings=self.headings, time=self.time[kept],
            values=self.values[kept], lines=self.lines[kept],
        )  # fmt: skip


def require_increasing(rows: Rows) -> None:
    time = rows.time
    missing = np.flatnonzero(np.isnan(time))
    if missing.size:
        raise rows.refused(int(missing[0]), rows.clock, "has no time; give it, or delete the line")
    steps = np.diff(time)
    wrong = np.flatnonzero(steps < SHORTEST)
    if wrong.size:
        at = int(wrong[0])
        what = "repeats" if steps[at] >= 0.0 else f"is {-steps[at]:.4g} s before"
        raise rows.refused(
            at + 1, rows.clock, f"{time[at + 1]:.10g} s {what} the time of the line above it, and so do "
            f"{wrong.size - 1} more lines; a clock that was set back, or stamps that are too coarse: correct "
            "them, or cut the record there by after= and before=",
        )  # fmt: skip


def warn_of_drift(rows: Rows, headings: Sequence[Heading], others: Array, rate_hz: float | None) -> None:
    """Against other clocks in the file, and against the number of samples at the nominal rate."""
    clocks = {f"column {shown(one.text)}": times for one, times in zip(headings, others.T, strict=True)}
    if rate_hz is not None:
        nominal = 1.0 / positive_of("rate_hz", rate_hz, "Hz")
        if abs(step_of(rows.time) / nominal - 1.0) > RATE:
            raise SceneError(
                f"rate_hz is {1.0 / nominal:g}, and the samples of {rows.file.path} are "
                f"{step_of(rows.time):.4g} s apart; correct one of them"
            )
        clocks[f"samples at {rate_hz:g} Hz"] = counted(rows.time, nominal)
    duration = float(rows.time[-1] - rows.time[0])
    for name, times in clocks.items():
        if not np.isfinite(times).all() or np.any(np.diff(times) <= 0.0):
            continue  # no clock that could tell anything
        drift = drift_of(rows.time, times)
        if abs(drift) * duration > step_of(rows.time):
            warn_caller(
                f"{rows.file.path}: its clock, column {shown(rows.clock.text)}, gains {drift * 1e6:+.0f} us "
                f"in a second on {name}, {drift * duration:+.3g} s over the record; take the clock that is "
                "right by columns={'time': ...}, or correct the times",
                ClockDriftWarning,
            )


def mended(rows: Rows, longest: float, drop: bool) -> tuple[Array, tuple[str, ...]]:
    """Values (n, columns) with gaps filled, and what was done."""
    missing = np.isnan(rows.values)
    _require_some(rows, missing)
    guess = _columns([filled(rows.time, *pair) for pair in zip(rows.values.T, missing.T, strict=True)])
    missing |= _outlying(rows, guess, missing, drop)
    _require_some(rows, missing)
    gaps = [*_missing_values(rows, missing, longest), *_missing_rows(rows, guess, longest)]
    if not gaps:
        return rows.values, ()
    values = _columns([filled(rows.time, *pair) for pair in zip(rows.values.T, missing.T, strict=True)])
    row, length = max(gaps, key=lambda gap: gap[1])
    told = f"{len(gaps)} gaps filled by cubic splines, the longest {length:.4g} s"
    warn_caller(
        f"{rows.file.path}: {told} before line {rows.lines[row]}; look at them, and cut the record where a "
        "gap is longer than an eighth of a period",
        FilledGapWarning,
    )
    return values, (told,)


def _columns(values: Sequence[Array]) -> Array:
    return np.stack(values, axis=1)


def _require_some(rows: Rows, missing: Bools) -> None:
    few = np.flatnonzero((~missing).sum(axis=0) < FEWEST)
    if few.size:
        at = int(few[0])
        raise rows.refused(
            int(np.argmax(missing[:, at])), rows.headings[at],
            f"the column has {(~missing[:, at]).sum()} values; leave it out by columns=",
        )  # fmt: skip


def _outlying(rows: Rows, values: Array, missing: Bools, drop: bool) -> Bools:
    """Which values are outliers that are dropped; they are told in any case."""
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
        then = (
            "they are dropped" if drop else "drop_outliers=True drops them; maximum_gap= fills what is left"
        )
        warn_caller(
            f"{rows.file.path}: {len(places)} outliers in SI units, {'; '.join(named)}{more}: {then}",
            OutlierWarning,
        )
    return found if drop else np.zeros_like(found)


def _missing_values(rows: Rows, missing: Bools, longest: float) -> list[tuple[int, float]]:
    """Row and length, s, of each gap in a column."""
    found = []
    for column, heading in enumerate(rows.headings):
        ends = np.flatnonzero(np.diff(np.concatenate([[0], missing[:, column].astype(int), [0]])))
        for first, end in ends.reshape(-1, 2).tolist():
            outer = first == 0 or end == rows.time.size
            length = float(rows.time[min(end, rows.time.size - 1)] - rows.time[max(first - 1, 0)])
            if outer or length > longest * (1.0 + ROUNDING):
                raise rows.refused(first, heading, _way_out(rows, first, end, length, outer))
            found.append((first, length))
    return found


def _way_out(rows: Rows, first: int, end: int, length: float, outer: bool) -> str:
    """What to do about missing values in the rows `first` to `end`."""
    what = f"{end - first} values are missing, or dropped as outliers, from here on"
    if not outer:
        return f"{what}: a gap of {length:.4g} s; maximum_gap={length * (1.0 + 1e-3):.4g} fills it"
    side = f"after={rows.time[min(end, rows.time.size - 1)]:.10g}" if first == 0 else (
        f"before={rows.time[first - 1]:.10g}"
    )  # fmt: skip
    return f"{what}, at an end of the record; leave them out by {side}"


def _missing_rows(rows: Rows, values: Array, longest: float) -> list[tuple[int, float]]:
    """Row after it and length, s, of each gap of the clock."""
    found = []
    for gap in breaks_of(rows.time, values):
        what = (
            "the clock jumps: the values go on as if one sample had passed; correct the times from here on"
            if gap.jump
            else "samples are missing"
        )
        if gap.length > longest * (1.0 + ROUNDING):
            raise rows.refused(
                gap.at + 1, rows.clock, f"{gap.length:.4g} s after the line above it, with samples of "
                f"{step_of(rows.time):.4g} s: {what}; maximum_gap={gap.length * (1.0 + 1e-3):.4g} fills it, "
                "after= and before= leave it out",
            )  # fmt: skip
        found.append((gap.at + 1, gap.length))
    return found


def require_possible(rows: Rows, values: Array, names: Sequence[str]) -> None:
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
