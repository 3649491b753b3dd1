"""weather_windows(): when a lift of some hours may start, and how long one waits for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.described import described
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.alpha import AlphaFactor, alpha_of
from seacrane.operability.hindcast import Flags, WaveHindcast
from seacrane.operability.phase import Span
from seacrane.operability.phase_table import PhaseSheet
from seacrane.plotting.panel import COLOURS, new_figure
from seacrane.plotting.table import Answer, Column, Table

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
HEADS = {
    "workable_percent": ("workable", "%"),
    "may_start_percent": ("may start", "%"),
    "waiting_mean": ("wait mean", "h"),
    "waiting_p50": ("P50", "h"),
    "waiting_p90": ("P90", "h"),
}
LONGEST = 8760.0  # h, of an operation
ROUNDING = 1e-9  # of a step


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class WeatherWindows(Answer):
    """When a lift may start and how long one waits. Made by `weather_windows`; prints as a table.

    Attributes
    ----------
    hours : float
        Of the operation, h: the window that it needs.
    dataset : xarray.Dataset
        Over `time`: `hs_limit` (m, alpha included), `workable` (Hs is at most the limit), `may_start` (it is
        for the hours to come) and `waiting` (h until it may start; NaN where the series ends before). Over
        `month` (1 to 12) the same as shares in % and waiting times: `workable_percent`, `may_start_percent`,
        `waiting_mean`, `waiting_p50`, `waiting_p90`. Over `window`: `start` and `length` (h) of every stretch
        of workable time of at least `hours`. Of phases in series: `hs_limit` and `workable` are those of the
        least phase, and a window ends with the first point of safe return.
    workable_percent, may_start_percent : float
        Of all the time.
    waiting_mean, waiting_p50, waiting_p90 : float
        From a time taken at random, h.
    unknown_percent, outside_percent, censored_percent : float
        Of all the time: sea states that are not known, or beyond the table of allowable Hs, both counted as
        not workable; and times from which no window comes before the series ends, left out of waiting times.
    """

    hours: float
    dataset: xarray.Dataset
    workable_percent: float
    may_start_percent: float
    waiting_mean: float
    waiting_p50: float
    waiting_p90: float
    unknown_percent: float
    outside_percent: float
    censored_percent: float
    alpha_factor: str
    source: str

    def __repr__(self) -> str:
        return f"<WeatherWindows of {self.hours:g} h: {self.dataset.sizes['window']}>"

    def _shown(self) -> Table:
        count = self.dataset.sizes["window"]
        title = f"Windows of {self.hours:g} h in {self.source}: {count}; {self.alpha_factor}"
        words = (
            f"{self.unknown_percent:.1f} % not known and {self.outside_percent:.1f} % beyond the table count "
            f"as not workable; {self.censored_percent:.1f} % wait past the end and are left out."
        )
        known = np.isfinite(self.dataset["workable_percent"].to_numpy())
        columns = [
            Column(name=name, values=[*self.dataset[name].to_numpy()[known], getattr(self, name)], unit=unit,
                   head=head, form=".1f")
            for name, (head, unit) in HEADS.items()
        ]  # fmt: skip
        months = Column(name="month", head="", values=[*np.array(MONTHS)[known].tolist(), "all"])
        return Table(axes=[months], columns=columns, title=title, remarks=[words])


@named
def weather_windows(
    hindcast: WaveHindcast,
    allowable: AllowableHs | PhaseSheet | float,
    *,
    hours: float | None = None,
    case: str | None = None,
    heading_deg: float | None = None,
    alpha: AlphaFactor | float | None = None,
) -> WeatherWindows:
    """Find weather windows of a hindcast, and the time that one waits for them.

    Each sea state stands for the step that begins at its time. An operation may start at a time if that step
    and all others until its end are workable; a started one is not interrupted.

    With a sheet phases are in series: each step is held to the phases that are then under way, contingency
    included, and the operation may start if it then comes to the first point of safe return. There it waits
    for the next phases; `waiting` is that of all of them together.

    Parameters
    ----------
    allowable : AllowableHs, PhaseSheet or float
        A table, a sheet, or one Hs (m) for all seas.
    hours : float, optional
        Of the operation, contingency included, h; default: those of the table. A sheet tells its own.
    case : str, optional
        Load case of a sheet that has several.
    heading_deg : float, optional
        Compass heading of the vessel's bow, with a table and directions. Default: the worst direction of the
        table counts.
    alpha : AlphaFactor, optional
        Default: that of the table, or 1.

    Raises
    ------
    SceneError
        For values that make no sense.
    """
    if not isinstance(hindcast, WaveHindcast):
        raise SceneError(f"hindcast is {shown(hindcast)}; give a WaveHindcast")
    if isinstance(allowable, PhaseSheet):
        if hours is not None or alpha is not None:
            raise SceneError("hours and alpha are those of the phases of a sheet; leave them out")
        return _in_series(hindcast, allowable, allowable.case_of(case), heading_deg)
    if case is not None:
        raise SceneError(f"case is {shown(case)}, and the table has none; leave it out")
    table = allowable if isinstance(allowable, AllowableHs) else None
    period = number_of("hours", (table.hours if table else None) if hours is None else hours)
    if not 0.0 < period <= LONGEST:
        raise SceneError(f"hours is {period}; give a positive number up to {LONGEST:g}")
    factor = (table.alpha if table else AlphaFactor()) if alpha is None else alpha_of(alpha)
    bare = _limit(hindcast, allowable, heading_deg)
    limit = bare * factor.at(bare, hours=period)
    steps = steps_of(period, hindcast.step_hours)
    may_start = startable(workable_in(hindcast, limit), steps)
    return _windows(
        hindcast, limit, may_start, waiting_steps(may_start), steps, period, factor.told(hours=period)
    )


def _in_series(
    hindcast: WaveHindcast, sheet: PhaseSheet, case: str, heading_deg: float | None
) -> WeatherWindows:
    """Leg after leg, of which each waits until it may start."""
    step = hindcast.step_hours
    limits, legs = [], []
    for leg in sheet.legs:
        of_leg = [limit_of(hindcast, sheet, case, span, sheet.lead_hours, heading_deg) for span in leg]
        limits += of_leg
        legs.append((leg_startable(hindcast, leg, of_leg), steps_of(leg[-1].end, step)))
    total, place = np.zeros(hindcast.time.size), np.arange(hindcast.time.size, dtype=float)
    for may_start, steps in legs:
        waits = np.append(waiting_steps(may_start), np.nan)
        here = np.nan_to_num(place, nan=may_start.size).clip(0, may_start.size).astype(int)
        total, place = total + waits[here], place + waits[here] + steps
    hours = sum(leg[-1].end for leg in sheet.legs)
    told = f"{sheet.alpha.told(hours=hours) if not sheet.alpha.hours else 'alpha factor by phase'}"
    told += f" (source: {sheet.alpha.source})" if sheet.alpha.hours else ""
    least = np.min(limits, axis=0)
    return _windows(hindcast, least, legs[0][0], total, legs[0][1], hours, told)


def limit_of(
    hindcast: WaveHindcast, sheet: PhaseSheet, case: str, span: Span, lead: float, heading_deg: float | None
) -> Array:
    """Largest Hs of a phase in a forecast that was issued `lead` hours before its leg, m, by sea state."""
    bare = _limit(hindcast, sheet.table(span.phase.name, case=case), heading_deg)
    return np.asarray(bare * sheet.alpha.at(bare, hours=lead + span.end))


def leg_startable(hindcast: WaveHindcast, leg: Sequence[Span], limits: Sequence[Array]) -> Flags:
    """Where all phases of a leg are workable, each in the steps in which it is under way."""
    step, size = hindcast.step_hours, hindcast.time.size
    found = np.ones(size, dtype=bool)
    for span, limit in zip(leg, limits, strict=True):
        first = int(np.floor(span.begin / step + ROUNDING))
        inside = startable(workable_in(hindcast, limit), steps_of(span.end, step) - first)
        found &= np.concatenate([inside[first:], np.zeros(min(first, size), dtype=bool)])
    return found


def steps_of(hours: float, step: float) -> int:
    """Steps that so many hours take, at least one."""
    return max(1, int(np.ceil(hours / step - ROUNDING)))


def workable_in(hindcast: WaveHindcast, limit: Array) -> Flags:
    """Whether each sea state is known and at most its limit."""
    below = np.nan_to_num(hindcast.hs, nan=np.inf) <= np.nan_to_num(limit, nan=-np.inf)
    return np.asarray(below & hindcast.known)


def _limit(hindcast: WaveHindcast, allowable: Any, heading_deg: float | None) -> Array:
    """Allowable Hs of each sea state, m; NaN beyond the table."""
    if isinstance(allowable, AllowableHs):
        travel = None if heading_deg is None else hindcast.travel_deg(heading_deg)
        return allowable.at(hindcast.tp, travel)
    if heading_deg is not None:
        raise SceneError(
            "heading_deg: one Hs for all seas knows no directions; leave it out, or give a table"
        )
    height = number_of("allowable", allowable)
    if not 0.0 <= height < np.inf:
        raise SceneError(f"allowable is {height} m; give zero or a positive number, or a table")
    return np.full(hindcast.time.size, height)


def _windows(
    hindcast: WaveHindcast, limit: Array, may_start: Flags, waits: Array, steps: int, hours: float,
    alpha_factor: str,
) -> WeatherWindows:  # fmt: skip
    """By waits in steps; a stretch of times at which one may start ends with the operation's own steps."""
    step, workable = hindcast.step_hours, workable_in(hindcast, limit)
    waiting = waits * step
    first, starts = stretches(may_start)
    month = hindcast.time.astype("datetime64[M]").astype(int) % 12
    by_month = np.array([_numbers(workable, may_start, waiting, month == i) for i in range(12)]).T
    all_of = _numbers(workable, may_start, waiting, np.ones(workable.size, dtype=bool))
    over = ("time",)
    columns = [
        Column(name="hs_limit", values=limit, unit="m", long_name=f"allowable Hs, {alpha_factor}", over=over),
        Column(name="workable", values=workable, over=over),
        Column(name="may_start", values=may_start, over=over),
        Column(name="waiting", values=waiting, unit="h", over=over),
        Column(name="start", values=hindcast.time[first], over=("window",)),
        Column(name="length", values=(starts + steps - 1) * step, unit="h", over=("window",)),
        *(
            Column(name=name, values=values, unit=unit, over=("month",))
            for (name, (_, unit)), values in zip(HEADS.items(), by_month, strict=True)
        ),
    ]
    axes = [Column(name="time", values=hindcast.time), Column(name="month", values=np.arange(1, 13))]
    about = {"hours": hours, "alpha_factor": alpha_factor, "source": hindcast.source}
    return WeatherWindows(
        hours=hours, dataset=Table(axes=axes, columns=columns, attributes=about).to_xarray(),
        **dict(zip(HEADS, all_of, strict=True)),
        unknown_percent=float(100.0 * np.mean(~hindcast.known)),
        outside_percent=float(100.0 * np.mean(hindcast.known & np.isnan(limit))),
        censored_percent=float(100.0 * np.mean(np.isnan(waiting))),
        alpha_factor=alpha_factor, source=hindcast.source,
    )  # fmt: skip


