"""Constrained solver against minimal-coordinate and closed-form solutions, and those against their
invariants.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .classic import Link, double_pendulum, free_rotation, spherical_pendulum
from .jets import Jet
from .mechanisms import ChangePointFourBar, SingleCoordinate, SliderCrank
from .rotation import Array, dot, matrix_from_quaternion, quaternions_from_matrices
from .simulate import simulate
from .system import System

UPRIGHT = [1.0, 0.0, 0.0, 0.0]
TIMES = np.linspace(0.0, 5.0, 51)


def joint(kind: str, name: str, first: str | None, second: str, point: Any, **more: Any) -> dict[str, Any]:
    return {"kind": kind, "name": name, "first": first, "second": second, "point": list(point), **more}


def test_free_rotation_about_the_intermediate_axis() -> None:
    inertia = (3.0, 2.0, 1.0)
    for rates in ((0.02, 0.0, 1.5), (1.5, 0.0, 0.02), (1.0, 0.0, 1.0)):
        w = free_rotation(TIMES, inertia, rates)
        i1, i2, i3 = inertia
        energy = w**2 @ np.array(inertia)
        momentum = (w * np.array(inertia)) ** 2 @ np.ones(3)
        np.testing.assert_allclose(energy, energy[0], rtol=1e-12)
        np.testing.assert_allclose(momentum, momentum[0], rtol=1e-12)
        slope = np.gradient(free_rotation(np.arange(-2, 3) * 1e-4 + 1.0, inertia, rates), 1e-4, axis=0)[2]
        now = free_rotation([1.0], inertia, rates)[0]
        right = [
            (i2 - i3) / i1 * now[1] * now[2],
            (i3 - i1) / i2 * now[2] * now[0],
            (i1 - i2) / i3 * now[0] * now[1],
        ]
        np.testing.assert_allclose(slope, right, atol=1e-7)


def test_tumbling_body_follows_the_elliptic_functions() -> None:
    inertia, rates = (3.0, 2.0, 1.0), (1.0, 0.0, 2.0)
    q = [0.5, 0.5, -0.5, 0.5]
    rotation = matrix_from_quaternion(q)
    block = {
        "name": "block",
        "mass": 1.0,
        "inertia": np.diag(inertia).tolist(),
        "position": [0.0, 0.0, 0.0],
        "quaternion": q,
        "angular_velocity": (rotation @ rates).tolist(),
    }
    out = simulate(System.from_records({"gravity": [0, 0, 0], "bodies": [block]}), 5.0, TIMES, rtol=1e-11)
    matrices = np.array([matrix_from_quaternion(row) for row in out["quaternion"][:, 0]])
    body_rates = np.einsum("kji,kj->ki", matrices, out["angular_velocity"][:, 0])
    np.testing.assert_allclose(body_rates, free_rotation(TIMES, inertia, rates), atol=1e-9)
    momentum = np.einsum("kij,kj->ki", matrices, body_rates * np.array(inertia))
    np.testing.assert_allclose(momentum, np.broadcast_to(momentum[0], momentum.shape), atol=1e-9)


def test_spherical_pendulum_keeps_energy_and_vertical_momentum() -> None:
    x, v = spherical_pendulum(TIMES, [1.0, 0.0, -1.5], [0.3, 2.0, 0.2])
    energy = 0.5 * dot(v, v) + 9.81 * x[:, 2]
    np.testing.assert_allclose(energy, energy[0], rtol=1e-10)
    np.testing.assert_allclose(x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0], 2.0, rtol=1e-10)
    np.testing.assert_allclose(dot(x, x), 3.25, rtol=1e-10)


@pytest.mark.parametrize("kind", ["spherical", "distance"])
def test_constrained_pendulum_follows_the_point_mass(kind: str) -> None:
    start, mass, inertia = np.array([1.2, 0.0, -1.6]), 2.0, 0.5
    spherical = kind == "spherical"
    # on a spherical joint the ball turns with its arm; on a link through its centre it does not turn at all
    gravity = 9.81 * (4.0 * mass / (4.0 * mass + inertia) if spherical else 1.0)
    speed = np.array([0.8, 2.0, 0.6])
    x, v = spherical_pendulum(TIMES, start, speed, gravity)
    ball = {
        "name": "ball",
        "mass": mass,
        "inertia": (inertia * np.eye(3)).tolist(),
        "position": start.tolist(),
        "quaternion": UPRIGHT,
        "velocity": speed.tolist(),
        "angular_velocity": (np.cross(start, speed) / 4.0).tolist() if spherical else [0.0] * 3,
    }
    more = {} if spherical else {"second_point": start.tolist()}
    records = {"bodies": [ball], "joints": [joint(kind, "pivot", None, "ball", [0, 0, 0], **more)]}
    out = simulate(System.from_records(records), 5.0, TIMES, rtol=1e-11)
    np.testing.assert_allclose(out["position"][:, 0], x, atol=1e-8)
    np.testing.assert_allclose(out["velocity"][:, 0], v, atol=1e-8)
    reaction = mass * (out["acceleration"][:, 0, :3] + np.array([0, 0, 9.81]))
    np.testing.assert_allclose(out["reaction_force"][:, 0], reaction, atol=1e-8)
    if not spherical:
        tension = mass * (dot(v, v) + x @ np.array([0, 0, -9.81])) / 2.0
        np.testing.assert_allclose(-dot(out["reaction_force"][:, 0], x) / 2.0, tension, atol=1e-7)


def test_double_pendulum() -> None:
    a, b = Link(2.0, 0.3, 1.0, 0.5), Link(1.0, 0.2, 0.8, 0.45)
    angles, rates = double_pendulum(TIMES, (a, b), [1.2, 2.0], [0.5, -1.0])
    directions = [np.array([np.sin(q), 0.0, -np.cos(q)]) for q in (1.2, 2.0)]
    tangents = [np.array([np.cos(q), 0.0, np.sin(q)]) for q in (1.2, 2.0)]
    pin, pin_speed = a.length * directions[0], a.length * 0.5 * tangents[0]
    axis = [0.0, -1.0, 0.0]  # turns z down towards x
    bodies = []
    for name, link, k, base, base_speed, rate in (
        ("upper", a, 0, np.zeros(3), np.zeros(3), 0.5),
        ("lower", b, 1, pin, pin_speed, -1.0),
    ):
        bodies.append(
            {
                "name": name,
                "mass": link.mass,
                "inertia": (link.inertia * np.eye(3)).tolist(),
                "position": (base + link.center * directions[k]).tolist(),
                "quaternion": UPRIGHT,
                "velocity": (base_speed + link.center * rate * tangents[k]).tolist(),
                "angular_velocity": (rate * np.array(axis)).tolist(),
            }
        )
    joints = [
        joint("revolute", "shoulder", None, "upper", [0, 0, 0], axis=axis, coordinate=1.2),
        joint("revolute", "elbow", "upper", "lower", pin, axis=axis, coordinate=0.8),
    ]
    out = simulate(System.from_records({"bodies": bodies, "joints": joints}), 5.0, TIMES, rtol=1e-11)
    np.testing.assert_allclose(wrapped(out["coordinate"][:, 0] - angles[:, 0]), 0.0, atol=1e-7)
    np.testing.assert_allclose(out["coordinate_rate"].sum(axis=1), rates[:, 1], atol=1e-6)
    assert np.max(np.abs(out["energy_balance"])) < 1e-9 * np.ptp(out["energy"] + 1.0) + 1e-7


def wrapped(angle: Array) -> Array:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)


def bodies_of(mechanism: SingleCoordinate, names: list[str], q: float, rate: float) -> list[dict[str, Any]]:
    """Body records of a one-coordinate mechanism in a pose, moving at a rate."""
    out = []
    for name, moving in zip(names, mechanism.kinematics(Jet(q, 1.0)), strict=True):
        _, _, position, slope, spin = moving.terms()
        axes = np.array([[c.f for c in axis] for axis in moving.axes]).T
        out.append(
            {
                "name": name,
                "mass": moving.mass,
                "inertia": moving.inertia.tolist(),
                "position": position.tolist(),
                "quaternion": quaternions_from_matrices(axes[None, None])[0, 0].tolist(),
                "velocity": (rate * slope).tolist(),
                "angular_velocity": (rate * spin).tolist(),
            }
        )
    return out


CRANK = SliderCrank(Link(1.5, 0.08, 0.4, 0.15), (0.0, 0.3, 0.2), 1.2, 1.5, (0.02, 0.25, 0.24), 2.0)


def slider_crank_records(q: float, rate: float) -> dict[str, Any]:
    mechanism = CRANK.mechanism()
    bodies = bodies_of(mechanism, ["crank", "rod", "slider"], q, rate)
    rod = CRANK.kinematics(Jet(q, 1.0))[1]
    e, n = (np.array([c.f for c in rod.axes[k]]) for k in (0, 1))
    middle = np.array(bodies[1]["position"])
    pin, end = middle - 0.75 * e, middle + 0.75 * e
    joints = [
        joint("revolute", "shaft", None, "crank", CRANK.pivot, axis=[1, 0, 0], coordinate=q),
        joint("spherical", "pin", "crank", "rod", pin),
        joint("universal", "cross", "slider", "rod", end, axis=[0, 1, 0], second_axis=n.tolist()),
        joint("prismatic", "guide", None, "slider", end, axis=[1, 0, 0], coordinate=float(end[0])),
    ]
    return {"bodies": bodies, "joints": joints}


@pytest.mark.slow("a long run at tight tolerance")
def test_spatial_slider_crank() -> None:
    q0, rate0 = 0.4, 6.0
    mechanism = CRANK.mechanism()
    q, rate = mechanism.simulate(TIMES, q0, rate0)
    energies = [mechanism.energy(a, b) for a, b in zip(q, rate, strict=True)]
    np.testing.assert_allclose(energies, energies[0], rtol=1e-10)
    assert np.ptp(q) > 2 * np.pi  # the crank goes round
    system = System.from_records(slider_crank_records(q0, rate0))
    assert (system.rows.count, system.degrees_of_freedom) == (17, 1)
    out = simulate(system, 5.0, TIMES, rtol=1e-11)
    np.testing.assert_allclose(wrapped(out["coordinate"][:, 0] - q), 0.0, atol=1e-7)
    positions, rotations = mechanism.poses(q)
    np.testing.assert_allclose(out["position"], positions, atol=1e-7)
    turned = np.array([[matrix_from_quaternion(b) for b in row] for row in out["quaternion"]])
    np.testing.assert_allclose(turned, rotations, atol=1e-7)


PARALLEL = ChangePointFourBar(
    Link(1.0, 0.1, 0.5, 0.2), Link(2.0, 0.3, 1.2, 0.5), Link(1.5, 0.1, 0.5, 0.3), 1.2
)
RHOMBUS = ChangePointFourBar(
    Link(1.0, 0.1, 0.8, 0.4), Link(2.0, 0.3, 0.8, 0.4), Link(1.5, 0.1, 0.8, 0.4), 0.8
)
CHANGE_POINT = ChangePointFourBar(
    Link(1.0, 0.1, 0.5, 0.2), Link(2.0, 0.3, 1.0, 0.5), Link(1.5, 0.2, 0.9, 0.4), 1.4
)


def four_bar_records(bar: ChangePointFourBar, q: float, rate: float, gravity: list[float]) -> dict[str, Any]:
    bodies = bodies_of(bar.mechanism(), ["crank", "coupler", "rocker"], q, rate)
    pin = bar.crank.length * np.array([np.cos(q), np.sin(q), 0.0])
    axes = [np.array([c.f for c in moving.axes[0]]) for moving in bar.kinematics(Jet(q, 1.0))]
    elbow = pin + bar.coupler.length * axes[1]
    joints = [
        joint("revolute", "O", None, "crank", [0, 0, 0], axis=[0, 0, 1], coordinate=q),
        joint("revolute", "A", "crank", "coupler", pin, axis=[0, 0, 1]),
        joint("revolute", "B", "coupler", "rocker", elbow, axis=[0, 0, 1]),
        joint("revolute", "C", None, "rocker", [bar.ground, 0, 0], axis=[0, 0, 1]),
    ]
    return {"gravity": gravity, "bodies": bodies, "joints": joints}


@pytest.mark.parametrize("bar", [PARALLEL, CHANGE_POINT], ids=["parallelogram", "change-point"])
def test_four_bar_closes_and_keeps_its_energy_through_the_flat_position(bar: ChangePointFourBar) -> None:
    for q in np.linspace(0.1, 4 * np.pi, 40):
        crank, coupler, rocker = bar.kinematics(Jet(float(q), 1.0))
        along = [np.array([c.f for c in m.axes[0]]) for m in (crank, coupler, rocker)]
        tip = bar.crank.length * along[0] + bar.coupler.length * along[1]
        np.testing.assert_allclose(tip - bar.rocker.length * along[2], [bar.ground, 0, 0], atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(along, axis=1), 1.0, atol=1e-12)
    mechanism = bar.mechanism((0.0, -9.81, 0.0))
    q, rate = mechanism.simulate(TIMES, 1.0, 8.0)
    assert q[-1] > 3 * np.pi
    energies = [mechanism.energy(a, b) for a, b in zip(q, rate, strict=True)]
    np.testing.assert_allclose(energies, energies[0], rtol=1e-10)


@pytest.mark.parametrize(
    ("bar", "q0"),
    [(PARALLEL, 1.0), (RHOMBUS, 1.5), (CHANGE_POINT, 1.0)],
    ids=["parallelogram", "rhombus", "other"],
)
def test_constrained_four_bar_passes_its_flat_position(bar: ChangePointFourBar, q0: float) -> None:
    gravity, rate0 = [0.0, -9.81, 0.0], 8.0
    times = np.linspace(0.0, 0.45, 19)
    q, _ = bar.mechanism(gravity).simulate(times, q0, rate0)
    assert q0 < np.pi < q[-1] < 2 * np.pi
    system = System.from_records(four_bar_records(bar, q0, rate0, gravity))
    assert system.redundant
    assert (system.rows.count, system.rank) == (20, 17)
    out = simulate(system, 0.45, times, rtol=1e-9, projection_interval=0.05)
    positions, _ = bar.mechanism(gravity).poses(q)
    np.testing.assert_allclose(out["position"], positions, atol=1e-5)
    assert np.max(out["constraint_error"]) < 1e-8
