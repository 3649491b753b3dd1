"""What a report of statics tells of one state at rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.inverse import channels_at, drive_name
from seacrane.analysis.reduced_coordinates import NEUTRAL, POSE, ReducedCoordinates, Terms
from seacrane.analysis.rest_state import held
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import (  # fmt: skip
    cylinders,
    luffing_ropes,
    luffs,
    piston_areas,
    placed,
    slews,
    tip_radius,
)
from seacrane.description.description import Description
from seacrane.description.given import given_vessels
from seacrane.description.loads import changed, lines_of
from seacrane.description.roles import LuffingRope, lengthening, pressure
from seacrane.description.rungs import ELASTIC, RIGID
from seacrane.description.suspension import ROD, Suspension, hung_loads, names_of_suspensions
from seacrane.inputs.frames import heading_of, heel_and_trim, rotation_matrix
from seacrane.one_thread import one_thread
from seacrane.run.channel_names import lowest_segments
from seacrane.run.derived import hook_loads

LINES = {"line_tension": ("tension", "N"), "line_length": ("length", "m"),
         "line_unstretched_length": ("unstretched length", "m")}  # fmt: skip
HOOK_STIFFNESS = "hook stiffness"
CHANNELS = {"driver_force", "tension", "end_tension", "position", "quaternion", *LINES}
LEAST_SAG = 1e-12  # m/N: less is none


@dataclass(frozen=True, kw_only=True, eq=False)
class AtRest:
    """A posed scene at rest: its model, its state, and the channels that were evaluated there."""

    scene: Description
    model: _core.Model
    state: _core.State
    channels: Mapping[str, Array]

    @classmethod
    def of(cls, scene: Description, state: _core.State) -> AtRest:
        """What holds of a posed scene and a state at rest of it."""
        model = compile_scene(held(scene, time=state.time))
        channels = channels_at(model, CHANNELS, state.time, np.array(state.values))
        return cls(scene=scene, model=model, state=state, channels=channels)

    def drive(self, joint: str, coordinate: str) -> float:
        """Load of the drive that holds a coordinate, N or N m."""
        drivers = [name for name, kind, _, _ in self.model.elements if kind == "driver"]
        return float(self.channels["driver_force"][drivers.index(drive_name((joint, coordinate)))])

    def rope_tension(self, place: tuple[str, str], rope: LuffingRope) -> float:
        """Tension of each fall of a rope that carries a hinge's moment, N; below zero: it would be slack."""
        joint = self.scene.joints[place[0]]
        hinge, turn = self._placed(joint.first, joint.first_frame.point)
        first, second = (self._placed(*block)[0] for block in (rope.first, rope.second))
        rate = lengthening(hinge, turn @ np.asarray(joint.first_frame.axes)[:, 2], first, second)
        return -self.drive(*place) / (rope.falls * rate)

    def _placed(self, body: str, point: Any) -> tuple[Array, Array]:
        return placed(self.scene, body, point, self.channels["position"], self.channels["quaternion"])

    def stiffness(self, hoist: Suspension) -> float:
        """Vertical force over sag of its lower end, N/m, the vessels held; NaN of a line that is slack."""
        body, point = hoist.lower
        found = hook_stiffness(self.scene, self.model, self.state, body=body, point=point)
        return found if np.isfinite(found) or hoist.rung in (ROD, RIGID) else np.nan


def columns_of(at_rest: AtRest) -> dict[str, tuple[str, float]]:
    """Unit (SI) and value of everything that is told, by name."""
    return {**_vessels(at_rest), **_cranes(at_rest), **_hoists(at_rest), **_lines(at_rest)}


def pulls_of(at_rest: AtRest) -> dict[str, tuple[str, float]]:
    """Of hooks, lines, and rods and wires that no load of a crane hangs on: unit (SI) and value, by name."""
    joints = [name for name, joint in at_rest.scene.joints.items() if joint.kind == "distance"]
    carried = _hook_loads(at_rest)
    rods = {f"tension {name}": ("N", carried[name]) for name in joints
            if name in carried and name not in at_rest.model.redundant}  # fmt: skip
    return {**rods, **_hoists(at_rest), **_lines(at_rest)}


def _vessels(at_rest: AtRest) -> dict[str, tuple[str, float]]:
    scene, model, found = at_rest.scene, at_rest.model, {}
    values, given = np.array(at_rest.state.values), given_vessels(scene)
    for vessel in scene.vessels.values():
        which = f" {vessel.name}" if len(scene.vessels) > 1 else ""
        motion = attitude(values, model, vessel.body)
        found[f"heel{which}"] = ("rad", float(motion[3]))
        found[f"trim{which}"] = ("rad", float(motion[4]))
        found[f"draught change{which}"] = ("m", float(-motion[2]))
        if not vessel.floats or vessel.body in given:  # it stands as it is given, whatever hangs on it
            continue
        stiffness = heeling_stiffness(model, values, at_rest.state.time, vessel.body)
        own = scene.bodies[vessel.body].mass * scene.gravity  # and what the ship displaces, N
        weight = float(own - np.asarray(vessel.restoring)[2, 2:5] @ motion[2:5])
        found[f"GM{which}"] = ("m", stiffness / weight)
        known = scene.provenance.get(vessel.name)
        if known is not None and any(known.taken):
            taken, least, most = known.taken
            found[f"GM solid{which}"] = ("m", (stiffness + taken) / weight)
            found[f"GM spread{which}"] = ("m", (most - least) / weight)
    return found


