"""Ensembles that grow by seeds until a statistic is known: where they stop, and that nothing changes it."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import bad_storm, lowest, storm, storm_that_parts

from seacrane import Kept, SceneError, SimulationError, ensemble
from seacrane.ensembles import Ensemble
from seacrane.ensembles.growing import BATCH
from seacrane.ensembles.targets import WIDENED, Target
from seacrane.statistics import seed_extremes
from seacrane.warnings import FailedSeedsWarning, FewSeedsWarning

RUN = {"t_end": 1.0, "rtol": 1e-3, "dt_out": 0.5}
REACH = Kept(channel="position", what="maximum", names={"body": "bob", "axis": "x"})
KEEP = {"reach": REACH}
OVER = {"height": [0.4, 1.0], "seed": range(1, 401)}
UNTIL = {"reach.mpm": 0.06}


@pytest.fixture(scope="module")
def grown() -> Ensemble:
    return ensemble(storm, over=OVER, keep=KEEP, until=UNTIL, **RUN)


def test_every_cell_stops_where_it_is_narrow_enough(grown: Ensemble) -> None:
    calm, rough = grown.certainty
    assert (calm.parameters, rough.parameters) == ({"height": 0.4}, {"height": 1.0})
    assert calm.seeds < rough.seeds == grown.dataset.sizes["seed"]
    for one in (calm, rough):
        assert one.seeds % BATCH == 0
        assert one.half_width <= one.asked == 0.06
        values = grown.dataset.reach.sel(one.parameters).to_numpy()
        assert np.isfinite(values).sum() == one.seeds
        found = seed_extremes(values[: one.seeds], duration=1.0).gumbel.mpm
        assert one.estimate.value == found.value
        assert one.estimate.half_width == pytest.approx(WIDENED * found.half_width)
        assert one.static == pytest.approx(grown.dataset.reach_mean.sel(one.parameters).mean())
    values = grown.dataset.reach.sel(height=1.0).to_numpy()[: rough.seeds - BATCH]
    before = seed_extremes(values, duration=1.0).gumbel.mpm
    assert WIDENED * before.half_width / (before.value - 0.5 * values.mean()) > 0.06
    assert set(grown.dataset.failure.sel(height=0.4).to_numpy()[calm.seeds :]) == {"not run"}


@pytest.mark.parametrize(("pool", "pack"), [(ThreadPoolExecutor, 8), (ProcessPoolExecutor, None)])
def test_it_is_the_same_to_the_bit(pool: Any, pack: int | None, grown: Ensemble, tmp_path: Path) -> None:
    store = tmp_path / "store"
    given = {"over": OVER, "keep": KEEP, "until": UNTIL, "pack": pack, "store": store, **RUN}
    with pool(2) as executor:
        there = ensemble(storm, executor=executor, **given)
    assert there.dataset.identical(grown.dataset) and there.certainty == grown.certainty
    assert Ensemble.load(store).dataset.identical(grown.dataset)
    for path in sorted(store.glob("pack_*"))[3::2]:
        path.unlink()
    again = ensemble(storm, **given)
    assert again.dataset.identical(grown.dataset) and again.certainty == grown.certainty


def test_a_narrower_interval_goes_on_from_the_same_store(grown: Ensemble, tmp_path: Path) -> None:
    store = tmp_path / "store"
    few = {**OVER, "seed": range(1, 50)}
    with pytest.warns(FewSeedsWarning, match="40 seeds are the most that over allows, and 1 of 2 statistics"):
        ensemble(storm, over=few, keep=KEEP, until=UNTIL, store=store, **RUN)
    kept = {path.name: path.stat().st_mtime_ns for path in store.glob("pack_*")}
    more = ensemble(storm, over=OVER, keep=KEEP, until=UNTIL, store=store, **RUN)
    assert more.dataset.identical(grown.dataset)
    assert all((store / name).stat().st_mtime_ns == time for name, time in kept.items())
    wider = ensemble(storm, over=OVER, keep=KEEP, until={"reach.mpm": 0.5}, store=store, **RUN)
    assert [one.seeds for one in wider.certainty] == [BATCH, BATCH]
    assert wider.dataset.sizes["seed"] == BATCH


def test_failures_are_told_and_allowed_for(tmp_path: Path) -> None:
    over = {"seed": range(1, 101), "height": [1.0, 2.0]}
    given = {"over": over, "keep": KEEP, "until": {"reach.mean": 0.2}, **RUN}
    with pytest.warns(FailedSeedsWarning, match=r"height=2.0.: all 20 seeds failed .member 1: Val"):
        there = ensemble(bad_storm, **given, store=tmp_path / "store")
    few, none = there.certainty
    assert (few.seeds, few.failed, few.futile) == (BATCH - 1, 1, False)
    assert (none.seeds, none.failed, none.futile, none.reached) == (0, BATCH, True, False)
    values = there.dataset.reach.sel(height=1.0).to_numpy()
    target = Target(variable="reach", number="mean", half_width=0.2, gumbel=True)
    plain = target.estimate(values[np.isfinite(values)])
    assert few.reached
    assert few.estimate.value == plain.value
    assert few.estimate.low < plain.low < plain.high < few.estimate.high
    with pytest.warns(FailedSeedsWarning):
        again = ensemble(bad_storm, **given, store=tmp_path / "store")
    assert str(again.certainty) == str(there.certainty)
    with pytest.raises(SimulationError, match=r"member 4 \(seed=3, height=1.0\) failed"):
        ensemble(bad_storm, on_error="raise", **given)


def test_the_worst_seeds_that_fail_leave_no_interval() -> None:
    """What an ensemble of the mild seeds alone would claim lies below the truth."""
    with pytest.warns(FailedSeedsWarning, match=r"failed: no interval.*the line parted.*1 stopped"):
        there = ensemble(
            storm_that_parts, over={"seed": range(1, 401)}, keep=KEEP, until={"reach.mpm": 0.1}, **RUN
        )
    (one,) = there.certainty
    assert one.failed > 0.2 * (one.seeds + one.failed) and one.seeds + one.failed < 400
    assert one.futile and not one.reached
    assert one.estimate.low == -np.inf


@pytest.mark.parametrize("share", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("which", ["largest", "smallest", "any"])
@pytest.mark.parametrize(
    ("number", "gumbel"), [("mpm", True), ("mean", True), ("p90", True), ("mean", False)]
)
def test_intervals_hold_whatever_failed_seeds_had_given(
    number: Any, gumbel: Any, which: Any, share: Any
) -> None:
    target = Target(variable="x", number=number, half_width=0.1, gumbel=gumbel)
    random, inside, lost = np.random.default_rng(3), 0, round(100 * share)
    truth = {"mpm": 0.0, "mean": np.euler_gamma, "p90": -np.log(-np.log(0.9))}[number] if gumbel else 0.0
    for _ in range(200):
        values = random.gumbel(size=100) if gumbel else random.normal(size=100)
        order = {"largest": np.sort(values), "smallest": -np.sort(-values), "any": values}[which]
        found = target.estimate(order[:-lost], lost)
        inside += found.low <= truth <= found.high
    assert inside >= 185


@pytest.mark.parametrize("failed", [(), (3,)])
@pytest.mark.parametrize("number", ["mpm", "mean", "p90"])
def test_smallest_values_are_those_with_the_sign_changed(number: str, failed: Any) -> None:
    values = np.random.default_rng(3).gumbel(5.0, 1.0, 40)
    given = {"variable": "x", "half_width": 0.1, "gumbel": True, "number": number}
    up = Target(**given).estimate(values, *failed)
    down = Target(sign=-1.0, **given).estimate(-values, *failed)
    assert (down.value, down.low, down.high) == (-up.value, -up.high, -up.low)
    still = Target(**given).estimate(np.full(20, 3.0))  # without scatter it is known
    assert number != "mpm" or (still.value, still.half_width) == (3.0, 0.0)


@pytest.mark.parametrize("number", ["mpm", "mean"])
def test_intervals_cover_after_stopping(number: str) -> None:
    """Sequential stopping undercovers; widened intervals hold the truth in 95 % of 400 ensembles."""
    target = Target(variable="x", number=number, half_width=0.04, gumbel=True)
    random, scale = np.random.default_rng(5), 0.12
    truth = 1.0 + (scale * np.euler_gamma if number == "mean" else 0.0)
    inside = 0
    for _ in range(400):
        maxima = random.gumbel(1.0, scale, 400)
        for count in range(BATCH, 401, BATCH):
            found = target.estimate(maxima[:count])
            if found.half_width <= 0.04 * found.value:
                break
        inside += found.low <= truth <= found.high
    assert 0.925 <= inside / 400 <= 0.985


def test_bad_input_is_named() -> None:
    track = Kept(channel="position", names={"body": "bob", "axis": "x"})
    usual = {"over": {"seed": range(1, 41)}, "keep": {"reach": REACH, "track": track}, "until": UNTIL, **RUN}
    for given, message in (
        ({"until": {"reech.mpm": 0.02}}, "'reech'.*'reach'"),
        ({"until": {"track.mean": 0.1}}, "track is a series"),
        ({"over": {"height": [1.0]}}, "over has none"), ({"over": {"seed": range(1, 60, 2)}}, "gaps"),
        ({"keep": {"reach": REACH, "reach_mean": lowest}}, "'reach_mean'"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            ensemble(storm, **{**usual, **given})
