"""How far a winch or an actuator moves a load, by the kinematics of the described pose."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.inverse import driven, hold_vessel
from seacrane.description.compilation import compile_scene
from seacrane.description.description import GROUND, Description
from seacrane.description.given import given_vessels
from seacrane.description.loads import path_of
from seacrane.description.places import placed
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]
SHORT = 1e-12  # m
SIX = ("x", "y", "z", "roll", "pitch", "yaw")


def _unit(direction: Any) -> Array:
    along = np.asarray(direction, dtype=float)
    return np.asarray(along / np.linalg.norm(along))


def falls_of(scene: Description, line: _core.Line, direction: Any) -> float:
    """By how much the path of a line shortens for each metre by which its load moves.

    The load is the body whose rise shortens it most.

    Parameters
    ----------
    scene : Scene
    line : Line
    direction : array_like, shape (3,)
        Of that motion, inertial axes.

    Returns
    -------
    float
        n for n falls along the direction.
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
    """How fast an actuator moves a point of a body: the vessels and all other actuators are held.

    Parameters
    ----------
    scene : Scene
    actuator : str
    body, point : str, array_like
        The point, m, in coordinates of the body.
    direction : array_like, shape (3,)
        Along which its speed counts, inertial axes.

    Returns
    -------
    float
        m/s for each m/s, or rad/s, of the actuator's coordinate.
    """
    curves = {name: _core.Curve.constant(value=0.0) for name in scene.actuators}
    curves[actuator] = _core.Curve.pieces(starts=[0.0], coefficients=[[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]])
    out = driven(scene, references=curves).copy(waves=None, orientation="quaternion", baumgarte=0.0)
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