def _cranes(at_rest: AtRest) -> dict[str, tuple[str, float]]:
    scene, found = at_rest.scene, {}
    for roles in scene.roles.values():
        if roles.slew is not None and roles.tip is not None:
            radius = tip_radius(scene, roles, at_rest.channels["position"], at_rest.channels["quaternion"])
            found[f"{roles.prefix}tip radius"] = ("m", float(radius))
        if roles.tip is not None:
            found[f"{roles.prefix}tip height"] = ("m", float(at_rest._placed(*roles.tip)[0][2]))
    areas = piston_areas(scene)
    for label, joint in cylinders(scene).items():
        force = at_rest.drive(joint, "displacement")
        found[f"cylinder force {label}"] = ("N", force)
        if label in areas:
            found[f"cylinder pressure {label}"] = ("Pa", float(pressure(force, areas[label])))
    for label, place in luffs(scene).items():
        found[f"luff moment {label}"] = ("N m", at_rest.drive(*place))
    for label, rope in luffing_ropes(scene).items():
        found[f"rope tension {label}"] = ("N", at_rest.rope_tension(luffs(scene)[label], rope))
    several = len(slews(scene)) > 1
    for label, place in slews(scene).items():
        found[f"slew torque {label}" if several else "slew torque"] = ("N m", at_rest.drive(*place))
    return found


def _lines(at_rest: AtRest) -> dict[str, tuple[str, float]]:
    """Load, tension and lengths of elastic lines, as they are stretched."""
    scene, found = at_rest.scene, {}
    lines = lines_of(scene.loads)
    carried = _hook_loads(at_rest)
    hung = {part for one in hung_loads(scene) for part in one.suspension.parts}
    for i, name in enumerate(lines):
        if name not in hung:
            found[f"hook load {name}"] = ("N", carried.get(f"{name} line", carried.get(name, np.nan)))
        for channel, (what, unit) in LINES.items():
            found[f"line {what} {name}"] = (unit, float(at_rest.channels[channel][i]))
    return found


def _hoists(at_rest: AtRest) -> dict[str, tuple[str, float]]:
    """Load on each hook, and tension of what it hangs on, at the upper end: of a line in one of its falls."""
    every, carried, found = hung_loads(at_rest.scene), _hook_loads(at_rest), {}
    lines, heavy = list(lines_of(at_rest.scene.loads)), lowest_segments(at_rest.scene)
    several = sum(one.crane is not None for one in every) > 1
    for one in every:
        label = "" if one.crane is not None and not several else f" {one.label}"
        found[f"hook load{label}"] = ("N", carried[one.suspension.channel])
        top = one.suspension.top.removesuffix(" line")
        if one.suspension.channel in heavy:
            pull = at_rest.channels["end_tension"][heavy[one.suspension.channel], 0]
        else:
            pull = at_rest.channels["line_tension"][lines.index(top)] if top in lines else carried[top]
        found[f"hoist tension{label}"] = ("N", float(pull))
        if one.crane is not None:
            found[f"{HOOK_STIFFNESS}{label}"] = ("N/m", at_rest.stiffness(one.suspension))
    return found


def _hook_loads(at_rest: AtRest) -> dict[str, float]:
    """N, by the names along `suspension`."""
    loads = hook_loads(at_rest.scene, {name: values[None] for name, values in at_rest.channels.items()})
    names = names_of_suspensions(at_rest.scene)
    return {} if loads is None else dict(zip(names, map(float, loads[0]), strict=True))


@one_thread
def heeling_stiffness(model: _core.Model, values: Array, time: float, body: str) -> float:
    """Heeling moment for each radian of heel, N m/rad, at rest: all else follows, hanging loads swing.

    The stiffness of the whole scene, K = -M da/dq in its minimal coordinates, is solved for a heeling moment.
    What nothing brings back stays where it is.
    """
    terms = Terms(model, time=time)
    coordinates = ReducedCoordinates.at(terms, values)
    basis, mass = coordinates.basis, np.asarray(terms.evaluator.terms(time, values)["mass"])
    k = list(model.bodies).index(body)
    at = model.pose_index(k)
    heading = heading_of(values[at + 3 : at + 7])
    forward = np.array([np.cos(heading), np.sin(heading), 0.0])
    turn = basis[6 * k + 3 : 6 * k + 6].T @ forward
    acceleration = np.linalg.solve(basis.T @ mass @ basis, turn)
    heel = float(turn @ _yielding(coordinates.stiffness(), acceleration))
    return 1.0 / heel if heel else float("inf")  # a ship whose motion is given does not heel


