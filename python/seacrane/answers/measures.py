"""Numbers of a run that several sections and commands tell: checks, pace, statistics of its channels."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from seacrane.pictures.overview import payload_bodies, resultants
from seacrane.result import Result
from seacrane.result.traces import NO_MOTION, Trace, beyond_rounding, traces

CLOSED = 1e-6  # m or rad: joints that are closed to it are closed for any engineer
BALANCED = 1e-3  # of the absolute work
STATED = [
    "wave_elevation",
    "slew_angle",
    "stroke",
    "limit_force",
    "coordinate",
    "actuator_force",
    "driver_force",
]
Statistics = tuple[Any, ...]  # title, unit, largest value, when (s), smallest, when, mean, standard deviation
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
PLANAR = ("surge", "sway", "yaw")  # motions that the summary leaves to the statistics
# What is shown under a crane's own names is not shown again under those of its parts.
SAME = {
    "coordinate": ("stroke", "slew_angle"),
    "actuator_force": ("cylinder_force", "slew_torque"),
    "driver_force": ("cylinder_force", "slew_torque"),
}


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
