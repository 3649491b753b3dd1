"""The limits that the scene has, and whether they held."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seacrane.description.pick import Pick
from seacrane.plotting.table import Table, Verdict, table_of
from seacrane.result import Result
from seacrane.result.events import Event
from seacrane.result.traces import ANGLES, NO_MOTION, shown_unit

OVERSHOT = 0.01  # m or rad that a control may overshoot a range, as OutsideRangeWarning counts it


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
    force = _force(result, name)
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
    told = Judged(
        name=str(bound["name"]), kind=str(bound["kind"]), bound=limits, words="coordinate not recorded"
    )
    known = bound["recorded"] is not None and "coordinate" in result.channels
    values = _reached(result, "coordinate", joint_coordinate=bound["recorded"]) if known else None
    if values is None:
        return told
    least, most = (_settled(float(factor * value)) for value in (values.min(), values.max()))
    beyond = max(-np.inf if low is None else low - least, -np.inf if high is None else most - high)
    held = beyond <= factor * (OVERSHOT if bound["kind"] == "range" else 0.0)
    words = f"held, {0.0 - beyond:.3g} {unit} left" if beyond <= 0.0 else f"{beyond:.3g} {unit} beyond"
    if held and beyond > 0.0:
        words = f"held, overshot by {beyond:.1g} {unit}"
    return replace(told, reached=f"{least:.4g} to {most:.4g} {unit}", held=bool(held), words=words)


def _settled(value: float) -> float:
    """Zero where it is so up to rounding, m or deg."""
    return 0.0 if abs(value) < NO_MOTION else value


def _finite(values: Any) -> Any:
    """Without what an interrupted run left open; None where nothing is left."""
    kept = values[np.isfinite(values)]
    return kept if kept.size else None


def _reached(result: Result, channel: str, **names: str) -> Any:
    """Least and largest values of a curve, finite ones; None where there are none."""
    return _finite(np.concatenate(result.reached(Pick(channel=channel, names=names))))


def _force(result: Result, name: str) -> Any:
    if "limit_force" not in result.channels or name not in result.coords["limit"]:
        return None
    return _finite(result.select("limit_force", limit=name))


def _newtons(values: Any) -> str:
    """Least and largest of forces, in the unit in which they are read."""
    factor, unit = shown_unit("N", [values])
    return f"{factor * values.min():.4g} to {factor * values.max():.4g} {unit}"


def _links(result: Result, described: Sequence[Mapping[str, Any]]) -> list[Judged]:
    """Links that a payload hangs on and that are no wires: they are rods, and must not push."""
    wired = {bound["joint"] for bound in described if bound["kind"] == "wire"}
    cranes = result.about.cranes
    names = [crane["link"] for crane in cranes if crane["link"] and crane["link"] not in wired]
    found = []
    for name in names:
        if "tension" not in result.channels or name not in result.coords["link"]:
            continue
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
    words = (
        "Coordinates are those at the outputs. Capacities of structure and wire are limit states: see the "
        "summary."
    )
    return table_of(("limit", "kind", "bound", "reached", "held?"), rows, remarks=[words]) if rows else None
