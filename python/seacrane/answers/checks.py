"""Checks of a run, of its limits and its pace, the statistics of its channels, where its numbers are from."""

from __future__ import annotations

import hashlib
import platform
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from seacrane.description.pick import Pick
from seacrane.pictures.plots import payload_bodies, resultants
from seacrane.plotting.table import Table, Verdict, table_of
from seacrane.result import CHANNELS, Result
from seacrane.result.about import Event
from seacrane.result.traces import ANGLES, NO_MOTION, Trace, beyond_rounding, shown_unit, traces

MOST_EVENTS = 200
CONSTRAINT_ERRORS = {
    "constraint_error": "position residual after projection [m or rad]",
    "constraint_rate_error": "velocity residual after projection [m/s or rad/s]",
    "constraint_error_before_projection": "position residual before projection [m or rad]",
}
COUNTERS = {
    "simulated_s": "simulated time [s]",
    "wall_s": "wall time of the loop [s]",
    "steps": "accepted steps",
    "rejected_steps": "rejected steps",
    "evaluations": "evaluations",
    "states": "states",
    "coordinates": "coordinates",
    "constraints": "constraints",
    "degrees_of_freedom": "degrees of freedom",
    "compiled_coordinates": "compiled coordinates",
    "compiled_constraints": "compiled constraints",
    "wave_components": "wave components",
    "realised_hs": "realised Hs [m]",
    "wave_energy_without_load": "share of the waves' energy above the database's frequencies",
    "load_variance_without_load": "the same of the variance of a vessel's load, estimated",
    "seed": "seed",
    "fastest_mode_per_s": "fastest mode at the start [1/s]",
    "formulation": "formulation",
    "integrator": "integrator",
}
Rows = list[tuple[Any, ...]]
CLOSED = 1e-6  # m or rad: joints that are closed to it are closed for any engineer
BALANCED = 1e-3  # of the absolute work
STATED = (
    "wave_elevation", "slew_angle", "stroke", "limit_force", "coordinate", "actuator_force", "driver_force",
)  # fmt: skip
Statistics = tuple[Any, ...]  # title, unit, largest value, when (s), smallest, when, mean, standard deviation
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
PLANAR = ("surge", "sway", "yaw")  # motions that the summary leaves to the statistics
# What is shown under a crane's own names is not shown again under those of its parts.
SAME = {
    "coordinate": ("stroke", "slew_angle"),
    "actuator_force": ("cylinder_force", "slew_torque"),
    "driver_force": ("cylinder_force", "slew_torque"),
}
PACKAGES = ("seacrane", "numpy", "scipy", "matplotlib", "netCDF4", "xarray")
OVERSHOT = 0.01  # m or rad that a control may overshoot a range, as OutsideRangeWarning counts it


def worst(result: Result, channel: str) -> float | None:
    """Largest absolute value of a channel over the run, or None if no number was recorded."""
    if channel not in result.channels or not np.isfinite(result[channel]).any():
        return None
    return max(float(np.nanmax(np.abs(bound))) for bound in result.reached(channel))


def energy_closure(result: Result) -> float | None:
    """Largest absolute energy balance over the largest absolute work, or None where it is not defined."""
    balance, work = worst(result, "energy_balance"), worst(result, "absolute_work")
    return balance / work if balance is not None and work else None


def speed(result: Result) -> float | None:
    """Simulated seconds per second of the loop, or None if the loop took no measurable time."""
    wall = float(result.stats["wall_s"])
    return float(result.stats["simulated_s"]) / wall if wall > 0 else None


def joints_closed(result: Result) -> bool | None:
    """Whether the constraint errors stay below what matters; None if they were not recorded."""
    error = worst(result, "constraint_error")
    return None if error is None else error <= CLOSED


def energy_balanced(result: Result) -> bool | None:
    """Whether the energy balance stays below its share of the work; None where it is not defined."""
    closure = energy_closure(result)
    return None if closure is None else closure <= BALANCED


def findings_of(result: Result) -> dict[str, int]:
    """What its description and the run were warned of: each by its first message, and how often it came."""
    told = [str(result.stats.get(key, "")).splitlines() for key in ("described", "validity")]
    alike: dict[str, list[str]] = {}
    for line in dict.fromkeys(line for lines in told for line in lines):
        alike.setdefault(NUMBER.sub("#", line), []).append(line)
    return {lines[0]: len(lines) for lines in alike.values()}


def stated_traces(result: Result) -> list[Trace]:
    """The curves whose numbers a report states beside its summary: of motions, crane, payload and joints."""
    held = set(result.channels)
    motions = PLANAR if "vessel_motion" in held else ()
    found = [one for motion in motions for one in traces(result, "vessel_motion", motion=motion)]
    names = [name for name in STATED if name in held and not held & set(SAME.get(name, ()))]
    found += [one for name in names for one in traces(result, name)]
    if "position" in held:
        found += [one for body in payload_bodies(result) for one in traces(result, "position", body=body)]
    for name in ("reaction_force", "reaction_moment"):
        found += resultants(result, name) if name in held else []
    return found


