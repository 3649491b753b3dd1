"""Wave loads at the slow part of a hull's position and heading, against closed forms and the other two."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import lsim

from seacrane import Curve, Run, Scene, SceneError, _core, cases, simulate
from seacrane.hydro import shipped_database
from seacrane.scene.position import force_by_heading
from seacrane.validity.hull_range import peak_frequency

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

Array = NDArray[np.float64]
CUTOFF = 0.5  # rad/s, of hulls that are driven: high, so that transients are short
SIX = ("x", "y", "z", "roll", "pitch", "yaw")


def slow_gain(omega: float, cutoff: float) -> complex:
    """What the low-pass leaves of a motion at omega: one less the high-pass."""
    s = 1j * omega / cutoff
    return complex((2.0 * s + 1.0) / (s**3 + 2.0 * s**2 + 2.0 * s + 1.0))


def driven(*, phase: Any, cutoff: float = CUTOFF, **curves: Curve) -> Scene:
    """A hull whose six coordinates are given, in a short-crested sea."""
    scene = Scene(name="driven")
    scene.add_vessel(shipped_database(), mooring_period=None, memory="none")
    scene.add_joint(kind="free", name="tow", first="ground", second="vessel", axis=(0.0, 0.0, 1.0))
    for name in SIX:
        scene.add_driver(joint="tow", coordinate=name, curve=curves.get(name, Curve.constant(value=0.0)))
    scene.add_sea(hs=2.0, tp=8.0, count=12)
    if phase == "slow":
        scene.use_slow_position(cutoff=cutoff)
    if phase == "actual":
        scene.use_actual_position()
    return scene


def load_at(scene: Scene, time: Array, pose: Array) -> Array:
    """Wave loads (n, 6) at poses x, y, yaw (n, 3)."""
    assert scene.waves is not None
    waves, table = scene.waves.components(), force_by_heading(shipped_database(), scene.waves.omega)
    load = _core.PositionedWaveLoad(waves, headings=table.heading.tolist(), transfer=table.values)
    rows = [load.evaluate(t, x=p[0], y=p[1], yaw=p[2])[0] for t, p in zip(time, pose, strict=True)]
    return np.array(rows)


def test_a_hull_that_is_held_gets_the_loads_of_the_mean_position() -> None:
    place = {"x": Curve.constant(value=0.0)}
    mean, slow = (
        simulate(driven(phase=phase, **place), t_end=20.0, dt_out=0.5)["wave_force"]
        for phase in ("mean", "slow")
    )
    # A table is within 1e-9 of the sum of all components, which is some ten times the load.
    assert np.all(np.abs(mean - slow) < 1e-7 * np.abs(mean).max())


@pytest.mark.warns("ForwardSpeedWarning")
def test_a_slow_position_is_the_low_passed_one_of_drift_turn_and_waves() -> None:
    """Steady drift, slow swings of sway and yaw and oscillations in all three: gain and phase of each."""
    drift, swing, wave = 0.4, 0.06, 1.1
    steady = Curve.pieces(starts=[0.0], coefficients=[[3.0, drift, 0, 0, 0, 0]], cosines=[[1.5, wave, 0.2]])
    sway = Curve.pieces(starts=[0.0], coefficients=[[0.0] * 6], cosines=[[25.0, swing, 0.0]])
    yaw = Curve.harmonic(amplitude=0.5, omega=swing, phase=-0.4)
    scene = driven(phase="slow", x=steady, y=sway, yaw=yaw)
    result = simulate(scene, t_end=140.0, dt_out=0.5, rtol=1e-8)
    time = result.time

    def part(amplitude: float, omega: float, phase: float) -> Array:
        return np.real(amplitude * slow_gain(omega, CUTOFF) * np.exp(1j * (omega * time + phase)))

    slow = np.stack(
        [
            # A drift that was there from the start on is followed from there, without lag.
            3.0 + drift * time + part(1.5, wave, 0.2),
            part(25.0, swing, 0.0),
            part(0.5, swing, -0.4),
        ],
        axis=1,
    )
    expected = load_at(scene, time, slow)
    later = time > 90.0  # the start's transient is exp(-w t / 2)
    scale = np.abs(expected).max()
    assert np.abs(result["wave_force"] - expected)[later].max() < 1e-5 * scale
    whole = np.stack(
        [steady.evaluate(time)[:, 0], sway.evaluate(time)[:, 0], yaw.evaluate(time)[:, 0]], axis=1
    )
    assert np.abs(load_at(scene, time, whole) - expected)[later].max() > 0.05 * scale


def test_a_hull_that_slowly_drifts_and_turns_tends_to_the_loads_of_where_it_is() -> None:
    """The error falls with the square of the drift's frequency over the cut-off, as 2 (omega / w)^2."""
    errors = []
    for swing in (0.04, 0.02):
        shape = {"omega": swing, "phase": -np.pi / 2.0}
        curves = {"x": Curve.harmonic(amplitude=20.0, **shape), "yaw": Curve.harmonic(amplitude=0.5, **shape)}
        scene = driven(phase="slow", **curves)
        result = simulate(scene, t_end=700.0, dt_out=1.0, rtol=1e-8)
        time, sine = result.time, np.sin(swing * result.time)
        actual = load_at(scene, time, np.stack([20.0 * sine, 0.0 * sine, 0.5 * sine], axis=1))
        error = np.abs(result["wave_force"] - actual)[time > 60.0].max() / np.abs(actual).max()
        assert error < 2.0 * (swing / CUTOFF) ** 2 * 2.0  # 20 m are 1.3 rad of waves at the peak
        errors.append(error)
    assert 3.0 < errors[0] / errors[1] < 5.0


