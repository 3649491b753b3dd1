"""Rotations, constraint rows and reference curves against numerical derivatives."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from . import reference_curves
from .joints import JOINT_ROWS
from .kinematics import Motion
from .linear_solve import solve_full_rank, solve_redundant
from .rotation import (
    Array,
    angle_rate_matrix,
    angle_rate_matrix_derivative,
    matrix_from_quaternion,
    quaternions_from_matrices,
    rotation_exponential,
    yaw_pitch_roll,
)
from .system import System

STEP = 1e-5


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


def pair(kind: str, driver: dict[str, Any] | None = None) -> System:
    rng = np.random.default_rng(3)
    joint = {
        "kind": kind,
        "name": "J",
        "first": "a",
        "second": "b",
        "point": [0.3, -0.2, 0.5],
        "axis": [1.0, 2.0, -0.5],
        "second_axis": [2.0, -1.0, 0.0],
    }
    if kind in ("distance", "planar"):
        joint["second_point"] = [1.0, 0.4, -0.6]
    records: dict[str, Any] = {"bodies": [body("a", rng), body("b", rng)], "joints": [joint]}
    if driver is not None:
        records["drivers"] = [driver]
    return System.from_records(records)


def advanced(motion: Motion, twist: Array, step: float) -> Motion:
    """Pose moved along constant twists, velocities unchanged."""
    out = motion.copy()
    out.r[:-1] += step * twist[:, :3]
    out.rotation[:-1] = rotation_exponential(step * twist[:, 3:]) @ motion.rotation[:-1]
    return out


def disturbed(system: System) -> Motion:
    """A pose off the constraints, so that no term of a derivative vanishes by accident."""
    twist = np.random.default_rng(5).normal(size=(len(system.mass), 6))
    return advanced(system.start, twist, 0.05)


DRIVEN_PRISMATIC = {
    "joint": "J",
    "reference": {"kind": "cosine", "mean": 0.2, "amplitude": 0.3, "period": 4.0},
}


@pytest.mark.parametrize("kind", sorted(JOINT_ROWS))
def test_rows_are_the_derivative_of_the_residual(kind: str) -> None:
    system = pair(kind, DRIVEN_PRISMATIC if kind == "prismatic" else None)
    motion = disturbed(system)
    assert system.rows.count == JOINT_ROWS[kind] + (kind == "prismatic")
    matrix = system.matrix(system.rows.evaluate(0.7, system.vectors.evaluate(motion)))
    for column in range(12):
        twist = np.zeros((2, 6))
        twist.flat[column] = 1.0
        ends = [
            system.rows.evaluate(0.7, system.vectors.evaluate(advanced(motion, twist, s))).residual
            for s in (STEP, -STEP)
        ]
        np.testing.assert_allclose((ends[0] - ends[1]) / (2 * STEP), matrix[:, column], atol=1e-8)


@pytest.mark.parametrize("kind", sorted(JOINT_ROWS))
def test_gamma_is_minus_the_rate_of_the_velocity_constraint(kind: str) -> None:
    system = pair(kind, DRIVEN_PRISMATIC if kind == "prismatic" else None)
    motion = disturbed(system)
    twist = motion.twists().reshape(2, 6)
    gamma = system.rows.evaluate(0.7, system.vectors.evaluate(motion)).gamma
    ends = [
        system.rows.evaluate(0.7 + s, system.vectors.evaluate(advanced(motion, twist, s))).rate
        for s in (STEP, -STEP)
    ]
    np.testing.assert_allclose((ends[0] - ends[1]) / (2 * STEP), -gamma, atol=2e-8)


@pytest.mark.parametrize("kind", sorted(JOINT_ROWS))
def test_projection_closes_position_and_velocity(kind: str) -> None:
    system = pair(kind)
    motion = system.project(0.0, advanced(system.start, np.ones((2, 6)), 0.01), np.zeros(0))
    values = system.rows.evaluate(0.0, system.vectors.evaluate(motion))
    assert np.all(np.abs(values.residual) < 1e-12)
    assert np.all(np.abs(values.rate) < 1e-12)


def test_angle_rates_and_their_derivative() -> None:
    rotation = matrix_from_quaternion([0.8, 0.2, -0.4, 0.5])
    w = np.array([0.3, -0.7, 0.4])
    forward, back = (yaw_pitch_roll(rotation_exponential(s * w) @ rotation) for s in (STEP, -STEP))
    _, pitch, yaw = yaw_pitch_roll(rotation)
    rates = angle_rate_matrix(pitch, yaw) @ w
    np.testing.assert_allclose(np.subtract(forward, back) / (2 * STEP), rates, atol=1e-9)
    numeric = (angle_rate_matrix(*forward[1:]) - angle_rate_matrix(*back[1:])) / (2 * STEP)
    np.testing.assert_allclose(
        numeric, angle_rate_matrix_derivative(pitch, yaw, rates[1], rates[2]), atol=1e-8
    )


def test_quaternions_round_trip_and_stay_continuous() -> None:
    angles = np.linspace(0.0, 4.0 * np.pi, 200)
    matrices = np.array([[rotation_exponential(a * np.array([0.6, 0.0, 0.8]))] for a in angles])
    q = quaternions_from_matrices(matrices)
    expected = np.stack(
        [np.cos(angles / 2), 0.6 * np.sin(angles / 2), 0 * angles, 0.8 * np.sin(angles / 2)], 1
    )
    np.testing.assert_allclose(q[:, 0], expected, atol=1e-12)
    np.testing.assert_allclose(matrix_from_quaternion(q[37, 0]), matrices[37, 0], atol=1e-14)


CURVES = [
    {"kind": "quintic", "start": 1.0, "end": -2.0, "t_start": 0.5, "t_end": 3.0},
    {"kind": "cosine", "mean": 1.0, "amplitude": 0.4, "period": 5.0, "phase": 0.3},
    {
        "kind": "sequence",
        "switch": [1.0],
        "pieces": [0.2, {"kind": "cosine", "mean": 0, "amplitude": 1, "period": 2}],
    },
]


@pytest.mark.parametrize("record", CURVES)
def test_curve_rates(record: dict[str, Any]) -> None:
    curve = reference_curves.from_record(record)
    for t in (0.2, 0.9, 1.4, 2.6, 4.0):
        low, high = curve(t - STEP), curve(t + STEP)
        for k in (0, 1):
            assert (high[k] - low[k]) / (2 * STEP) == pytest.approx(curve(t)[k + 1], abs=1e-6)


def test_the_two_linear_solvers_agree_and_duplicate_rows_share_their_multiplier() -> None:
    rng = np.random.default_rng(11)
    root = rng.normal(size=(12, 12))
    mass, rows = root @ root.T + np.eye(12), rng.normal(size=(5, 12))
    force, gamma = rng.normal(size=12), rng.normal(size=5)
    a, multipliers = solve_full_rank(mass, rows, force, gamma)
    np.testing.assert_allclose(mass @ a - rows.T @ multipliers, force, atol=1e-10)
    np.testing.assert_allclose(rows @ a, gamma, atol=1e-11)
    b, doubled = solve_redundant(mass, np.vstack([rows, rows]), force, np.tile(gamma, 2), 1e-11)
    np.testing.assert_allclose(b, a, atol=1e-10)
    np.testing.assert_allclose(doubled, 0.5 * np.tile(multipliers, 2), atol=1e-10)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"joints": [{"kind": "hinge", "name": "J", "second": "a", "point": [0, 0, 0]}]}, "kind 'hinge'"),
        ({"joints": [{"kind": "weld", "name": "J", "second": "z", "point": [0, 0, 0]}]}, "body 'z'"),
        ({"bodies": []} | {"sails": []}, "sails"),
    ],
)
def test_bad_records_name_what_is_wrong(change: dict[str, Any], message: str) -> None:
    records = {"bodies": [body("a", np.random.default_rng(0))]} | change
    with pytest.raises(ValueError, match=message):
        System.from_records(records)