def startable(workable: Flags, steps: int) -> Flags:
    """Where this step and the next ones, so many together, are all workable."""
    if steps > workable.size:
        return np.zeros(workable.size, dtype=bool)
    total = np.concatenate([[0], np.cumsum(workable)])
    found = np.zeros(workable.size, dtype=bool)
    found[: workable.size - steps + 1] = total[steps:] - total[:-steps] == steps
    return found


def waiting_steps(may_start: Flags) -> Array:
    """Steps from each one to the first at which one may start; NaN where there is none."""
    starts = np.flatnonzero(may_start)
    next_one = np.searchsorted(starts, np.arange(may_start.size))
    there = next_one < starts.size
    found = np.full(may_start.size, np.nan)
    found[there] = starts[next_one[there]] - np.flatnonzero(there)
    return found


def stretches(workable: Flags) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First step and length of every run of workable ones."""
    edges = np.diff(np.concatenate([[False], workable, [False]]).astype(int))
    first = np.flatnonzero(edges == 1)
    return first, np.flatnonzero(edges == -1) - first


def _numbers(workable: Flags, may_start: Flags, waiting: Array, chosen: Flags) -> tuple[float, ...]:
    """Shares in % and waiting times of chosen steps; NaN without any."""
    if not chosen.any():
        return (np.nan,) * 5
    waits = waiting[chosen & np.isfinite(waiting)]
    times = [waits.mean(), *np.quantile(waits, (0.5, 0.9))] if waits.size else [np.nan] * 3
    shares = [100.0 * flags[chosen].mean() for flags in (workable, may_start)]
    return tuple(float(one) for one in (*shares, *times))


def plot_weather_windows(windows: WeatherWindows) -> Figure:
    """Draw shares of the time and waiting times by month.

    Raises
    ------
    SceneError
        For something else.
    """
    if not isinstance(windows, WeatherWindows):
        raise SceneError(f"windows is {described(windows)}; give what weather_windows() returns")
    figure = new_figure(figsize=(7.2, 5.4), layout="constrained")
    shares, waits = figure.subplots(2, sharex=True)
    data, months = windows.dataset, np.arange(12)
    for k, (name, label) in enumerate(
        (("workable_percent", "workable"), ("may_start_percent", f"{windows.hours:g} h may start"))
    ):
        shares.bar(months + 0.4 * (k - 0.5), data[name], 0.38, color=COLOURS[k], label=label)
    shares.set(ylabel="of the time [%]", ylim=(0.0, 100.0))
    for k, (name, label) in enumerate(
        (("waiting_mean", "mean"), ("waiting_p50", "P50"), ("waiting_p90", "P90"))
    ):
        waits.plot(months, data[name], "-o", markersize=4, color=COLOURS[k], label=label)
    waits.set(ylabel="waiting time [h]", ylim=(0.0, None))
    waits.set_xticks(months, MONTHS)
    for axes in (shares, waits):
        axes.grid(axis="y", alpha=0.4)
        axes.legend(fontsize=8)
    figure.suptitle(f"Windows of {windows.hours:g} h in {windows.source}", fontsize=11)
    figure.supxlabel(windows.alpha_factor, fontsize=7, ha="left", x=0.02)
    return figure