@pytest.mark.warns("ForwardSpeedWarning")
def test_a_steady_drift_is_followed_from_the_start_on() -> None:
    ahead = Curve.pieces(starts=[0.0], coefficients=[[0.0, 2.0, 0, 0, 0, 0]])
    slow, actual = (
        simulate(driven(phase=phase, x=ahead), t_end=30.0, dt_out=0.5, rtol=1e-8)["wave_force"]
        for phase in ("slow", "actual")
    )
    assert np.abs(slow - actual).max() < 1e-7 * np.abs(actual).max()


def afloat(phase: Any, *, memory: Any = "per-pair", **waves: Any) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(shipped_database(), mooring_period=120.0, memory=memory)
    scene.add_sea(phase=phase, **{"hs": 3.0, "tp": 8.0, "count": 30} | waves)
    return scene


def test_a_hull_that_oscillates_about_a_place_tends_to_the_loads_of_the_mean_position() -> None:
    """In surge, sway and yaw, at the peak frequency: what is left is what the filter leaves of the motion."""
    shape = {"omega": 2.0 * np.pi / 8.0}
    curves = {
        "x": Curve.harmonic(amplitude=0.5, **shape),
        "y": Curve.harmonic(amplitude=0.5, phase=1.0, **shape),
        "yaw": Curve.harmonic(amplitude=0.01, phase=2.0, **shape),
    }
    mean, slow, actual = (
        simulate(
            driven(phase=phase, cutoff=0.2 * shape["omega"], **curves), t_end=300.0, dt_out=0.5, rtol=1e-8
        )
        for phase in ("mean", "slow", "actual")
    )
    later = mean.time > 150.0
    apart, near = (np.abs(run["wave_force"] - mean["wave_force"])[later].max() for run in (actual, slow))
    left = abs(slow_gain(5.0, 1.0))
    assert apart > 0.02 * np.abs(mean["wave_force"]).max()
    assert 0.7 * left < near / apart < 1.3 * left


def test_the_motion_of_a_free_hull_through_the_filter_is_where_its_loads_are_taken() -> None:
    """The filter once more, as a transfer function over the recorded motion."""
    scene = afloat("slow", direction_deg=70.0)
    result = simulate(scene, t_end=60.0, dt_out=0.02, rtol=1e-8, channels=["vessel_motion", "wave_force"])
    assert scene.waves is not None
    w = scene.waves.hull().cutoff
    assert w == pytest.approx(0.2 * peak_frequency(scene.waves))
    motion = result["vessel_motion"][:, [0, 1, 5]]
    low_pass = ([2.0 * w**2, w**3], [1.0, 2.0 * w, 2.0 * w**2, w**3])
    slow = np.stack([lsim(low_pass, U=motion[:, i], T=result.time)[1] for i in range(3)], axis=1)
    expected = load_at(scene, result.time, slow)
    assert np.abs(result["wave_force"] - expected).max() < 1e-6 * np.abs(expected).max()


