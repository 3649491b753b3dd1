"""Wave loads at a hull's actual position and heading, and at the slow part of them, against closed forms."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from element_runs import goes_on

from seacrane import Curve, Run, Scene, SceneError, _core, cases, simulate
from seacrane.analysis.hull_range import peak_frequency
from seacrane.arrays import Array
from seacrane.hydro import shipped_database
from seacrane.scene import ByHeading, HullLoads, Waves

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

G = 9.80665
CUTOFF = 0.5  # rad/s, of hulls that are driven: high, so that transients are short
TIMES = np.array([0.0, 0.4, 17.3, 99.0, 1234.5])


def spread_sea(count: int = 60) -> _core.WaveComponents:
    """Components of many directions, some of them alike, as spread seas have them."""
    rng = np.random.default_rng(4)
    return _core.WaveComponents(
        omega=np.sort(rng.uniform(0.35, 2.0, count)), amplitude=rng.uniform(0.01, 0.2, count),
        phase=rng.uniform(0.0, 6.28, count), direction=np.repeat(rng.uniform(-4.0, 8.0, count // 3), 3),
    )  # fmt: skip


def positioned(waves: _core.WaveComponents) -> _core.PositionedWaveLoad:
    heading, _ = shipped_database().full_circle()
    values = shipped_database().force_at(np.array(waves.omega)[None, :], heading[:, None])
    return _core.PositionedWaveLoad(waves, headings=heading, transfer=values)


@pytest.mark.parametrize(
    ("x", "y", "yaw"), [(0.0, 0.0, 0.0), (31.0, -12.0, 0.0), (-250.0, 80.0, 0.7), (4.0, 9.0, -9.0)]
)
def test_a_fixed_vessel_gets_the_mean_load_of_its_place_and_heading(x: float, y: float, yaw: float) -> None:
    waves = spread_sea()
    transfer = shipped_database().force_at(waves.omega, np.array(waves.direction) - yaw)
    mean = _core.ExactWaveLoad(waves, transfer=transfer, position=(x, y))
    load = positioned(waves)
    for t in TIMES:
        force, drift, elevation = load.evaluate(t, x=x, y=y, yaw=yaw)
        # Rounding of phases, of spline weights and of the sum.
        assert np.all(np.abs(force - mean.evaluate(t)) < 1e-12 * mean.magnitude())
        assert elevation == pytest.approx(float(mean.elevation(t)), abs=1e-11)
        assert np.all(drift == 0.0)


def driven(*, cutoff: float = CUTOFF, phase: str | None = None, **curves: Curve) -> Scene:
    """A hull whose six coordinates are given; in a short-crested sea where a phase is asked for."""
    scene = Scene(name="driven")
    scene.add_vessel(shipped_database(), mooring=None, memory="none")
    scene.add_joint(kind="free", name="tow", first="ground", second="vessel", axis=(0.0, 0.0, 1.0))
    for name in ("x", "y", "z", "roll", "pitch", "yaw"):
        scene.add_driver(joint="tow", coordinate=name, curve=curves.get(name, Curve.constant(value=0.0)))
    if phase:
        scene.add_sea(hs=2.0, tp=8.0, count=12, phase=phase, cutoff=cutoff if phase == "slow" else None)
    return scene


@pytest.mark.warns("ForwardSpeedWarning")
@pytest.mark.parametrize(("direction_deg", "yaw"), [(180.0, 0.0), (0.0, 0.0), (130.0, 0.4)])
def test_a_towed_vessel_meets_the_encounter_frequency(direction_deg: float, yaw: float) -> None:
    speed, omega, direction = 5.0, 0.9, np.radians(direction_deg)
    hull = shipped_database()
    heading, _ = hull.full_circle()
    table = ByHeading(heading=heading, values=hull.force_at([[omega]], heading[:, None]))
    loads = HullLoads(transfer=hull.force_at(np.array([omega]), direction), force_by_heading=table)
    scene = driven(x=steady(0.0, speed), yaw=Curve.constant(value=yaw))
    scene.waves = Waves(
        omega=np.array([omega]), amplitude=np.array([0.8]), phase=np.array([0.3]),
        direction=np.array([direction]), hulls={"vessel": loads},
    )  # fmt: skip
    result = simulate(scene, t_end=60.0, dt_out=0.25)
    encounter = omega - omega**2 / G * speed * np.cos(direction)
    assert abs(encounter - omega) > 0.2
    transfer = shipped_database().force_at(omega, direction - yaw)
    wave = 0.8 * np.exp(1j * (encounter * result.time + 0.3))
    # Positions come from the driven joint, to 1e-9 m and better.
    np.testing.assert_allclose(result["wave_elevation"], wave.real, atol=1e-8)
    error = np.abs(result["wave_force"] - (wave[:, None] * transfer).real).max(axis=0)
    assert np.all(error < 1e-7 * np.abs(transfer).max())


def steady(start: float, speed: float, **more: Any) -> Curve:
    return Curve.pieces(starts=[0.0], coefficients=[[start, speed, 0, 0, 0, 0]], **more)


def actual_scene(*, evaluation: str = "table", **changes: Any) -> Scene:
    scene = Scene(name="actual")
    scene.add_vessel(shipped_database(), mooring=100.0)
    scene.add_sea(hs=3.0, tp=8.0, direction_deg=60.0, count=40, phase="actual")
    scene.waves = replace(scene.waves.changed(**changes), evaluation=evaluation)
    return scene


@pytest.mark.warns("MeanHeadingWarning")
def test_a_free_vessel_feels_where_it_is_and_its_energy_balances() -> None:
    scene = actual_scene()
    result = simulate(scene, t_end=60.0, dt_out=0.5, rtol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-6 * result["absolute_work"][-1]
    expected = load_at(scene, result.time, result["vessel_motion"][:, [0, 1, 5]])
    scale = np.abs(result["wave_force"]).max(axis=0)
    assert np.all(np.abs(expected - result["wave_force"]) < 1e-9 * scale)
    mean = actual_scene(force_by_heading=None)
    other = simulate(mean, t_end=60.0, dt_out=0.5, rtol=1e-8)
    assert np.abs(other["wave_force"] - result["wave_force"]).max() > 0.02 * scale.max()


def test_far_beyond_the_fast_sines_the_load_is_still_right() -> None:
    waves = spread_sea()
    transfer = shipped_database().force_at(waves.omega, waves.direction)
    mean = _core.ExactWaveLoad(waves, transfer=transfer)
    # Phases of 6e6 rad are rounded to 1e-9.
    error = np.abs(positioned(waves).evaluate(3e6)[0] - mean.evaluate(3e6))
    assert np.all(error < 1e-8 * mean.magnitude())


def test_what_makes_no_sense_is_refused_by_name() -> None:
    force = actual_scene().waves.hull().force_by_heading
    turned = actual_scene(force_by_heading=ByHeading(heading=force.heading[::-1], values=force.values))
    paper = Scene(name="paper")
    paper.add_vessel(shipped_database(), kinematics="paper")
    paper.waves = afloat("slow").waves
    for call, message in (
        (turned.compile, "45 deg"),
        (actual_scene(drift=np.zeros((40, 6))).compile, "drift_by_heading"),
        (paper.compile, "yaw_following"),
        (lambda: afloat("mean").waves.changed(cutoff=0.1), "no force_by_heading"),
    ):
        with pytest.raises(SceneError, match=message):
            call()


def slow_gain(omega: float, cutoff: float) -> complex:
    """What the low-pass leaves of a motion at omega: one less the high-pass."""
    s = 1j * omega / cutoff
    return complex((2.0 * s + 1.0) / (s**3 + 2.0 * s**2 + 2.0 * s + 1.0))


def load_at(scene: Scene, time: Array, pose: Array) -> Array:
    """Wave loads (n, 6) at poses x, y, yaw (n, 3)."""
    load = positioned(scene.waves.components())
    return np.array([load.evaluate(t, x=p[0], y=p[1], yaw=p[2])[0] for t, p in zip(time, pose, strict=True)])


@pytest.mark.warns("ForwardSpeedWarning")
def test_a_slow_position_is_the_low_passed_one_of_drift_turn_and_waves() -> None:
    """Steady drift, slow swings of sway and yaw and oscillations in all three: gain and phase of each."""
    drift, swing, wave = 0.4, 0.06, 1.1
    curves = {
        "x": steady(3.0, drift, cosines=[[1.5, wave, 0.2]]),
        "y": steady(0.0, 0.0, cosines=[[25.0, swing, 0.0]]),
        "yaw": Curve.harmonic(amplitude=0.5, omega=swing, phase=-0.4),
    }
    scene = driven(phase="slow", **curves)
    result = simulate(scene, t_end=140.0, dt_out=0.5, rtol=1e-8)
    time = result.time

    def part(amplitude: float, omega: float, phase: float) -> Array:
        return np.real(amplitude * slow_gain(omega, CUTOFF) * np.exp(1j * (omega * time + phase)))

    # A drift that was there from the start on is followed from there, without lag.
    slow = [3.0 + drift * time + part(1.5, wave, 0.2), part(25.0, swing, 0.0), part(0.5, swing, -0.4)]
    expected = load_at(scene, time, np.stack(slow, axis=1))
    later = time > 90.0  # the start's transient is exp(-w t / 2)
    scale = np.abs(expected).max()
    assert np.abs(result["wave_force"] - expected)[later].max() < 1e-5 * scale
    whole = np.stack([curve.evaluate(time)[:, 0] for curve in curves.values()], axis=1)
    assert np.abs(load_at(scene, time, whole) - expected)[later].max() > 0.05 * scale


@pytest.mark.warns("ForwardSpeedWarning")
def test_a_steady_drift_is_followed_from_the_start_on() -> None:
    slow, actual = (
        simulate(driven(phase=phase, x=steady(0.0, 2.0)), t_end=30.0, dt_out=0.5, rtol=1e-8)["wave_force"]
        for phase in ("slow", "actual")
    )
    assert np.abs(slow - actual).max() < 1e-7 * np.abs(actual).max()


def afloat(phase: Any, *, memory: Any = "per-pair", **waves: Any) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(shipped_database(), mooring=120.0, memory=memory)
    scene.add_sea(phase=phase, **{"hs": 3.0, "tp": 8.0, "count": 30} | waves)
    return scene


def test_formulations_and_merging_agree() -> None:
    scene = cases.case2(phase="slow", count=20)
    scene.waves = replace(scene.waves, negligible=0.0)
    found = []
    for formulation, merge in (("redundant", True), ("redundant", False), ("recursive", True)):
        run = Run(
            scene, 4.0, dt_out=0.5, model=scene.compile(merge=merge), rtol=1e-9, formulation=formulation
        )
        run.advance(4.0)
        channels = run.core.channels()
        found.append(np.column_stack([channels["vessel_motion"], channels["wave_force"]]))
    for other in found[1:]:
        assert np.all(np.abs(other - found[0]) < 1e-6 * np.abs(found[0]).max(axis=0))


@pytest.mark.parametrize(
    ("integrator", "formulation"), [("dopri5", "recursive"), ("rosenbrock", "redundant")]
)
def test_a_run_goes_on_bit_for_bit(integrator: str, formulation: str) -> None:
    goes_on(lambda: afloat("slow"), 8.0, 3.3, dt_out=0.5, integrator=integrator, formulation=formulation)


def test_files_keep_positions_and_actual_ones_have_no_filter_left(tmp_path: Path) -> None:
    scene = afloat("slow")
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again.waves.hull().cutoff == pytest.approx(0.2 * peak_frequency(scene.waves))
    first, second = (simulate(s, t_end=3.0, dt_out=1.0)["vessel_motion"] for s in (scene, again))
    np.testing.assert_array_equal(first, second)
    states = scene.compile().memory_states
    scene.add_sea(phase="actual")
    assert scene.compile().memory_states == states - 9
