"""Case 2 against an independent NumPy/SciPy implementation: ten bodies, vessel, memory, waves, controllers.

The reference shares no code with the engine: other constraint rows, rotation matrices instead of quaternions,
another integrator, and a wave load summed here from the components.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from reference.compare import differences
from reference.simulate import simulate as simulate_reference
from reference.system import System

from seacrane import Scene, cases, simulate
from seacrane._core import Curve
from seacrane.arrays import Array
from seacrane.crane import FOOT, Payload, load_crane
from seacrane.hydro import shipped_database, vessel_parameters
from seacrane.inputs.frames import rotation_matrix

MOVE_END = 2.0  # s: faster than the case's 45 s, so that every term counts within a short run
SWITCH = 2.5  # s: from there both strokes follow 2 m - (1 + cos) as in case 3, with its step in acceleration
T_END = 4.0
TARGETS = {"slew": -0.5, "main": 2.0, "knuckle": 2.0}


def engine_reference(name: str) -> Curve:
    move = Curve.quintic(start_time=0.0, end_time=MOVE_END, start=0.0, end=TARGETS[name])
    if name == "slew":
        return move
    return move.then(
        time=SWITCH,
        curve=Curve.harmonic(start_time=SWITCH, offset=3.0, amplitude=-1.0, omega=2.0 * np.pi / 5.0),
    )


def reference_record(name: str) -> dict[str, Any]:
    move = {"kind": "quintic", "start": 0.0, "end": TARGETS[name], "t_start": 0.0, "t_end": MOVE_END}
    swing = {"kind": "cosine", "mean": 3.0, "amplitude": 1.0, "period": 5.0}  # cos(2 pi 2.5 / 5) = -1
    if name == "slew":
        return move
    return {"kind": "sequence", "switch": [SWITCH], "pieces": [move, swing]}


def quick_case2() -> Scene:
    """Case 2 with its gains and feed-forwards, fast references and case 3's oscillation, Hs 4 m."""
    scene = cases.case2(hs=4.0)
    actuators = dict(scene.actuators)
    scene.actuators.clear()
    for name, actuator in actuators.items():
        scene.add_actuator(
            name=name, joint=actuator.joint, stiffness=actuator.stiffness, damping=actuator.damping,
            feed_forward=actuator.feed_forward, reference=engine_reference(name),
        )  # fmt: skip
    return scene


def wave_load(scene: Scene) -> Callable[[float], Array]:
    """F(t) = Re sum a X exp(i (w t + eps)) at the mean position, the inertial origin."""
    waves = scene.waves
    assert waves is not None and waves.hull().position == (0.0, 0.0)
    force = (waves.amplitude * np.exp(1j * waves.phase))[:, None] * waves.hull().transfer
    return lambda t: np.asarray((np.exp(1j * waves.omega * t) @ force).real, dtype=float)


def body_records(scene: Scene) -> list[dict[str, Any]]:
    return [
        {
            "name": body.name, "mass": body.mass, "inertia": body.inertia,
            "position": body.position + rotation_matrix(body.quaternion) @ body.center_of_mass,
            "quaternion": body.quaternion,
        }
        for body in scene.bodies.values()
    ]  # fmt: skip


def joint_records(payload: Payload | None) -> list[dict[str, Any]]:
    parts = load_crane().parts(foot=FOOT)
    joints = [*parts.joints, *([] if payload is None else [payload.link(parts.tip[1], parts.tip[0])])]
    keys = ("kind", "name", "first", "second", "point", "axis", "second_axis", "second_point")
    return [
        {key: getattr(joint, key) for key in keys if getattr(joint, key) is not None}
        | ({} if joint.first else {"first": "vessel"})
        for joint in joints
    ]