def recorded(scene: Scene, t_end: float, *, merge: bool = True, **settings: Any) -> Array:
    run = Run(scene, t_end=t_end, dt_out=0.5, model=scene.compile(merge=merge), **settings)
    run.advance(t_end)
    channels = run.core.channels()
    return np.column_stack([channels["vessel_motion"], channels["wave_force"]])


def test_formulations_and_merging_agree() -> None:
    scene = cases.case2(phase="slow", count=20)
    scene.waves = replace(scene.waves, negligible=0.0) if scene.waves else None
    motions = [
        recorded(scene, 4.0, merge=merge, rtol=1e-9, formulation=formulation)
        for formulation, merge in (("redundant", True), ("redundant", False), ("recursive", True))
    ]
    scale = np.abs(motions[0]).max(axis=0)
    for other in motions[1:]:
        assert np.all(np.abs(other - motions[0]) < 1e-6 * scale)


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize("integrator", ["dopri5", "rosenbrock"])
def test_a_run_goes_on_bit_for_bit(integrator: str, formulation: str) -> None:
    settings: dict[str, Any] = {"integrator": integrator, "formulation": formulation, "dt_out": 0.5}
    scene = afloat("slow")
    whole = Run(scene, t_end=8.0, **settings)
    whole.advance(3.3)
    left = whole.core.state
    later = Run(scene, t_end=8.0, start=left, **settings)
    for going in (whole, later):
        going.advance(8.0)
    one, other = (np.array(going.core.state.values) for going in (whole, later))
    assert not np.array_equal(one, left.values)
    np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("memory", ["none", "passive", "convolution"])
def test_any_memory_goes_with_it(memory: str) -> None:
    motions = []
    for kind in (memory, "per-pair"):
        result = simulate(afloat("slow", memory=kind), t_end=20.0, dt_out=0.5)
        motions.append(result["vessel_motion"])
    limit = 0.5 if memory == "none" else 0.05
    assert np.abs(motions[0] - motions[1]).max() < limit * np.abs(motions[1]).max()


def test_a_scene_file_keeps_the_cut_off(tmp_path: Path) -> None:
    scene = afloat("slow")
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert scene.waves is not None
    assert again.waves is not None
    assert again.waves.hull().cutoff == scene.waves.hull().cutoff > 0.0
    first, second = (simulate(s, t_end=3.0, dt_out=1.0)["vessel_motion"] for s in (scene, again))
    np.testing.assert_array_equal(first, second)


def test_the_actual_position_after_the_slow_one_has_no_filter_left() -> None:
    scene = afloat("slow")
    states = scene.compile().memory_states
    scene.use_actual_position()
    assert scene.compile().memory_states == states - 9


def test_what_makes_no_sense_is_refused_by_name() -> None:
    with pytest.raises(SceneError, match="loads at the slow position needs a sea"):
        Scene(name="calm").use_slow_position()
    scene = afloat("mean")
    for value in (0.0, -1.0, float("nan")):
        with pytest.raises(SceneError, match="give a frequency between slow drift and waves"):
            scene.use_slow_position(cutoff=value)
    assert scene.waves is not None
    with pytest.raises(SceneError, match="no force_by_heading"):
        scene.waves.changed(cutoff=0.1)
    with pytest.raises(SceneError, match="cutoff is -1"):
        scene.waves.changed(cutoff=-1.0)
    slow = afloat("slow")
    assert slow.waves is not None
    slow.waves = replace(slow.waves, evaluation="fft")
    with pytest.raises(SceneError, match="choose evaluation='exact'"):
        slow.compile()
    paper = Scene(name="paper")
    paper.add_vessel(shipped_database(), kinematics="paper")
    paper.waves = afloat("slow").waves
    with pytest.raises(SceneError, match="yaw_following"):
        paper.compile()
