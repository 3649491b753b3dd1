"""The three lift cases: counting, drift, energy, balance, driven runs, and feed-forward along curves."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from seacrane import Curve, Run, Scene, SceneError, balance, cases, simulate
from seacrane.analysis import Evaluator, driven, feed_forward, quasi_static_loads
from seacrane.arrays import Array
from seacrane.crane import FOOT, Payload, load_crane
from seacrane.warnings import UnstableRestWarning

G = 9.80665
CASES: dict[str, Callable[..., Scene]] = {"case1": cases.case1, "case2": cases.case2, "case3": cases.case3}


def mass_scaled_singular_values(terms: dict[str, Array]) -> Array:
    """Of D M^-1/2, rows of unit length, M block by block from the engine's mass matrix."""
    values, vectors = np.linalg.eigh(terms["mass"])
    scaled = terms["jacobian"] @ vectors / np.sqrt(values)
    scaled /= np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.asarray(np.linalg.svd(scaled, compute_uv=False))


def test_case2_has_60_coordinates_46_constraints_and_14_freedoms_and_keeps_its_equations() -> None:
    """Rank by NumPy along the motion; M a - D^T lambda = load and D a = gamma solved to rounding."""
    scene = cases.case2()
    model = scene.compile()
    evaluator = Evaluator(model)
    assert len(scene.bodies) == 10
    run = Run(scene, t_end=60.0, dt_out=60.0, channels=[])
    for time in (0.0, 10.0, 20.0, 30.0, 45.0, 60.0):
        run.advance(time)
        terms = evaluator.terms(time, np.array(run.core.state.values))
        assert terms["jacobian"].shape == (46, 60) == (model.constraints, model.coordinates)
        values = mass_scaled_singular_values(terms)
        assert values[-1] > 1e-3 * values[0]
        assert 60 - np.linalg.matrix_rank(terms["jacobian"]) == 14 == model.degrees_of_freedom
        pull = terms["jacobian"].T @ terms["multipliers"]
        load = terms["mass"] @ terms["acceleration"] - pull - terms["load"]
        assert np.max(np.abs(load)) < 1e-10 * np.max(np.abs(terms["load"]))
        assert np.max(np.abs(terms["jacobian"] @ terms["acceleration"] - terms["gamma"])) < 1e-10


def test_projection_closes_what_steps_of_the_redundant_form_open() -> None:
    run = simulate(cases.case2(), formulation="redundant", t_end=10.0)
    assert 0.0 < np.max(run["constraint_error_before_projection"]) < 1e-5
    assert np.max(run["constraint_error"]) < 1e-9


def still(scene: Scene) -> Scene:
    """The case with its references held at their start."""
    actuators = dict(scene.actuators)
    scene.actuators.clear()
    for name, a in actuators.items():
        scene.add_actuator(name=name, joint=a.joint, stiffness=a.stiffness, damping=a.damping,
                           feed_forward=float(a.feed_forward.evaluate([0.0])[0, 0]))  # fmt: skip
    return scene


@pytest.mark.parametrize("name", CASES)
def test_at_rest_in_calm_water_it_stays(name: str) -> None:
    run = simulate(still(CASES[name](hs=0.0)), rtol=1e-10)
    assert np.max(np.abs(run["vessel_motion"])) < 1e-10
    assert np.max(np.ptp(run["position"], axis=0)) < 1e-8
    assert np.max(np.abs(run["velocity"])) < 1e-8


@pytest.mark.parametrize("payload", [None, Payload()])
def test_balance_equals_weight_and_moments_by_hand(payload: Payload | None) -> None:
    """Vessel wrench about {0}: the weight up, and its moment at the common centre of mass."""
    scene = cases.case2(payload=payload) if payload else cases.case1()
    del scene.point_forces["balance"]
    held = balance(scene)
    crane = load_crane()
    weight, moment = crane.mass * G, crane.mass * G * crane.center_of_mass(foot=FOOT)
    if payload:
        tip = np.array(FOOT) + crane.tip(slew=0.0, s1=0.0, s2=0.0)
        weight, moment = weight + payload.mass * G, moment + payload.mass * G * tip
    assert held.vessel_wrench is not None
    expected = [0.0, 0.0, weight, moment[1], -moment[0], 0.0]
    np.testing.assert_allclose(held.vessel_wrench, expected, rtol=1e-9, atol=1e-2)
    assert held.weight == pytest.approx(weight, rel=1e-12)
    forces = crane.static_cylinder_forces(s1=0.0, s2=0.0, payload_mass=payload.mass if payload else 0.0)
    np.testing.assert_allclose([held.loads["main"], held.loads["knuckle"]], forces, rtol=1e-9)
    assert abs(held.loads["slew"]) < 1e-3


STROKES = ("main", "knuckle")


def on_the_ground(payload: Payload | None) -> Scene:
    scene = Scene(name="crane on a quay")
    scene.add_crane(base="ground", payload=payload)
    for name, joint in cases.ACTUATORS.items():
        scene.add_actuator(name=name, joint=joint)
    return scene


def moves() -> dict[str, Curve]:
    ends = {"slew": cases.SLEW_END, "main": 3.0, "knuckle": 4.0}
    return {n: Curve.quintic(start_time=2.0, end_time=20.0, start=0.0, end=end) for n, end in ends.items()}