def vessel_record(scene: Scene) -> dict[str, Any]:
    parameters = vessel_parameters(shipped_database())
    moored = scene.vessels["vessel"]
    assert not np.any(parameters.quadratic_damping[[0, 1, 2, 4, 5]])
    blocks = [
        {"inputs": b.inputs.tolist(), "outputs": b.outputs.tolist(), "A": b.A, "B": b.B, "C": b.C, "D": b.D}
        for b in parameters.memory.blocks
    ]
    return {
        "body": "vessel", "added_mass": parameters.added_mass, "damping": parameters.linear_damping,
        "restoring": parameters.restoring, "quadratic_roll_damping": parameters.quadratic_damping[3],
        "reference_point": [0.0, 0.0, 0.0],
        "station_keeping": {"stiffness": moored.mooring_stiffness, "damping": moored.mooring_damping},
        "memory": {"blocks": blocks},
    }  # fmt: skip


def actuator_records(scene: Scene) -> list[dict[str, Any]]:
    return [
        {
            "joint": actuator.joint, "stiffness": actuator.stiffness, "damping": actuator.damping,
            "feedforward": feed_forward_record(actuator.feed_forward), "reference": reference_record(name),
        }
        for name, actuator in scene.actuators.items()
    ]  # fmt: skip


def feed_forward_record(curve: Curve) -> dict[str, Any]:
    pieces = curve.to_pieces()
    assert not np.any(pieces["cosines"])
    return {"kind": "polynomials", "starts": pieces["starts"], "coefficients": pieces["coefficients"]}


def reference_system(scene: Scene) -> System:
    balance = scene.point_forces["balance"]
    records = {
        "gravity": [0.0, 0.0, -scene.gravity], "bodies": body_records(scene),
        "joints": joint_records(Payload()), "actuators": actuator_records(scene),
        "point_forces": [{"body": "vessel", "point": balance.point, "force": balance.force}],
        "vessel": vessel_record(scene),
    }  # fmt: skip
    return System(records, wave_load(scene))


MOTION = ("time", "position", "velocity", "angular_velocity", "quaternion", "vessel_motion")


@pytest.mark.warns("LargeSwingWarning", "PushingLinkWarning")
def test_a_run_agrees_with_the_reference() -> None:
    scene = quick_case2()
    ours = simulate(scene, t_end=T_END, dt_out=0.5, rtol=1e-11)
    system = reference_system(scene)
    theirs = simulate_reference(system, T_END, ours.time, rtol=1e-9)
    channels = {n: ours.time if n == "time" else ours[n] for n in MOTION}
    found = differences(theirs, channels, bodies=list(ours.coords["body"]))
    assert max(found.values()) < 1e-8
    moved = channels | {"position": ours["position"] + [0.0, 0.0, 1e-3], "quaternion": -ours["quaternion"]}
    other = differences(theirs, moved, bodies=list(ours.coords["body"]))  # is not blind
    assert other["position"] == pytest.approx(1e-3, rel=1e-3) and other["attitude"] < 1e-8
    for one, other in (("actuator_force", "actuator_load"), ("wave_force", "wave_force")):
        error = np.max(np.abs(ours[one] - theirs[other]), axis=0) / np.max(np.abs(theirs[other]), axis=0)
        np.testing.assert_array_less(error, 1e-8)
    channels = {"time": ours.time} | {n: ours[n] for n in ("reaction_force", "reaction_moment")}
    found = differences(theirs, channels, bodies=list(ours.coords["body"]), joints=list(ours.coords["joint"]))
    for name in ("reaction_force", "reaction_moment"):
        assert found[name] < 1e-8 * np.max(np.abs(theirs[name]))
    assert system.rows.count == system.rank == ours.stats["constraints"] == 46
    assert 60 - system.rank == ours.stats["degrees_of_freedom"] == 14
    travel = np.ptp(theirs["position"], axis=0)  # all goes far
    assert np.all(np.linalg.norm(travel[2:], axis=1) > 0.3)
    assert np.max(np.abs(theirs["memory_force"][:, 2])) > 5e4
