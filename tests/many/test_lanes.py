"""Runs side by side in vector lanes: the scalar engine's numbers, and its help where lanes do not go."""

from __future__ import annotations

import shutil
import subprocess
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import drifting_hull, luffed, pendulum
from marks import needs_lanes
from random_scenes import KINDS, Shape, build

from seacrane import Kept, Result, Run, Scene, _core, cases, ensemble, simulate
from seacrane.ensembles.other_sea import with_sea
from seacrane.ensembles.study import with_values
from seacrane.run.lanes import INSTRUCTIONS, advance_side_by_side, lanes_of, module_of

LANES = [lanes for lanes in INSTRUCTIONS if module_of(lanes) is not None]

TRACK = Kept(channel="position", names={"body": "payload"}, interval=2.0)
MORE = "the lifts differ in what lanes share: in"


@cache
def case(name: str) -> Scene:
    return getattr(cases, name)(seed=1, hs=2.0)


def seas(name: str, count: int) -> list[Scene]:
    return [with_sea(case(name), {"seed": seed}) for seed in range(1, count + 1)]


def differences(
    scenes: list[Scene], rounds: int, spread: float = 0.1, at: Any = (0.37).__mul__, lanes: int = 4
) -> float:
    """Largest difference of rates at random states, over the largest of positions, speeds and the rest."""
    models = [one.compile() for one in scenes]
    evaluator = _core.LaneEvaluator(module_of(lanes), models)
    start, rng = evaluator.start(), np.random.default_rng(1)
    tree = models[0].tree
    edges = [*np.cumsum([0, tree["positions"], tree["speeds"]]).tolist(), start.shape[1]]
    worst = 0.0
    for moment in range(rounds):
        state = start + spread * rng.normal(size=start.shape)
        one_by_one = evaluator.scalar_derivative(at(moment), state)
        off = np.abs(evaluator.derivative(at(moment), state) - one_by_one)
        for begin, end in pairwise(edges):
            if end > begin:
                size = np.abs(one_by_one[:, begin:end]).max(axis=1, keepdims=True)
                worst = max(worst, float((off[:, begin:end] / (size + 1e-300)).max()))
    return worst


@needs_lanes
@pytest.mark.parametrize("lanes", LANES)
@pytest.mark.parametrize("name", ["vessel", "case1", "case2", "case3"])
def test_an_evaluation_is_that_of_each_lane(name: str, lanes: int) -> None:
    scenes = seas(name, lanes)
    assert differences(scenes, 20, lanes=lanes) < 1e-12
    if name == "case2":  # forth and back over minutes
        forth_and_back = [31.7 * ((7 * moment) % 20) for moment in range(20)]
        assert differences(scenes, 20, at=forth_and_back.__getitem__, lanes=lanes) < 1e-11


@needs_lanes
@pytest.mark.parametrize("kind", KINDS)
def test_every_branch_of_the_tree_takes_packs(kind: str) -> None:
    shape = Shape(seed=3, parents=(-1, 0, 1), kinds=(kind, "revolute", kind), swapped=(False, True, False),
                  base="vessel", decades=2.0)  # fmt: skip
    assert differences([build(shape)] * 4, 10, 0.02) < 1e-11


def stats(result: Result) -> list[float]:
    return [float(result.stats.get("lanes", 1)), float(result.stats["steps"]), float(result.time[-1])]


@needs_lanes
@pytest.mark.parametrize("lanes", LANES)
def test_members_are_those_of_the_scalar_engine_within_the_tolerance(lanes: int) -> None:
    study = {"over": {"seed": range(1, 6)}, "keep": {"track": TRACK, "stats": stats},
             "t_end": 20.0, "dt_out": 1.0, "channels": ("position",)}  # fmt: skip
    fine = ensemble(case("case2"), rtol=1e-8, lanes=1, **study).dataset
    for rtol, bound in ((1e-2, 2e-2), (1e-5, 2e-5)):
        side_by_side = ensemble(case("case2"), rtol=rtol, lanes=lanes, **study).dataset
        assert np.abs(side_by_side.track - fine.track).max() < bound
        beside = 4 if lanes == 4 else 5
        assert (side_by_side.stats[:beside, 0] == lanes).all()  # the fifth of four has nobody beside it
        assert (side_by_side.stats[beside:, 0] == 1).all()
        assert (side_by_side.stats[:, 2] == 20.0).all()


@needs_lanes
def test_outputs_of_every_kind_are_those_of_a_single_run() -> None:
    scene = case("case2")
    names = ("position", "vessel_motion", "reaction_force", "actuator_force", "wave_elevation")
    keep = {name: Kept(channel=name) for name in names}
    made = ensemble(scene, over={"seed": [1, 2]}, keep=keep, t_end=5.0, rtol=1e-9, lanes=4).dataset
    for seed in (1, 2):
        result = simulate(with_sea(scene, {"seed": seed}), t_end=5.0, rtol=1e-9)
        for name in keep:
            scale = np.abs(result[name]).max()
            assert np.abs(made[name].sel(seed=seed) - result[name]).max() < 1e-6 * scale, name


