"""go_or_no_go(): a forecast against the sheet of an operation, phase by phase."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.hindcast import HOUR, Flags, WaveHindcast
from seacrane.operability.phase import Span
from seacrane.operability.phase_table import PhaseSheet
from seacrane.operability.sea_states import Times
from seacrane.operability.windows import ROUNDING, leg_startable, limit_of, steps_of
from seacrane.plotting.table import Answer, Column, Table, Verdict

MOST_HOURS = 1e5  # of a forecast


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class GoNoGo(Answer):
    """Whether an operation may start by a forecast. Made by `go_or_no_go`; prints as a table.

    Attributes
    ----------
    go : bool
        Whether all phases to the point of safe return are below their limits.
    start : datetime64
    phases : tuple of str
        Up to the point of safe return.
    hs, limit : ndarray, shape (phases,)
        Of the forecast and of the phase with alpha, m, in the step that is nearest to the limit; NaN where
        the forecast ends before, or the table does not reach.
    begin, end : ndarray of datetime64, shape (phases,)
    governing : tuple of str
        Criterion of each phase at the nearest period and direction of its table.
    starts : ndarray of datetime64
        All times of the forecast at which it is go.
    told : tuple of str
        Why a phase cannot be judged, and what is not judged.
    """

    go: bool
    start: np.datetime64
    phases: tuple[str, ...]
    hs: Array
    limit: Array
    begin: Times
    end: Times
    governing: tuple[str, ...]
    starts: Times
    source: str
    told: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<GoNoGo: {'go' if self.go else 'no go'} at {self.start}>"

    def _shown(self) -> Table:
        share = self.hs / self.limit
        go = [bool(one <= 1.0) for one in share]
        said = Verdict("GO" if self.go else "NO GO", self.go)
        later = self.starts[self.starts > self.start]
        following = str(later[0]) if later.size else "none"
        remark = f"go from {len(self.starts)} times of the forecast; the next: {following}"
        return Table(
            axes=[Column(name="phase", values=list(self.phases))],
            columns=[
                Column(name="begin", head="from", values=[str(one) for one in self.begin]),
                Column(name="end", head="to", values=[str(one) for one in self.end]),
                Column(name="hs", head="Hs", values=self.hs, unit="m", form=".2f"),
                Column(name="limit", values=self.limit, unit="m", form=".2f"),
                Column(name="share", head="Hs/limit", values=share, form=".2f"),
                Column(name="governing", head="governs", values=list(self.governing)),
                Column(name="go", head="", values=go,
                       read=("", [Verdict("go" if one else "no go", one) for one in go])),
            ],
            title=f"{said} at {self.start} by {self.source}", remarks=[*self.told, remark],
        )  # fmt: skip


@named
def go_or_no_go(
    forecast: WaveHindcast,
    sheet: PhaseSheet,
    *,
    start: Any = None,
    issued: Any = None,
    case: str | None = None,
    heading_deg: float | None = None,
    first: str | None = None,
) -> GoNoGo:
    """Judge a forecast by the sheet of an operation, to the first point of safe return.

    Each phase is held to the steps of the forecast in which it is under way, contingency included, with the
    alpha factor of the hours from the issue to its end.

    Parameters
    ----------
    forecast : WaveHindcast
        Sea states to come.
    start, issued : datetime64, optional
        When the operation begins, and when the forecast was issued; default: its first time, for both. The
        start is a time of the forecast.
    case, heading_deg
        As of `weather_windows`.
    first : str, optional
        The phase that comes next, where others are over: the first one, or one after a point of safe return.

    Raises
    ------
    SceneError
        For values that make no sense.
    """
    if not isinstance(forecast, WaveHindcast):
        raise SceneError(f"forecast is {shown(forecast)}; give a WaveHindcast")
    if not isinstance(sheet, PhaseSheet):
        raise SceneError(f"sheet is {shown(sheet)}; give what phase_sheet() returns")
    times, begins = forecast.time, {leg[0].phase.name: leg for leg in sheet.legs}
    if first is not None and first not in begins:
        raise SceneError(f"first is {shown(first)}; an operation waits before {', '.join(begins)}")
    leg = sheet.legs[0] if first is None else begins[first]
    begin, issue = start_of(forecast, start, issued)
    place = int(np.searchsorted(times, begin))
    chosen = sheet.case_of(case)

    def lead(at: int) -> float:
        return max(float((times[at] - issue) / HOUR), 0.0) if sheet.alpha.hours else 0.0

    @cache
    def limits(hours: float) -> list[Array]:
        return [limit_of(forecast, sheet, chosen, span, hours, heading_deg) for span in leg]

    @cache
    def may_start(hours: float) -> Flags:
        return leg_startable(forecast, leg, limits(hours))

    longest = sheet.alpha.hours[-1] if sheet.alpha.hours else np.inf
    last = issue + np.timedelta64(round(min(longest - leg[-1].end, MOST_HOURS) * 3600.0), "s")
    later = [at for at in range(times.size) if issue <= times[at] <= last]
    starts = np.array([at for at in later if may_start(lead(at))[at]], dtype=int)
    held = zip(leg, limits(lead(place)), strict=True)
    worst = [_worst(forecast, span, limit, place) for span, limit in held]
    travel = None if heading_deg is None else forecast.travel_deg(heading_deg)
    tables = [sheet.table(span.phase.name, case=case) for span in leg]
    why = [
        f"{span.phase.name}: {_why(forecast, table, one[0], travel)}"
        for span, table, one in zip(leg, tables, worst, strict=True) if np.isnan(one[1])
    ]  # fmt: skip
    names = [phase.name for phase in sheet.phases]
    if after := names[names.index(leg[-1].phase.name) + 1 :]:
        why.append(f"{', '.join(after)}: by another forecast, after {leg[-1].phase.name}")
    return GoNoGo(
        go=bool(np.isin(place, starts)), start=begin, phases=tuple(span.phase.name for span in leg),
        hs=np.array([one[1] for one in worst]), limit=np.array([one[2] for one in worst]),
        begin=_at(begin, [span.begin for span in leg]), end=_at(begin, [span.end for span in leg]),
        governing=tuple(
            "not known" if np.isnan(one[1]) else _governing(forecast, table, one[0], travel)
            for table, one in zip(tables, worst, strict=True)
        ),
        starts=times[starts], source=forecast.source, told=tuple(why),
    )  # fmt: skip


def start_of(forecast: WaveHindcast, start: Any, issued: Any) -> tuple[np.datetime64, np.datetime64]:
    """When an operation begins and its forecast was issued; SceneError for no time of the forecast."""
    times = forecast.time
    begin, issue = (_time(name, one, times) for name, one in (("start", start), ("issued", issued)))
    if begin not in times:
        raise SceneError(f"start is {begin}; give a time of the forecast, {times[0]} to {times[-1]}")
    if issue > begin:
        raise SceneError(f"issued is {issue}, after the start {begin}; give when the forecast was issued")
    return begin, issue


def _time(name: str, given: Any, times: Times) -> np.datetime64:
    """A time that was given, or the first one."""
    try:
        found: np.datetime64 = times[0] if given is None else np.datetime64(given)
    except ValueError as error:
        raise SceneError(f"{name} is {shown(given)}; give a time such as {times[0]}") from error
    if np.isnat(found):
        raise SceneError(f"{name} is no time; give one such as {times[0]}")
    return found


def _at(begin: np.datetime64, hours: list[float]) -> Times:
    return begin + (np.array(hours) * 3600.0).round().astype("timedelta64[s]")


def _worst(forecast: WaveHindcast, span: Span, limit: Array, place: int) -> tuple[int, float, float]:
    """The step of a phase nearest to its limit, with Hs and limit; NaN where a step is not known."""
    step = forecast.step_hours
    begin = place + int(np.floor(span.begin / step + ROUNDING))
    end = place + steps_of(span.end, step)
    here: Flags = forecast.known[begin:end] & np.isfinite(limit[begin:end])
    if end > forecast.time.size or not here.all():
        return begin + int(np.argmin([*here, False])), float("nan"), float("nan")
    ratio = forecast.hs[begin:end] / np.maximum(limit[begin:end], 1e-12)
    at = begin + int(np.argmax(ratio))
    return at, float(forecast.hs[at]), float(limit[at])


def _why(forecast: WaveHindcast, table: AllowableHs, at: int, travel: Array | None) -> str:
    """Why there is no limit at a step, the first of its phase."""
    if at >= forecast.time.size:
        return f"the forecast ends at {forecast.time[-1]}, before it is over"
    if not forecast.known[at]:
        return f"the forecast has no sea state at {forecast.time[at]}"
    tp, towards = (table.dataset[name].to_numpy() for name in ("tp", "direction_deg"))
    has, asked = f"{tp.min():g} to {tp.max():g} s", f"Tp {forecast.tp[at]:.3g} s"
    if travel is not None:
        has += f", to {towards.min():g} to {towards.max():g} deg"
        asked += f", waves to {(travel[at] + 180.0) % 360.0 - 180.0:g} deg from the bow to port"
    return f"no limit for the sea of {forecast.time[at]}, {asked}: the sheet has {has}"


def _governing(forecast: WaveHindcast, table: AllowableHs, at: int, travel: Array | None) -> str:
    """The criterion that governs nearest to the sea of a step; without a direction in the worst one."""
    data = table.dataset
    i = int(np.argmin(np.abs(data["tp"].to_numpy() - forecast.tp[at])))
    if travel is None:
        j = int(np.argmin(np.nan_to_num(data["forecast_hs"].to_numpy()[i], nan=-np.inf)))
    else:
        apart = (data["direction_deg"].to_numpy() - travel[at] + 180.0) % 360.0 - 180.0
        j = int(np.argmin(np.abs(apart)))
    return str(data["governing"].to_numpy()[i, j]) or "none"
