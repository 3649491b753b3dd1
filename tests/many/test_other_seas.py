"""Members that differ in their sea alone: described and compiled once, and still what each is by itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from ensemble_studies import drifting_hull

from seacrane import FlowCoefficients, Kept, Run, Scene, SceneError, _core, cases, ensemble, simulate
from seacrane.ensembles import job
from seacrane.ensembles.other_sea import OtherSeeds, with_sea
from seacrane.ensembles.study import with_values
from seacrane.hydro.data import excitation
from seacrane.sea import MeasuredWaves, SeaState, WaveSystem, cos_2s, jonswap, torsethaugen
from seacrane.warnings import SteepSeaWarning

DATABASE = drifting_hull()
PATH = {"track": Kept(channel="position", names={"body": "vessel"})}


def wind_sea_and_swell(seed: int) -> Scene:
    systems = [
        WaveSystem(spectrum=jonswap(hs=1.5, tp=6.0), direction_deg=120.0, spreading=cos_2s(6.0), count=60),
        WaveSystem(spectrum=jonswap(hs=1.0, tp=13.0), direction_deg=40.0, count=40, name="swell"),
    ]
    return cases.vessel(database=DATABASE, sea=SeaState(systems=systems, seed=seed))


def slowly(seed: int) -> Scene:
    """A hull with way, whose slow position has another cut-off in each sea."""
    scene = vessel(seed, tp=6.0 + seed, phase="slow", drift=True, count=20)
    scene.replace("vessel", kind="body", velocity=(0.5, 0.1, 0.0))
    return scene


def in_a_current(seed: int) -> Scene:
    scene = vessel(seed, evaluation="exact", count=20)
    angle = np.radians([0.0, 90.0, 180.0])
    rows = FlowCoefficients(angle=angle, x=[0.1, 0.0, -0.1], y=[0.0, 0.6, 0.0], yaw=[0.0, 0.05, 0.0])
    scene.add_current(
        coefficients=rows, speed=0.8, direction_deg=20, frontal_area=200, lateral_area=700, length=100,
        body="vessel",
    )  # fmt: skip
    return scene


def on_a_wire(seed: int) -> Scene:
    """Events take the model of other sets of limits."""
    scene = vessel(seed, hs=4.0)
    low, high = (0.0, 25.0, 10.0), (0.0, 25.0, 20.0)
    scene.add_body(name="load", mass=1e4, inertia=(1e4, 1e4, 1e4), position=low, velocity=(0.0, 0.0, 3.0))
    scene.add_joint(kind="distance", name="wire", first="vessel", second="load", point=high, second_point=low)
    scene.add_line(joint="wire", rung="rigid")
    return scene


def case2(seed: int, **sea: Any) -> Scene:
    return cases.case2(database=DATABASE, seed=seed, **sea)


def vessel(seed: int, **how: Any) -> Scene:
    return cases.vessel(database=DATABASE, seed=seed, **how)


SLOW = {"phase": "slow", "spreading": 3.0, "count": 20}
SCENES: dict[str, tuple[Callable[[int], Scene], dict[str, Any]]] = {
    "crane with actuators": (case2, {}),
    "crane, redundant": (case2, {"formulation": "redundant", "integrator": "cvode-bdf", "t_end": 1.0}),
    "wind sea and swell": (wind_sea_and_swell, {}),
    "slow position": (slowly, {}),
    "crane at a slow position": (lambda seed: case2(seed, tp=6.0 + seed, **SLOW), {"t_end": 2.0}),
    "current": (in_a_current, {"integrator": "rk4", "dt": 0.05}),
    "wire": (on_a_wire, {}),
    "paper": (partial(vessel, kinematics="paper"), {}),
    "convolution": (partial(vessel, memory="convolution"), {}),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_run_in_another_sea_is_that_of_the_scene_in_it(name: str) -> None:
    made, settings = SCENES[name]
    given = {"t_end": 5.0, "dt_out": 0.5} | ({} if "dt" in settings else {"rtol": 1e-4}) | settings
    first, other = made(1), made(2)
    alone, again = Run(other, **given), Run(first, **given).in_sea(other.waves)
    for run in (alone, again):
        run.advance(given["t_end"])
    expected, result = alone.result(), again.result()
    assert list(expected) == list(result)
    for channel, values in expected.items():
        assert np.array_equal(values, result[channel]), channel
    told, same = ({k: v for k, v in one.stats.items() if k != "wall_s"} for one in (expected, result))
    assert told == same
    assert np.array_equal(np.array(alone.state.values), np.array(again.state.values))
    assert expected.events == result.events
    assert bool(result.events) == (name == "wire")
    assert result.scene is not None and result.scene.waves is other.waves


WORDS: dict[str, list[Any]] = {
    "seed": [3, 4], "hs": [0.8, 2.4], "tp": [7.0, 11.0], "direction_deg": [60.0, 170.0], "gamma": [1.0, 5.0]
}  # fmt: skip


@pytest.mark.parametrize("word", WORDS)
def test_members_are_what_simulate_gives_in_their_sea(word: str) -> None:
    scene = cases.case2(database=DATABASE, spreading=4.0 if word == "seed" else None)
    given = {"t_end": 3.0, "rtol": 1e-3, "channels": ["position"]}
    there = ensemble(scene, over={word: WORDS[word]}, lanes=1, keep=PATH, **given)
    for value in WORDS[word]:
        alone = simulate(with_sea(scene, {word: value}), **given)
        assert np.array_equal(there.dataset.track.sel({word: value}), alone.select("position", body="vessel"))
    if word == "seed":
        scene = wind_sea_and_swell(1)
        there = ensemble(scene, over={"seed": [1, 2]}, lanes=1, keep=PATH, **given)
        for seed in (1, 2):
            alone = simulate(wind_sea_and_swell(seed), **given).select("position", body="vessel")
            assert np.array_equal(there.dataset.track.sel(seed=seed), alone)
        with pytest.raises(SceneError, match=r"SeaState.* not hs, tp"):
            ensemble(scene, over={"hs": [1.0], "tp": [8.0]}, keep=PATH, **given)


def test_what_a_scene_says_of_its_waves_holds_in_its_other_seas() -> None:
    scene = vessel(1)
    says: dict[str, Any] = {
        "negligible": 1e-3,
        "relative_bound": 1e-7,
        "evaluation": "exact",
        "stretching": "none",
    }
    scene.waves = replace(scene.waves, **says)
    other = with_sea(scene, {"seed": 2}).waves
    assert {name: getattr(other, name) for name in says} == says


def test_a_sea_that_cannot_be_made_again_is_refused() -> None:
    time = np.arange(20.0)
    for system, message in (
        (WaveSystem(spectrum=torsethaugen(hs=2.0, tp=9.0), direction_deg=0.0), "'waves' .*Torse"),
        (MeasuredWaves(time=time, elevation=np.sin(time), direction_deg=0.0), "'measured' .*record"),
        (WaveSystem(spectrum=jonswap(hs=2.0, tp=9.0), direction_deg=0.0, maximum_omega=1.5, count=20),
         "its record describes"),
    ):  # fmt: skip
        scene = cases.vessel(database=DATABASE, sea=SeaState(systems=[system]))
        with pytest.raises(SceneError, match=message):
            ensemble(scene, over={"seed": [1, 2]}, keep=PATH)


def test_a_scene_is_compiled_once_for_all_its_seas(monkeypatch: Any) -> None:
    scene = cases.vessel(database=DATABASE)
    path, given = "bodies.vessel.mass", {"t_end": 1.0, "rtol": 1e-3}
    masses = [float(scene.bodies["vessel"].mass) * share for share in (1.0, 1.01)]
    over = {path: masses, "seed": range(4)}
    compiled, compile_scene = [], _core.compile

    def counting(**given: Any) -> _core.Model:
        compiled.append(given["name"])
        return compile_scene(**given)

    monkeypatch.setattr(_core, "compile", counting)
    there = ensemble(scene, over=over, lanes=1, keep=PATH, **given)
    assert len(compiled) == len(masses)
    monkeypatch.setattr(job, "MOST_HELD", 1)
    turned = ensemble(scene, over={"seed": range(4), path: masses}, lanes=1, keep=PATH, pack=3, **given)
    assert len(compiled) == len(masses) + 8  # none is held for as long as the next sea
    assert there.failures == turned.failures == {}
    assert np.array_equal(there.dataset.track, turned.dataset.track.transpose(*there.dataset.track.dims))
    heavier = with_sea(with_values(scene, {path: masses[1]}), {"seed": 2})
    alone = simulate(heavier, **given, channels=["position"]).select("position", body="vessel")
    assert np.array_equal(there.dataset.track.sel({path: masses[1], "seed": 2}), alone)


@pytest.mark.parametrize(("count", "heading"), [(1, 0.0), (7, 0.3), (311, -2.5)])
def test_forces_of_one_heading_are_those_of_any_headings(heading: float, count: int) -> None:
    one = excitation._by_heading(DATABASE, np.full(count, heading))
    every = excitation._interpolated_in_heading(DATABASE, np.full(count, heading))
    assert np.array_equal(np.broadcast_to(one, every.shape), every)
    weights = np.random.default_rng(count).normal(size=(count, every.shape[1]))
    sums = _core.weighted_sums(weights, every)
    assert np.array_equal(_core.weighted_sums(weights, one), sums)
    expected = np.einsum("qn,qnd->qd", weights, every)
    assert np.allclose(sums, expected, rtol=0.0, atol=1e-13 * np.abs(every).max() * np.abs(weights).sum())


@pytest.mark.parametrize("what", ["series", "mean", "maximum"])
def test_a_record_keeps_what_the_result_does(what: Any) -> None:
    run = Run(cases.case2(), 3.0, rtol=1e-3)
    run.advance(3.0)
    kept = Kept(channel="hook_load", what=what, after=0.5)
    record, result = kept.of(run.record()), kept.of(run.result())
    assert record.lies_like(result)
    assert np.array_equal(record.values, result.values)
    assert record.attributes == result.attributes


def test_every_seed_of_a_sea_is_warned_of_alike() -> None:
    scene = vessel(1, count=10)
    seeds = OtherSeeds(scene, {"hs": 9.0, "tp": 6.0})
    for seed in (1, 2):
        with pytest.warns(SteepSeaWarning, match="hs 9 m"):
            seeds.sea(seed)
