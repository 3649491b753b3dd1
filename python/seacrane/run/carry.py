"""The state of one stage carried over to the scene of the next, where other elements are there."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Some
from seacrane.description.loads import winches_of, with_length
from seacrane.inputs.caller import silently
from seacrane.inputs.frames import quaternion_product, rotation_matrix
from seacrane.scene.scene import Scene
from seacrane.warnings import AssemblyWarning

Array = NDArray[np.float64]


def redescribed(scene: Some, measured: Mapping[str, Array], state: _core.State) -> Some:
    """The scene with its bodies described where they are, so that joints that close there can be compiled.

    Vessels stay as described, because their mean position and heading are; the others keep their places
    relative to the first vessel. Drivers begin at their present value, lines at their winch's length.

    Parameters
    ----------
    measured : Channels of the present instant.
    """
    out = scene.copy()
    floating = {vessel.body: None for vessel in scene.vessels.values() if vessel.floats}
    now = {name: _Placed(body, measured, at) for at, (name, body) in enumerate(scene.bodies.items())}
    way = _Way(None, None)
    for ship in list(floating)[:1]:
        way = _Way(scene.bodies[ship], now[ship])
    for name, body in scene.bodies.items():
        if name not in floating:
            out.bodies[name] = _core.Body(**body.__getstate__() | way.described(now[name]))
    for name, driver in scene.drivers.items():
        held = _core.Curve.constant(value=float(driver.curve.evaluate([state.time])[0, 0]))
        curve = held.then(time=state.time, curve=driver.curve) if state.time > 0.0 else driver.curve
        out.drivers[name] = _core.Driver(**driver.__getstate__() | {"curve": curve})
    lengths = state.load_states
    for winch in winches_of(scene.loads):
        if f"{winch}.length" in lengths:
            out.loads.update(with_length(scene.loads, winch, lengths[f"{winch}.length"]))
    return out


def lifted_seats(scene: Scene, state: _core.State) -> set[str]:
    """Joints of seats that hold no more: described anew, they would hold again."""
    if state.closed is None:
        return set()
    seats = [load for load in scene.loads.values() if isinstance(load, _core.Limit) and load.kind == "seat"]
    return {seat.joint for seat in seats if seat.name not in state.closed}


class _Placed:
    """Where a body's origin is, and how it moves."""

    def __init__(self, body: _core.Body, measured: Mapping[str, Array], index: int) -> None:
        self.quaternion = np.asarray(measured["quaternion"][index])
        lever = rotation_matrix(self.quaternion) @ np.asarray(body.center_of_mass)
        self.spin = np.asarray(measured["angular_velocity"][index])
        self.origin = np.asarray(measured["position"][index]) - lever
        self.velocity = np.asarray(measured["velocity"][index]) - np.cross(self.spin, lever)


class _Way:
    """The motion that takes a vessel from where it is to where it is described; of none: no motion."""

    def __init__(self, described: _core.Body | None, ship: _Placed | None) -> None:
        self.ship = ship
        self.quaternion, self.shift = np.array([1.0, 0.0, 0.0, 0.0]), np.zeros(3)
        if described is not None and ship is not None:
            back = ship.quaternion * (1.0, -1.0, -1.0, -1.0)
            self.quaternion = quaternion_product(described.quaternion, back)
            self.shift = np.asarray(described.position) - rotation_matrix(self.quaternion) @ ship.origin

    def described(self, body: _Placed) -> dict[str, Array]:
        """Entries of a body that goes along, its velocity relative to the vessel."""
        turn, velocity, spin = rotation_matrix(self.quaternion), body.velocity, body.spin
        if self.ship is not None:
            carried = self.ship.velocity + np.cross(self.ship.spin, body.origin - self.ship.origin)
            velocity, spin = velocity - carried, spin - self.ship.spin
        return {
            "position": turn @ body.origin + self.shift,
            "quaternion": quaternion_product(self.quaternion, body.quaternion),
            "velocity": turn @ velocity,
            "angular_velocity": turn @ spin,
        }


def compiled_there(scene: Scene) -> _core.Model:
    """The model of a scene that was described where it is: what assembly then moves is told elsewhere."""
    with silently(AssemblyWarning):
        return scene.compile()
