"""The state of one stage carried over to the scene of the next, where other elements are there."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.assembled import AssemblyWarning
from seacrane.description.loads import lines_of
from seacrane.description.scene import Some
from seacrane.inputs.frames import quaternion_product, rotation_matrix
from seacrane.run.input_slots import slots_of
from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
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


def _closed(
    state: _core.State, old: _core.Model, new: _core.Model, begun: _core.State
) -> list[str]:
    """Limits that hold: those that did, and new ones that do as they are described."""
    before = _core.initial_state(old).closed if state.closed is None else state.closed
    known = {name for name, _ in old.limits}
    there = {name for name, _ in new.limits}
    return [*(n for n in before or () if n in there), *(n for n in begun.closed or () if n not in known)]


def redescribed(scene: Some, measured: Mapping[str, Array], state: _core.State) -> Some:
    """The scene with its bodies described where they are, so that joints that close there can be compiled.

    Vessels stay as described, because their mean position and heading are; the others keep their places
    relative to the first vessel. Drivers begin at their present value, lines at their winch's length.

    Parameters
    ----------
    measured : mapping
        Channels of the present instant.
    """
    out = scene.copy()
    floating = {vessel.body for vessel in scene.vessels.values()}
    names = list(scene.bodies)
    turn, shift, now = _Way.none(), np.zeros(3), None
    if floating:
        vessel = next(iter(scene.vessels.values())).body
        now = _Placed(scene, measured, names.index(vessel), vessel)
        body = scene.bodies[vessel]
        turn = _Way(np.asarray(body.quaternion), now.quaternion)
        shift = np.asarray(body.position) - turn.matrix @ now.origin
    for index, name in enumerate(names):
        if name in floating:
            continue
        pose = _Placed(scene, measured, index, name)
        velocity, spin = pose.velocity, pose.spin
        if now is not None:
            velocity = velocity - now.velocity - np.cross(now.spin, pose.origin - now.origin)
            spin = spin - now.spin
        changes = {
            "position": turn.matrix @ pose.origin + shift, "velocity": turn.matrix @ velocity,
            "quaternion": quaternion_product(turn.quaternion, pose.quaternion),
            "angular_velocity": turn.matrix @ spin,
        }  # fmt: skip
        out.bodies[name] = _core.Body(**scene.bodies[name].__getstate__() | changes)
    for name, driver in scene.drivers.items():
        held = _core.Curve.constant(value=float(driver.curve.evaluate([state.time])[0, 0]))
        curve = held.then(time=state.time, curve=driver.curve) if state.time > 0.0 else driver.curve
        out.drivers[name] = _core.Driver(**driver.__getstate__() | {"curve": curve})
    lengths = state.load_states
    for name, line in lines_of(scene.loads).items():
        if f"{name}.length" in lengths:
            length = {"length": lengths[f"{name}.length"]}
            out.loads[name] = _core.Line(**line.__getstate__() | length)
    return out


class _Way:
    """The rotation from the present orientation of a vessel to the described one."""

    def __init__(self, described: Array, present: Array) -> None:
        w, *vector = present
        self.quaternion = quaternion_product(described, np.array([w, *(-np.array(vector))]))
        self.matrix = rotation_matrix(self.quaternion)

    @classmethod
    def none(cls) -> _Way:
        still = np.array([1.0, 0.0, 0.0, 0.0])
        return cls(still, still)


class _Placed:
    """Where a body's origin is, and how it moves."""

    def __init__(self, scene: Scene, measured: Mapping[str, Array], index: int, name: str) -> None:
        self.quaternion = np.asarray(measured["quaternion"][index])
        lever = rotation_matrix(self.quaternion) @ np.asarray(scene.bodies[name].center_of_mass)
        self.spin = np.asarray(measured["angular_velocity"][index])
        self.origin = np.asarray(measured["position"][index]) - lever
        self.velocity = np.asarray(measured["velocity"][index]) - np.cross(self.spin, lever)


def compiled_there(scene: Scene) -> _core.Model:
    """The model of a scene that was described where it is: what assembly then moves is told elsewhere."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AssemblyWarning)
        return scene.compile()
