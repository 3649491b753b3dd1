"""The state of one model carried over to another of the same bodies, with other loads or limits."""

from __future__ import annotations

import numpy as np

from seacrane import _core
from seacrane.run.input_slots import slots_of

WORK_STATES = 2  # at the end of a state's values


def carried(state: _core.State, old: _core.Model, new: _core.Model) -> _core.State:
    """The state for another model of the same bodies and vessels.

    Poses, velocities, fluid memory and histories as they are; states of loads, inputs and limits by their
    names; what is new begins as it is described.
    """
    begun = _core.initial_state(new)
    kept = state.load_states
    first = len(begun.values) - WORK_STATES - len(begun.load_states)
    own = [kept.get(name, value) for name, value in begun.load_states.items()]
    values = np.concatenate([state.values[:first], own, state.values[-WORK_STATES:]])
    inputs, had = np.array(begun.inputs), slots_of(old)
    for name, place in slots_of(new).items():
        if name in had:
            inputs[place] = state.inputs[had[name]]
    return _core.State(
        time=state.time, values=values, inputs=inputs, histories=state.histories,
        closed=_closed(state, old, new, begun), parts=begun.parts,
    )  # fmt: skip


def _closed(state: _core.State, old: _core.Model, new: _core.Model, begun: _core.State) -> list[str]:
    """Limits that hold: those that did, and new ones that do as they are described."""
    before = _core.initial_state(old).closed if state.closed is None else state.closed
    known = {name for name, _ in old.limits}
    there = {name for name, _ in new.limits}
    return [*(n for n in before or () if n in there), *(n for n in begun.closed or () if n not in known)]
