"""Coordinates that drivers prescribe are no unknowns of the recursive form: as with rows, at every level."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from element_runs import FORMULATIONS as FORMS
from element_runs import goes_on
from marks import needs_lanes
from multibody_runs import ACTUATORS, crane_scene, ramp, record, struck, swing_out

from seacrane import Curve, Run, Scene, SceneError, SeacraneError, _core, shipped_database, simulate
from seacrane.analysis import driven, inverse_dynamics, reflected_inertia
from seacrane.run.lanes import module_of

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


def moved(start: float, end: float, *, over: float = 8.0) -> Curve:
    return Curve.quintic(start_time=0.5, end_time=0.5 + over, start=start, end=end)


def lift(*, rung: str = "elastic", seed: int = 2, **hoist: Any) -> Scene:
    """The shipped hull and crane, which slews and moves both cylinders, with 40 t on a line, in still air."""
    scene = Scene(name="driven")
    scene.add_vessel(shipped_database())
    scene.add_crane(slew=-1.0, s1=1.5, s2=1.0, held=False)
    scene.add_driver("A", curve=moved(0.0, 0.7))
    scene.add_driver("main_cylinder", curve=moved(0.0, 0.4))
    scene.add_driver("knuckle_cylinder", curve=moved(0.0, -0.3))
    scene.add_hoist(mass=40e3, size=(4.0, 4.0, 3.0), length=12.0, EA=2e8, rung=rung, **hoist)
    scene.add_sea(hs=1.5, tp=7.0, direction_deg=150.0, seed=seed)
    return scene


def given_ship() -> Scene:
    """A ship led by six drivers off its centre, with a crane that slews and a load on its rod."""
    scene = Scene(name="given ship")
    scene.add_body("ship", mass=1e6, inertia=(1e8, 2e9, 2e9), center_of_mass=(3.0, 0.5, 1.0))
    scene.add_joint("motion", kind="free", first="ground", second="ship", point=(2.0, 1.0, 3.0))
    for i, name in enumerate(("x", "y", "z", "roll", "pitch", "yaw")):
        curve = Curve.harmonic(amplitude=0.3 - 0.04 * i, omega=0.7 + 0.1 * i, phase=0.4 * i - 0.5 * np.pi)
        scene.add_driver("motion", coordinate=name, curve=curve, name=f"motion {name}")
    scene.add_body("jib", mass=2e4, inertia=(1e5, 4e5, 4e5), position=(8.0, 0.0, 12.0))
    scene.add_joint("slew", kind="revolute", first="ship", second="jib", point=(0.0, 0.0, 10.0))
    scene.add_driver("slew", curve=moved(0.0, 0.8))
    scene.add_body("load", mass=3e4, inertia=(1e4, 1e4, 1e4), position=(16.0, 0.0, 2.0))
    rod = {"point": (16.0, 0.0, 12.0), "second_point": (16.0, 0.0, 2.0)}
    scene.add_joint("rod", kind="distance", first="jib", second="load", **rod)
    return scene


def reversed_slide() -> Scene:
    """A slide and a hinge whose first body is the outer one, and a door on two hinges beside them."""
    scene = Scene(name="reversed")
    scene.add_body("cart", mass=50.0, inertia=(9.0, 8.0, 7.0), position=(0.3, 0.0, 0.0))
    scene.add_joint("rail", kind="prismatic", first="cart", second="ground", axis=(1.0, 0.2, 0.0))
    scene.add_driver("rail", curve=Curve.harmonic(amplitude=0.4, omega=2.0, phase=-0.5 * np.pi))
    scene.add_body("wheel", mass=20.0, inertia=(3.0, 2.0, 4.0), position=(0.3, 0.1, 0.5))
    scene.add_joint("axle", kind="revolute", first="wheel", second="cart", axis=(0.0, 1.0, 0.3))
    scene.add_driver("axle", curve=Curve.harmonic(amplitude=1.4, omega=1.1, phase=-0.5 * np.pi))
    scene.add_body("door", mass=30.0, inertia=(4.0, 4.0, 1.0), position=(0.8, 0.1, 0.5))
    for name, height in (("upper", 1.0), ("lower", 0.0)):
        hinge = {"kind": "revolute", "point": (0.3, 0.1, height), "axis": (0.1, 0.0, 1.0)}
        scene.add_joint(name, first="wheel", second="door", **hinge)
    return scene


SCENES = {
    "crane": lift, "crane on the rod's rung": lambda: lift(rung="quasi-static"), "given ship": given_ship,
    "reversed": reversed_slide,
}  # fmt: skip


@pytest.mark.parametrize("name", SCENES)
def test_accelerations_and_a_run_at_a_fixed_step_are_those_of_rows(name: str) -> None:
    scene = SCENES[name]()
    model = scene.compile()
    assert sorted(model.tree["driven"]) == sorted(scene.drivers)
    for t in (0.0, 1.7, 3.1):
        run = Run(scene, t_end=t + 1e-9, model=model, formulation="redundant", rtol=1e-9)
        run.advance(t + 1e-9)
        found = [
            _core.Evaluator(model, form).accelerations(t + 1e-9, run.core.state.values) for form in FORMS
        ]
        assert np.abs(found[0] - found[1]).max() < 1e-10 * max(1e-3, np.abs(found[0]).max())
    how = {"t_end": 3.0, "dt_out": 0.5, "integrator": "rk4", "dt": 0.00125}
    rows, led = (record(SCENES[name](), formulation=form, **how) for form in FORMS)
    for channel in ("position", "velocity", "acceleration", "driver_force"):
        scale = np.abs(rows[channel]).max()
        assert np.abs(led[channel] - rows[channel]).max() < 1e-8 * scale, channel
    work = np.abs(rows["absolute_work"]).max()
    assert np.abs(led["absolute_work"] - rows["absolute_work"]).max() < 1e-7 * work
    assert np.abs(led["energy_balance"]).max() < 1e-6 * work


def test_a_stroke_beyond_its_hinge_is_refused_by_name() -> None:
    scene = Scene(name="far")
    scene.add_crane(base="ground", slew=-1.0, s1=1.5, s2=1.0, payload_mass=20e3, held=True)
    scene.remove("main_cylinder.displacement")
    scene.add_driver("main_cylinder", curve=moved(0.0, 30.0))
    scene.ranges.clear()
    with pytest.raises(
        SeacraneError, match=r"driver 'main_cylinder.*asks for a stroke of .* its hinge allows"
    ):
        simulate(scene, 9.0, integrator="rk4", dt=0.05)


def test_a_rate_that_jumps_strikes_the_others_by_its_impulse_and_once() -> None:
    fixed: dict[str, Any] = {"integrator": "rk4", "dt": 0.005, "dt_out": 0.25}
    rows, led = (record(struck(), 2.0, formulation=form, **fixed) for form in FORMS)
    assert np.abs(rows["velocity"][4:, 1, 0]).max() > 0.5  # the bob is struck
    for channel in ("position", "velocity"):
        assert np.abs(led[channel] - rows[channel]).max() < 1e-9, channel
    settings: dict[str, Any] = {"formulation": "recursive", "rtol": 1e-9, "dt_out": 0.25}
    whole = record(struck(), 2.0, **settings)["position"]
    first = Run(struck(), t_end=1.0, **settings)
    first.advance(1.0)
    second = Run(struck(), t_end=2.0, start=first.core.state, **settings)
    second.advance(2.0)
    assert np.abs(dict(second.core.channels())["position"][-1] - whole[-1]).max() < 1e-7
    goes_on(lift, 3.0, 1.5, formulation="recursive", rtol=1e-6, dt_out=0.5)


def test_a_stop_that_holds_leaves_one_unknown_less_and_the_same_motion() -> None:
    scene, across = Scene(name="stop"), {"kind": "revolute", "axis": (0.0, 1.0, 0.0)}
    scene.add_body("bar", mass=5.0, inertia=(1.0, 2.0, 1.0), position=(1.0, 0.0, 0.0))
    scene.add_joint("pin", first="ground", second="bar", point=(0.0, 0.0, 0.0), **across)
    scene.add_body("bob", mass=2.0, inertia=(0.3, 0.3, 0.3), position=(2.0, 0.0, -1.0))
    scene.add_joint("knee", first="bar", second="bob", point=(2.0, 0.0, 0.0), **across)
    scene.add_stop("pin", minimum=-3.0, maximum=0.4)
    rows, led = (record(scene, 2.0, formulation=form, rtol=1e-9, dt_out=0.25) for form in FORMS)
    assert np.abs(led["position"] - rows["position"]).max() < 1e-6


@needs_lanes
@pytest.mark.parametrize("name", ["crane", "crane on the rod's rung", "given ship"])
def test_lanes_follow_drivers_too(name: str) -> None:
    scenes = [lift(rung="elastic" if name == "crane" else "quasi-static", seed=seed) for seed in range(1, 5)]
    if name == "given ship":
        scenes = [given_ship()] * 4
    evaluator = _core.LaneEvaluator(module_of(4), [scene.compile() for scene in scenes])
    start, rng = evaluator.start(), np.random.default_rng(1)
    for t in (0.0, 1.1, 2.9):
        state = start + 1e-3 * rng.normal(size=start.shape)
        alone = evaluator.scalar_derivative(t, state)
        assert np.abs(evaluator.derivative(t, state) - alone).max() < 1e-9 * np.abs(alone).max()


def test_drivers_on_a_free_joint_prescribe_all_six_motions() -> None:
    scene = Scene(gravity=9.81)
    scene.add_body(name="ship", mass=5.0, inertia=(1.0, 2.0, 3.0), center_of_mass=(0.1, 0.0, -0.2))
    scene.add_joint(kind="free", name="motion", first="ground", second="ship")
    curves = {}
    for i, motion in enumerate(("x", "y", "z", "roll", "pitch", "yaw")):
        curves[motion] = Curve.harmonic(amplitude=0.2 + 0.05 * i, omega=1.0 + 0.3 * i, phase=0.5 * i)
        scene.add_driver(joint="motion", coordinate=motion, curve=curves[motion])
        scene.add_channel(joint="motion", coordinate=motion, name=motion)
    assert scene.compile().degrees_of_freedom == 0
    out = record(scene, 5.0)
    for i, motion in enumerate(("x", "y", "z", "roll", "pitch", "yaw")):
        expected = curves[motion].evaluate(out["time"])
        np.testing.assert_allclose(out["coordinate"][:, i], expected[:, 0], atol=1e-11)
        np.testing.assert_allclose(out["coordinate_rate"][:, i], expected[:, 1], atol=1e-11)
    # Newton at the centre of mass: drivers along the inertial axes are the only supports.
    force = 5.0 * (out["acceleration"][:, 0] + [0.0, 0.0, 9.81])
    np.testing.assert_allclose(out["driver_force"][:, :3], force, atol=1e-9 * np.abs(force).max())


def test_a_driven_hinge_goes_round_many_times() -> None:
    scene = Scene()
    scene.add_body(name="rotor", mass=1.0, inertia=(1, 1, 1))
    scene.add_joint(kind="revolute", name="shaft", first="ground", second="rotor")
    scene.add_driver(joint="shaft", curve=ramp(10.0))
    scene.add_channel(joint="shaft")
    out = record(scene, 5.0)
    np.testing.assert_allclose(out["angular_velocity"][:, 0, 2], 10.0, atol=1e-10)
    np.testing.assert_allclose(np.unwrap(out["coordinate"][:, 0]), 10.0 * out["time"], atol=1e-9)


def test_inverse_dynamics_by_algebra_agrees_with_the_driven_simulation() -> None:
    scene = crane_scene(payload=False, references=swing_out(4.0))
    times = np.linspace(0.0, 4.0, 9)
    loads = inverse_dynamics(scene, times=times)
    out = record(driven(scene), 4.0, dt_out=0.5)
    for i, name in enumerate(ACTUATORS):
        np.testing.assert_allclose(
            loads[name], out["driver_force"][:, i], rtol=1e-7, atol=1e-7 * np.abs(loads[name]).max()
        )
        assert np.ptp(loads[name]) > 1e3
    with pytest.raises(SceneError, match=r"5 degree\(s\) of freedom are not prescribed"):
        inverse_dynamics(crane_scene(payload=True, references=swing_out(4.0)), times=[0.0])


def test_reflected_inertia_by_hand() -> None:
    scene = Scene(gravity=9.81)
    scene.add_body(name="inner", mass=3.0, inertia=(0.1, 0.2, 0.3), position=(0.5, 0.0, 0.0))
    scene.add_body(name="outer", mass=2.0, inertia=(0.2, 0.25, 0.4), position=(1.0, 0.6, 0.0))
    scene.add_joint(kind="revolute", name="root", first="ground", second="inner", point=(0, 0, 0))
    scene.add_joint(kind="revolute", name="elbow", first="inner", second="outer", point=(1, 0, 0))
    scene.add_actuator(joint="root")
    scene.add_actuator(joint="elbow")
    inertia = reflected_inertia(scene)
    assert inertia["elbow"] == pytest.approx(0.4 + 2.0 * 0.36, rel=1e-9)
    assert inertia["root"] == pytest.approx(0.3 + 3.0 * 0.25 + 0.4 + 2.0 * (1.0 + 0.36), rel=1e-9)
