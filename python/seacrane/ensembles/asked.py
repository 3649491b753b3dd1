"""What a call of ensemble() asks for, checked: where members begin, and until when they run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from seacrane import _core
from seacrane.analysis.rest_state import equilibrium
from seacrane.ensembles.members import Members, Over, members_of
from seacrane.ensembles.study import START_TIME, Stages, Start
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, number_of
from seacrane.inputs.shown import shown
from seacrane.run.method import REST

USUAL_END = 100.0  # s


def checked_start(start: Any) -> Start:
    """Where members begin. Raises SceneError for what tells no state."""
    if isinstance(start, str) and start == REST:
        return equilibrium
    if start is not None and not isinstance(start, _core.State) and not callable(start):
        raise SceneError(
            f"start is {shown(start)}; give a seacrane.State, {REST!r}, or a function that returns a State"
        )
    return start  # type: ignore[no-any-return]


def start_times_of(over: Over, stages: Stages) -> tuple[tuple[float, ...], Members]:
    """Times at which lifts begin, s, ascending, and the members, those of one sea next to each other.

    Raises SceneError as `members_of`, for times in a list or design, negative ones, and those of a lift
    without stages.
    """
    if START_TIME not in (over if isinstance(over, Mapping) else members_of(over).axes):
        return (), members_of(over)
    if not isinstance(over, Mapping):
        raise SceneError(f"over: {START_TIME} is of grids; give a mapping of names to values")
    if not stages:
        raise SceneError(f"over: {START_TIME} is of lifts in stages; give stages, or start")
    ordered = {name: values for name, values in over.items() if name != START_TIME}
    members = members_of(ordered | {START_TIME: over[START_TIME]})
    times = [not_negative_of(f"over: {START_TIME}", one, "s") for one in members.axes[START_TIME]]
    return tuple(sorted(times)), members


def end_of(t_end: float | None, stages: Stages) -> float:
    """Until when the members run, s; in stages as long as these take at most, where that is known."""
    if not stages:
        return USUAL_END if t_end is None else number_of("t_end", t_end)
    if t_end is not None:
        raise SceneError(f"ensemble: t_end is {t_end!r}, and stages tell their end; leave t_end out")
    if callable(stages):
        return math.inf
    return float(sum(one.duration or one.maximum_duration or 0.0 for one in stages))