def lanes_of_run(result: Result) -> float:
    return float(result.stats.get("lanes", 1))


def reason(over: Any, **given: Any) -> str:
    """Why the first member of an ensemble did not go side by side."""
    study = {"over": over, "keep": {"lanes": lanes_of_run}, "lanes": 4, "t_end": 0.2, "rtol": 1e-3}
    made = ensemble(pendulum, **study | given)
    assert not made.failures and (made.dataset.lanes == 1).all()
    assert made.dataset.attrs["side_by_side"].endswith("twice its time in lanes")
    return str(made.dataset.kept_apart.to_numpy().ravel()[0])


@needs_lanes
@pytest.mark.parametrize(
    ("over", "given", "told"),
    [
        ({"start": [1.0, 2.0]}, {}, f"{MORE} joint 'pin' (second_frame)"),
        ({"start": [1.0]}, {}, "no other run beside it"),
        ([{"start": 1.0}] * 2, {"integrator": "dopri5-stiff"}, "steps nothing"),
        ([{"start": 1.0}] * 2, {"formulation": "redundant"}, "recursive one"),
        ([{"start": 1.0}] * 2, {"energy_limit": 1.0}, "energy is watched"),
    ],
)
def test_what_lanes_cannot_do_runs_by_itself_and_says_why(over: Any, given: Any, told: str) -> None:
    assert told in reason(over, **given)


def test_lanes_that_fail_altogether_and_a_processor_without_them_are_told(monkeypatch: Any) -> None:
    def fails(*_: Any) -> bool:
        raise ValueError("no such luck")

    if 4 in LANES:
        with monkeypatch.context() as patch:
            patch.setattr("seacrane.run.lanes._core.advance_side_by_side", fails)
            assert "ValueError: no such luck" in reason([{"start": 1.0}] * 2)
    monkeypatch.setattr("seacrane.run.lanes.module_of", lambda lanes: None)
    assert lanes_of(None) == 1
    assert "no lanes" in reason([{"start": 1.0}] * 2)


def drifting(*, seed: int, drift: bool) -> Scene:
    return cases.vessel(database=drifting_hull(), hs=2.0, tp=8.0, seed=seed, count=40, drift=drift)


@needs_lanes
@pytest.mark.parametrize("drift", [[False, True], [True, False]])
def test_slow_drift_is_that_of_each_member(drift: list[bool]) -> None:
    """In lanes beside those that have it too, whichever is first."""
    study = {"over": {"seed": [1, 2], "drift": drift}, "t_end": 20.0, "rtol": 1e-8}
    study["keep"] = {"sway": Kept(channel="vessel_motion", what="mean", names={"motion": "sway"})}
    alone, beside = (ensemble(drifting, lanes=lanes, **study).dataset for lanes in (1, 4))
    assert np.abs(alone.sway - beside.sway).max() < 1e-5
    assert (beside.kept_apart == "").all()
    assert np.abs(alone.sway.sel(drift=True) - alone.sway.sel(drift=False)).min() > 0.01


@needs_lanes
def test_what_the_first_of_the_runs_decides_is_the_same_in_all() -> None:
    given = {"t_end": 1.0, "rtol": 1e-6, "formulation": "recursive"}
    for other in ({"rtol": 1e-5}, {"maximum_step": 0.01}, {"integrator": "tsit5"}):
        runs = [Run(pendulum(), **given), Run(pendulum(), **given | other)]
        assert advance_side_by_side(runs, 4, lambda _: None)
        assert [run.core.time for run in runs] == [0.0, 0.0]
        assert all("different methods" in run.lanes["kept_apart"] for run in runs)
    runs = [Run(pendulum(start=start), **given) for start in (1.0, 2.0)]
    with pytest.raises(ValueError, match=f"side by side: {MORE} joint 'pin'"):
        _core.advance_side_by_side([run.core for run in runs], module_of(4), 1.0)


def beside_and_alone(
    scenes: list[Scene], t_end: float = 1.0, dt_out: float = 0.5
) -> tuple[list[Run], list[float]]:
    """Runs in lanes, and the largest difference of poses of each from its run alone."""
    given = {"rtol": 1e-9, "formulation": "recursive", "integrator": "dopri5", "dt_out": dt_out}
    runs, alone = ([Run(scene, t_end, **given) for scene in scenes] for _ in range(2))
    assert advance_side_by_side(runs, 4, lambda _: None)
    off = []
    for run, one in zip(runs, alone, strict=True):
        run.advance(t_end)
        one.advance(t_end)
        beside, by_itself = run.result(), one.result()
        names = ("position", "quaternion", "velocity")
        off.append(max(float(np.abs(beside[x] - by_itself[x]).max()) for x in names))
    return runs, off


def why_apart(runs: list[Run]) -> list[str]:
    return [str(run.lanes.get("kept_apart", "")) for run in runs]


