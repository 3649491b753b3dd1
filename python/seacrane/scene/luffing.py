"""Luffing ropes as elastic lines on winches."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import luffing_ropes, luffs
from seacrane.description.description import GROUND, Description
from seacrane.description.line_path import Pose, described_poses, laid
from seacrane.description.loads import lines_of
from seacrane.description.luffing_rope import LuffingRope, lengthening
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.scene.lines import add_line, add_winch

Array = NDArray[np.float64]
SMALL = 1e-5  # rad, over which lengths are differenced


def add_luffing_rope(scene: Description, *, luff: str | None = None, **winch: Any) -> _core.Line:
    """Let a crane's luffing rope carry its jib, as an elastic line of all its falls on a winch.

    The rope starts with the tension that holds the weights beyond the hinge, and the pull of the lines that
    are there, at rest on an upright base: add the hoist before it. A driver that holds the hinge still
    (`add_crane(held=True)`) is taken away. The rope's name is that in the crane's file, such as "luffing
    rope"; `statics` with coordinates leads the hinge and tells the tension from its moment.

    Parameters
    ----------
    luff : str, optional
        Label of the hinge, with the crane's prefix; default: the only one with a rope.
    **winch
        As of `add_winch`, such as ``rate`` in m/s of rope: a luffing hook moves by the rate over the falls.

    Raises
    ------
    SceneError
        For a hinge without a rope, one that a moving driver or an actuator leads, or a rope that would have
        to push.
    """
    label = _which(scene, luff)
    rope, (joint, coordinate) = luffing_ropes(scene)[label], luffs(scene)[label]
    what = f"luffing rope {rope.name!r}"
    for name, driver in list(scene.drivers.items()):
        if (driver.joint, driver.coordinate) == (joint, coordinate):
            if driver.curve != _core.Curve.constant(value=0.0):
                raise SceneError(f"{what}: driver {name!r} leads its hinge; take the driver out first")
            del scene.drivers[name]
    led = [
        name for name, one in scene.actuators.items() if (one.joint, one.coordinate) == (joint, coordinate)
    ]
    if led:
        raise SceneError(f"{what}: actuator {led[0]!r} drives its hinge; take one of them out")
    ends = [rope.first if i % 2 == 0 else rope.second for i in range(rope.falls + 1)]
    add_line(
        scene,
        name=rope.name,
        bodies=[body for body, _ in ends],
        points=[point for _, point in ends],
        EA=rope.EA,
        tension_at_start=_tension(scene, what, joint, rope),
    )
    return add_winch(scene, line=rope.name, **winch)


def _which(scene: Description, luff: str | None) -> str:
    known = luffing_ropes(scene)
    label = next(iter(known)) if luff is None and len(known) == 1 else luff
    if label not in known:
        which = ", ".join(map(repr, known)) or "none"
        raise SceneError(f"luffing rope: luff is {shown(luff)}; the hinges with a rope are {which}")
    return str(label)


def _tension(scene: Description, what: str, joint: str, rope: LuffingRope) -> float:
    """The tension of each fall, N, that carries what is beyond the hinge at the described pose: virtual work.

    That is the weights of the bodies there, and the pull of the lines that run to others.
    """
    described = scene.joints[joint]
    hinge = _at(scene, described.first, np.asarray(described.first_frame.point))
    turn = _turn(scene, described.first)
    axis = turn @ np.asarray(described.first_frame.axes)[:, 2]
    up = np.array([0.0, 0.0, 1.0])
    beyond = set(_beyond(scene, joint))
    moment = _moment_of_lines(scene, beyond, hinge, axis)
    for body in sorted(beyond):
        one = scene.bodies[body]
        center = one.position + _turn(scene, body) @ np.asarray(one.center_of_mass)
        moment -= one.mass * scene.gravity * float(up @ np.cross(axis, center - hinge))
    first, second = (_at(scene, body, np.array(point)) for body, point in (rope.first, rope.second))
    tension = moment / (rope.falls * lengthening(hinge, axis, first, second))
    if not tension >= 0.0:
        raise SceneError(
            f"{what}: would have to push by {-tension:.4g} N as described: the jib falls backwards; describe "
            "it lower"
        )
    return tension


def _moment_of_lines(scene: Description, beyond: set[str], hinge: Array, axis: Array) -> float:
    """About the hinge, N m, of the lines between bodies beyond it and others, as described: -T dl/dangle."""
    lines = lines_of(scene.loads)
    ends = {name: {*line.bodies} for name, line in lines.items()}
    pulling = [name for name, bodies in ends.items() if bodies & beyond and bodies - beyond]
    if not pulling:
        return 0.0
    tensions, poses = _tensions(scene), described_poses(scene)

    def length(name: str, angle: float) -> float:
        turn = rotation_matrix([np.cos(0.5 * angle), *(np.sin(0.5 * angle) * axis)])

        def pose(body: str) -> Pose:
            origin, rotation = poses(body)
            return (
                (hinge + turn @ (origin - hinge), turn @ rotation) if body in beyond else (origin, rotation)
            )

        return laid(lines[name], pose).length

    slopes = {name: (length(name, SMALL) - length(name, -SMALL)) / (2.0 * SMALL) for name in pulling}
    return -float(sum(tensions[name] * slope for name, slope in slopes.items()))


def _tensions(scene: Description) -> dict[str, float]:
    """The tensions of all lines as described, N."""
    model = compile_scene(scene)
    run = _core.Simulation(
        model=model,
        start=_core.initial_state(model),
        options=_core.RunOptions(integrator="rk4", output_times=[0.0], channels={"line_tension"}),
    )
    return dict(zip(lines_of(scene.loads), run.channels()["line_tension"][0].tolist(), strict=True))


def _beyond(scene: Description, hinge: str) -> Iterator[str]:
    """Bodies that hang on the second side of a joint."""
    found, before = {scene.joints[hinge].second}, scene.joints[hinge].first
    grown = True
    while grown:
        grown = False
        for name, joint in scene.joints.items():
            ends = {joint.first, joint.second}
            if (
                name != hinge
                and ends & found
                and not ends <= found
                and before not in ends
                and GROUND not in ends
            ):
                found |= ends
                grown = True
    yield from found


def _turn(scene: Description, body: str) -> Array:
    return np.eye(3) if body == GROUND else rotation_matrix(scene.bodies[body].quaternion)


def _at(scene: Description, body: str, point: Array) -> Array:
    """A point of a body (its coordinates) as described, m."""
    where = np.zeros(3) if body == GROUND else np.asarray(scene.bodies[body].position)
    return np.asarray(where + _turn(scene, body) @ point)