def attitude(values: Array, model: _core.Model, body: str) -> Array:
    """Height (m), roll and pitch (rad) of a vessel's reference point, as (6,) motions without the others."""
    at = model.pose_index(list(model.bodies).index(body))
    return np.array([0.0, 0.0, values[at + 2], *heel_and_trim(values[at + 3 : at + 7]), 0.0])


@one_thread
def hook_stiffness(
    scene: Description, model: _core.Model, state: _core.State, *, body: str, point: ArrayLike
) -> float:
    """Vertical force over sag of a point of a body (its coordinates, m) at rest, N/m; infinite if rigid.

    The stiffness of the whole scene in its minimal coordinates and the states of its loads, as of
    `heeling_stiffness`, with the twists of floating vessels held at zero.
    """
    model, values = _elastic(scene, model, state)
    terms = Terms(model, time=state.time)
    coordinates = ReducedCoordinates.at(terms, values)
    basis, names = coordinates.basis, list(model.bodies)
    mass = basis.T @ np.asarray(terms.evaluator.terms(state.time, values)["mass"]) @ basis
    free = _held_free(scene, names, basis)
    matrix, _, _ = coordinates.rest_matrix()
    dof = coordinates.size
    inner = free.T @ mass
    small = inner @ free
    reduced = np.block([
        [np.linalg.solve(small, inner @ matrix[:dof, :dof] @ free),
         np.linalg.solve(small, inner @ matrix[:dof, dof:])],
        [matrix[dof:, :dof] @ free, matrix[dof:, dof:]],
    ])  # fmt: skip
    down = free.T @ (basis.T @ _vertical(scene, model, values, names.index(body), point))
    acceleration = np.concatenate([np.linalg.solve(small, down), np.zeros(len(matrix) - dof)])
    sag = float(down @ _yielding(reduced, acceleration)[: free.shape[1]])
    return 1.0 / sag if sag > LEAST_SAG else np.inf


def _yielding(stiffness: Array, acceleration: Array) -> Array:
    """How far a stiffness (acceleration over coordinates) lets a load move what something brings back."""
    u, size, vt = np.linalg.svd(-stiffness)
    fixed = size > NEUTRAL
    return np.asarray(vt[fixed].T @ ((u.T @ acceleration)[fixed] / size[fixed]))


def _elastic(scene: Description, model: _core.Model, state: _core.State) -> tuple[_core.Model, Array]:
    """Model and values with lines that stretch at once: a quasi-static one has an inertia beside its EA."""
    values = np.array(state.values)
    lines = {name: line for name, line in lines_of(scene.loads).items() if line.rung != ELASTIC}
    if not lines:
        return model, values
    at_once = {name: changed(line, rung=ELASTIC) for name, line in lines.items()}
    other = compile_scene(held(scene.copy(loads=dict(scene.loads) | at_once), time=state.time))
    out, poses = np.array(other.initial_state), POSE * len(model.bodies)
    out[:poses] = values[:poses]
    known = {name: place for name, _, place, *_ in model.load_states}
    for name, _, place, *_ in other.load_states:
        out[place] = values[known[name]]
    return other, out


def _held_free(scene: Description, names: list[str], basis: Array) -> Array:
    """Directions of the coordinates (dof, k) in which no floating vessel moves."""
    floating = [names.index(one.body) for one in scene.vessels.values() if one.floats]
    if not floating:
        return np.eye(basis.shape[1])
    rows = np.concatenate([basis[6 * k : 6 * k + 6] for k in floating])
    _, size, vt = np.linalg.svd(rows)
    rank = int(np.sum(size > 1e-9 * max(size.max(initial=0.0), 1e-9)))
    return vt[rank:].T


def _vertical(scene: Description, model: _core.Model, values: Array, k: int, point: ArrayLike) -> Array:
    """A unit force upwards at a point of the k-th body, (6 n,), moments about the state points."""
    body = scene.bodies[model.bodies[k]]
    at = model.pose_index(k)
    floats = any(one.body == body.name for one in scene.vessels.values())
    start = np.zeros(3) if floats else np.asarray(body.center_of_mass)
    lever = rotation_matrix(values[at + 3 : at + 7]) @ (np.asarray(point) - start)
    out = np.zeros(6 * len(model.bodies))
    out[6 * k : 6 * k + 3] = (0.0, 0.0, 1.0)
    out[6 * k + 3 : 6 * k + 6] = (lever[1], -lever[0], 0.0)
    return out
