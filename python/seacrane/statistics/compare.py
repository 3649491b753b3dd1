"""compare(): a channel of a run beside what was measured, where their correlation is largest."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import unit_of
from seacrane.description.pick import Pick, pick_of
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import not_negative_of
from seacrane.inputs.described import described
from seacrane.inputs.shown import listed, shown
from seacrane.plotting.panel import Line, Panel, Sheet, draw
from seacrane.plotting.table import Answer, Column, Table, read_as
from seacrane.result import Result
from seacrane.sea.measured_series import MeasuredSeries
from seacrane.warnings import UncertainShiftWarning

if TYPE_CHECKING:
    from matplotlib.figure import Figure

USUAL = 0.25  # of the shorter of both: the longest shift that is looked at
LEAST_OVERLAP = 0.5  # of the shorter of both
FEWEST = 8  # samples that lie side by side
LEAST_CORRELATION = 0.5
AS_GOOD = 1.1, 1e-4  # times, and plus, the variance that is left by the best shift
MOST = 4_000_000  # samples of a grid
FINENESS = 1e-4  # of a step
NAMES = ("mean (bias)", "standard deviation", "largest", "smallest", "RMS of the difference",
         "the same without bias")  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Comparison(Answer):
    """A run and a record at the same times. Made by `compare`; prints as a table, in kN and deg.

    Attributes
    ----------
    channel, column : str
        Of the run, and of the record.
    unit : str
        SI, of all values.
    source : str
        Where the record comes from and what was done to it.
    shift : float
        s by which the record is later than the run; it was moved back by that.
    correlation : float
        Of both, there.
    time : ndarray, shape (n,)
        Of the run, s; these are the record's samples.
    run, record : ndarray, shape (n,)
    """

    channel: str
    column: str
    unit: str
    source: str
    shift: float
    correlation: float
    time: Array
    run: Array
    record: Array

    def __post_init__(self) -> None:
        for values in (self.time, self.run, self.record):
            values.setflags(write=False)

    @property
    def difference(self) -> Array:
        """Run minus record, shape (n,)."""
        return np.asarray(self.run - self.record)

    @property
    def bias(self) -> float:
        """Mean of run minus record."""
        return float(self.difference.mean())

    @property
    def rms(self) -> float:
        """Root mean square of the difference, with the bias in it."""
        return float(np.sqrt(np.mean(self.difference**2)))

    @property
    def scatter(self) -> float:
        """Standard deviation of the difference: what is left of `rms` without the bias."""
        return float(self.difference.std())

    @property
    def gain(self) -> float:
        """Standard deviation of the run over that of the record."""
        return float(self.run.std() / self.record.std())

    def plot(self) -> Figure:
        """Both curves over time, and their difference."""
        factor, unit = read_as(self.unit)
        both = (
            Line(label="run", values=factor * self.run),
            Line(label="record, moved", values=factor * self.record, colour=1),
        )
        left = (Line(label="", values=factor * self.difference, colour=6),)
        panels = (
            Panel(quantity=self.channel, unit=unit, lines=both),
            Panel(quantity="run minus record", unit=unit, lines=left),
        )
        sheet = Sheet(title=self._caption(), caption=self.source, panels=panels, abscissa=self.time)
        return draw(sheet, note=self.source)

    def _data(self) -> Table:
        names = ("run", "record", "difference")
        return Table(
            axes=[Column(name="time", values=self.time, unit="s")],
            columns=[Column(name=name, values=getattr(self, name), unit=self.unit) for name in names],
            attributes={"shift": self.shift, "source": self.source},
        )

    __repr__ = Answer.__str__

    def _shown(self) -> Table:
        both = (self.run, self.record)
        run, record = (np.array([one.mean(), one.std(), one.max(), one.min()]) for one in both)
        apart = [*(run - record), self.rms, self.scatter]
        factor, unit = read_as(self.unit)
        extent = float(np.ptp(self.record))
        signs = ["+", "+", "+", "+", "", ""]

        def signed(values: Sequence[float], form: str) -> list[str]:
            return [f"{value:{sign}{form}}" for value, sign in zip(values, signs, strict=True)]

        share = signed([100.0 * one / extent for one in apart], ".2f") if extent > 0.0 else [""] * 6
        return Table(
            axes=[Column(values=NAMES)],
            columns=[
                Column(head="run", values=[*run, None, None], unit=self.unit, form=".5g"),
                Column(head="record", values=[*record, None, None], unit=self.unit, form=".5g"),
                Column(head="run - record", values=apart,
                       read=(unit, signed([factor * one for one in apart], ".4g"))),
                Column(head="% of the record's range", values=apart, read=("", share)),
            ],
            title=self._caption(), remarks=[self.source],
        )  # fmt: skip

    def _caption(self) -> str:
        later = "later" if self.shift >= 0.0 else "earlier"
        return (
            f"{self.channel} against {self.column}: {self.time.size} samples, the record "
            f"{abs(self.shift):.4g} s {later} than the run, correlation {self.correlation:.4f}"
        )


def compare(
    result: Result,
    series: MeasuredSeries,
    *,
    channel: str | Pick | None = None,
    column: str | None = None,
    maximum_shift: float | None = None,
) -> Comparison:
    """Compare a channel of a run with a measured series.

    The record is moved in time to where its correlation with the run is largest, and compared there at its
    own samples, with the cubic spline through the outputs of the run. Differences are run minus record.

    Parameters
    ----------
    result : Result
    series : MeasuredSeries
    channel : str or Pick, optional
        Which curve, such as "hook_load[main, after=60]" or "roll" (`docs/channels.md`). Default: the name of
        the column, "hook load" as "hook_load".
    column : str, optional
        Of the series; it needs no name where there is only one, or one has the name of the channel.
    maximum_shift : float, optional
        s by which the record may be earlier or later than the run; default a quarter of the shorter of both;
        0: both have the same clock.

    Returns
    -------
    Comparison

    Raises
    ------
    SceneError
        For a channel or column that is not there, other units, or where both do not overlap.

    Warns
    -----
    UncertainShiftWarning
    """
    if not isinstance(result, Result) or not isinstance(series, MeasuredSeries):
        given = result if not isinstance(result, Result) else series
        raise SceneError(f"compare: {described(given)} is given; give a Result and a MeasuredSeries")
    name = _column_of(series, column, channel)
    pick = pick_of("compare", name.replace(" ", "_") if channel is None else channel, held=result.channels)
    unit = _unit_of(pick, name, series)
    part = result.part(after=pick.after, stage=pick.stage)
    time, run = result.time[part], result.curve(pick.channel, **pick.names)[part]
    if time.size < FEWEST or not np.isfinite(run).all():
        raise SceneError(f"compare: {pick} has {time.size} outputs, or a gap; give another part of the run")
    shorter = float(min(np.ptp(time), np.ptp(series.time)))
    most = USUAL * shorter if maximum_shift is None else not_negative_of("maximum_shift", maximum_shift, "s")
    shift = found_shift(time, run, series.time, series[name], most) if most > 0.0 else 0.0
    return _beside(pick, name, unit, shift, (time, run), series)


def _beside(
    pick: Pick, name: str, unit: str, shift: float, run: tuple[np.ndarray, np.ndarray], series: MeasuredSeries
) -> Comparison:
    from scipy.interpolate import CubicSpline

    times = series.time - shift
    inside = (times >= run[0][0]) & (times <= run[0][-1])
    if inside.sum() < FEWEST:
        raise SceneError(
            f"compare: the run is from {run[0][0]:.6g} to {run[0][-1]:.6g} s, and the record from "
            f"{times[0]:.6g} to {times[-1]:.6g} s: they have {inside.sum()} samples in common"
        )
    values, record = np.asarray(CubicSpline(*run)(times[inside])), series[name][inside]
    return Comparison(
        channel=str(pick), column=name, unit=unit, source=series.told, shift=shift,
        correlation=correlation(values, record), time=times[inside], run=values, record=record,
    )  # fmt: skip


def _column_of(series: MeasuredSeries, column: str | None, channel: str | Pick | None) -> str:
    alike = str(channel).replace("_", " ")
    if column is None and len(series.columns) > 1 and alike not in series.columns:
        raise SceneError(
            f"compare: the series has several columns; give column=, {listed(list(series.columns))}"
        )
    name = alike if alike in series.columns else next(iter(series.columns))
    name = name if column is None else column
    series[name]
    return name


def _unit_of(pick: Pick, name: str, series: MeasuredSeries) -> str:
    unit = unit_of(pick.channel, pick.names.values())
    if " or " not in unit and unit not in ("SI", series.units[name]):
        raise SceneError(
            f"compare: {pick} is in {unit}, and column {shown(name)} in {series.units[name]}; give channel= "
            "and column= of one unit"
        )
    return series.units[name]


def correlation(first: Array, second: Array) -> float:
    """Pearson's; 0 where one of both does not vary."""
    a, b = first - first.mean(), second - second.mean()
    size = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / size if size > 0.0 else 0.0


