"""Small damping of hanging loads against closed forms: its ratio, its drag, its ledger, and none of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from element_runs import both_forms, goes_on
from line_scenes import MASS as LOAD
from line_scenes import STIFFNESS, hung
from test_jacobian import largest_error, moving

from seacrane import Curve, Scene, _core, equilibrium, natural_modes, simulate
from seacrane.analysis import Evaluator
from seacrane.arrays import Array
from seacrane.crane import Payload
from seacrane.hydro import shipped_database

G = 9.80665
LENGTH, MASS = 9.0, 12e3  # m, kg


def pendulum(angle: float = 1e-3, *, name: str = "pendulum") -> Scene:
    """A load below a fixed point, held at its centre: a point mass, let go at an angle (rad)."""
    scene = Scene(name=name)
    place = LENGTH * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 2e4, 3e4), position=place)
    scene.add_joint(
        kind="distance", name="link", first="ground", second="load", point=(0, 0, 0), second_point=place
    )
    return scene


def swing(result: Any) -> Array:
    x, _, z = result.select("position", body="load").T
    return np.arctan2(x, -z)


def decay(time: Array, ratio: float) -> Array:
    """Of a linear pendulum let go at 1."""
    omega = np.sqrt(G / LENGTH)
    damped = omega * np.sqrt(1.0 - ratio**2)
    turn = np.cos(damped * time) + ratio * omega / damped * np.sin(damped * time)
    return np.asarray(np.exp(-ratio * omega * time) * turn)


@pytest.mark.parametrize("ratio", [0.005, 0.2])
def test_a_point_mass_swings_with_that_ratio_of_critical_damping(ratio: float, formulation: str) -> None:
    scene = pendulum()
    scene.add_spring(name="swing", first="ground", second="load", damping_ratio=ratio)
    result = simulate(scene, t_end=30.0, rtol=1e-10, formulation=formulation)
    assert swing(result) == pytest.approx(1e-3 * decay(result.time, ratio), abs=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-6 * result["absolute_work"][-1]


def test_the_default_of_a_crane_s_payload_is_a_mode_of_that_ratio() -> None:
    """The load is no point mass: the mode that swings as a whole is near the ratio, not at it."""
    scene = Scene(name="crane")
    scene.add_crane(base="ground", payload=Payload(link_length=20.0, size=(2.0, 2.0, 2.0)))
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint=joint, curve=Curve.constant(value=0.0))
    modes = natural_modes(scene)
    assert modes.damping_ratio[:2] == pytest.approx([0.005, 0.005], rel=0.05)
    scene.remove("payload swing")
    assert natural_modes(scene).damping_ratio[:2] == pytest.approx([0.0, 0.0], abs=1e-9)


def thrown(scene: Scene, rng: np.random.Generator, *names: str) -> None:
    for name in names:
        scene.add_body(
            name=name, mass=2.0, inertia=(1.0, 2.0, 2.5), position=rng.normal(size=3),
            velocity=rng.normal(size=3), angular_velocity=rng.normal(size=3), gravity=False,
        )  # fmt: skip


def test_swing_damping_makes_no_momentum_and_no_force_along_the_wire() -> None:
    scene = Scene(name="free", gravity=9.0)
    rng = np.random.default_rng(3)
    thrown(scene, rng, "tip", "load")
    points = rng.normal(size=(2, 3))
    ends = {"first": "tip", "second": "load", "first_point": points[0], "second_point": points[1]}
    scene.add_spring(name="swing", damping_ratio=0.4, **ends)
    terms = Evaluator(scene.compile()).terms(0.0, scene.compile().initial_state)
    wrench = np.asarray(terms["mass"] @ terms["acceleration"]).reshape(2, 6)
    places = np.array([scene.bodies[name].position for name in ("tip", "load")])
    assert wrench[:, :3].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)
    total = wrench[:, 3:] + np.cross(places, wrench[:, :3])
    bodies = [scene.bodies[name] for name in ("tip", "load")]
    gyroscopic = [np.cross(b.angular_velocity, b.inertia @ b.angular_velocity) for b in bodies]
    assert total.sum(axis=0) == pytest.approx(-np.sum(gyroscopic, axis=0), abs=1e-9)
    wire = places[1] + points[1] - places[0] - points[0]
    assert wrench[1, :3] @ wire == pytest.approx(0.0, abs=1e-12)
    assert np.linalg.norm(wrench[1, :3]) > 0.1


def test_a_free_body_slows_in_still_air_as_one_over_time() -> None:
    scene = Scene(name="puck")
    scene.add_body(name="puck", mass=50.0, inertia=(1.0, 1.0, 1.0), velocity=(8.0, 0.0, 0.0), gravity=False)
    scene.add_wind(body="puck", frontal_area=12.0, lateral_area=40.0)
    result = simulate(scene, t_end=20.0, rtol=1e-9)
    rate = 0.5 * 1.226 * 1.05 * 12.0 / 50.0
    law = 8.0 / (1.0 + rate * 8.0 * result.time)
    assert result.select("velocity", body="puck")[:, 0] == pytest.approx(law, rel=1e-7)
    assert np.abs(result["energy_balance"]).max() < 1e-7 * result["absolute_work"][-1]


def test_half_swings_in_still_air_end_where_their_closed_form_says(formulation: str) -> None:
    """Of a'' + b |a'| a' + w^2 a = 0 from rest at a0 to rest at -a1: (1 + 2 b a0) exp(-2 b a0) =
    (1 - 2 b a1) exp(2 b a1); for small b the amplitude falls as 1 / (1 + 4 b a0 w t / (3 pi))."""
    start, area = 0.01, 5e4
    b = 0.5 * 1.226 * 1.05 * area * LENGTH / MASS
    scene = pendulum(start)
    scene.add_wind(body="load", frontal_area=area, lateral_area=area)
    result = simulate(scene, t_end=40.0, dt_out=0.05, rtol=1e-9, formulation=formulation)
    angle = swing(result)
    turns = np.flatnonzero(np.diff(np.sign(np.diff(angle)))) + 1
    peaks = []
    for i in turns[:6]:
        fit = np.polynomial.Polynomial.fit(result.time[i - 2 : i + 3], angle[i - 2 : i + 3], 4)
        at = [z.real for z in fit.deriv().roots() if abs(z.imag) < 1e-9]
        peaks.append(abs(fit(min(at, key=lambda t: abs(t - result.time[i])))))
    before = np.array([start, *peaks[:-1]])
    left = (1.0 + 2.0 * b * before) * np.exp(-2.0 * b * before)
    right = (1.0 - 2.0 * b * np.array(peaks)) * np.exp(2.0 * b * np.array(peaks))
    assert left == pytest.approx(right, rel=2e-5)
    halves = np.pi * np.arange(1, 7)
    averaged = start / (1.0 + 4.0 * b * start * halves / (3.0 * np.pi))
    assert np.array(peaks) == pytest.approx(averaged, rel=0.03)
    assert np.abs(result["energy_balance"]).max() < 1e-6 * result["absolute_work"][-1]


@pytest.mark.warns(sometimes=["UnitWarning"])
@pytest.mark.parametrize(
    "kind", ["pendulum damping", "span drag", "immersed span", "wound span", "seabed node"]
)
def test_the_jacobian_is_exact_and_both_formulations_agree_to_the_bits_of_a_restart(kind: str) -> None:
    def make() -> Scene:
        scene, rng = Scene(name="two"), np.random.default_rng(5)
        thrown(scene, rng, "first", "second")
        scene.add_load(_core.LOAD_KINDS[kind].example())
        return scene

    model = make().compile()
    for seed in (1, 2):
        assert largest_error(model, 0.0, moving(model, seed), step=3e-4) < 1e-7
    both_forms(make(), 2.0, {"position": 1e-8}, rtol=1e-10)
    goes_on(make, 2.0, 1.0)


def test_drag_of_an_oblique_wind_is_that_of_each_area() -> None:
    scene = Scene(name="box")
    scene.add_body(name="box", mass=1e3, inertia=(1.0, 1.0, 1.0), gravity=False)
    scene.add_wind(
        body="box", frontal_area=6.0, lateral_area=20.0, drag_coefficient=2.0, speed=10.0, direction_deg=33.0
    )
    model = scene.compile()
    found = np.asarray(Evaluator(model).terms(0.0, model.initial_state)["acceleration"])[:3] * 1e3
    angle = np.radians(33.0)
    expected = 0.5 * 1.226 * 2.0 * 100.0 * np.array([6.0 * np.cos(angle), 20.0 * np.sin(angle), 0.0])
    assert found == pytest.approx(expected, abs=2e-5 * 0.5 * 1.226 * 2.0 * 100.0 * 20.0)


def below_a_ship(order: int) -> Scene:
    scene = Scene(name="order")
    scene.add_vessel(shipped_database())
    scene.add_body(name="load", mass=LOAD, inertia=(LOAD, LOAD, LOAD), position=(0, 40, 5))
    scene.add_line(name="hoist", bodies=["vessel", "load"][::order], points=[(0, 40, 25), (0, 0, 0)][::order],
                   EA=2e7, tension_at_start=0.8 * LOAD * G)  # fmt: skip
    return scene


def bounce(scene: Scene) -> tuple[float, float, float]:
    """Mass (kg), frequency (rad/s) and ratio."""
    return scene.compile().line_bounces["hoist"]


def test_the_order_of_the_ends_does_not_matter() -> None:
    there, back = (bounce(below_a_ship(order)) for order in (1, -1))
    assert there == pytest.approx(back, rel=1e-12)
    assert 0.8 * LOAD < there[0] < LOAD and there[2] == pytest.approx(0.02)


def test_falls_count_and_a_mass_that_is_given_is_taken() -> None:
    falls, scene = 3, hung(falls=3, damping=0.02)
    scene.replace("hoist", mass=0.0)
    assert bounce(scene) == pytest.approx((LOAD / falls**2, np.sqrt(STIFFNESS / LOAD), 0.02), rel=1e-9)
    modes = natural_modes(scene, state=equilibrium(scene))
    assert np.max(modes.damping_ratio) == pytest.approx(0.02, rel=1e-2)
    scene.replace("hoist", mass=100.0 * LOAD / falls**2)
    assert bounce(scene)[2] == pytest.approx(0.2)
    seated = Scene(name="deck")
    seated.add_body(name="load", mass=LOAD, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0))
    seated.add_joint(kind="weld", name="deck", first="ground", second="load")
    seated.add_stop(joint="deck")
    seated.add_line(name="hoist", bodies=["ground", "load"] * falls, points=np.zeros((2 * falls, 3)), EA=5e7)
    assert bounce(seated)[0] == pytest.approx(LOAD / (2 * falls - 1) ** 2, rel=1e-9)  # as if lifted


def test_all_that_hangs_on_a_hook_counts() -> None:
    """20 t on four stiff slings below a hook of 500 kg on a soft hoist."""
    scene, whole = Scene(name="slings"), LOAD + 500.0
    scene.add_body(name="hook", mass=500.0, inertia=(50.0, 50.0, 50.0), position=(0, 0, -20.0))
    scene.add_body(name="box", mass=LOAD, inertia=(4e4, 4e4, 6e4), position=(0, 0, -25.0))
    corners = [(2, 1, 1), (-2, 1, 1), (-2, -1, 1), (2, -1, 1)]
    for corner in corners:
        scene.add_line(f"sling {corner}", bodies=["hook", "box"], points=[(0, 0, 0), corner], EA=2e8)
    scene.add_line(
        name="hoist", bodies=["ground", "hook"], points=np.zeros((2, 3)), EA=3e7, tension_at_start=whole * G
    )
    mass, _, ratio = bounce(scene)
    assert mass == pytest.approx(whole, rel=0.05) and ratio == pytest.approx(0.02, rel=0.05)
    modes = natural_modes(scene, state=equilibrium(scene))
    period = 2.0 * np.pi * np.sqrt(whole * 20.0 / 3e7)
    heave = int(np.argmin(np.abs(modes.natural_period / period - 1.0)))
    assert modes.damping_ratio[heave] == pytest.approx(0.02, rel=0.05)
