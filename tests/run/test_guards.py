"""Failure that is loud, early and explained: stops by name, and warnings of what left its range."""

from __future__ import annotations

import ctypes
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from multibody_runs import ramp

from seacrane import Curve, Result, Run, Scene, SceneError, SimulationError, State, _core, simulate
from seacrane._core import integrators
from seacrane.answers import report
from seacrane.cases import vessel
from seacrane.errors import OutputMemoryError
from seacrane.validity.left_range import findings
from seacrane.warnings import (
    FullTurnWarning,
    LargeHeelWarning,
    MeanHeadingWarning,
    NearSingularWarning,
    OutsideDatabaseWarning,
    PushingLinkWarning,
    StiffWarning,
)

SIGNATURE = ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3)


@SIGNATURE
def fails_later(t: float, state: Any, parameters: Any, wrench: Any) -> None:
    wrench[0] = float("nan") if t > 0.55 else 1.0


def box() -> Scene:
    scene = Scene(name="box")
    scene.add_body(name="box", mass=1.0, inertia=[1, 1, 1])
    scene.add_body(name="mate", mass=1.0, inertia=[1, 1, 1], position=(1, 0, 0))
    scene.add_joint(kind="spherical", name="ball", first="box", second="mate", point=(1, 0, 0))
    return scene