@needs_lanes
def test_a_vessel_is_moored_where_its_own_lift_describes_it() -> None:
    for attribute, value in (
        ("position", (0.0, 2.0, 0.0)),
        ("quaternion", (np.cos(0.1), 0.0, 0.0, np.sin(0.1))),
    ):
        there = with_values(case("vessel"), {f"bodies.vessel.{attribute}": value})
        runs, off = beside_and_alone([case("vessel"), there])
        assert why_apart(runs) == [f"{MORE} where vessel 'vessel' is at rest"] * 2
        assert off == [0.0, 0.0]
    lifted = with_values(case("vessel"), {"bodies.vessel.position": (0.0, 0.0, 0.5)})  # above its rest
    runs, off = beside_and_alone([case("vessel"), lifted])
    assert why_apart(runs) == ["", ""] and max(off) < 1e-6


@needs_lanes
@pytest.mark.parametrize(
    ("one", "other", "told"),
    [
        ({}, {"turned": True}, "the strut of joint 'ram' stands on different sides"),
        ({"driven": True}, {"driven": True, "behind": True}, "joint 'hinge' is on different sides of a dead"),
        ({}, {"behind": True}, ""),
        ({"driven": True}, {"driven": True}, ""),
    ],
)
def test_a_cylinder_stands_on_the_side_of_its_own_lift(one: Any, other: Any, told: str) -> None:
    runs, off = beside_and_alone([luffed(**one), luffed(**other)])
    assert all(told in reason if told else not reason for reason in why_apart(runs))
    assert max(off) <= (0.0 if told else 1e-6)


def spun(speed: float) -> Run:
    """A flywheel, whose angle packs no longer turn into sines from 1.6e6 rad on."""
    scene = Scene(name="flywheel")
    scene.add_body(name="wheel", mass=1.0, inertia=(1.0, 2.0, 1.0))
    scene.add_joint(
        kind="revolute", name="axle", first="ground", second="wheel", point=(0, 0, 0), axis=(0, 1, 0)
    )
    model = scene.compile()
    values = model.initial_state
    values[model.twist_index(0) + 4] = speed
    start = _core.State(time=0.0, values=values, inputs=[])
    return Run(scene, 4.0, start=start, rtol=1e-6, integrator="tsit5", formulation="recursive", dt_out=1.0)


@needs_lanes
def test_a_lane_that_fails_leaves_the_others_alone() -> None:
    speeds = [1.0, 2.0, 1e6, 3.0]
    runs = [spun(speed) for speed in speeds]
    assert advance_side_by_side(runs, 4, lambda _: None)
    assert [run.core.time for run in runs[:2]] == [4.0, 4.0] and runs[3].core.time == 4.0
    left = runs[2].core.time
    assert 1.0 < left < 1.7
    assert [run.stats().get("kept_apart", "") for run in runs] == [
        "", "", f"from t = {left:.6g} s on: its step beside the others failed", ""
    ]  # fmt: skip
    assert runs[2].advance(4.0)  # its own engine goes on from there
    for speed, run in zip(speeds, runs, strict=True):
        result = run.result()
        assert np.allclose(result["angular_velocity"][:, 0, 1], speed, rtol=1e-9)
        assert result.time.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]
        turned = np.arctan2(-result["quaternion"][:, 0, 2], result["quaternion"][:, 0, 0])
        assert np.abs(np.sin(turned + 0.5 * speed * result.time)).max() < 1e-6 * speed


@needs_lanes
@pytest.mark.skipif(shutil.which("readelf") is None, reason="readelf is missing: install binutils")
@pytest.mark.parametrize("lanes", LANES)
def test_a_lane_module_shows_nothing_but_its_entry(lanes: int) -> None:
    """Code for another processor in one process must not take the place of the core's: see docs/design.md."""
    told = subprocess.check_output(["readelf", "--dyn-syms", "--wide", module_of(lanes).__file__], text=True)
    table = [line.split() for line in told.splitlines()]
    symbols = [row for row in table if len(row) >= 8 and row[0].rstrip(":").isdigit()]
    assert [row[7] for row in symbols if row[6] != "UND"] == [f"PyInit__lanes_{INSTRUCTIONS[lanes]}"]


@pytest.mark.skipif(not Path("/proc/cpuinfo").is_file(), reason="Linux tells what its processor can do")
def test_instructions_are_those_that_linux_tells_of(monkeypatch: Any) -> None:
    """Whichever compiler made the core; Linux leaves out what it keeps no registers of."""
    monkeypatch.syspath_prepend(str(Path(__file__).resolve().parents[2] / "tools" / "wheel"))
    from processor import lanes_of_this_processor

    assert [lanes for lanes in INSTRUCTIONS if _core.has_instructions(INSTRUCTIONS[lanes])] == (
        lanes_of_this_processor()
    )


@needs_lanes
def test_lanes_are_the_default_where_a_sea_varies() -> None:
    study = {"keep": {"lanes": lanes_of_run}, "t_end": 0.5, "rtol": 1e-2}
    assert (ensemble(case("vessel"), over={"seed": [1, 2]}, **study).dataset.lanes == 4).all()
    assert (ensemble(case("vessel"), over={"seed": [1, 2]}, pack=2, **study).dataset.lanes == 1).all()
    assert (ensemble(case("vessel"), over={"gravity": [9.8, 9.81]}, **study).dataset.lanes == 1).all()