@pytest.mark.parametrize("payload", [None, Payload(mass=15e3)])
def test_on_a_fixed_base_they_are_the_cranes_static_forces(payload: Payload | None) -> None:
    times = np.array([0.0, 6.0, 11.0, 15.0, 30.0])
    loads = quasi_static_loads(on_the_ground(payload), times=times, references=moves())
    for i, time in enumerate(times):
        s1, s2 = (float(moves()[name].evaluate([time])[0, 0]) for name in STROKES)
        mass = 0.0 if payload is None else payload.mass
        forces = load_crane().static_cylinder_forces(s1=s1, s2=s2, payload_mass=mass)
        np.testing.assert_allclose([loads[name][i] for name in STROKES], forces, rtol=1e-7)
        assert abs(loads["slew"][i]) < 1.0


def test_afloat_they_are_what_a_driven_crane_comes_to_rest_with() -> None:
    """Heel and trim included: mean loads of drivers that hold the end pose in calm water, without payload."""
    scene = cases.case1(hs=0.0)
    start, end = (quasi_static_loads(scene, times=[time]) for time in (0.0, 45.0))
    assert start == pytest.approx(balance(scene).loads, rel=1e-6, abs=1.0)
    run = simulate(driven(scene), t_end=700.0, dt_out=1.0)
    late = run.time > 300.0  # two periods of the mooring
    settled = np.append(run["slew_torque"][late].mean(), run["cylinder_force"][late].mean(axis=0))
    np.testing.assert_allclose([end[name][0] for name in ("slew", "main", "knuckle")], settled, rtol=2e-3)
    assert abs(end["slew"][0]) > 2e4  # the heel's


@pytest.mark.parametrize("case", [cases.case2, cases.case3], ids=lambda case: case.__name__)
def test_between_its_nodes_a_cases_curve_is_the_static_load(case: object) -> None:
    """Within what moves a stroke by 0.5 mm; 5 mm in the oscillation of case 3 after its 100 s."""
    scene = case(hs=0.0)  # type: ignore[operator]
    times = np.array([2.4, 12.6, 23.1, 37.7, 47.0, 51.3, 53.05])
    exact = quasi_static_loads(scene, times=times)
    for name, actuator in scene.actuators.items():
        curve = actuator.feed_forward
        assert np.all(np.abs(curve.evaluate(times)[:, 0] - exact[name]) < 5e-4 * actuator.stiffness)
        later = curve.evaluate(times[5:] + 150.0)[:, 0]
        assert np.all(np.abs(later - exact[name][5:]) < 5e-3 * actuator.stiffness)


def test_a_swing_goes_on_with_its_mean_and_first_harmonic() -> None:
    """A weight on an arm, held by a torque: m g l cos(angle), expanded by quadrature."""
    scene = Scene(name="arm")
    scene.add_body(name="arm", mass=2.0, inertia=np.eye(3), position=(1.5, 0.0, 0.0))
    scene.add_joint(kind="revolute", name="hinge", first="ground", second="arm", point=(0.0, 0.0, 0.0),
                    axis=(0.0, -1.0, 0.0))  # fmt: skip
    scene.add_actuator(name="motor", joint="hinge")
    swing = Curve.harmonic(start_time=4.0, offset=0.5, amplitude=0.3, omega=2.0 * np.pi / 8.0)
    reference = Curve.quintic(start_time=0.0, end_time=3.0, start=0.0, end=0.8).then(time=4.0, curve=swing)
    times = np.append(np.linspace(0.0, 3.0, 7), np.linspace(3.25, 20.0, 68))
    torque = feed_forward(scene, references={"motor": reference}, times=times, period=8.0)["motor"]
    weight = 2.0 * scene.gravity * 1.5
    exact = weight * np.cos(reference.evaluate(times)[:, 0])
    np.testing.assert_allclose(torque.evaluate(times[:-1])[:, 0], exact[:-1], rtol=1e-9)
    phase = 2.0 * np.pi * np.arange(400) / 400.0
    over = weight * np.cos(0.5 + 0.3 * np.cos(phase))
    first = 2.0 * np.mean(over * np.cos(phase))
    later = np.linspace(20.0, 60.0, 41)
    expected = np.mean(over) + first * np.cos(2.0 * np.pi * (later - 4.0) / 8.0)
    np.testing.assert_allclose(torque.evaluate(later)[:, 0], expected, rtol=1e-6)
    assert torque.breakpoints == []


def test_what_makes_no_feed_forward_is_named() -> None:
    scene, wanted = on_the_ground(None), moves()
    for given, message in (
        ({"times": [2.0, 6.0, 10.0]}, "'slew' moves at t = 10 s"),
        ({"times": [2.0, 10.0, 16.0, 20.0], "period": 5.0}, "last period of 5 s holds 2"),
    ):
        with pytest.raises(SceneError, match=message):
            feed_forward(scene, **({"references": wanted} | given))


def test_a_load_that_the_vessel_cannot_carry_is_told_and_constant_loads_leave_strokes_short() -> None:
    with pytest.warns(UnstableRestWarning, match="capsizes"):
        simulate(cases.case2(payload=Payload(mass=1.5e6)), t_end=0.1)
    short = 2.0 - simulate(cases.case2(hs=0.0, feed_forward="start"))["stroke"][-1]
    np.testing.assert_allclose(short, [0.0151, 0.158], rtol=0.1)
