"""Inputs by name: where the core keeps them, and what may be set."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.places import ANGLES
from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of
from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
ACTUATOR_INPUTS = ("force", "reference", "reference_rate")


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
        _check_turn(scene, name, float(new[0] - old[0]))
        slots[places[name]] = new
    return slots


def _check_turn(scene: Scene, name: str, jump: float) -> None:
    """An actuator takes the turn of an angle that is nearest to its reference."""
    owner, _, kind = name.rpartition(".")
    if kind == "reference" and scene.actuators[owner].coordinate in ANGLES and abs(jump) >= np.pi:
        raise SceneError(
            f"input {name!r} jumps by {np.degrees(jump):.6g} deg, half a turn or more: it would turn the "
            "short way; lead it there in smaller steps"
        )


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
