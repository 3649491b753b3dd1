"""Every joint kind in motion: what it forbids stays, what it leaves free moves, energy and momentum are
kept."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from . import reference_curves
from .joints import JOINT_ROWS
from .rotation import Array, cross, dot, matrix_from_quaternion
from .simulate import simulate
from .system import System

TIMES = np.linspace(0.0, 4.0, 9)
POINT, AXIS, SECOND_AXIS = [0.3, -0.2, 0.5], np.array([1.0, 2.0, -0.5]), np.array([2.0, -1.0, 0.0])


def body(name: str, rng: np.random.Generator) -> dict[str, Any]:
    root = rng.normal(size=(3, 3))
    return {
        "name": name,
        "mass": float(rng.uniform(1.0, 3.0)),
        "inertia": (root @ root.T + np.eye(3)).tolist(),
        "position": rng.normal(size=3).tolist(),
        "quaternion": rng.normal(size=4).tolist(),
        "velocity": rng.normal(size=3).tolist(),
        "angular_velocity": rng.normal(size=3).tolist(),
    }


def joined(kind: str, damping: float) -> dict[str, Any]:
    """Two tumbling bodies with one joint and a spring-damper between them, no gravity."""
    rng = np.random.default_rng(3)
    joint = {
        "kind": kind,
        "name": "J",
        "first": "a",
        "second": "b",
        "point": POINT,
        "axis": AXIS.tolist(),
        "second_axis": SECOND_AXIS.tolist(),
    }
    if kind in ("distance", "planar"):
        joint["second_point"] = [1.0, 0.4, -0.6]
    spring = {
        "first": "a",
        "second": "b",
        "first_point": [1.0, 0.0, 0.0],
        "second_point": [0.0, 1.5, 0.5],
        "stiffness": 8.0,
        "damping": damping,
        "rest_length": 1.0,
    }
    bodies = [body("a", rng), body("b", rng)]
    return {"gravity": [0.0, 0.0, 0.0], "bodies": bodies, "joints": [joint], "springs": [spring]}


def momenta(system: System, out: dict[str, Any]) -> tuple[Array, Array]:
    """Linear momentum and angular momentum about the origin (time, 3)."""
    rotation = np.array([[matrix_from_quaternion(q) for q in row] for row in out["quaternion"]])
    inertia = rotation @ system.inertia @ rotation.swapaxes(-1, -2)
    linear = system.mass[:, None] * out["velocity"]
    spin = np.einsum("tbij,tbj->tbi", inertia, out["angular_velocity"])
    return linear.sum(axis=1), (spin + cross(out["position"], linear)).sum(axis=1)


@pytest.mark.parametrize("kind", sorted(JOINT_ROWS))
def test_energy_and_momentum_are_kept(kind: str) -> None:
    system = System.from_records(joined(kind, damping=0.0))
    assert (system.rows.count, system.degrees_of_freedom) == (JOINT_ROWS[kind], 12 - JOINT_ROWS[kind])
    out = simulate(system, 4.0, TIMES, rtol=1e-10)
    linear, angular = momenta(system, out)
    np.testing.assert_allclose(out["energy"], out["energy"][0], rtol=1e-8)
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-8)
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-8)
    assert np.max(out["constraint_error"]) < 1e-11
    assert np.max(out["constraint_rate_error"]) < 1e-11


@pytest.mark.parametrize("kind", sorted(JOINT_ROWS))
def test_damped_energy_is_the_work_done(kind: str) -> None:
    system = System.from_records(joined(kind, damping=2.0))
    out = simulate(system, 4.0, TIMES, rtol=1e-10)
    np.testing.assert_allclose(out["energy_balance"], 0.0, atol=1e-8 * out["energy"][0])
    assert (out["energy"][-1] < 0.999 * out["energy"][0]) == (kind != "weld")


@pytest.mark.parametrize("kind", sorted(set(JOINT_ROWS) - {"free"}))
def test_reaction_does_no_work_in_the_freedoms_of_the_joint(kind: str) -> None:
    """Power of the reaction on both bodies together is zero, and it has no component along a free axis."""
    system = System.from_records(joined(kind, damping=0.0))
    out = simulate(system, 4.0, TIMES, rtol=1e-10)
    rotation = np.array([[matrix_from_quaternion(q) for q in row] for row in out["quaternion"]])
    local = system.start.rotation[0].T
    f, n = out["reaction_force"][:, 0], out["reaction_moment"][:, 0]
    owner = 1 if kind == "distance" else 0
    point = POINT if kind != "distance" else [1.0, 0.4, -0.6]
    arm = system.start.rotation[owner].T @ (np.array(point) - system.start.r[owner])
    place = out["position"][:, owner] + rotation[:, owner] @ arm
    power = np.zeros(len(TIMES))
    for k, sign in ((1, 1.0), (0, -1.0)):
        lever = place - out["position"][:, k]
        power += sign * dot(f, out["velocity"][:, k])
        power += sign * dot(n + cross(lever, f), out["angular_velocity"][:, k])
    size = np.max(np.abs(f)) + np.max(np.abs(n))
    np.testing.assert_allclose(power, 0.0, atol=1e-9 * size)
    axis = rotation[:, 0] @ local @ (AXIS / np.linalg.norm(AXIS))
    if kind in ("revolute", "cylindrical"):
        np.testing.assert_allclose(dot(n, axis), 0.0, atol=1e-10 * size)
    if kind in ("prismatic", "cylindrical"):
        np.testing.assert_allclose(dot(f, axis), 0.0, atol=1e-10 * size)
    if kind == "planar":
        np.testing.assert_allclose(cross(f, axis), 0.0, atol=1e-10 * size)
    if kind in ("spherical", "distance"):
        np.testing.assert_allclose(n, 0.0, atol=1e-10 * size)
    if kind == "universal":
        second = rotation[:, 1] @ system.start.rotation[1].T @ SECOND_AXIS
        np.testing.assert_allclose(dot(n, second), 0.0, atol=1e-10 * size)
        np.testing.assert_allclose(dot(n, axis), 0.0, atol=1e-10 * size)


def test_redundant_weld_shares_its_reaction() -> None:
    """The same weld twice: accelerations as with one, each carrying half."""
    records = joined("weld", damping=0.0)
    single = simulate(System.from_records(records), 1.0, [1.0], rtol=1e-9)
    twice = {**records, "joints": [records["joints"][0], {**records["joints"][0], "name": "K"}]}
    system = System.from_records(twice)
    assert system.redundant and system.rank == 6
    double = simulate(system, 1.0, [1.0], rtol=1e-9)
    np.testing.assert_allclose(double["position"], single["position"], atol=1e-8)
    for key in ("reaction_force", "reaction_moment"):
        np.testing.assert_allclose(double[key].sum(axis=1), single[key][:, 0], atol=1e-6)
        np.testing.assert_allclose(double[key][:, 0], double[key][:, 1], atol=1e-6)


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "cylindrical"])
def test_actuator_is_internal_and_its_power_is_booked(kind: str) -> None:
    """Feedback off the centres of mass: momentum is kept, energy changes by the actuator's work."""
    reference = {"kind": "cosine", "mean": 0.1, "amplitude": 0.5, "period": 3.0}
    actuator = {"joint": "J", "stiffness": 9.0, "damping": 2.0, "feedforward": 1.5, "reference": reference}
    records = {**joined(kind, damping=0.0), "actuators": [actuator]}
    records["joints"][0]["coordinate"] = 0.4
    if kind == "prismatic":
        records["joints"][0]["second_point"] = (np.array(POINT) + 0.7 * AXIS).tolist()
    system = System.from_records(records)
    out = simulate(system, 4.0, TIMES, rtol=1e-10)
    linear, angular = momenta(system, out)
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-8)
    np.testing.assert_allclose(angular, np.broadcast_to(angular[0], angular.shape), atol=1e-8)
    assert out["absolute_work"][-1] > 1.0
    np.testing.assert_allclose(out["energy_balance"], 0.0, atol=1e-8 * out["energy"][0])
    s, rate = out["coordinate"][:, 0], out["coordinate_rate"][:, 0]
    assert s[0] == pytest.approx(0.4, abs=1e-12)
    turn = 2.0 * np.pi / 3.0
    wanted = 0.1 + 0.5 * np.cos(turn * TIMES)
    wanted_rate = -0.5 * turn * np.sin(turn * TIMES)
    expected = 9.0 * (wanted - s) + 2.0 * (wanted_rate - rate) + 1.5
    if kind == "revolute":
        assert np.max(np.abs(wanted - s)) < np.pi  # within the half turn that feedback measures
    np.testing.assert_allclose(out["actuator_load"][:, 0], expected, atol=1e-9)


