"""Reactions: against the balance of every body, against statics, and as action and reaction."""

from __future__ import annotations

from typing import Any

import multibody_runs as runs
import numpy as np
import pytest
from joint_examples import KINDS, own_arguments
from multibody_runs import Array, masses, record

from seacrane import Curve, Scene
from seacrane.analysis import driven
from seacrane.crane import Payload, load_crane
from seacrane.inputs.frames import rotation_matrix

G = 9.80665


def joint_points(scene: Scene, out: dict[str, Any]) -> Array:
    """Where reactions are given, (k, joints, 3): fixed on the first body where the joint slides."""
    points = []
    names = list(scene.bodies)
    rotation = rotation_matrix(out["quaternion"])
    for joint in scene.joints.values():
        on_first = KINDS[joint.kind].slides
        body, frame = (joint.first, joint.first_frame) if on_first else (joint.second, joint.second_frame)
        if body == "ground":
            points.append(np.broadcast_to(frame.point, (len(out["time"]), 3)))
            continue
        b, described = names.index(body), scene.bodies[body]
        points.append(out["position"][:, b] + rotation[:, b] @ (frame.point - described.center_of_mass))
    return np.stack(points, axis=1)


def loads_on_bodies(scene: Scene, out: dict[str, Any]) -> tuple[Array, Array]:
    """Of weight, reactions, actuators and drivers per body about its centre of mass, (k, n, 3)."""
    names = list(scene.bodies)
    count = len(out["time"])
    force, moment = np.zeros((count, len(names), 3)), np.zeros((count, len(names), 3))
    force[:, :, 2] -= masses(scene) * scene.gravity
    points = joint_points(scene, out)

    def add(body: str, f: Array, m: Array, point: Array) -> None:
        if body == "ground":
            return
        b = names.index(body)
        force[:, b] += f
        moment[:, b] += m + np.cross(point - out["position"][:, b], f)

    rotation = rotation_matrix(out["quaternion"])
    for j, joint in enumerate(scene.joints.values()):
        f, m = out["reaction_force"][:, j], out["reaction_moment"][:, j]
        add(joint.second, f, m, points[:, j])
        add(joint.first, -f, -m, points[:, j])
    for table, channel in ((scene.actuators, "actuator_force"), (scene.drivers, "driver_force")):
        for i, drive in enumerate(table.values()):
            j = list(scene.joints).index(drive.joint)
            joint = scene.joints[drive.joint]
            axis = np.broadcast_to(joint.first_frame.axes[:, 2], (count, 3))
            if joint.first != "ground":
                axis = rotation[:, names.index(joint.first)] @ joint.first_frame.axes[:, 2]
            along = out[channel][:, i, None] * axis
            f, m = (along, 0.0 * along) if drive.coordinate == "displacement" else (0.0 * along, along)
            add(joint.second, f, m, points[:, j])
            add(joint.first, -f, -m, points[:, j])
    return force, moment


def check_balance(scene: Scene, out: dict[str, Any]) -> None:
    """m a and d(J w)/dt of every body equal its loads to rounding of the loads that meet there."""
    force, moment = loads_on_bodies(scene, out)
    inertia = runs.world_inertia(scene, out["quaternion"])
    w = out["angular_velocity"]
    spin = np.einsum("knij,knj->kni", inertia, w)
    spin_rate = np.einsum("knij,knj->kni", inertia, out["angular_acceleration"]) + np.cross(w, spin)
    size = np.max(np.abs(out["reaction_force"]))
    reach = np.max(np.abs(joint_points(scene, out)))
    np.testing.assert_allclose(
        masses(scene)[:, None] * out["acceleration"], force, rtol=0.0, atol=1e-9 * size
    )
    np.testing.assert_allclose(spin_rate, moment, rtol=0.0, atol=1e-9 * size * reach)


def test_every_body_of_a_moving_crane_is_in_balance() -> None:
    scene = runs.crane_scene(payload=True, references=runs.swing_out(6.0))
    for one in (scene, driven(scene)):
        out = record(one, 7.0, dt_out=0.25)
        assert np.max(np.abs(out["acceleration"])) > 0.1
        check_balance(one, out)


def all_kinds() -> Scene:
    """A chain through every joint kind that carries load, hanging from the ground and swinging."""
    scene = Scene(gravity=G)
    before = "ground"
    for i, kind in enumerate(kind for kind, about in KINDS.items() if about.rows > 0):
        here = np.array([0.4 * i, 0.1 * i, -1.0 * i])
        scene.add_body(
            name=kind, mass=1.0 + i, inertia=(0.3, 0.4, 0.5), position=here, center_of_mass=(0.2, -0.1, -0.5)
        )
        own = own_arguments(kind, lambda: (1.0, -0.3, 0.0), lambda here=here: here - (0.0, 0.0, 1.0))
        scene.add_joint(
            kind=kind, name=kind, first=before, second=kind, point=here, axis=(0.3, 1.0, 0.2), **own
        )
        before = kind
    return scene


def test_every_joint_kind_reports_the_load_it_carries_however_its_bodies_are_written() -> None:
    scene, other = all_kinds(), Scene(gravity=G)
    other.bodies = dict(scene.bodies)
    for joint in scene.joints.values():
        step = -1 if joint.kind in ("weld", "revolute", "spherical") else 1  # these do not slide
        first, second = (joint.first, joint.second)[::step]
        frames = (joint.first_frame, joint.second_frame)[::step]
        other.add_joint(
            kind=joint.kind, name=joint.name, first=first, second=second, **joint.parameters,
            first_frame=frames[0], second_frame=frames[1],
        )  # fmt: skip
    for one in (scene, other):
        assert one.compile().degrees_of_freedom == sum(6 - KINDS[kind].rows for kind in scene.joints)
        out = record(one, 0.6)
        assert np.max(np.abs(out["angular_velocity"])) > 0.2
        check_balance(one, out)


@pytest.mark.parametrize(("s1", "s2", "payload"), [(0.0, 0.0, False), (3.0, 1.0, True)])
def test_crane_at_rest_on_a_fixed_base(s1: float, s2: float, payload: bool) -> None:
    scene = driven(
        runs.crane_scene(payload=payload, slew=-0.7, s1=s1, s2=s2),
        references=dict.fromkeys(runs.ACTUATORS, Curve.constant(value=0.0)),
    )
    out = record(scene, 0.0)
    assert np.max(np.abs(out["acceleration"])) < 1e-9
    weight = masses(scene).sum() * G
    deck = out["joints"].index("deck")
    np.testing.assert_allclose(
        out["reaction_force"][0, deck], (0.0, 0.0, weight), rtol=1e-12, atol=1e-9 * weight
    )
    # Moments about the foot: the weight acts at the common centre of mass.
    center = np.average(out["position"][0], axis=0, weights=masses(scene))
    foot = joint_points(scene, out)[0, deck]
    overturning = np.cross(center - foot, (0.0, 0.0, -weight))
    np.testing.assert_allclose(out["reaction_moment"][0, deck], -overturning, atol=1e-9 * weight * 30.0)
    mass = Payload().mass if payload else 0.0
    crane = load_crane()
    expected = crane.static_cylinder_forces(s1=s1, s2=s2, payload_mass=mass, gravity=G)
    got = out["driver_force"][0]
    np.testing.assert_allclose(got[1:], expected, rtol=1e-9)
    np.testing.assert_allclose(got[0], 0.0, atol=1e-6 * weight)  # weight has no moment about the slew axis
    if payload:
        np.testing.assert_allclose(out["tension"][0, 0], mass * G, rtol=1e-10)