def found_shift(time: Array, run: Array, times: Array, record: Array, most: float) -> float:
    """s by which a record (times, record) is later than a run (time, run), `most` at most.

    Pearson's correlation over what overlaps, at every step of a grid, then between the steps by the cubic
    spline through the run. SceneError where they do not overlap by half of the shorter, or one does not vary.
    """
    step = min(float(np.median(np.diff(time))), float(np.median(np.diff(times))))
    longest = float(max(np.ptp(time), np.ptp(times)))
    if longest / step > MOST:
        raise SceneError(f"compare: {longest:.4g} s in steps of {step:.4g} s; resample the record")
    if min(run.std(), record.std()) == 0.0:
        raise SceneError("compare: one of both does not vary, which tells no shift; give maximum_shift=0")
    shifts, found = _correlations(*_grid(time, run, step), *_grid(times, record, step), step=step, most=most)
    best = int(found.argmax())
    _warn_of_doubt(shifts, found, best)
    return _between(time, run, times, record, float(shifts[best]), step)


def _grid(time: Array, values: Array, step: float) -> tuple[float, Array]:
    from scipy.interpolate import CubicSpline

    even = time[0] + step * np.arange(int(np.ptp(time) / step * (1.0 + 1e-12)) + 1)
    return float(time[0]), np.asarray(CubicSpline(time, values - values.mean())(np.minimum(even, time[-1])))