def test_a_jump_of_the_set_point_restarts_the_integrator() -> None:
    """Unit mass on a slide, set-point 0 then 1 at t = 1 s: s = 1 - cos(w (t - 1))."""
    block = {
        "name": "b",
        "mass": 1.0,
        "inertia": np.eye(3).tolist(),
        "position": [0.0] * 3,
        "quaternion": [1.0, 0.0, 0.0, 0.0],
    }
    slide = {"kind": "prismatic", "name": "J", "second": "b", "point": [0.0] * 3, "axis": [1.0, 0.0, 0.0]}
    step = reference_curves.sequence([1.0], [reference_curves.constant(0.0), reference_curves.constant(1.0)])
    silent = reference_curves.ReferenceCurve(step.curve)  # the same jump, undeclared
    evaluations = []
    for curve in (step, silent):
        actuator = {"joint": "J", "stiffness": 25.0, "reference": curve}
        system = System.from_records({"bodies": [block], "joints": [slide], "actuators": [actuator]})
        out = simulate(system, 2.5, [1.0, 1.6, 2.5], rtol=1e-10, projection_interval=5.0)
        evaluations.append(out["stats"]["evaluations"])
        expected = 1.0 - np.cos(5.0 * (np.array([1.0, 1.6, 2.5]) - 1.0))
        np.testing.assert_allclose(out["coordinate"][:, 0], expected, atol=1e-8)
    assert evaluations[0] < evaluations[1]
    rest = {"joint": "J", "stiffness": 25.0, "reference": step}
    system = System.from_records({"bodies": [block], "joints": [slide], "actuators": [rest]})
    before = simulate(system, 1.0, [0.999999], rtol=1e-10)
    assert before["coordinate"][0, 0] == 0.0
    whole = simulate(system, 1.5, [0.9999], rtol=1e-10, projection_interval=5.0)
    assert whole["coordinate"][0, 0] == 0.0
