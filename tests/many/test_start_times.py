"""Lifts that begin at several times in one long sea, and distributions of what depends on one another."""

from __future__ import annotations

import re
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm
from test_staged_ensembles import HOW, KEEP, STAGES, feeder

from seacrane import SceneError, ensemble, simulate, simulate_stages
from seacrane.ensembles import Ensemble
from seacrane.ensembles.other_sea import with_sea
from seacrane.statistics import distribution

OVER = {"start_time": [40.0, 0.0, 12.5], "seed": [3, 5]}


@pytest.fixture(scope="module")
def lifts() -> Ensemble:
    return ensemble(feeder(), stages=STAGES, over=OVER, keep=KEEP, **HOW)


@pytest.mark.warns("LineLengthWarning")
def test_each_begins_in_the_state_of_its_sea_to_the_bit(lifts: Ensemble) -> None:
    for seed in OVER["seed"]:
        scene = with_sea(feeder(), {"seed": seed})
        state = None
        for begin in sorted(OVER["start_time"]):
            state = simulate(scene, begin, start=state, **HOW).state if begin else state
            run = simulate_stages(scene, STAGES, start=state, **HOW)
            member = lifts.dataset.sel(seed=seed, start_time=begin)
            up = run.reached("hook_load", suspension="hoist", part=run.stage("up"))[1]
            assert float(member.peak.squeeze()) == up.max()
            assert float(member.lifted) == run.stages[1].end
            assert run.stages[0].start == begin
    assert len(np.unique(lifts.dataset.peak)) == 6


@pytest.mark.parametrize("pack", [1, 4])
def test_packs_pools_and_a_resumed_store_give_the_same(pack: int, lifts: Ensemble, tmp_path: Path) -> None:
    same = {"stages": STAGES, "over": OVER, "keep": KEEP, "pack": pack, **HOW}
    for pool, given in ((ThreadPoolExecutor, {}), (ProcessPoolExecutor, {"store": tmp_path / "s"})):
        with pool(2) as executor:
            assert ensemble(feeder(), executor=executor, **given, **same).dataset.identical(lifts.dataset)
    for gone in sorted((tmp_path / "s").glob("pack_*.nc"))[::2]:
        gone.unlink()
    assert ensemble(feeder(), store=tmp_path / "s", **same).dataset.identical(lifts.dataset)


def test_a_load_that_goes_through_its_deck_while_it_waits_is_told_by_later_lifts() -> None:
    """Its line is too short for the sea: barge and load part before the lift begins."""
    scene = feeder(hs=3.0)
    scene.replace("hoist", length=27.02)
    told = ensemble(scene, stages=STAGES, over={"start_time": [0.0, 40.0]}, keep=KEEP, **HOW)
    early, late = told.dataset.validity.transpose("start_time", ...).to_numpy().ravel()
    assert "goes below its plane" not in early
    assert 0.0 < float(re.findall(r"goes below its plane at t = ([\d.]+) s", late)[0]) < 40.0


def test_bad_start_times_are_named() -> None:
    for over, given, message in (
        ([{"start_time": 1.0}], {}, "start_time is of grids"), ({"start_time": [-1.0]}, {}, "is -1"),
        ({"start_time": [1.0]}, {"stages": ()}, "start_time is of lifts in stages"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            ensemble(feeder(), over=over, keep=KEEP, **{"stages": STAGES, **given})


@pytest.mark.warns("FewSeedsWarning")
def test_a_distribution_of_an_ensemble(lifts: Ensemble) -> None:
    found = lifts.distribution("lifted")
    every = lifts.dataset.lifted.to_numpy().ravel()
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
