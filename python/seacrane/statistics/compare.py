"""compare(): a channel of a run beside what was measured."""

from __future__ import annotations

import numpy as np

from seacrane.description.channels import unit_of
from seacrane.description.pick import Pick, pick_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of
from seacrane.inputs.described import described
from seacrane.inputs.shown import listed, shown
from seacrane.result import Result
from seacrane.series.measured_series import MeasuredSeries
from seacrane.statistics.comparison import Comparison
from seacrane.statistics.shift import FEWEST, correlation, found_shift

USUAL = 0.25  # of the shorter of both: the longest shift that is looked at


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
        Of the series; it needs no name where there is only one.
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
    name = _column_of(series, column)
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


def _column_of(series: MeasuredSeries, column: str | None) -> str:
    if column is None and len(series.columns) > 1:
        raise SceneError(
            f"compare: the series has several columns; give column=, {listed(list(series.columns))}"
        )
    name = next(iter(series.columns)) if column is None else column
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