def statistics_of(result: Result) -> tuple[list[Statistics], int]:
    """Statistics of `stated_traces`, and how many are left out as zero up to rounding."""
    every = stated_traces(result)
    by_channel: dict[str, list[Trace]] = {}
    for one in every:
        by_channel.setdefault(one.channel, []).append(one)
    kept = [one for group in by_channel.values() for one in beyond_rounding(group)]
    return [_statistics(one, result) for one in kept], len(every) - len(kept)


def _statistics(one: Trace, result: Result) -> Statistics:
    high, low = int(np.nanargmax(one.largest)), int(np.nanargmin(one.least))
    numbers = (one.largest[high], result.time[high], one.least[low], result.time[low],
               np.nanmean(one.values), np.nanstd(one.values))  # fmt: skip
    return (one.title, one.unit, *(0.0 if abs(value) < NO_MOTION else float(value) for value in numbers))


def constraint_rows(result: Result) -> Rows:
    """Worst constraint errors by what they are."""
    return [(text, worst(result, name)) for name, text in CONSTRAINT_ERRORS.items()]


def energy_rows(result: Result) -> Rows:
    """The energy balance, and its share of the work."""
    return [
        ("largest |energy balance| [J]", worst(result, "energy_balance")),
        ("largest absolute work [J]", worst(result, "absolute_work")),
        ("balance over work", energy_closure(result)),
    ]


def counter_rows(result: Result) -> Rows:
    """What the run took."""
    found = [(text, result.stats[name]) for name, text in COUNTERS.items() if name in result.stats]
    return [*found, ("times faster than real time", speed(result))]


def side_by_side(runs: Mapping[str, Result], rows: Callable[[Result], Rows]) -> Table:
    """One table of several runs; what none of them has is left out."""
    by_run: list[dict[str, Any]] = [dict(rows(run)) for run in runs.values()]
    texts = list(dict.fromkeys(text for one in by_run for text in one))
    return table_of(["", *runs], [[text, *(one.get(text) for one in by_run)] for text in texts])


def events(result: Result) -> Table | None:
    """The events of limits, if there are any; begins of stages are in the particulars."""
    found = [one for one in result.events if one.kind != "stage"]
    lasting = set(result.coords.get("contact_point", ()))  # whose force has no impulse of an instant
    rows = [
        (one.time, one.name, one.kind, one.speed,
         *(("", "") if one.name in lasting else (one.impulse, one.energy_lost)))
        for one in found[:MOST_EVENTS]
    ]  # fmt: skip
    head = ("time [s]", "limit", "event", "speed [m/s or rad/s]", "impulse [N s or N m s]", "energy lost [J]")
    more = len(found) - len(rows)
    remarks = [f"{more} later events are not shown."] if more else []
    return table_of(head, rows, remarks=remarks) if rows else None


