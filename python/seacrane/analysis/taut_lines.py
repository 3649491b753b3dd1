"""Elastic lines that a search for rest takes as taut: one without stretch has no stiffness either."""

from __future__ import annotations

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description, Some
from seacrane.description.line_path import Pose, laid
from seacrane.description.loads import changed, length_at, lines_of, states_of, winch_of, winches_of
from seacrane.description.rungs import WITH_MASS
from seacrane.description.suspension import bodies_below
from seacrane.inputs.frames import rotation_matrix

LARGEST_SLACK = 0.01  # of the length: a line with more of it is meant to hang
STRAIN = 1e-6  # that it is given
NO_BOUND = 1e7  # m/s and m/s2: the engine takes it as none


def tautened(scene: Some, values: Array) -> tuple[Some, Array] | None:
    """The scene and its state with lines shortened that are slack by little; None if there is none.

    `values` is a state of the scene, whose orientation is the quaternion.
    """
    model = compile_scene(scene, merge=False)
    places = {name: place for name, _, place, *_ in model.load_states}
    out, state, found = scene.copy(), np.array(values), False
    known = states_of(model, values)
    for name, line in lines_of(scene.loads).items():
        length = length_at(line, 0.0, known)
        path = laid(line, lambda body: pose_of(scene, model, body, values)).length
        if not (1.0 - LARGEST_SLACK) * length <= path <= (1.0 + STRAIN) * length:
            continue
        found = True
        if winch_of(line):
            paid_out = places[f"{winch_of(line)}.length"]
            state[paid_out] = min(state[paid_out], path / (1.0 + STRAIN) / line.share)
        else:
            out.loads[name] = changed(line, length=path / (1.0 + STRAIN))
    return (out, state) if found else None


def with_what_hangs(
    scene: Description, model: _core.Model, before: Array, after: Array, *, least: float = 0.0
) -> Array:
    """The later of two states, with what hangs on lines moved as far as what holds them, from `least` (m) on.

    A line that is stretched by metres on the way to a pose would throw what it is made of about.
    """
    out, moved = np.array(after), set[str]()
    for line, bodies in bodies_below(scene):
        if line.name in scene.joints or moved & set(bodies):
            continue
        body, point = line.held_at
        ends = [
            place + turn @ point for place, turn in (pose_of(scene, model, body, y) for y in (before, after))
        ]
        if np.max(np.abs(ends[1] - ends[0])) < least:
            continue
        for name in bodies:
            at = model.pose_index(list(model.bodies).index(name))
            out[at : at + 3] = before[at : at + 3] + ends[1] - ends[0]
        moved |= set(bodies)
    return out


def has_masses(scene: Description) -> bool:
    """Whether something hangs on a line with mass, and on nothing else."""
    return any(line.rung == WITH_MASS for line, _ in bodies_below(scene))


def unbounded(scene: Some) -> Some:
    """The scene with winches that hold a tension at any rate: one at its bound shows no stiffness."""
    wound = {
        name: changed(line, maximum_rate=NO_BOUND, maximum_acceleration=NO_BOUND)
        for name, line in lines_of(scene.loads).items()
        if line.tension_gain > 0.0
    }
    return scene.copy(loads=dict(scene.loads) | wound) if wound else scene


def kept_lengths(scene: Description, model: _core.Model) -> list[int]:
    """Places of the states of loads, but for those of winches that hold a tension."""
    holds = {name for name, line in winches_of(scene.loads).items() if line.tension_gain > 0.0}
    return [place for name, _, place, *_ in model.load_states if name.rpartition(".")[0] not in holds]


def slack_lines(scene: Description, model: _core.Model, values: Array) -> dict[str, float]:
    """By how much (m) lines are slack in a state."""
    found, known = {}, states_of(model, values)
    for name, line in lines_of(scene.loads).items():
        path = laid(line, lambda body: pose_of(scene, model, body, values)).length
        slack = float(length_at(line, 0.0, known) - path)
        if slack > 0.0:
            found[name] = slack
    return found


def pose_of(scene: Description, model: _core.Model, body: str, values: Array) -> Pose:
    """The pose of a body's origin; the state holds the centre of mass, of a vessel its origin."""
    if body not in scene.bodies:
        return np.zeros(3), np.eye(3)
    at = model.pose_index(list(model.bodies).index(body))
    rotation = rotation_matrix(values[at + 3 : at + 7])
    floating = {vessel.body for vessel in scene.vessels.values()}
    start = np.zeros(3) if body in floating else np.asarray(scene.bodies[body].center_of_mass)
    return values[at : at + 3] - rotation @ start, rotation