def _correlations(
    start: float, run: Array, begin: float, record: Array, *, step: float, most: float
) -> tuple[Array, Array]:
    """Shifts, s, and the correlation at each."""
    from scipy.signal import correlate

    def sums(first: Array, second: Array) -> Array:
        return np.asarray(correlate(first, second, mode="full", method="fft"))

    ones, others = np.ones_like(run), np.ones_like(record)
    shifts = begin - start + step * np.arange(1 - run.size, record.size)
    count = np.maximum(np.round(sums(others, ones)), 1.0)
    mean_record, mean_run = sums(record, ones) / count, sums(others, run) / count
    left = sums(record**2, ones) / count - mean_record**2, sums(others, run**2) / count - mean_run**2
    size = np.sqrt(np.maximum(left[0], 0.0) * np.maximum(left[1], 0.0))
    usual = 1e-9 * record.std() * run.std()
    found = (sums(record, run) / count - mean_record * mean_run) / np.maximum(size, usual)
    shorter = min(run.size, record.size)
    kept = (np.abs(shifts) <= most + 0.5 * step) & (count >= max(FEWEST, LEAST_OVERLAP * shorter))
    if not kept.any():
        raise SceneError(
            f"compare: the run begins at {start:.6g} s and the record at {begin:.6g} s, and within shifts of "
            f"{most:.4g} s they do not overlap by half of the shorter; give a larger maximum_shift, or a "
            "record whose times begin elsewhere: dataclasses.replace(record, time=record.time - ...)"
        )
    return shifts[kept], found[kept]


def _warn_of_doubt(shifts: Array, found: Array, best: int) -> None:
    top = _vertex(found, best)
    inner = np.flatnonzero((found[1:-1] >= found[:-2]) & (found[1:-1] > found[2:])) + 1
    left = AS_GOOD[0] * (1.0 - top**2) + AS_GOOD[1]
    good = [at for at in inner.tolist() if at != best and 1.0 - max(0.0, _vertex(found, at)) ** 2 <= left]
    if top < LEAST_CORRELATION:
        words = f"the correlation is {top:.3f} at best: these may not be the same curves, or of other sign"
    elif best in (0, found.size - 1) and found.size > 1:
        words = f"the correlation still grows at {shifts[best]:+.4g} s, the longest shift that was looked at"
    elif good:
        other = min(good, key=lambda at: abs(at - best))
        words = (
            f"{shifts[other]:+.4g} s is as good: correlation {_vertex(found, other):.4f} against {top:.4f}"
        )
    else:
        return
    warn_caller(
        f"compare: a shift of {shifts[best]:+.4g} s is not sure: {words}. Give maximum_shift, 0 where both "
        "have the same clock",
        UncertainShiftWarning,
    )


def _vertex(found: Array, at: int) -> float:
    """Top of the parabola through a value and its two neighbours, where it has two."""
    if not 0 < at < found.size - 1:
        return float(found[at])
    before, top, after = found[at - 1 : at + 2].tolist()
    bend = 2.0 * top - before - after
    return float(top + (after - before) ** 2 / (8.0 * bend)) if bend > 0.0 else float(top)


def _between(time: Array, run: Array, times: Array, record: Array, near: float, step: float) -> float:
    """The shift within a step of one of the grid."""
    from scipy.interpolate import CubicSpline
    from scipy.optimize import minimize_scalar

    inside = (times - near - step >= time[0]) & (times - near + step <= time[-1])
    if inside.sum() < FEWEST:
        return near
    curve, kept, values = CubicSpline(time, run), times[inside], record[inside]
    found = minimize_scalar(
        lambda shift: -correlation(curve(kept - shift), values), bounds=(near - step, near + step),
        method="bounded", options={"xatol": FINENESS * step},
    )  # fmt: skip
    return float(found.x)
