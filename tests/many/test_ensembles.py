"""Ensembles: the same numbers whatever runs them, nothing lost, a method by an accuracy, refusals."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import KEEP, SWING, dies_once, drifting_hull, fails_in_the_middle, lowest, pendulum

from seacrane import Kept, SceneError, SimulationError, ensemble, simulate
from seacrane.cases import vessel
from seacrane.ensembles import Ensemble, LatinHypercube
from seacrane.ensembles.other_sea import with_sea
from seacrane.errors import WorkerVersionError
from seacrane.scene.file import described
from seacrane.warnings import AccuracyNotHeldWarning

GRID = {"start": [1.0, 2.0, 3.0], "mass": [2.0, 5.0]}


@pytest.fixture(scope="module")
def serial() -> Ensemble:
    return ensemble(pendulum, over=GRID, keep=KEEP, **SWING)


def test_members_are_what_simulate_gives(serial: Ensemble) -> None:
    result = simulate(pendulum(start=2.0, mass=5.0), **SWING)
    place = result.select("position", body="bob")
    one, late = serial.dataset.sel(start=2.0, mass=5.0), result.time >= 1.0
    assert np.array_equal(one.track, place[::5]) and np.array_equal(one.time, result.time[::5])
    assert np.array_equal(one["mean"], place.mean(axis=0))
    assert (one.highest, one.lowest) == (place[late, 2].max(), place[:, 2].min())
    assert one.scatter == place[:, 0].std()
    assert serial.dataset.track.attrs["units"] == "m"
    assert serial.failures == {}


@pytest.mark.parametrize(("pool", "pack"), [(ThreadPoolExecutor, 100), (ProcessPoolExecutor, 4)])
def test_results_are_the_same_to_the_bit(pool: Any, pack: int, serial: Ensemble, tmp_path: Path) -> None:
    how = {"pack": pack, "store": tmp_path / "store", **SWING}
    with pool(2) as executor:
        there = ensemble(pendulum, over=GRID, keep=KEEP, executor=executor, **how)
    assert there.dataset.identical(serial.dataset)
    assert Ensemble.load(tmp_path / "store").dataset.identical(serial.dataset)


def test_seas_of_a_scene_are_those_of_add_sea() -> None:
    afloat = vessel(seed=7, hs=1.5)
    words = {"seed": 11, "hs": 2.5, "tp": 9.0, "gamma": 2.0, "direction_deg": 160.0}
    made, asked = with_sea(afloat, words), vessel(**words)
    assert asked.waves is not None and afloat.waves is not None
    known = replace(asked.waves.provenance, repeat_period_s=None, repeat_found=None)
    asked.waves = replace(asked.waves, provenance=known)
    assert described(made)["waves"] == described(asked)["waves"]
    assert afloat.waves.provenance.seed == 7


@pytest.mark.parametrize("phase", ["slow", "actual"])
def test_what_a_sea_does_to_a_vessel_stays(phase: str) -> None:
    scenes = [vessel(database=drifting_hull(), hs=0.0) for _ in range(2)]
    for seed, scene in enumerate(scenes):
        scene.add_sea(
            seed=seed, hs=1.0, tp=7.0, spreading=6.0, phase=phase, drift=True, position=(3.0, -2.0),
            heading_deg=20.0,
        )  # fmt: skip
    own, other = with_sea(scenes[0], {"seed": 1}).waves.hull(), scenes[1].waves.hull()
    assert (own.position, own.heading, own.cutoff) == (other.position, other.heading, other.cutoff)
    assert own.transfer.tobytes() == other.transfer.tobytes()
    for name in ("force_by_heading", "drift_by_heading"):
        assert getattr(own, name).values.tobytes() == getattr(other, name).values.tobytes()


def test_paths_change_elements_of_a_copy() -> None:
    scene = pendulum()
    scene.add_actuator(name="motor", joint="pin", stiffness=500.0, damping=50.0)
    keep = {"x": Kept(channel="position", names={"body": "bob", "axis": "x"})}
    there = ensemble(
        scene, over={"actuators.motor.stiffness": [500.0, 900.0], "gravity": [9.81, 1.62]}, keep=keep, **SWING
    )
    other = scene.copy(gravity=1.62)
    other.replace("motor", stiffness=900.0)
    expected = simulate(other, **SWING).select("position", body="bob", axis="x")
    picked = there.dataset.x.sel({"actuators.motor.stiffness": 900.0, "gravity": 1.62})
    assert np.array_equal(picked, expected)
    assert scene.actuators["motor"].stiffness == 500.0


def test_a_design_fills_every_part_of_its_ranges() -> None:
    design = LatinHypercube(ranges={"start": (1.0, 3.0), "mass": (2.0, 6.0)}, count=8, seed=3)
    there = ensemble(pendulum, over=design, keep={"lowest": lowest}, **SWING)
    for name, (low, high) in design.ranges.items():
        parts = np.floor((there.dataset[name].to_numpy() - low) / (high - low) * 8)
        assert sorted(parts) == list(range(8))
    listed = [there.parameters(index) for index in range(8)]
    again = ensemble(pendulum, over=listed, keep={"lowest": lowest}, **SWING)
    assert again.dataset.identical(there.dataset)


@pytest.mark.warns("FailedMembersWarning")
@pytest.mark.parametrize("stored", [False, True])
def test_a_member_that_fails_is_recorded(stored: bool, tmp_path: Path) -> None:
    """And ends it where asked."""
    given = {"over": {"start": [1.0, 2.0, 3.0, 4.0]}, "keep": {"lowest": lowest}, **SWING}
    told = "ValueError: no such start"
    there = ensemble(fails_in_the_middle, store=tmp_path / "store" if stored else None, **given)
    assert there.failures == {2: told}
    assert np.isnan(there.dataset.lowest.to_numpy()).tolist() == [False, False, True, False]
    assert there.dataset.failure.sel(start=3.0) == told
    with pytest.raises(SimulationError, match=rf"member 2 \(start=3.0\) failed: {told}"):
        ensemble(fails_in_the_middle, store=tmp_path / "other", on_error="raise", **given)
    left = Ensemble.load(tmp_path / "other")
    assert left.dataset.failure.to_numpy().tolist() == ["", "", told, "not run"]


def test_a_killed_worker_loses_only_what_was_in_flight(tmp_path: Path, monkeypatch: Any) -> None:
    monkeypatch.setenv("SEACRANE_TEST_PARENT", str(os.getpid()))
    over = {"start": [1.0, 2.0, 3.0, 4.0, 5.0], "mark": [str(tmp_path / "mark")]}
    given = {"over": over, "keep": KEEP, "store": tmp_path / "store", **SWING}
    with ProcessPoolExecutor(2) as executor, pytest.raises(SimulationError, match=r"pack \d was lost"):
        ensemble(dies_once, executor=executor, **given)
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "store").glob("pack_*")}
    assert before and "pack_0000002.nc" not in {path.name for path in before}
    with ProcessPoolExecutor(2) as executor:
        resumed = ensemble(dies_once, executor=executor, **given)
    assert all(path.stat().st_mtime_ns == kept for path, kept in before.items())
    assert resumed.dataset.identical(ensemble(dies_once, over=over, keep=KEEP, **SWING).dataset)


@pytest.mark.parametrize(
    ("changes", "named"),
    [({"rtol": 1e-5}, "method"), ({"t_end": 3.0}, "t_end"), ({"keep": {"lowest": max}}, "keep"),
     ({"over": {"start": [1.0, 2.0], "mass": [2.0, 6.0]}}, "first and last member, over"),
     ({"pack": 2}, "members in a pack")],
)  # fmt: skip
def test_the_store_of_another_study_is_refused(changes: dict[str, Any], named: str, tmp_path: Path) -> None:
    given = {"source": pendulum, "over": {"start": [1.0, 2.0], "mass": [2.0, 5.0]},
             "keep": {"lowest": lowest}, "store": tmp_path / "store", **SWING}  # fmt: skip
    first = ensemble(**given)
    with pytest.raises(SceneError, match=f"is of another study: .*{named}"):
        ensemble(**given | changes)
    assert ensemble(**given).dataset.identical(first.dataset)


def test_a_worker_of_another_version_is_named(monkeypatch: Any) -> None:
    with ProcessPoolExecutor(1) as executor:
        executor.submit(os.getpid).result()  # it is there, with the version of before
        monkeypatch.setattr("seacrane.ensembles.filling.__version__", "9.9")
        with pytest.raises(WorkerVersionError, match=r"9\.9"):
            ensemble(pendulum, over=GRID, keep=KEEP, executor=executor, **SWING)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"over": {"bodies.bob.mas": [1.0]}}, r"'bodies.bob.mas'.*'bodies.bob.mass'"),
        ({"over": {"gravity": range(1000), "baumgarte": range(1001)}}, "1001000 members"),
        ({"over": {"gravity": [1.0, 1.0]}}, "gravity has 1.0 twice"),
        ({"keep": {"failure": lowest}}, "'failure' is taken"),
        ({"keep": {"x": Kept(channel="position", interval=0.15)}}, "multiple of the output interval"),
        ({"lanes": 4, "pack": 6}, "pack is 6 and lanes is 4"),
        ({"store": Path(__file__).parent}, "something else than an ensemble"),
    ],
)
def test_bad_input_is_named(given: dict[str, Any], message: str) -> None:
    usual = {"source": pendulum(), "over": {"gravity": [9.0]}, "keep": KEEP, **SWING}
    with pytest.raises(SceneError, match=message):
        ensemble(**usual | given)


def test_members_begin_where_they_are_told(tmp_path: Path) -> None:
    """A state for all, or a function of each scene; a store of another start is refused."""
    asked = {"over": {"start": [1.0]}, "keep": {"lowest": lowest}, **SWING}
    half = simulate(pendulum(), **SWING | {"t_end": 1.0}).state
    whole = simulate(pendulum(), **SWING)["position"]
    later = ensemble(pendulum, **asked, start=half, store=tmp_path / "later")
    assert float(later.dataset.lowest[0]) == pytest.approx(whole[10:, 0, 2].min(), rel=1e-6)
    by_scene = ensemble(pendulum, **asked, start=lambda scene: half)
    assert float(by_scene.dataset.lowest[0]) == float(later.dataset.lowest[0])
    for given in ({"store": tmp_path / "later"}, {"start": 1.0}):
        with pytest.raises(SceneError, match="start"):
            ensemble(pendulum, **asked, **given)


LIMIT = 1e-4
TRACK = {"track": Kept(channel="position", names={"body": "bob"})}
SWUNG = {"keep": TRACK, "t_end": 3.0, "dt_out": 0.1}
STARTS = {"start": [1.0 + 0.02 * place for place in range(40)]}


@pytest.fixture(scope="module")
def chosen() -> Ensemble:
    return ensemble(pendulum, over=STARTS, accuracy={"position": LIMIT}, **SWUNG)


def test_every_member_is_as_accurate_as_asked(chosen: Ensemble) -> None:
    for start in STARTS["start"]:
        truth = simulate(pendulum(start=start), 3.0, dt_out=0.1, integrator="verner76", rtol=1e-12)
        error = chosen.dataset.track.sel(start=start).to_numpy() - truth.select("position", body="bob")
        assert np.linalg.norm(error, axis=-1).max() < LIMIT


def test_one_method_is_chosen_at_little_cost(chosen: Ensemble, tmp_path: Path) -> None:
    """And alike on threads and resumed."""
    told = chosen.accuracy
    assert told is not None and told.held and told.cost < 1.2
    assert (len(told.probes), len(told.checks)) == (1, 2) and not set(told.probes) & set(told.checks)
    method = {"integrator": told.method.integrator, "rtol": told.method.used_rtol}
    assert ensemble(pendulum, over=STARTS, **method, **SWUNG).dataset.identical(chosen.dataset)
    asked = {"over": STARTS, "accuracy": {"position": LIMIT}, "store": tmp_path / "s", **SWUNG}
    with ThreadPoolExecutor(2) as executor:
        there = ensemble(pendulum, executor=executor, **asked)
    for one in (there, ensemble(pendulum, **asked)):
        assert one.dataset.identical(chosen.dataset) and one.accuracy == told


def test_members_wilder_than_their_probes_are_found() -> None:
    rows = [{"gravity": 1e-3 if place == 15 else 1e5} for place in range(30)]
    with pytest.warns(AccuracyNotHeldWarning, match=r"1 of 1 members .*worst is member \d+ \(grav"):
        found = ensemble(pendulum(), over=rows, accuracy={"position": LIMIT}, **SWUNG)
    assert found.accuracy is not None and not found.accuracy.held
