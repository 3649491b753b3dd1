"""Checks of a run, its pace, the statistics of its channels, and where its numbers are from."""

from __future__ import annotations

import hashlib
import platform
import re
from collections.abc import Callable, Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np

from seacrane.pictures.plots import payload_bodies, resultants
from seacrane.plotting.table import Table, table_of
from seacrane.result import CHANNELS, Result
from seacrane.result.traces import NO_MOTION, Trace, beyond_rounding, traces

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
    """What its description and the run were warned of: each by its first message, and how often it came.

    A lift in stages is told of one thing in several, with other numbers.
    """
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
