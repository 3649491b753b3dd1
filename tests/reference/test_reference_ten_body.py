"""The ten-body crane: counts, balance, statics by hand, energy, momentum, convergence, drivers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from . import reference_curves, ten_body
from .rotation import Array, cross, dot, matrix_from_quaternion
from .simulate import simulate
from .system import System

G = 9.81


def test_counts() -> None:
    system = System.from_records(ten_body.records())
    assert (6 * len(system.mass), system.rows.count, system.rank, system.degrees_of_freedom) == (
        60,
        46,
        46,
        14,
    )
    assert sum(b["mass"] for b in ten_body.crane_bodies(ten_body.points())) == pytest.approx(390e3)


def test_balance_is_the_weight_and_its_moment() -> None:
    scene = ten_body.records()
    loads = ten_body.balance(scene)
    weights = [(b["mass"] * G, np.array(b["position"])) for b in scene["bodies"][1:]]
    total = sum(w for w, _ in weights)
    center = sum((w * p for w, p in weights), np.zeros(3)) / total
    assert loads["sea.heave"] == pytest.approx(total, rel=1e-12)
    assert loads["sea.roll"] == pytest.approx(total * center[1], rel=1e-10)
    assert loads["sea.pitch"] == pytest.approx(-total * center[0], rel=1e-10)
    for name in ("sea.surge", "sea.sway", "sea.yaw", "A"):
        assert abs(loads[name]) < 1e-6 * total


def test_cylinder_forces_at_rest_follow_from_moments_about_the_pivots() -> None:
    scene = ten_body.records(vessel=False)
    loads = ten_body.balance(scene)
    p = ten_body.points()
    body = {b["name"]: b for b in scene["bodies"]}

    def force(cylinder: str, low: str, high: str, pivot: str, carried: list[tuple[float, Array]]) -> float:
        moment = sum(m * G * (x - p[pivot])[0] for m, x in carried)
        span = p[high] - p[low]
        length = float(np.linalg.norm(span))
        along, lever = span / length, p[high] - p[pivot]
        parts = [body[f"{cylinder}_{part}"] for part in ("barrel", "rod")]
        # moments of the cylinder's own weight about its foot: what it leans on the rod end across its line
        leaning = sum(b["mass"] * G * (np.array(b["position"]) - p[low])[0] for b in parts) / length
        across = cross(np.array([0.0, 1.0, 0.0]), along)
        push = (-moment - leaning * cross(lever, across)[1]) / cross(lever, along)[1]
        return float(push + parts[1]["mass"] * G * along[2])  # the driver also holds the rod's weight

    tip = [(body["payload"]["mass"], p["tip"])]
    knuckle = [(body["knuckle_jib"]["mass"], np.array(body["knuckle_jib"]["position"])), *tip]
    expected = force("knuckle", "E", "G", "F", knuckle)
    assert loads["knuckle_cylinder"] == pytest.approx(expected, rel=1e-9)


def test_base_reactions_carry_the_weight_and_every_body_balances() -> None:
    scene = ten_body.records(vessel=False, case=2)
    system = System.from_records(scene)
    e = system.evaluate(0.0, system.start, np.zeros(0))
    assert np.max(np.abs(e.acceleration)) < 1e-9
    force, _ = system.reactions(e)
    np.testing.assert_allclose(force[system.joint_names.index("deck")], [0.0, 0.0, 400e3 * G], atol=1e-3)
    motion = simulate(system, 3.0, [3.0], rtol=1e-9)
    balance_of_bodies(system, scene, motion)


def balance_of_bodies(system: System, scene: dict[str, Any], out: dict[str, Any]) -> None:
    """Newton-Euler residual of every body from the recorded reactions, actuator loads and weights."""
    names = {b["name"]: i for i, b in enumerate(scene["bodies"])}
    rotation = np.array([matrix_from_quaternion(q) for q in out["quaternion"][-1]])
    r = out["position"][-1]
    start = system.start

    def carried(body: int, point: Any) -> Array:
        return np.asarray(
            r[body] + rotation[body] @ start.rotation[body].T @ (np.asarray(point) - start.r[body])
        )

    force, moment = np.zeros((len(r), 3)), np.zeros((len(r), 3))
    for k, record in enumerate(scene["joints"]):
        first, second = names.get(record["first"], -1), names[record["second"]]
        on_second = record["kind"] == "distance"
        if first < 0:
            point = np.asarray(record["point"])
        else:
            point = carried(second, record["second_point"]) if on_second else carried(first, record["point"])
        f, n = out["reaction_force"][-1, k].copy(), out["reaction_moment"][-1, k].copy()
        if record["name"] in out["names"]["actuator"]:
            axis = rotation[first] @ start.rotation[first].T @ np.array(record["axis"])
            load = out["actuator_load"][-1, out["names"]["actuator"].index(record["name"])]
            f, n = (f, n + load * axis) if record["kind"] == "revolute" else (f + load * axis, n)
        for body, sign in ((second, 1.0), (first, -1.0)):
            if body >= 0:
                force[body] += sign * f
                moment[body] += sign * (n + cross(point - r[body], f))
    force[:, 2] -= G * system.mass
    a = out["acceleration"][-1]
    inertia = rotation @ system.inertia @ rotation.transpose(0, 2, 1)
    w = out["angular_velocity"][-1]
    euler = np.einsum("bij,bj->bi", inertia, a[:, 3:]) + cross(w, np.einsum("bij,bj->bi", inertia, w))
    np.testing.assert_allclose(force, system.mass[:, None] * a[:, :3], atol=1e-2)
    np.testing.assert_allclose(moment, euler, atol=1e-1)


def test_energy_balance_closes_in_waves_and_falls_with_tolerance() -> None:
    system = System.from_records(ten_body.records(case=2))
    errors = []
    for rtol in (1e-4, 1e-7):
        out = simulate(system, 8.0, np.linspace(0.0, 8.0, 9), rtol=rtol)
        errors.append(np.max(np.abs(out["energy_balance"])) / out["absolute_work"][-1])
        assert np.max(out["constraint_error"]) < 1e-11
    assert errors[1] < 1e-9
    assert errors[1] < 0.1 * errors[0]


def test_floating_crane_in_zero_gravity_keeps_its_momentum() -> None:
    scene = ten_body.records(case=3)
    scene = {k: v for k, v in scene.items() if k not in ("vessel", "point_forces")} | {"gravity": [0.0] * 3}
    system = System.from_records(scene)
    out = simulate(system, 10.0, np.linspace(0.0, 10.0, 11), rtol=1e-8)
    rotation = np.array([[matrix_from_quaternion(q) for q in row] for row in out["quaternion"]])
    inertia = rotation @ system.inertia @ rotation.swapaxes(-1, -2)
    linear = np.einsum("b,tbi->tbi", system.mass, out["velocity"])
    spin = np.einsum("tbij,tbj->tbi", inertia, out["angular_velocity"])
    angular = spin + cross(out["position"], linear)
    size = np.max(np.sum(np.abs(linear), axis=1))
    assert size > 1e4
    np.testing.assert_allclose(linear.sum(axis=1), 0.0, atol=1e-6 * size)
    np.testing.assert_allclose(angular.sum(axis=1), 0.0, atol=1e-5 * size)


@pytest.mark.slow("an engine in Python")
def test_the_crane_reaches_its_references() -> None:
    system = System.from_records(ten_body.records(vessel=False, payload=False, case=2))
    out = simulate(system, 50.0, [25.0, 50.0], rtol=1e-4)
    names = out["names"]["coordinate"]
    final = dict(zip(names, out["coordinate"][-1], strict=True))
    assert final["A"] == pytest.approx(-0.5 * math.pi, abs=0.01)
    for name in ("main_cylinder", "knuckle_cylinder"):
        assert final[name] == pytest.approx(2.0, abs=0.15)
    stroke = np.linalg.norm(separation(system, out, "main"), axis=1) - np.linalg.norm(
        np.subtract(ten_body.points()["D"], ten_body.points()["B"])
    )
    np.testing.assert_allclose(stroke, out["coordinate"][:, names.index("main_cylinder")], atol=1e-9)


def separation(system: System, out: dict[str, Any], cylinder: str) -> Array:
    """Vector from the cylinder's foot to its rod end at every output."""
    low, high = {"main": ("B", "D"), "knuckle": ("E", "G")}[cylinder]
    p = ten_body.points()
    ends = []
    for part, name in (("barrel", low), ("rod", high)):
        k = system.body_names.index(f"{cylinder}_{part}")
        rotation = np.array([matrix_from_quaternion(q) for q in out["quaternion"][:, k]])
        ends.append(out["position"][:, k] + rotation @ (p[name] - system.start.r[k]))
    return np.asarray(ends[1] - ends[0])


