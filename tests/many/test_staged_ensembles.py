"""Ensembles of lifts in stages, also from several times in one sea: each is its own run, to the bit."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import norm

import seacrane as sc
from seacrane import ensemble, simulate
from seacrane.ensembles import Ensemble
from seacrane.ensembles.other_sea import with_sea
from seacrane.operability import Criterion, allowable_hs
from seacrane.statistics import distribution, seed_extremes

G = 9.80665
MASS, EA = 40e3, 2e8


def feeder(*, hs: float = 1.0, damping_ratio: float = 0.02) -> sc.Scene:
    """A load on the deck of a barge, below a crane on the ground that lifts it off."""
    scene = sc.Scene(name="feeder")
    scene.add_vessel(sc.shipped_database(), memory="none", mooring=60.0)
    scene.add_body(name="load", mass=MASS, size=(6.0, 6.0, 3.0), position=(0.0, 0.0, 11.5))
    scene.add_joint(kind="weld", name="grillage", first="vessel", second="load", point=(0.0, 0.0, 10.0))
    scene.add_stop("grillage")
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0.0, 0.0, 40.0), (0.0, 0.0, 1.5)], EA=EA,
                   length=28.0, damping_ratio=damping_ratio)  # fmt: skip
    scene.add_winch("hoist", lag=0.2, maximum_rate=1.0)
    scene.add_sea(hs=hs, tp=8.0, direction_deg=180.0, seed=1)
    return scene


def lift_at(rate: float, most: float = 30.0) -> list[sc.Stage]:
    lift = sc.Stage(
        name="lift", until=sc.Until.release("grillage"), maximum_duration=most, commands={"hoist.rate": rate}
    )
    return [sc.Stage(name="wait", duration=5.0), lift, sc.Stage(name="up", duration=5.0)]


STAGES = lift_at(-0.5)
KEEP = {"peak": "hook_load[stage=up].max", "whole": "hook_load.max",
        "lifted": "stage[lift].end", "took": "stage[lift].duration"}  # fmt: skip
HOW = {"dt_out": 0.02, "rtol": 1e-5}


@pytest.fixture(scope="module")
def lifts() -> Ensemble:
    return sc.ensemble(feeder(), stages=STAGES, over={"seed": [1, 2, 3]}, keep=KEEP, **HOW)


@pytest.mark.warns("LineLengthWarning")
def test_members_are_their_staged_runs_to_the_bit(lifts: Ensemble) -> None:
    for place, seed in enumerate((1, 2, 3)):
        run = sc.simulate(with_sea(feeder(), {"seed": seed}), STAGES, **HOW)
        lift = run.stages[1]
        member = lifts.dataset.isel(seed=place)
        assert float(member.whole.squeeze()) == run.reached("hook_load", suspension="hoist")[1].max()
        assert float(member.peak.squeeze()) == _reached(run, "up")
        assert (float(member.lifted), float(member.took)) == (lift.end, lift.end - lift.start)
    assert not lifts.failures and len(set(lifts.dataset.lifted.to_numpy().tolist())) == 3


def test_the_peak_is_that_of_the_relative_speed_at_lift_off() -> None:
    """m g + sqrt((m a)^2 + v^2 k m), by hand, of a load that leaves a deck at v against the hook.

    Undamped, at a constant rate. Later peaks are larger: the line that a winch takes in grows stiffer.
    """
    first = [*STAGES[:2], sc.Stage(name="up", duration=0.3)]
    keep = {"peak": "hook_load[stage=up].max", "by_hand": _peak_by_hand}
    lifts = sc.ensemble(
        feeder(damping_ratio=0.0), stages=first, over={"seed": range(8)}, keep=keep, dt_out=0.005, rtol=1e-7
    )
    hand = lifts.dataset.by_hand.to_numpy()
    assert np.ptp(hand) > 0.15 * MASS * G
    assert lifts.dataset.peak.to_numpy().reshape(hand.shape) == pytest.approx(hand, rel=3e-3)


def _peak_by_hand(result: Any) -> float:
    """From how the deck moves, by a parabola through the outputs before it lets go."""
    end = result.stages[1].end
    i = int(np.searchsorted(result.time, end))
    rise = result.select("velocity", body="load", axis="z")[i - 6 : i]
    _, acceleration, speed = np.polyfit(result.time[i - 6 : i] - end, rise, 2)
    stiffness = EA / float(result.curve("line_unstretched_length[hoist]")[i])
    return MASS * G + float(np.hypot(MASS * acceleration, (0.5 - speed) * np.sqrt(stiffness * MASS)))


@pytest.mark.warns("LineLengthWarning")
def test_numbers_of_stages_vary_by_path(lifts: Ensemble) -> None:
    over = [{"stages.lift.commands.hoist.rate": rate, "stages.wait.duration": wait, "seed": 2}
            for rate, wait in ((-0.5, 5.0), (-0.25, 5.0), (-0.5, 7.0))]  # fmt: skip
    told = sc.ensemble(feeder(), stages=STAGES, over=over, keep=KEEP, **HOW).dataset
    assert float(told.lifted[0]) == float(lifts.dataset.lifted[1])
    run = sc.simulate(with_sea(feeder(), {"seed": 2}), lift_at(-0.25), **HOW)
    assert float(told.lifted[1]) == run.stages[1].end
    assert float(told.lifted[2] - told.took[2]) == 7.0


def test_numbers_of_moves_vary_too() -> None:
    scene = sc.Scene(name="cart")
    scene.add_body(name="cart", mass=10.0, size=(1.0, 1.0, 1.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="cart", axis=(1.0, 0.0, 0.0))
    scene.add_driver("rail", curve=0.0)
    stages = [sc.Stage(name="out", duration=4.0, commands={"rail.displacement": sc.Move(to=1.0, over=2.0)})]
    path = "stages.out.commands.rail.displacement.to"
    told = sc.ensemble(scene, stages=stages, over={path: [1.0, 2.5]}, keep={"x": "position[cart, x].max"})
    assert told.dataset.x.to_numpy().ravel() == pytest.approx([1.0, 2.5], abs=1e-9)


@pytest.mark.warns("FailedMembersWarning")
def test_a_member_that_never_reaches_a_stage_says_so() -> None:
    over = {"stages.lift.maximum_duration": [0.5, 30.0]}
    told = sc.ensemble(feeder(), stages=lift_at(-0.5, 0.5), over=over, keep=KEEP, **HOW)
    assert list(told.failures) == [0]
    assert "stage 'lift'" in told.failures[0] and "SimulationError" in told.failures[0]


def test_a_store_tells_other_stages_apart(tmp_path: Path, lifts: Ensemble) -> None:
    """Another rate is another study; stages that are a function of the scene are those of a list."""
    asked = {"over": {"seed": [1]}, "keep": KEEP, **HOW}
    made = sc.ensemble(feeder(), stages=lambda scene: STAGES, **asked)
    assert made.dataset.peak.to_numpy().ravel()[0] == lifts.dataset.peak.to_numpy().ravel()[0]
    sc.ensemble(feeder(), stages=STAGES, store=tmp_path / "s", **asked)
    with pytest.raises(sc.SceneError, match="another study"):
        sc.ensemble(feeder(), stages=lift_at(-0.6), store=tmp_path / "s", **asked)


@pytest.mark.warns("FewSeedsWarning")
def test_allowable_hs_of_a_lift_in_stages() -> None:
    """Each storm is the staged run of its own; what a lift reaches in calm water is where Hs is zero."""
    scene, seeds, heights = feeder(), range(1, 9), (1.0, 3.0)
    bound = 1.85 * MASS * G
    up = Criterion(channel="hook_load[stage=up]", maximum=bound, statistic="p90")
    criteria = [up, Criterion(channel="hook_load", maximum=bound, name="whole", statistic="p90")]
    how = {"dt_out": 0.05, "rtol": 1e-4}
    told = allowable_hs(scene, criteria=criteria, tp=[8.0], direction_deg=[180.0], hs=heights, seeds=seeds,
                        stages=STAGES, **how)  # fmt: skip
    how["start"] = sc.equilibrium(scene)
    rest = _reached(sc.simulate(scene.copy(waves=None), STAGES, **how), "up")
    assert MASS * G < rest < bound
    levels = []
    for hs in heights:
        storms = (with_sea(scene, {"hs": hs, "seed": seed}) for seed in seeds)
        peaks = np.array([_reached(sc.simulate(storm, STAGES, **how), "up") for storm in storms])
        levels.append(float(seed_extremes(peaks - rest, duration=1.0, exposure=1.0).gumbel.p90.value))
    expected = np.interp(bound - rest, [0.0, *levels], [0.0, *heights])
    found = told.dataset.by_criterion.sel(criterion="hook load in up").item()
    assert levels[0] < bound - rest < levels[1]
    assert found == pytest.approx(expected, rel=1e-9)
    assert told.dataset.domain.item() == "time" and told.dataset.reason.item() == "a lift in stages"


def _reached(run: Any, stage: str) -> float:
    return float(run.reached("hook_load", suspension="hoist", part=run.stage(stage))[1].max())


@pytest.mark.parametrize(
    ("criterion", "given", "message"),
    [({"channel": "hook_load[stage=down]"}, {}, "'down'; the lift has wait, lift, up"),
     ({"exposure": 900.0}, {}, "exposure"), ({"motion": True}, {}, "motion=True"),
     ({}, {"duration": 900.0}, "leave duration out")],
)  # fmt: skip
def test_what_lifts_in_stages_do_not_take(criterion: Any, given: dict[str, Any], message: str) -> None:
    asked = Criterion(**{"channel": "hook_load", "maximum": 1e6, **criterion})
    sea = {"tp": [8.0], "direction_deg": [180.0], "stages": STAGES}
    with pytest.raises(sc.SceneError, match=message):
        allowable_hs(feeder(), criteria=[asked], **sea | given)


STARTS = {"start_time": [40.0, 0.0, 12.5], "seed": [3, 5]}


@pytest.fixture(scope="module")
def waiting() -> Ensemble:
    return ensemble(feeder(), stages=STAGES, over=STARTS, keep=KEEP, **HOW)


@pytest.mark.warns("LineLengthWarning")
def test_each_begins_in_the_state_of_its_sea_to_the_bit(waiting: Ensemble) -> None:
    for seed in STARTS["seed"]:
        scene = with_sea(feeder(), {"seed": seed})
        state = None
        for begin in sorted(STARTS["start_time"]):
            state = simulate(scene, begin, start=state, **HOW).state if begin else state
            run = simulate(scene, STAGES, start=state, **HOW)
            member = waiting.dataset.sel(seed=seed, start_time=begin)
            up = run.reached("hook_load", suspension="hoist", part=run.stage("up"))[1]
            assert float(member.peak.squeeze()) == up.max()
            assert float(member.lifted) == run.stages[1].end
            assert run.stages[0].start == begin
    assert len(np.unique(waiting.dataset.peak)) == 6
    told = waiting.dataset.attrs["side_by_side"]
    assert told.startswith("6 one by one: lifts with start_time") and "twice its time in lanes" in told


@pytest.mark.parametrize("pack", [1, 4])
def test_packs_pools_and_a_resumed_store_give_the_same(pack: int, waiting: Ensemble, tmp_path: Path) -> None:
    same = {"stages": STAGES, "over": STARTS, "keep": KEEP, "pack": pack, **HOW}
    for pool, given in ((ThreadPoolExecutor, {}), (ProcessPoolExecutor, {"store": tmp_path / "s"})):
        with pool(2) as executor:
            assert ensemble(feeder(), executor=executor, **given, **same).dataset.identical(waiting.dataset)
    for gone in sorted((tmp_path / "s").glob("pack_*.nc"))[::2]:
        gone.unlink()
    assert ensemble(feeder(), store=tmp_path / "s", **same).dataset.identical(waiting.dataset)


@pytest.mark.warns("FewSeedsWarning")
def test_a_distribution_of_an_ensemble(waiting: Ensemble) -> None:
    found = waiting.distribution("lifted")
    every = waiting.dataset.lifted.to_numpy().ravel()
    assert found.count == 6 and found.failed == 0
    assert found.mean.value == pytest.approx(every.mean())
    assert found.quantile(0.5).value == np.sort(every)[2]
    assert found.exceedance(np.sort(every)[2]).value == 0.5
    some = distribution([[1.0, np.nan], [2.0, 3.0]])
    assert (some.count, some.failed) == (3, 1)
    assert np.isnan(distribution([[1.0, 2.0]]).mean.low)


@pytest.mark.slow("hundreds of members")
def test_intervals_hold_for_values_that_depend_on_their_seed() -> None:
    """Of 400 draws of 20 seeds with 10 values each, 95 % intervals hold the truth as often as they say."""
    random, size, naive = np.random.default_rng(1), 400, 0
    spread, inside = np.sqrt(1.0 + 0.5**2), np.zeros(3)
    truths = np.array([0.0, spread * norm.ppf(0.9), norm.sf(1.0 / spread)])
    for _ in range(size):
        values = random.normal(size=(20, 1)) + 0.5 * random.normal(size=(20, 10))
        found = distribution(values)
        intervals = (found.mean, found.quantile(0.9), found.exceedance(1.0))
        inside += [one.low <= truth <= one.high for one, truth in zip(intervals, truths, strict=True)]
        naive += abs(values.mean()) < 1.96 * values.std() / np.sqrt(values.size)
    assert np.all(inside / size > 0.90) and inside[0] / size < 0.985
    assert naive / size < 0.7  # what independent values would give
