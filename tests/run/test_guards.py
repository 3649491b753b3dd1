"""Failure that is loud, early and explained: stops by name, and warnings of what left its range."""

from __future__ import annotations

import ctypes
import re
from pathlib import Path
from typing import Any

import named
import numpy as np
import pytest
from named import on_joint

from seacrane import Result, Run, Scene, SceneError, SimulationError, State, _core, simulate
from seacrane._core import integrators
from seacrane.analysis.left_range import findings
from seacrane.answers import report
from seacrane.cases import vessel
from seacrane.errors import OutputMemoryError
from seacrane.warnings import (
    FullTurnWarning,
    OutsideDatabaseWarning,
    PushingLinkWarning,
    StiffWarning,
)

SIGNATURE = ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3)


@SIGNATURE
def fails_later(t: float, state: Any, parameters: Any, wrench: Any) -> None:
    wrench[0] = float("nan") if t > 0.55 else 1.0


def slide(stiffness: float) -> Scene:
    """A box of 1 kg on a slide, held by a stiff actuator: an oscillator of sqrt(stiffness) rad/s."""
    scene = on_joint("box", velocity=(0.1, 0, 0))
    scene.add_actuator(name="hold", joint="rail", stiffness=stiffness)
    return scene


def test_a_force_that_is_not_finite_is_named_and_the_outputs_until_then_are_kept(formulation: str) -> None:
    scene = Scene(name="box")
    scene.add_body(name="box", mass=1.0, inertia=[1, 1, 1])
    scene.add_body(name="mate", mass=1.0, inertia=[1, 1, 1], position=(1, 0, 0))
    scene.add_joint(kind="spherical", name="ball", first="box", second="mate", point=(1, 0, 0))
    scene.add_force("box", name="pull", force=fails_later)
    with pytest.raises(SimulationError, match=r"function force 'pull': force \(nan, 0, 0\) N") as caught:
        simulate(scene, t_end=1.0, dt_out=0.1, formulation=formulation)
    assert "on body 'box', at t = 0.55 s" in str(caught.value)
    result = caught.value.result
    assert isinstance(result, Result)
    np.testing.assert_allclose(result.time, [0.0, 0.1, 0.2, 0.3, 0.4, 0.5], atol=1e-12)
    # Until then a constant force on the two boxes, along the line through both: a = F / (2 m).
    assert result["position"][-1, 0, 0] == pytest.approx(0.5 * 0.5 * 0.5**2, rel=1e-9)
    assert result.interrupted


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
    few = simulate(held(5.0), t_end=20.0, channels=["position"])
    assert "validity" not in few.stats


def pendulum() -> Scene:
    scene = named.pendulum()
    scene.add_channel(joint="pin")
    return scene


@pytest.mark.filterwarnings("ignore::seacrane.warnings.FullTurnWarning")
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


def test_motions_beyond_the_database_warn() -> None:
    ship = vessel(hs=0.0)
    _, top = ship.provenance["vessel"].omega or (0.0, 0.0)
    time = np.arange(0.0, 200.0, 0.1)
    for omega, expected in ((0.5 * top, False), (2.0 * top, True)):
        motion = np.zeros((time.size, 6))
        motion[:, 2] = 0.2 * np.sin(omega * time)
        found = dict(findings(ship, time, {"vessel_motion": motion}, {}))
        assert (OutsideDatabaseWarning in found) == expected
    assert "energy of heave is above" in found[OutsideDatabaseWarning]
    assert not findings(ship, time, {"vessel_motion": 1e-4 * motion}, {})


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
    assert "link &#39;wire&#39;: pushes with " in report(loaded).html


def test_an_angle_that_passes_half_a_turn_warns() -> None:
    scene = pendulum()
    simulate(scene, t_end=0.5)
    scene.replace("bob", kind="body", angular_velocity=(0, 10, 0), velocity=(0, 0, -10))
    with pytest.warns(FullTurnWarning, match="'pin': passes 180 deg"):
        simulate(scene, t_end=2.0)
