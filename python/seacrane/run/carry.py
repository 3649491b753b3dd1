"""What a stage hands to the next one, or to those alike in other seas, and where a lift in stages begins."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from seacrane import _core
from seacrane.analysis.rest_state import equilibrium, led
from seacrane.arrays import Array
from seacrane.description.description import Some
from seacrane.description.given import given_drivers, led_by
from seacrane.description.loads import winches_of, with_length
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.inputs.frames import quaternion_product, rotation_matrix
from seacrane.run.carried_state import carried
from seacrane.run.commands import Move, taken_up
from seacrane.run.plan import waiting, without
from seacrane.run.run import Run
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene
from seacrane.warnings import AssemblyWarning

LEAD = 5.0  # s of a way along which a given ship is led to where its motion has it
MOST_RUNS = 64  # alike: behind an event, a stage begins at its own time in every sea
Key = tuple[str, float, frozenset[str]]  # a stage, when it began (s), what was absent


def redescribed(scene: Some, measured: Mapping[str, Array], state: _core.State) -> Some:
    """The scene with its bodies described where they are, so that joints that close there can be compiled.

    Vessels stay as described, because their mean position and heading are; the others keep their places
    relative to the first vessel. Drivers begin at their present value, lines at their winch's length.
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


@dataclass(frozen=True)
class Begin:
    """Where a stage began, to run it again from: just before its connections and commands.

    The scene is that with the commands of the stages before, and with what later stages connect.
    """

    scene: Scene
    state: _core.State


@dataclass(frozen=True, kw_only=True)
class There:
    """Where a lift is between two stages: the scene as it is there, and `whole` with what is absent."""

    whole: Scene
    absent: frozenset[str]
    scene: Scene
    model: _core.Model
    state: _core.State


def rest_after(calm: There, later: Sequence[Stage], scene: Scene, start: _core.State | None) -> Begin:
    """Where a lift stands still that was carried out in calm water until then, in the sea of a scene.

    What still moved is at rest, and takes its way up from there. Seats that let go stay open. From a state
    that is known there (`start`), all goes on as it was. Raises SceneError where nothing rests there.
    """
    time = calm.state.time
    if start is not None:
        return Begin(_in_sea(without(calm.whole, calm.absent - waiting(later)), scene, time), start)
    gone = (calm.absent | lifted_seats(calm.scene, calm.state)) - waiting(later)
    still = taken_up(without(calm.whole, gone), time)
    moving = _in_sea(still, scene, time)
    there = without(still, waiting(later))
    try:
        state = equilibrium(there, state=carried(calm.state, calm.model, compiled_there(there)))
        if given_drivers(scene):
            state = _aboard(there, without(moving, waiting(later)), state)
    except SceneError as error:
        first = later[0].name
        raise SceneError(
            f"first is {first!r}, and nothing rests where the stages before it lead: {error}. Begin with an "
            f"earlier one, or give start=, the state in which {first!r} begins"
        ) from error
    return Begin(moving, state)


def _in_sea(still: Scene, scene: Scene, time: float) -> Scene:
    """The sea and the motion of given ships from a time on, s."""
    curves = {
        name: still.drivers[name].curve.then(time=time, curve=scene.drivers[name].curve)
        for name in given_drivers(scene)
    }
    return led_by(still, curves).copy(waves=scene.waves)


def _aboard(still: Scene, moving: Scene, state: _core.State) -> _core.State:
    """The state at rest on given ships that stand where they are at that time."""
    time, curves = state.time, {}
    for name in given_drivers(moving):
        place = float(moving.drivers[name].curve.evaluate([time])[0, 0])
        way = Move(to=place, over=LEAD).from_where_it_is(still.drivers[name].curve, time)
        curves[name] = way
    there = led(led_by(still, curves), state, time=time + LEAD)
    return equilibrium(moving, state=there)


@dataclass
class AlikeStages:
    """Found by the first of them, and used by the others; threads may share it."""

    model: _core.Model | None = None  # of the scene before the first stage
    channels: dict[frozenset[str], set[str]] = field(default_factory=dict)  # known names, by what is absent
    runs: dict[Key, Run] = field(default_factory=dict)  # of stages, at their start