def test_driven_loads_given_back_as_forces_return_the_motion() -> None:
    curve = reference_curves.quintic(0.0, -0.3, 0.0, 4.0)
    stroke = reference_curves.quintic(0.0, 0.5, 0.0, 4.0)
    scene = ten_body.records(vessel=False)
    names = ("A", "main_cylinder", "knuckle_cylinder")
    drivers = [{"joint": n, "reference": curve if n == "A" else stroke} for n in names]
    driven = System.from_records({**scene, "drivers": drivers})
    times = np.linspace(0.0, 4.0, 41)
    first = simulate(driven, 4.0, times, rtol=1e-9)
    slots = [first["names"]["coordinate"].index(n) for n in names]
    expected = np.array([[curve(t)[0], stroke(t)[0], stroke(t)[0]] for t in times])
    np.testing.assert_allclose(first["coordinate"][:, slots], expected, atol=1e-11)
    assert np.max(np.abs(first["energy_balance"])) < 1e-8 * first["absolute_work"][-1]

    from scipy.interpolate import CubicSpline

    loads = CubicSpline(times, first["driver_load"])
    # a follower with unit stiffness and the load as its set-point is a force given in time
    actuators = [
        {"joint": n, "damping": 1.0, "reference": lambda t, k=k: (0.0, float(loads(t)[k]), 0.0)}
        for k, n in enumerate(names)
    ]
    free = System.from_records({**scene, "actuators": actuators})
    second = simulate(free, 4.0, times, rtol=1e-9)
    np.testing.assert_allclose(second["coordinate"][:, slots], expected, atol=2e-4)


