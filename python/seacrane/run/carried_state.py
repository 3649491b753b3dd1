"""Inputs of a model by name, and the state of one model carried over to another of the same bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.places import ANGLES
from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of
from seacrane.scene.scene import Scene

WORK_STATES = 2  # at the end of a state's values
ACTUATOR_INPUTS = ("force", "reference", "reference_rate")


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
    before = _core.initial_state(old).closed if state.closed is None else state.closed
    known, there = ({name for name, _ in model.limits} for model in (old, new))
    closed = [name for name in before or () if name in there]  # those that held
    closed += [name for name in begun.closed or () if name not in known]  # and new ones, as described
    return _core.State(
        time=state.time, values=values, inputs=inputs, histories=state.histories, closed=closed,
        parts=begun.parts,
    )  # fmt: skip


def slots_of(model: _core.Model) -> dict[str, slice]:
    """Places of the inputs."""
    return {name: slice(first, first + count) for name, first, count in model.inputs}


def changed_inputs(scene: Scene, model: _core.Model, present: Array, values: Mapping[str, Any]) -> Array:
    """The inputs with some of them replaced by name; SceneError for what is unknown or makes no sense."""
    places = slots_of(model)
    slots = np.array(present)
    for name, value in values.items():
        if name not in places:
            raise SceneError(f"input {name!r} is unknown; this scene has: {', '.join(places) or 'none'}")
        new = np.atleast_1d(numbers_of(f"input {name!r}", value))
        old = slots[places[name]]
        if new.shape != old.shape or not np.isfinite(new).all():
            raise SceneError(f"input {name!r} is {value!r}; give {old.size} finite number(s)")
        owner, _, kind = name.rpartition(".")
        turns = kind == "reference" and scene.actuators[owner].coordinate in ANGLES
        if turns and abs(jump := float(new[0] - old[0])) >= np.pi:  # it takes the turn that is nearest
            raise SceneError(
                f"input {name!r} jumps by {np.degrees(jump):.6g} deg, half a turn or more: it would turn the "
                "short way; lead it there in smaller steps"
            )
        slots[places[name]] = new
    return slots


def steered(scene: Scene, model: _core.Model, inputs: Array) -> set[str]:
    """Actuators whose inputs are not zero."""
    values = np.asarray(inputs)
    if not values.any():
        return set()
    places = slots_of(model)
    return {
        name
        for name in scene.actuators
        if any(np.any(values[places[f"{name}.{kind}"]] != 0.0) for kind in ACTUATOR_INPUTS)
    }
