"""Small damping of hanging loads against closed forms: its ratio, its drag, its ledger, and none of it."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from test_jacobian import largest_error, moving

from seacrane import Curve, Run, Scene, SceneError, _core, cases, natural_modes, simulate
from seacrane.analysis import Evaluator
from seacrane.crane import Payload
from seacrane.warnings import CompassDirectionWarning

Array = NDArray[np.float64]
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


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize("ratio", [0.005, 0.2])
def test_a_point_mass_swings_with_that_ratio_of_critical_damping(ratio: float, formulation: str) -> None:
    scene = pendulum()
    scene.add_pendulum_damping(name="swing", first="ground", second="load", ratio=ratio)
    result = simulate(scene, t_end=30.0, rtol=1e-10, formulation=formulation)
    assert swing(result) == pytest.approx(
        1e-3 * decay(result.time, ratio), abs=1e-8
    )  # sin: 1e-6 of the angle in the period
    assert np.abs(result["energy_balance"]).max() < 1e-6 * result["absolute_work"][-1]


def test_two_maxima_have_the_logarithmic_decrement_of_the_ratio() -> None:
    scene = pendulum()
    scene.add_pendulum_damping(name="swing", first="ground", second="load", ratio=0.03)
    period = 2.0 * np.pi / np.sqrt(G / LENGTH) / np.sqrt(1.0 - 0.03**2)
    result = simulate(scene, t_end=3.0 * period, dt_out=period, rtol=1e-10)
    decrement = np.log(swing(result)[:-1] / swing(result)[1:])
    assert decrement == pytest.approx(np.full(3, 2.0 * np.pi * 0.03 / np.sqrt(1.0 - 0.03**2)), rel=1e-4)


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


def test_swing_damping_makes_no_momentum_and_no_force_along_the_wire() -> None:
    scene = Scene(name="free", gravity=9.0)
    rng = np.random.default_rng(3)
    for name in ("tip", "load"):
        scene.add_body(
            name=name, mass=2.0, inertia=(1.0, 2.0, 2.5), position=rng.normal(size=3),
            velocity=rng.normal(size=3), angular_velocity=rng.normal(size=3), gravity=False,
        )  # fmt: skip
    points = rng.normal(size=(2, 3))
    scene.add_pendulum_damping(
        name="swing", first="tip", second="load", first_point=points[0], second_point=points[1], ratio=0.4
    )
    terms = Evaluator(scene.compile()).terms(0.0, scene.compile().initial_state)
    wrench = np.asarray(terms["mass"] @ terms["acceleration"]).reshape(2, 6)
    places = np.array([scene.bodies[name].position for name in ("tip", "load")])
    assert wrench[:, :3].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)
    total = wrench[:, 3:] + np.cross(places, wrench[:, :3])
    gyroscopic = [_gyroscopic(scene.bodies[name]) for name in ("tip", "load")]
    assert total.sum(axis=0) == pytest.approx(-np.sum(gyroscopic, axis=0), abs=1e-9)
    wire = places[1] + points[1] - places[0] - points[0]
    assert wrench[1, :3] @ wire == pytest.approx(0.0, abs=1e-12)
    assert np.linalg.norm(wrench[1, :3]) > 0.1


def _gyroscopic(body: _core.Body) -> Array:
    omega = np.asarray(body.angular_velocity)
    return np.cross(omega, np.asarray(body.inertia) @ omega)


def test_a_free_body_slows_in_still_air_as_one_over_time() -> None:
    scene = Scene(name="puck")
    scene.add_body(name="puck", mass=50.0, inertia=(1.0, 1.0, 1.0), velocity=(8.0, 0.0, 0.0), gravity=False)
    scene.add_air_drag(body="puck", frontal_area=12.0, lateral_area=40.0)
    result = simulate(scene, t_end=20.0, rtol=1e-9)
    rate = 0.5 * 1.226 * 1.05 * 12.0 / 50.0
    law = 8.0 / (1.0 + rate * 8.0 * result.time)
    assert result.select("velocity", body="puck")[:, 0] == pytest.approx(law, rel=1e-7)
    assert np.abs(result["energy_balance"]).max() < 1e-7 * result["absolute_work"][-1]


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_half_swings_in_still_air_end_where_their_closed_form_says(formulation: str) -> None:
    """Of a'' + b |a'| a' + w^2 a = 0 from rest at a0 to rest at -a1: (1 + 2 b a0) exp(-2 b a0) =
    (1 - 2 b a1) exp(2 b a1); for small b the amplitude falls as 1 / (1 + 4 b a0 w t / (3 pi))."""
    start, area = 0.01, 5e4
    b = 0.5 * 1.226 * 1.05 * area * LENGTH / MASS
    scene = pendulum(start)
    scene.add_air_drag(body="load", frontal_area=area, lateral_area=area)
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
def test_the_jacobian_is_exact_and_both_formulations_agree(kind: str) -> None:
    scene = Scene(name="two")
    rng = np.random.default_rng(5)
    for name in ("first", "second"):
        scene.add_body(
            name=name, mass=2.0, inertia=(1.0, 2.0, 2.5), position=rng.normal(size=3),
            velocity=rng.normal(size=3), angular_velocity=rng.normal(size=3), gravity=False,
        )  # fmt: skip
    scene.add_load(_core.LOAD_KINDS[kind].example())
    model = scene.compile()
    for seed in (1, 2):
        assert largest_error(model, 0.0, moving(model, seed), step=3e-4) < 1e-7
    ends = [simulate(scene, t_end=2.0, rtol=1e-10, formulation=one) for one in ("redundant", "recursive")]
    assert ends[0]["position"][-1] == pytest.approx(ends[1]["position"][-1], abs=1e-8)
    for result in ends:
        assert np.abs(result["energy_balance"]).max() < 1e-7 * result["absolute_work"][-1]


def test_drag_of_an_oblique_wind_is_that_of_each_area() -> None:
    scene = Scene(name="box")
    scene.add_body(name="box", mass=1e3, inertia=(1.0, 1.0, 1.0), gravity=False)
    scene.add_air_drag(
        body="box", frontal_area=6.0, lateral_area=20.0, drag_coefficient=2.0, speed=10.0, direction_deg=33.0
    )
    model = scene.compile()
    found = np.asarray(Evaluator(model).terms(0.0, model.initial_state)["acceleration"])[:3] * 1e3
    angle = np.radians(33.0)
    expected = 0.5 * 1.226 * 2.0 * 100.0 * np.array([6.0 * np.cos(angle), 20.0 * np.sin(angle), 0.0])
    assert found == pytest.approx(expected, abs=2e-5 * 0.5 * 1.226 * 2.0 * 100.0 * 20.0)


def test_still_air_against_the_waves_is_no_wind() -> None:
    scene = cases.case2(hs=2.0, wave_direction_deg=180.0)
    scene.add_air_drag(body="payload", frontal_area=24.0, lateral_area=24.0)
    with warnings.catch_warnings():
        warnings.simplefilter("error", CompassDirectionWarning)
        simulate(scene, t_end=0.1)


def test_without_damping_a_crane_is_as_before_to_the_bit() -> None:
    """And so is one whose numbers are zero: nothing is added."""
    scenes = []
    for payload, damping in (
        (Payload(), False), (Payload(swing_damping_ratio=0.0, drag_coefficient=0.0), True)
    ):  # fmt: skip
        scene = Scene(name="crane")
        scene.add_crane(base="ground", payload=payload, damping=damping)
        assert not scene.loads
        scenes.append(scene)
    assert scenes[0] == scenes[1]
    damped = Scene(name="crane")
    damped.add_crane(base="ground", payload=Payload())
    assert list(damped.loads) == ["payload swing", "payload drag"]
    for name in list(damped.loads):
        damped.remove(name)
    assert damped == scenes[0]


def test_the_paper_s_cases_have_none() -> None:
    for case in (cases.case1, cases.case2, cases.case3):
        assert not case().loads


def test_each_payload_of_two_cranes_has_its_own() -> None:
    scene = Scene(name="tandem")
    for prefix, y in (("", 0.0), ("aft ", 30.0)):
        scene.add_crane(base="ground", foot=(0.0, y, 0.0), prefix=prefix, payload=Payload())
    assert list(scene.loads) == [
        "payload swing", "payload drag", "aft payload swing", "aft payload drag"
    ]  # fmt: skip
    swings = [scene.loads[name] for name in ("payload swing", "aft payload swing")]
    assert [one.first for one in swings] == ["knuckle_jib", "aft knuckle_jib"]


def test_a_damped_scene_comes_back_from_its_file_and_goes_on_to_the_bit(tmp_path: Path) -> None:
    scene = pendulum(0.1)
    scene.add_pendulum_damping(name="swing", first="ground", second="load")
    scene.add_air_drag(body="load", frontal_area=10.0, lateral_area=12.0)
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again == scene
    whole, half = (Run(one, t_end=2.0) for one in (scene, again))
    for run in (whole, half):
        run.advance(1.0)
    whole.advance(2.0)
    rest = Run(again, t_end=2.0, start=half.state)
    rest.advance(2.0)
    assert rest.state == whole.state


@pytest.mark.parametrize(
    ("call", "given", "message"),
    [
        ("add_pendulum_damping", {"ratio": -0.1}, "pendulum damping 'swing': ratio is -0.1"),
        (
            "add_pendulum_damping",
            {"ratio": 20.0},
            "ratio is 20; give 0 to 10 .of critical damping of the swing",
        ),
        ("add_pendulum_damping", {"second": "hook"}, "pendulum damping 'swing': there is no body 'hook'"),
        ("add_pendulum_damping", {"first": "load"}, "joins 'load' to itself"),
        ("add_pendulum_damping", {"mass": "1e3"}, "mass is '1e3'; give a number"),
        ("add_air_drag", {"drag_coefficient": -1.0}, "drag_coefficient is -1.0; give a finite number"),
        ("add_air_drag", {"body": "hook"}, "air drag 'hook drag': there is no body 'hook'"),
        ("add_air_drag", {"frontal_area": -2.0}, "frontal_area is -2 m2; it must not be negative"),
        ("add_air_drag", {"point": (0.0, 0.0)}, r"point has shape \(2,\); give \(3,\)"),
    ],
)
def test_wrong_damping_is_refused_by_name(call: str, given: dict[str, Any], message: str) -> None:
    usual: dict[str, dict[str, Any]] = {
        "add_pendulum_damping": {"name": "swing", "first": "ground", "second": "load"},
        "add_air_drag": {"body": "load", "frontal_area": 1.0, "lateral_area": 1.0},
    }
    scene = pendulum()
    with pytest.raises(SceneError, match=message):
        getattr(scene, call)(**usual[call] | given)
        scene.compile()


@pytest.mark.parametrize("key", ["swing_damping_ratio", "drag_coefficient"])
@pytest.mark.parametrize("value", [-0.1, float("nan"), float("inf")])
def test_a_payload_s_damping_is_not_negative(key: str, value: float) -> None:
    with pytest.raises(SceneError, match=f"payload: {key} is"):
        Payload(**{key: value})
