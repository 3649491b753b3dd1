"""At a glance: the numbers that are asked for first, and whether the run may be trusted."""

from __future__ import annotations

import numpy as np

from seacrane.figures.traces import traces
from seacrane.reporting.blocks import cards
from seacrane.reporting.limits import judged_bounds
from seacrane.reporting.measures import energy_balanced, findings_of, joints_closed
from seacrane.reporting.section import Section
from seacrane.result import Result

Cards = dict[str, tuple[str, bool | None]]


def _largest(result: Result, channel: str, label: str) -> Cards:
    """The curve of a channel that reaches furthest from zero."""
    if channel not in result.channels:
        return {}
    one = max(traces(result, channel), key=lambda trace: float(np.nanmax(np.abs(trace.values))))
    at = int(np.nanargmax(np.abs(one.values)))
    return {label: (f"{one.values[at]:.4g} {one.unit} at {result.time[at]:.4g} s", None)}


def _tensions(result: Result) -> Cards:
    if "link_tension" not in result.channels:
        return {}
    found = traces(result, "link_tension")
    low = min(found, key=lambda trace: float(np.nanmin(trace.values)))
    value = float(np.nanmin(low.values))
    at = result.time[int(np.nanargmin(low.values))]
    return {
        **_largest(result, "link_tension", "Largest link tension"),
        "Least link tension": (f"{value:.4g} {low.unit} at {at:.4g} s", value >= 0.0 or None),
    }


def _roll(result: Result) -> Cards:
    if "vessel_motion" not in result.channels:
        return {}
    rolls = traces(result, "vessel_motion", motion="roll")
    one = max(rolls, key=lambda trace: float(np.nanmax(np.abs(trace.values))))
    half = one.values[result.time.size // 2 :]
    return {
        "Roll": (f"{np.nanmin(one.values):.3g} to {np.nanmax(one.values):.3g} deg", None),
        "Mean roll, second half": (f"{np.nanmean(half):.3g} deg", None),
    }


def _limits(result: Result) -> Cards:
    judged = [bound.held for bound in judged_bounds(result) if bound.held is not None]
    if not judged:
        return {}
    broken = judged.count(False)
    return {
        "Limits": (f"{broken} of {len(judged)} not held" if broken else f"all {len(judged)} held", not broken)
    }


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
            **_tensions(result),
            **_largest(result, "limit_force", "Largest force of a wire, stop or seat"),
            **_largest(result, "cylinder_force", "Largest cylinder force"),
            **_largest(result, "slew_torque", "Largest slew torque"),
            **_roll(result),
            **_limits(result),
            **_trust(result),
        }
    )


GLANCE: Section[Result] = Section(title="At a glance", applies=lambda _: True, html=_html)