def slide(stiffness: float) -> Scene:
    """A box of 1 kg on a slide, held by a stiff actuator: an oscillator of sqrt(stiffness) rad/s."""
    scene = Scene(name="slide")
    scene.add_body(name="box", mass=1.0, inertia=[1, 1, 1], velocity=(0.1, 0, 0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="box", axis=(1, 0, 0))
    scene.add_actuator(name="hold", joint="rail", stiffness=stiffness)
    return scene


def folding(rate: float, start: float = 0.5) -> Scene:
    """Two equal arms, a turned crank and a link from its tip to a slider: they fold together at 90 deg."""
    scene = Scene(name="folding", gravity=0.0)
    tip = (np.cos(start), 0.0, np.sin(start))
    end = (2.0 * np.cos(start), 0.0, 0.0)
    scene.add_body(name="crank", mass=1.0, inertia=[1, 1, 1])
    scene.add_body(name="slider", mass=1.0, inertia=[1, 1, 1], position=end)
    scene.add_joint(kind="revolute", name="pin", first="ground", second="crank", axis=(0, -1, 0))
    scene.add_joint("guide", kind="prismatic", first="ground", second="slider", point=end, axis=(1, 0, 0))
    scene.add_joint(kind="distance", name="link", first="crank", second="slider", point=tip, second_point=end)
    scene.add_driver(name="turn", joint="pin", curve=ramp(rate))
    return scene


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_a_force_that_is_not_finite_is_named_and_the_outputs_until_then_are_kept(formulation: str) -> None:
    scene = box()
    address = ctypes.cast(fails_later, ctypes.c_void_p).value
    scene.add_function_force(name="pull", body="box", address=address, parameters=[])
    with pytest.raises(SimulationError, match=r"function force 'pull': force \(nan, 0, 0\) N") as caught:
        simulate(scene, t_end=1.0, dt_out=0.1, formulation=formulation)
    assert "on body 'box', at t = 0.55 s" in str(caught.value)
    result = caught.value.result
    assert isinstance(result, Result)
    np.testing.assert_allclose(result.time, [0.0, 0.1, 0.2, 0.3, 0.4, 0.5], atol=1e-12)
    # Until then a constant force on the two boxes, along the line through both: a = F / (2 m).
    assert result["position"][-1, 0, 0] == pytest.approx(0.5 * 0.5 * 0.5**2, rel=1e-9)
    assert result.interrupted


@pytest.mark.warns("EnergyErrorWarning")
def test_a_step_beyond_stability_tells_what_has_grown_and_the_longest_step() -> None:
    """100 rad/s: rk4 is stable up to sqrt(8) / 100 = 0.028 s."""
    with pytest.raises(SimulationError, match=r"longer than about 0\.028 s") as caught:
        simulate(slide(1e4), t_end=100.0, integrator="rk4", dt=0.1)
    assert "the velocity x of body 'box' had grown to" in str(caught.value)


STABLE_UP_TO = {k.name: k.stable_up_to for k in integrators() if k.stable_up_to}


@pytest.mark.warns("EnergyErrorWarning")
@pytest.mark.parametrize("method", sorted(STABLE_UP_TO))
def test_the_limits_told_are_those_of_the_methods(method: str) -> None:
    """Energy over 2000 steps of an undamped oscillator, a little below and above the limit."""
    limit = _core.integrator(method).stable_up_to
    settings = {"integrator": method, "t_end": 1900 * limit, "dt_out": 10.0 * limit}
    kept = simulate(slide(1.0), dt=0.95 * limit, **settings)
    assert np.abs(kept["velocity"][:, 0, 0]).max() < 1.0
    with pytest.raises((SimulationError, AssertionError)):
        left = simulate(slide(1.0), dt=1.05 * limit, **settings)
        assert np.abs(left["velocity"][:, 0, 0]).max() < 1e3


def held(mode: float) -> Scene:
    """Two boxes on slides: one critically damped at `mode` (rad/s), one slow."""
    scene = Scene(name="held")
    for i, (name, speed) in enumerate((("stiff", mode), ("slow", 1.0))):
        place, rail = (0, float(i), 0), f"{name} rail"
        scene.add_body(name=name, mass=1.0, inertia=[1, 1, 1], position=place, velocity=(0.1, 0, 0))
        scene.add_joint(kind="prismatic", name=rail, first="ground", second=name, point=place, axis=(1, 0, 0))
        scene.add_actuator(name=name, joint=rail, stiffness=speed**2, damping=2.0 * speed)
    return scene


@pytest.mark.parametrize("integrator", ["dopri5", "dop853", "bs32"])
def test_a_run_that_one_fast_mode_makes_slow_tells_the_mode_and_the_body(integrator: str) -> None:
    with pytest.warns(StiffWarning, match=r"mode, (\S+) per s .* moves body 'stiff'") as caught:
        result = simulate(held(5e3), t_end=20.0, integrator=integrator, channels=["position"])
    told = re.search(r"mode, (\S+) per s", str(caught[0].message))
    # A double eigenvalue: half of its digits are told.
    assert float(told[1]) == pytest.approx(5e3, rel=1e-3)
    assert "fastest mode" in str(result.stats["validity"])
    few = simulate(held(5.0), t_end=20.0, integrator=integrator, channels=["position"])
    assert "validity" not in few.stats


def test_a_collapsed_step_names_the_state() -> None:
    scene = slide(10.0)
    scene.replace("hold", reference=Curve.constant(value=0.1))
    with pytest.raises(SimulationError, match=r"worst in the \w+ 0 of joint 'rail'"):
        simulate(scene, t_end=1.0, rtol=1e-34)


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_the_nearest_approach_to_a_singular_position_is_told(formulation: str) -> None:
    """The crank turns to 0.01 rad before the arms fold: 10 times nearer than at 0.1 rad."""
    found = []
    for gap in (0.1, 0.01):
        t_end = (np.pi / 2.0 - 0.5 - gap) / 0.2
        result = simulate(folding(0.2), t_end=t_end, formulation=formulation, maximum_step=0.05)
        assert result.stats["smallest_pivot_joint"] == "link"
        # The ratio is told to a tenth, which is when the state is kept.
        assert result.stats["smallest_pivot_at_s"] == pytest.approx(t_end, abs=0.1)
        assert 0.0 < result.stats["smallest_pivot"] < 0.1
        found.append(float(result.stats["smallest_singular_value"]))
    assert found[0] / found[1] == pytest.approx(10.0, rel=0.1)


def test_a_run_into_a_singular_position_warns() -> None:
    t_end = (np.pi / 2.0 - 0.5 - 1e-5) / 0.2
    with pytest.warns(NearSingularWarning, match=r"joint 'link'.*depend on the others at t = 5.35"):
        result = simulate(folding(0.2), t_end=t_end, formulation="redundant", maximum_step=0.05)
    assert "depend on the others" in str(result.stats["validity"])


def pendulum() -> Scene:
    scene = Scene(name="pendulum")
    scene.add_body(name="rod", mass=1.0, inertia=[0.1, 0.1, 0.1], position=(1.0, 0, 0))
    scene.add_joint("pin", kind="revolute", first="ground", second="rod", point=(0, 0, 0), axis=(0, 1, 0))
    scene.record_coordinate(joint="pin")
    return scene


@pytest.mark.filterwarnings("ignore::seacrane.validity.left_range.FullTurnWarning")
def test_energy_limit_stops_by_name_and_keeps_the_outputs() -> None:
    settings = {"t_end": 20.0, "integrator": "semi-implicit-euler", "dt": 0.02}
    free = simulate(pendulum(), **settings)
    share = np.abs(free["energy_balance"]).max() / 10.0
    with pytest.raises(SimulationError, match=r"energy_balance is .* beyond energy_limit = ") as caught:
        simulate(pendulum(), energy_limit=0.1 * share, **settings)
    kept = caught.value.result
    assert 0 < kept.time.size < free.time.size
    np.testing.assert_array_equal(kept["energy_balance"], free["energy_balance"][: kept.time.size])
    simulate(pendulum(), t_end=20.0, energy_limit=1e-4)


def test_settings_that_make_no_sense_are_refused() -> None:
    """Outputs that do not fit before memory is taken, and times that doubles do not resolve."""
    resting = Run(pendulum(), t_end=1.0).state
    late = State(time=1e11, values=resting.values, inputs=resting.inputs)
    for kind, given, words in (
        (OutputMemoryError, {"t_end": 1e8, "dt_out": 1.0}, r"100000001 times \d+ values need .* bytes"),
        (SceneError, {"t_end": 1e13, "dt_out": 1e12}, r"beyond 1e\+12 s"),
        (SceneError, {"t_end": 1e11 + 1e-3, "dt_out": 1e-5, "start": late}, r"dt_out is 1e-05 s.* 1e\+11 s"),
        (SimulationError, {"t_end": 1.0, "integrator": "rk4", "dt": 1e-20}, "dt is below"),
        (SceneError, {"t_end": 1.0, "energy_limit": float("nan")}, "energy_limit is"),
    ):
        with pytest.raises(kind, match=words):
            simulate(pendulum(), **given)
    with pytest.raises(SceneError, match="'paper' has no energy balance"):
        simulate(vessel(kinematics="paper", hs=0.0), t_end=1.0, energy_limit=1e-3)


def judged(scene: Scene, time: Any, channels: dict[str, Any], **stats: Any) -> dict[type[Warning], str]:
    return dict(findings(scene, np.asarray(time, dtype=float), channels, stats))


@pytest.mark.parametrize(("angle", "told"), [(15.0, False), (30.0, True)])
def test_heel_beyond_the_linear_restoring_warns(angle: float, told: bool) -> None:
    """A weight off the centre line; the ship overshoots its heel."""
    ship, lever = vessel(hs=0.0), 20.0
    weight = 0.5 * np.radians(angle) * np.asarray(ship.vessels["vessel"].restoring)[3, 3] / lever
    ship.add_point_force(name="push", body="vessel", point=(0.0, lever, 0.0), force=(0.0, 0.0, -weight))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = simulate(ship, t_end=30.0)
    assert [w.filename for w in caught if w.category is LargeHeelWarning] == [__file__] * told
    assert ("validity" in result.stats) == told


def test_yaw_away_from_the_mean_heading_warns_with_loads_of_the_mean_only() -> None:
    ship = vessel(hs=1.0)
    time, motion = np.linspace(0.0, 100.0, 201), np.zeros((201, 6))
    motion[:, 5] = 0.5 * np.sin(2.0 * np.pi / 8.0 * time)  # as fast as the waves
    assert not judged(ship, time, {"vessel_motion": motion})
    motion[100:, 5] -= 0.5
    found = judged(ship, time, {"vessel_motion": motion})
    reached = re.search(r"'vessel': yaw reaches (\S+) deg", found[MeanHeadingWarning])
    assert reached and float(reached[1]) == pytest.approx(np.degrees(0.5), abs=0.5)
    assert not judged(vessel(hs=0.0), time, {"vessel_motion": motion})
    assert not judged(vessel(hs=1.0, phase="actual"), time, {"vessel_motion": motion})


def test_motions_beyond_the_database_warn() -> None:
    ship = vessel(hs=0.0)
    _, top = ship.provenance["vessel"].omega or (0.0, 0.0)
    time = np.arange(0.0, 200.0, 0.1)
    for omega, expected in ((0.5 * top, False), (2.0 * top, True)):
        motion = np.zeros((time.size, 6))
        motion[:, 2] = 0.2 * np.sin(omega * time)
        found = judged(ship, time, {"vessel_motion": motion})
        assert (OutsideDatabaseWarning in found) == expected
    assert "energy of heave is above" in found[OutsideDatabaseWarning]
    assert not judged(vessel(hs=0.0), time, {"vessel_motion": 1e-4 * motion})


def test_a_link_that_pushes_warns_once(tmp_path: Path) -> None:
    """Thrown over the top: v^2 < g l there, and the tension m (v^2 / l - g) is negative."""
    speed, end = np.sqrt(4.0 * 9.80665 * 2.0 + 0.2 * 9.80665 * 2.0), (0.0, 0.0, -2.0)
    scene = Scene(name="hanging")
    scene.add_body("load", mass=10.0, inertia=[1, 1, 1], position=end, velocity=(speed, 0.0, 0.0))
    ends = {"first": "ground", "second": "load", "point": (0, 0, 0), "second_point": end}
    scene.add_joint("wire", kind="distance", **ends)
    with pytest.warns() as caught:
        result = simulate(scene, t_end=3.0)
    assert [w.category for w in caught] == [PushingLinkWarning]
    pushed = 10.0 * (0.2 * 9.80665 * 2.0 / 2.0 - 9.80665)
    assert result["tension"].min() == pytest.approx(pushed, rel=1e-2)
    assert f"{-result['tension'].min():.4g} N" in str(caught[0].message)
    loaded = Result.load(result.save(tmp_path / "thrown.nc"))
    assert loaded.stats["validity"] == result.stats["validity"]
    assert "link &#x27;wire&#x27;: pushes with " in report(loaded).html
    scene = folding(0.2)  # a rod of a mechanism may push
    scene.add_point_force(name="squeeze", body="slider", force=(-10.0, 0.0, 0.0))
    assert simulate(scene, t_end=4.0)["tension"].min() < 0.0


def test_an_angle_that_passes_half_a_turn_warns() -> None:
    scene = pendulum()
    simulate(scene, t_end=0.5)
    scene.replace("rod", kind="body", angular_velocity=(0, 10, 0), velocity=(0, 0, -10))
    with pytest.warns(FullTurnWarning, match="'pin': passes 180 deg"):
        simulate(scene, t_end=2.0)