def test_driven_free_joint_follows_six_motions() -> None:
    scene = ten_body.records(payload=False)
    scene["joints"].append(
        {"kind": "free", "name": "sea", "first": None, "second": "vessel", "point": [0.0, 0.0, 0.0]}
    )
    motions = ("surge", "sway", "heave", "roll", "pitch", "yaw")
    sizes = (1.0, -0.5, 0.7, 0.2, -0.1, 0.3)
    curves = [reference_curves.quintic(0.0, s, 0.0, 6.0) for s in sizes]
    scene["drivers"] = [
        {"joint": "sea", "motion": m, "reference": c} for m, c in zip(motions, curves, strict=True)
    ] + [{"joint": j, "reference": 0.0} for j in ("A", "main_cylinder", "knuckle_cylinder")]
    system = System.from_records(scene)
    assert system.degrees_of_freedom == 0
    out = simulate(system, 6.0, [3.0, 6.0], rtol=1e-8)
    expected = [[curve(t)[0] for curve in curves] for t in (3.0, 6.0)]
    np.testing.assert_allclose(out["vessel_motion"], expected, atol=1e-11)
    assert np.max(np.abs(out["energy_balance"])) < 1e-7 * out["absolute_work"][-1]


@pytest.mark.slow("runs at many tolerances")
def test_payload_path_converges_with_tolerance() -> None:
    system = System.from_records(ten_body.records(case=2))
    ends = [simulate(system, 3.0, [3.0], rtol=rtol)["position"][0, -1] for rtol in (1e-3, 1e-7, 1e-10)]
    errors = [math.sqrt(float(dot(e - ends[-1], e - ends[-1]))) for e in ends[:-1]]
    assert errors[1] < 0.1 * errors[0]
    assert errors[1] < 1e-8
