"""At a glance: the numbers that are asked for first, and whether the run may be trusted."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.answers.blocks import cards
from seacrane.answers.limits_section import judged_bounds
from seacrane.answers.measures import energy_balanced, findings_of, joints_closed
from seacrane.answers.reported_curves import hook_loads
from seacrane.answers.section import Section
from seacrane.result import Result
from seacrane.result.contact_loads import contact_loads
from seacrane.result.traces import Trace, traces

Array = NDArray[np.float64]
Cards = dict[str, tuple[str, bool | None]]


def _finite(result: Result, channel: str, **names: str) -> list[Trace]:
    """The curves of a channel that hold any number: an interrupted run may have none."""
    if channel not in result.channels:
        return []
    return [one for one in traces(result, channel, **names) if np.isfinite(one.values).any()]


def _largest(result: Result, channel: str, label: str) -> Cards:
    """The curve of a channel that reaches furthest from zero."""
    found = _finite(result, channel)
    if not found:
        return {}
    one = max(found, key=lambda trace: float(np.nanmax(np.abs(_farthest(trace)))))
    values = _farthest(one)
    at = int(np.nanargmax(np.abs(values)))
    return {label: (f"{values[at]:.4g} {one.unit} at {result.time[at]:.4g} s", None)}


def _farthest(one: Trace) -> Array:
    """Of least and largest values since the output before the one farther from zero."""
    return np.where(np.abs(one.least) > np.abs(one.largest), one.least, one.largest)


def _hook_loads(result: Result) -> Cards:
    found = [one for one in hook_loads(result) if np.isfinite(one.values).any()]
    if not found:
        return {}
    largest = max(found, key=lambda one: float(np.nanmax(one.largest)))
    least = min(found, key=lambda one: float(np.nanmin(one.least)))
    places = {
        "Largest hook load": (largest, largest.largest, int(np.nanargmax(largest.largest))),
        "Least hook load": (least, least.least, int(np.nanargmin(least.least))),
    }
    return {
        text: (f"{values[at]:.4g} {one.unit} at {result.time[at]:.4g} s", values[at] >= 0.0 or None)
        for text, (one, values, at) in places.items()
    }


def _roll(result: Result) -> Cards:
    rolls = _finite(result, "vessel_motion", motion="roll")
    if not rolls:
        return {}
    one = max(rolls, key=lambda trace: float(np.nanmax(np.abs(_farthest(trace)))))
    values = one.values[np.isfinite(one.values)]
    half = values[values.size // 2 :]
    return {
        "Roll": (f"{np.nanmin(one.least):.3g} to {np.nanmax(one.largest):.3g} deg", None),
        "Mean roll, second half": (f"{half.mean():.3g} deg", None),
    }


def _limits(result: Result) -> Cards:
    judged = [bound.held for bound in judged_bounds(result) if bound.held is not None]
    if not judged:
        return {}
    broken = judged.count(False)
    return {
        "Limits": (f"{broken} of {len(judged)} not held" if broken else f"all {len(judged)} held", not broken)
    }


def _contacts(result: Result) -> Cards:
    known = [one for one in contact_loads(result) if one.peak > 0.0]
    if not known:
        return {}
    worst = max(known, key=lambda one: one.peak)
    return {"Hardest press of a contact": (f"{worst.peak / 1e3:.4g} kN, {worst.point}", None)}


def _utilisation(result: Result) -> Cards:
    known = [state for state in result.utilisation if state.kept is not None]
    if not known:
        return {}
    worst = max(known, key=lambda state: state.utilisation)
    return {"Largest utilisation": (f"{worst.utilisation:.2f}, {worst.name}", worst.kept)}


def _trust(result: Result) -> Cards:
    checks = [good for good in (joints_closed(result), energy_balanced(result)) if good is not None]
    warned = len(findings_of(result))
    told: Cards = {"Warnings": (str(warned) if warned else "none", not warned)}
    if checks:
        told["Numerical checks"] = ("passed" if all(checks) else "not passed", all(checks))
    return told


def _html(result: Result) -> str:
    span = {
        "Simulated": (f"{float(result.stats['simulated_s']):g} s", None if not result.interrupted else False)
    }
    return cards(
        {
            **span,
            **_hook_loads(result),
            **_largest(result, "limit_force", "Largest force of a wire, stop or seat"),
            **_largest(result, "cylinder_force", "Largest cylinder force"),
            **_largest(result, "slew_torque", "Largest slew torque"),
            **_roll(result),
            **_contacts(result),
            **_limits(result),
            **_utilisation(result),
            **_trust(result),
        }
    )


GLANCE: Section[Result] = Section("At a glance", _html)
