"""Control variates: no bias, the gain of theory, the linear response of the waves, off where loose."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import Scene, SceneError, equilibrium, simulate
from seacrane.arrays import Array
from seacrane.cases import vessel
from seacrane.crane import Payload
from seacrane.ensembles import HookLoadControl, LinearControl
from seacrane.ensembles.other_sea import with_sea
from seacrane.hydro import BoxPart, shipped_database
from seacrane.statistics import controlled_mean


def pairs(random: np.random.Generator, correlation: float, count: int) -> tuple[Array, Array]:
    """Values of mean 5 and unit scatter that are not Gaussian, and controls of mean 2 and scatter 3."""
    shared, own = (random.gumbel(-np.euler_gamma, 1.0, count) * np.sqrt(6.0) / np.pi for _ in range(2))
    return 5.0 + correlation * shared + np.sqrt(1.0 - correlation**2) * own, 2.0 + 3.0 * shared


@pytest.mark.parametrize("correlation", [0.7, 0.89, 0.95])
def test_the_mean_is_unbiased_and_the_gain_that_of_theory(correlation: float) -> None:
    """Over 500 ensembles of 40 seeds."""
    random = np.random.default_rng(4)
    found = []
    for _ in range(500):
        values, controls = pairs(random, correlation, 40)
        many = pairs(random, correlation, 2000)[1]
        found.append(controlled_mean(values, controls=controls, many_controls=many))
    means = np.array([one.estimate.value for one in found])
    plain = np.array([one.plain.value for one in found])
    theory = 1.0 / (1.0 - correlation**2 * (1.0 - 40.0 / 2000.0))  # 2000 controls tell their own mean
    assert abs(means.mean() - 5.0) < 3.5 * means.std() / 500**0.5
    assert plain.var() / means.var() == pytest.approx(theory, rel=0.2)
    assert np.median([one.gain for one in found]) == pytest.approx(theory, rel=0.15)
    inside = np.mean([one.estimate.low < 5.0 < one.estimate.high for one in found])
    assert 0.92 < inside < 0.98


def test_a_loose_control_is_left_out() -> None:
    values, controls = pairs(np.random.default_rng(5), 0.2, 60)
    found = controlled_mean(values, controls=controls, many_controls=np.tile(controls, 20))
    assert not found.used and found.estimate == found.plain and found.gain == 1.0
    values, controls = pairs(np.random.default_rng(5), 0.95, 60)
    opposite = controlled_mean(values, controls=-controls, many_controls=-np.tile(controls, 20))
    assert opposite.used and opposite.correlation < -0.8


@pytest.mark.filterwarnings("ignore::seacrane.warnings.ScatteredWavesWarning")
@pytest.mark.parametrize(
    ("channel", "within"),
    [("position[vessel, z]", 0.01), ("velocity[vessel, y]", 0.01), ("acceleration[vessel, x]", 0.01),
     ("heel[vessel]", 0.01), ("position[box, z]", 0.02)],
)  # fmt: skip
def test_the_control_is_the_run_in_small_waves(channel: str, within: float) -> None:
    """From rest on, with the transient of the start; of a load in water with the waves on it."""
    wet = "box" in channel
    scene = lowered_load(drag=0.0) if wet else vessel(hs=0.02, memory="by-motion", mooring=None)
    state = equilibrium(scene) if wet else None
    control = LinearControl(scene, channel, t_end=30.0, after=3.0, state=state)
    name = channel.partition("[")[0]
    sea = with_sea(scene, {"seed": 5})
    run = simulate(sea, 30.0, rtol=1e-7, dt_out=0.1, channels=[name], start=state)
    late = run.time >= 3.0
    motion = run.curve(channel)
    moved = motion[late] - (motion[0] if name == "position" else 0.0)
    assert np.allclose(control.times, run.time[late])
    assert np.abs(control.series(5) - moved).max() < within * moved.std()
    largest, smallest = (control.extremes([5], what=what)[0] for what in ("maximum", "minimum"))
    assert (largest, smallest) == (control.series(5).max(), control.series(5).min())


def lifted() -> Scene:
    """A load held by a crane over the side."""
    scene = Scene(name="over the side")
    scene.add_vessel(shipped_database())
    scene.add_sea(hs=1.0, tp=8.0, direction_deg=150.0)
    load = Payload(mass=2e4, link_length=8.0)
    scene.add_crane(foot=(33.0, 10.0, 10.0), slew=-1.0, s1=1.0, s2=1.5, held=True, payload=load)
    scene.add_ballast(heel_deg=0.0)
    return scene


def test_a_hook_load_follows_the_square_of_the_swing() -> None:
    """Which the linear motions tell to second order: in small waves the run itself, in others nearly."""
    scene = lifted()
    given = {"t_end": 40.0, "after": 5.0, "dt_out": 0.25}
    for hs, known in ((0.05, 0.02), (1.0, 0.3)):
        control = HookLoadControl(scene, words={"hs": hs}, **given)
        sea = with_sea(scene, {"seed": 2, "hs": hs})
        run = simulate(sea, 40.0, rtol=1e-5, dt_out=0.25, channels=["hook_load"])
        load = run["hook_load"][run.time >= 5.0 - 1e-9, 0]
        assert np.allclose(control.times, run.time[run.time >= 5.0 - 1e-9])
        assert (control.series(2) - load).std() < known * load.std()
    acceleration = LinearControl(scene, "acceleration[payload, z]", words={"hs": 1.0}, **given)
    plain = 2e4 * (scene.gravity + acceleration.series(2))
    assert (control.series(2) - load).std() < 0.5 * (plain - load).std()


def test_what_makes_no_sense_is_refused() -> None:
    wet = lifted()
    wet.add_immersed("payload", parts=[BoxPart(size=(1.0, 1.0, 1.0))])
    heave = {"channel": "position[vessel, z]", "t_end": 10.0}
    for call, message in (
        (
            lambda: controlled_mean(np.arange(12.0), controls=[1.0] * 12, many_controls=np.arange(50.0)),
            "all are",
        ),
        (lambda: LinearControl(vessel(memory="convolution"), **heave), "is a convolution"),
        (lambda: LinearControl(lowered_load(1.0, depth=0.2), **heave), "crosses the surface at rest"),
        (lambda: HookLoadControl(wet, t_end=10.0), "'payload' is in water"),
    ):
        with pytest.raises(SceneError, match=message):
            call()


def lowered_load(drag: float, *, depth: float = 12.0, EA: float = 1e7) -> Scene:
    """A box in water, its middle at a depth, on a wire from the side of a ship."""
    scene = Scene(name="wet")
    scene.add_vessel(shipped_database())
    scene.add_body("box", mass=40e3, size=(4.0, 3.0, 2.0), position=(33.0, 30.0, -depth))
    scene.add_line(
        "wire", "vessel", "box", first_point=(33.0, 30.0, 20.0), second_point=(0.0, 0.0, 1.0), EA=EA,
        tension_at_start=(40e3 - 0.5 * 24.0 * 1025.0 * min(0.5 * depth + 0.5, 1.0)) * 9.80665,
    )  # fmt: skip
    scene.add_immersed("box", parts=[BoxPart(size=(4.0, 3.0, 2.0), fill=0.5, drag=drag)])
    scene.add_sea(hs=0.02, tp=7.0, direction_deg=150.0)
    return scene


@pytest.mark.filterwarnings("ignore::seacrane.warnings.ScatteredWavesWarning")
def test_drag_in_the_sea_as_described_damps_a_control() -> None:
    how = {"channel": "position[box, z]", "t_end": 100.0, "after": 20.0, "words": {"hs": 2.0}}
    free, braked = (LinearControl(lowered_load(drag, EA=2e6), **how) for drag in (0.0, 5.0))
    seeds = range(1, 5)
    assert braked.extremes(seeds).mean() < 0.98 * free.extremes(seeds).mean()
