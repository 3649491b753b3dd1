"""Active heave compensation, on a winch or an actuator."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import driven, hold_vessel
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import GROUND, Description
from seacrane.description.elements import put_load
from seacrane.description.given import given_vessels
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, with_ideal_cylinders
from seacrane.description.loads import path_of, winches_of
from seacrane.description.places import ORIGIN, placed
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.values import flat, told_by, value

NO_BOUND = 1e7  # m, m/s: a bound here or beyond is none
UP = (0.0, 0.0, 1.0)
LEAST_RATIO = 1e-3  # below it what follows does not move the load
SHORT = 1e-12  # m
SIX = ("x", "y", "z", "roll", "pitch", "yaw")


@value(_core.HeaveCompensator, "actuator", "frequency", "damping")
class Drive:
    """What moves a heave compensator's stroke; without a frequency it follows at once."""

    frequency: float = 0.0  # Hz
    damping: float = 0.7
    maximum_rate: float = NO_BOUND  # m/s
    maximum_stroke: float = NO_BOUND  # m
    settling: float = 0.2  # s


VALUES: dict[str, type[Any]] = {"drive": Drive}


@told_by(_core.HeaveCompensator)
def add_heave_compensation(
    scene: Description, name: str, *, body: str, point: Any = ORIGIN, winch: str | None = None,
    actuator: str | None = None, ratio: float | None = None, direction: Any = UP, gain: float = 1.0,
    high_pass: float = 0.03, lag: float = 0.0, lag_order: float = 1, drive: Drive | None = None,
) -> _core.HeaveCompensator:  # fmt: skip
    """Let a winch or an actuator take the motion of a point away: active heave compensation.

    The motion of the point along the direction, behind a high-pass filter, a lag and a drive, is the stroke,
    a state "<name>.stroke". A winch pays out `ratio` times its rate; the reference of an actuator moves by
    `ratio` times the stroke. With neither, a Python controller may read it. A bound that is reached is an
    event "<name>.rate" or "<name>.stroke" of kind "limit". See docs/heave-compensation.md.

    Parameters
    ----------
    body, point : str, array_like
        The point whose motion is measured, m, in coordinates of the body. For an actuator, a point that the
        actuator does not move itself: the tip as a point of the vessel.
    actuator : str, optional
        The actuator or the hydraulic cylinder that follows, in place of a winch.
    ratio : float, optional
        Of what follows to the stroke. Default: of a winch the rope for each metre of the load, such as 2 on
        two falls; of an actuator its coordinate for each metre that the crane's tip goes down, in the
        described pose.
    lag_order : {1, 2}
        Of the lag: 1 / (1 + T p), or 1 / (1 + T p + T^2 p^2 / 3), nearer to a pure delay.
    drive : Drive, optional
        What moves: its frequency and its bounds. Default: it follows at once, without bounds.

    Raises
    ------
    SceneError
        For a winch or an actuator that is not there, or whose ratio cannot be computed; what else does not
        fit is said by `Scene.compile`.
    """
    given = {key: one for key, one in locals().items() if key != "scene"}
    what = f"heave compensator {text_of('heave compensation: name', name)!r}"
    if winch is not None and actuator is not None:
        raise SceneError(
            f"{what}: moves winch {winch!r} and actuator {actuator!r}; give each its own compensator"
        )
    if ratio is None:
        given["ratio"] = _ratio(scene, what, winch, actuator, direction)
    compensator = _core.HeaveCompensator(**flat(what, given, VALUES))
    return put_load(scene, compensator)


def _ratio(scene: Description, what: str, winch: str | None, actuator: str | None, direction: Any) -> float:
    """The ratio of what follows to the stroke, by the kinematics of the described pose."""
    if winch is not None:
        line = winches_of(scene.loads).get(winch)
        if line is None:
            raise SceneError(f"{what}: there is no winch {winch!r}; add the line and its winch first")
        ratio = falls_of(scene, line, direction)
    elif actuator is not None:
        if actuator not in scene.actuators and actuator not in hydraulic_cylinders(scene):
            raise SceneError(f"{what}: there is no actuator {actuator!r}; add it first")
        if len(scene.roles) != 1 or (tip := next(iter(scene.roles.values())).tip) is None:
            raise SceneError(
                f"{what}: its ratio is not known, as the scene has no one crane with a tip; give ratio, the "
                "coordinate for each metre that the load goes down, or tell the tip by add_roles"
            )
        rate = tip_rate(with_ideal_cylinders(scene), actuator, *tip, direction)
        ratio = -1.0 / rate if abs(rate) > LEAST_RATIO else 0.0
    else:
        return 1.0
    if abs(ratio) < LEAST_RATIO:
        raise SceneError(
            f"{what}: {winch or actuator!r} does not move the load along the direction in the described "
            "pose; name another, or give ratio"
        )
    return ratio


def _unit(direction: Any) -> Array:
    along = np.asarray(direction, dtype=float)
    return np.asarray(along / np.linalg.norm(along))


def falls_of(scene: Description, line: _core.Line, direction: Any) -> float:
    """By how much the path of a line shortens for each metre by which its load moves along a direction (3,).

    n for n falls; inertial axes. The load is the body whose rise shortens it most.
    """
    places = [placed(scene, body, point) for body, point in path_of(line)]
    shortening = {body: np.zeros(3) for body in line.bodies if body != GROUND}
    for (first, start), (second, end) in pairwise(zip(line.bodies, places, strict=True)):
        span = end - start
        along = span / max(float(np.linalg.norm(span)), SHORT)
        for body, sign in ((first, 1.0), (second, -1.0)):
            if body in shortening:
                shortening[body] = shortening[body] + sign * along
    load = max(shortening.values(), key=lambda slope: float(slope[2]))
    return float(load @ _unit(direction))


def tip_rate(scene: Description, actuator: str, body: str, point: Any, direction: Any) -> float:
    """Speed of a point (m, in coordinates of a body) along a direction (3,), for that of an actuator.

    m/s for each m/s, or rad/s, of its coordinate; inertial axes. Vessels and all other actuators are held.
    """
    curves = {name: _core.Curve.constant(value=0.0) for name in scene.actuators}
    curves[actuator] = _core.Curve.pieces(starts=[0.0], coefficients=[[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]])
    out = driven(scene, references=curves).copy(
        waves=calm_water(scene.waves), orientation="quaternion", baumgarte=0.0
    )
    given = given_vessels(scene)
    for vessel in scene.vessels.values():
        if vessel.body not in given:
            hold_vessel(out, vessel.body, {motion: _core.Curve.constant(value=0.0) for motion in SIX})
    model = compile_scene(out)
    values = _core.Evaluator(model).project(0.0, np.array(model.initial_state))
    at = model.twist_index(list(model.bodies).index(body))
    velocity, turning = values[at : at + 3], values[at + 3 : at + 6]
    tip = out.bodies[body]
    lever = rotation_matrix(np.asarray(tip.quaternion)) @ (np.asarray(point) - np.asarray(tip.center_of_mass))
    return float(_unit(direction) @ (velocity + np.cross(turning, lever)))
