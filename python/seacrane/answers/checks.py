"""The engine's tables: events, warnings, constraint errors, energy balance, cost."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from html import escape
from typing import Any

from seacrane.answers.measures import (
    BALANCED,
    CLOSED,
    energy_balanced,
    energy_closure,
    findings_of,
    joints_closed,
    speed,
    worst,
)
from seacrane.answers.section import Section
from seacrane.plotting.table import facts, table_of
from seacrane.result import Event, Result

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
Rows = list[tuple[str, Any]]


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


def side_by_side(runs: Mapping[str, Result], rows: Callable[[Result], Rows]) -> str:
    """One table of several runs; what none of them has is left out."""
    by_run = [dict(rows(run)) for run in runs.values()]
    texts = list(dict.fromkeys(text for one in by_run for text in one))
    return table_of(["", *runs], [[text, *(one.get(text) for one in by_run)] for text in texts]).html()


def _told(rows: Rows) -> Rows:
    return [(text, value) for text, value in rows if value is not None]


def _judgement(good: bool | None, passed: str, failed: str) -> str:
    return "" if good is None else f'<p class="{"good" if good else "bad"}">{passed if good else failed}</p>'


def _checks(result: Result) -> str:
    joints = _judgement(
        joints_closed(result),
        f"Joints stay closed within {CLOSED:g} m or rad.",
        f"Joints open by more than {CLOSED:g} m or rad: do not use the numbers before this is understood.",
    )
    energy = _judgement(
        energy_balanced(result),
        f"Energy is balanced within {BALANCED:g} of the absolute work.",
        f"Energy is off by more than {BALANCED:g} of the absolute work: tighten the tolerance and compare.",
    )
    parts = [
        ("Worst constraint errors", _told(constraint_rows(result)), joints),
        ("Energy balance", _told(energy_rows(result)), energy),
    ]
    return "\n".join(f"<h3>{name}</h3>{facts(rows).html()}{words}" for name, rows, words in parts if rows)


def _beside_stages(result: Result) -> list[Event]:
    """Begins of stages are in the particulars."""
    return [one for one in result.events if one.kind != "stage"]


def _events(result: Result) -> str:
    events = _beside_stages(result)
    lasting = set(result.coords.get("contact_point", ()))  # whose force has no impulse of an instant
    rows: list[Sequence[Any]] = [
        (one.time, one.name, one.kind, one.speed,
         *(("", "") if one.name in lasting else (one.impulse, one.energy_lost)))
        for one in events[:MOST_EVENTS]
    ]  # fmt: skip
    head = ("time [s]", "limit", "event", "speed [m/s or rad/s]", "impulse [N s or N m s]", "energy lost [J]")
    more = len(events) - len(rows)
    remarks = [f"{more} later events are not shown."] if more else []
    return table_of(head, rows, remarks=remarks).html() if rows else ""


def _warnings(result: Result) -> str:
    items = "".join(
        f"<li>{escape(text)}.{f' It came {times} times, with other numbers.' if times > 1 else ''}</li>"
        for text, times in findings_of(result).items()
    )
    return f"<ul>{items}</ul>" if items else "<p>None.</p>"


def _cost(result: Result) -> str:
    return facts(_told(counter_rows(result))).html()


CHECKS: Section[Result] = Section("Checks", _checks)
EVENTS: Section[Result] = Section("Events", _events)
WARNINGS: Section[Result] = Section("Warnings", _warnings)
COST: Section[Result] = Section("Cost", _cost)
