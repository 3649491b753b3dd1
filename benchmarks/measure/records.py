"""A crane scene as the plain records of `tests/reference/system.py`: the rival gets the very same case."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Curve, Scene
from seacrane.description.description import GROUND
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]


def scene_records(scene: Scene) -> dict[str, Any]:
    """JSON-ready records of a scene with one vessel.

    Raises
    ------
    ValueError
        For what the records cannot hold: springs, force tables, C functions, drivers, references other than
        rest-to-rest quintics, quadratic damping other than in roll.
    """
    for kind in ("springs", "force_tables", "function_forces", "drivers"):
        if getattr(scene, kind):
            raise ValueError(f"scene {scene.name!r}: has {kind}, which the rival's records do not hold")
    return {
        "gravity": [0.0, 0.0, -scene.gravity],
        "bodies": [_body(body) for body in scene.bodies.values()],
        "joints": [_joint(scene, joint) for joint in scene.joints.values()],
        "actuators": [_actuator(actuator) for actuator in scene.actuators.values()],
        "point_forces": [_force(scene, force) for force in scene.point_forces.values()],
        "vessel": _vessel(scene),
    }


def _pose(scene: Scene, body: str) -> tuple[Array, Array]:
    if body == GROUND:
        return np.zeros(3), np.eye(3)
    return scene.bodies[body].position, rotation_matrix(scene.bodies[body].quaternion)


def _body(body: Any) -> dict[str, Any]:
    center = body.position + rotation_matrix(body.quaternion) @ body.center_of_mass
    if np.any(body.velocity) or np.any(body.angular_velocity):
        raise ValueError(f"body {body.name!r}: moves at the start; the benchmark's scenes start at rest")
    return {
        "name": body.name,
        "mass": body.mass,
        "inertia": body.inertia.tolist(),
        "position": center.tolist(),
        "quaternion": body.quaternion.tolist(),
        "gravity": body.gravity,
    }


def _joint(scene: Scene, joint: Any) -> dict[str, Any]:
    ends = []
    for body, frame in ((joint.first, joint.first_frame), (joint.second, joint.second_frame)):
        position, rotation = _pose(scene, body)
        ends.append((position + rotation @ frame.point, rotation @ frame.axes))
    (point, axes), (second_point, second_axes) = ends
    record = {"kind": joint.kind, "name": joint.name, "first": joint.first, "second": joint.second}
    record["point"] = point.tolist()
    if joint.kind in ("revolute", "prismatic", "universal"):
        record["axis"] = axes[:, 2].tolist()
    if joint.kind == "universal":
        record["second_axis"] = second_axes[:, 2].tolist()
    if joint.kind == "distance":
        record |= {"second_point": second_point.tolist(), "length": joint.length}
    return record


def _quintic(name: str, curve: Curve) -> dict[str, Any]:
    starts = curve.to_pieces()["starts"]
    start, end = float(starts[0]), float(starts[-1])
    times = np.linspace(start, end, 101)
    low, high = curve.evaluate(np.array([start, end + 1.0]))[:, 0]
    u = (times - start) / (end - start)
    expected = low + (high - low) * u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    error = np.max(np.abs(curve.evaluate(times)[:, 0] - expected))
    if not error <= 1e-12 * max(1.0, abs(high - low)):
        raise ValueError(f"actuator {name!r}: its reference is not a quintic from rest to rest")
    return {"kind": "quintic", "start": float(low), "end": float(high), "t_start": start, "t_end": end}


def _feed_forward(name: str, curve: Curve) -> float | dict[str, Any]:
    """A number where it is one for ever."""
    pieces = curve.to_pieces()
    coefficients = np.array(pieces["coefficients"])
    if np.any(pieces["cosines"]):
        raise ValueError(f"actuator {name!r}: its feed-forward swings, which the rival's records do not hold")
    if not np.any(coefficients[:, 1:]) and np.ptp(coefficients[:, 0]) == 0.0:
        return float(coefficients[0, 0])
    return {"kind": "polynomials", "starts": pieces["starts"], "coefficients": coefficients.tolist()}


def _actuator(actuator: Any) -> dict[str, Any]:
    return {
        "joint": actuator.joint,
        "stiffness": actuator.stiffness,
        "damping": actuator.damping,
        "feedforward": _feed_forward(actuator.name, actuator.feed_forward),
        "reference": _quintic(actuator.name, actuator.reference),
    }


def _force(scene: Scene, force: Any) -> dict[str, Any]:
    if force.body_axes:
        raise ValueError(
            f"point force {force.name!r}: turns with the body, which the rival's records do not hold"
        )
    position, rotation = _pose(scene, force.body)
    point = position + rotation @ force.point
    return {"body": force.body, "point": point.tolist(), "force": force.force.tolist()}


def _vessel(scene: Scene) -> dict[str, Any]:
    (vessel,) = scene.vessels.values()
    quadratic = vessel.quadratic_damping
    if np.any(np.delete(quadratic, 3)):
        raise ValueError(f"vessel {vessel.name!r}: has quadratic damping in a motion other than roll")
    blocks = [
        {"inputs": b.inputs, "outputs": b.outputs, "A": b.a.tolist(), "B": b.b.tolist(), "C": b.c.tolist(),
         "D": b.d.tolist()}
        for b in vessel.memory
    ]  # fmt: skip
    return {
        "body": vessel.body,
        "reference_point": scene.bodies[vessel.body].position.tolist(),
        "added_mass": vessel.added_mass.tolist(),
        "damping": vessel.linear_damping.tolist(),
        "restoring": vessel.restoring.tolist(),
        "quadratic_roll_damping": float(quadratic[3]),
        "station_keeping": {
            "stiffness": vessel.mooring_stiffness.tolist(),
            "damping": vessel.mooring_damping.tolist(),
        },
        **({"memory": {"blocks": blocks}} if blocks else {}),
        **({"waves": _waves(scene)} if scene.waves is not None else {}),
    }


def _waves(scene: Scene) -> dict[str, Any]:
    waves = scene.waves
    if waves is None or np.isfinite(waves.depth):
        raise ValueError(f"scene {scene.name!r}: the rival's records are made for deep water")
    hull = waves.hull()
    wavenumber = waves.omega**2 / 9.80665
    along = hull.position[0] * np.cos(waves.direction) + hull.position[1] * np.sin(waves.direction)
    elevation = waves.amplitude * np.exp(1j * (waves.phase - wavenumber * along))
    force = hull.transfer * elevation[:, None]
    return {
        "omega": waves.omega.tolist(),
        "force_real": force.real.tolist(),
        "force_imag": force.imag.tolist(),
    }