def versions() -> dict[str, str]:
    """Versions of Python and of the packages a result depends on."""
    found = {"python": platform.python_version(), "platform": f"{platform.system()} {platform.machine()}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed as a package"
    return found


def digest(result: Result) -> str:
    """SHA-256 of the recorded numbers: equal digests are equal results, bit for bit."""
    summed = hashlib.sha256(np.ascontiguousarray(result.time).tobytes())
    for name in sorted(result.channels):
        summed.update(name.encode())
        summed.update(np.ascontiguousarray(result[name]).tobytes())
    return summed.hexdigest()


def recorded(result: Result) -> Rows:
    """Name, dimensions, unit and meaning of each channel."""
    every = ((name, CHANNELS[name]) for name in result.channels)
    return [(name, ", ".join(result.dims[name]), one.unit, one.long_name) for name, one in every]


@dataclass(frozen=True, kw_only=True)
class Judged:
    """A limit, what was reached, and whether it held; None where nothing recorded tells it."""

    name: str
    kind: str
    bound: str
    words: str
    reached: str = ""
    held: bool | None = None


def judged_bounds(result: Result) -> list[Judged]:
    """Every limit of a scene: wires, stops, seats, ranges, and links that may only pull."""
    described = result.about.bounds
    judge = {"wire": _contact, "seat": _contact, "stop": _stop, "soft stop": _bounded, "range": _bounded}
    return [judge[bound["kind"]](result, bound) for bound in described] + _links(result, described)


def _contact(result: Result, bound: Mapping[str, Any]) -> Judged:
    """A wire that is to stay taut, or a seat that is to stay pressed."""
    wire, name = bound["kind"] == "wire", str(bound["name"])
    closed, opened = ("taut throughout", "slack") if wire else ("pressed throughout", "lifted off")
    mine = [event for event in result.events if event.name == name]
    count = sum(event.kind in ("release", "rebound") for event in mine)
    known = "limit_force" in result.channels and name in result.coords["limit"]
    force = _finite(result.select("limit_force", limit=name)) if known else None
    starts_open = force is not None and float(force[0]) == 0.0
    fallen = sum(event.kind == "through" for event in mine)
    asked = _asked_for(result, mine)
    words = f"{opened} {_often(count)}" if count else f"{opened} at the start" if starts_open else closed
    words += f", as stage {asked!r} asks" if asked else ""
    hardest = max((abs(event.impulse) for event in mine), default=0.0)
    if hardest > 0.0:
        words += f", hardest snatch {hardest:.3g} N s"
    if fallen:
        words += f", then through it {_often(fallen)}"
    return Judged(
        name=name, kind=str(bound["kind"]), bound="pulls only" if wire else "presses only",
        reached="" if force is None else _newtons(_reached(result, "limit_force", limit=name)), words=words,
        held=not starts_open and (not count or (bool(asked) and count == 1 and not fallen)),
    )  # fmt: skip


def _asked_for(result: Result, events: Sequence[Event]) -> str:
    """The stage that waits for a limit to let go, or releases it; none where nobody asked."""
    gone = [event for event in events if event.kind in ("release", "rebound")]
    for span in result.stages:
        for event in gone:
            waited = span.start <= event.time <= span.end and f"{event.name!r} lets go" in span.ended_by
            if waited or event.time == span.start:
                return str(span.name)
    return ""


def _often(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _stop(result: Result, bound: Mapping[str, Any]) -> Judged:
    base = _bounded(result, bound)
    ends = [base.name, f"{base.name}.minimum", f"{base.name}.maximum"]
    hits = [one for one in result.events if one.name in ends and one.kind in ("contact", "rebound")]
    fastest = max((hit.speed for hit in hits), default=0.0)
    words = f"hit {_often(len(hits))}, fastest {fastest:.3g} m/s or rad/s" if hits else "not hit"
    return replace(base, held=not hits, words=words)


def _bounded(result: Result, bound: Mapping[str, Any]) -> Judged:
    """A coordinate that is to stay between two values."""
    angular = bound["coordinate"] in ANGLES
    factor, unit = shown_unit("rad" if angular else "m", [])
    low, high = (None if bound[end] is None else factor * bound[end] + 0.0 for end in ("minimum", "maximum"))
    limits = f"{'' if low is None else f'{low:.4g}'} to {'' if high is None else f'{high:.4g}'} {unit}"
    name, kind = str(bound["name"]), str(bound["kind"])
    told = Judged(name=name, kind=kind, bound=limits, words="coordinate not recorded")
    known = bound["recorded"] is not None and "coordinate" in result.channels
    values = _reached(result, "coordinate", joint_coordinate=bound["recorded"]) if known else None
    if values is None:
        return told
    ends = (float(factor * value) for value in (values.min(), values.max()))
    least, most = (0.0 if abs(end) < NO_MOTION else end for end in ends)  # m or deg
    beyond = max(-np.inf if low is None else low - least, -np.inf if high is None else most - high)
    held = beyond <= factor * (OVERSHOT if bound["kind"] == "range" else 0.0)
    words = f"held, {0.0 - beyond:.3g} {unit} left" if beyond <= 0.0 else f"{beyond:.3g} {unit} beyond"
    if held and beyond > 0.0:
        words = f"held, overshot by {beyond:.1g} {unit}"
    return replace(told, reached=f"{least:.4g} to {most:.4g} {unit}", held=bool(held), words=words)


def _finite(values: Any) -> Any:
    """Without what an interrupted run left open; None where nothing is left."""
    kept = values[np.isfinite(values)]
    return kept if kept.size else None


def _reached(result: Result, channel: str, **names: str) -> Any:
    """Least and largest values of a curve, finite ones; None where there are none."""
    return _finite(np.concatenate(result.reached(Pick(channel=channel, names=names))))


def _newtons(values: Any) -> str:
    """Least and largest of forces, in the unit in which they are read."""
    factor, unit = shown_unit("N", [values])
    return f"{factor * values.min():.4g} to {factor * values.max():.4g} {unit}"


def _links(result: Result, described: Sequence[Mapping[str, Any]]) -> list[Judged]:
    """Links that a payload hangs on and that are no wires: they are rods, and must not push."""
    wired = {bound["joint"] for bound in described if bound["kind"] == "wire"}
    known = result.coords["link"] if "tension" in result.channels else ()
    links = [crane["link"] for crane in result.about.cranes]
    found = []
    for name in (link for link in links if link in known and link not in wired):
        tension = _reached(result, "tension", link=name)
        if tension is None:
            continue
        pushed = tension.min() < -1e-9 * np.abs(tension).max()
        found.append(Judged(
            name=name, kind="link", bound="must pull", reached=_newtons(tension), held=not pushed,
            words="pushed: a wire would have gone slack" if pushed else "pulled throughout",
        ))  # fmt: skip
    return found


def limits(result: Result) -> Table | None:
    """A row for each limit."""
    rows = [(j.name, j.kind, j.bound, j.reached, Verdict(j.words, j.held)) for j in judged_bounds(result)]
    return table_of(("limit", "kind", "bound", "reached", "held?"), rows) if rows else None
