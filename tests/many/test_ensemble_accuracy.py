"""One method for an ensemble by the error that its runs may have."""

from __future__ import annotations

import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import pendulum

from seacrane import Kept, SceneError, ensemble, simulate
from seacrane.cases import vessel
from seacrane.ensembles import Ensemble
from seacrane.warnings import AccuracyNotHeldWarning

LIMIT = 1e-4
TRACK = {"track": Kept(channel="position", names={"body": "bob"})}
GIVEN: dict[str, Any] = {"keep": TRACK, "t_end": 3.0, "dt_out": 0.1}
STARTS = {"start": [1.0 + 0.02 * place for place in range(40)]}


@pytest.fixture(scope="module")
def chosen() -> Ensemble:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return ensemble(pendulum, over=STARTS, accuracy={"position": LIMIT}, **GIVEN)


def test_every_member_is_as_accurate_as_asked(chosen: Ensemble) -> None:
    for start in STARTS["start"]:
        truth = simulate(pendulum(start=start), 3.0, dt_out=0.1, integrator="verner76", rtol=1e-12)
        error = chosen.dataset.track.sel(start=start).to_numpy() - truth.select("position", body="bob")
        assert np.linalg.norm(error, axis=-1).max() < LIMIT


def test_one_method_is_chosen_at_little_cost(chosen: Ensemble) -> None:
    told = chosen.accuracy
    assert told is not None
    assert told.held
    assert told.cost < 1.2
    assert len(told.probes) == 1
    assert len(told.checks) == 2
    assert not set(told.probes) & set(told.checks)
    same = ensemble(
        pendulum, over=STARTS, integrator=told.method.integrator, rtol=told.method.used_rtol, **GIVEN
    )
    assert same.dataset.identical(chosen.dataset)


def test_a_sea_is_as_cheap() -> None:
    """Of 25 storms one is the probe and one is checked."""
    given: dict[str, Any] = {"over": {"seed": range(1, 26)}}
    roll = {"roll": Kept(channel="vessel_motion", what="maximum", names={"motion": "roll"})}
    told = ensemble(
        vessel(hs=1.0, memory="passive"), keep=roll, accuracy={"roll": 1e-3}, t_end=20.0, dt_out=0.5, **given
    ).accuracy
    assert told is not None
    assert (len(told.probes), len(told.checks)) == (1, 1)
    assert told.held
    assert told.cost < 1.2


def test_it_is_the_same_on_threads_and_resumed(chosen: Ensemble, tmp_path: Path) -> None:
    given: dict[str, Any] = {
        "over": STARTS,
        "accuracy": {"position": LIMIT},
        "store": tmp_path / "store",
        **GIVEN,
    }
    with ThreadPoolExecutor(2) as executor:
        there = ensemble(pendulum, executor=executor, **given)
    again = ensemble(pendulum, **given)
    for one in (there, again):
        assert one.dataset.identical(chosen.dataset)
        assert one.accuracy == chosen.accuracy


def test_members_wilder_than_their_probes_are_found() -> None:
    rows = [{"gravity": 1e-3 if place == 15 else 1e5} for place in range(30)]
    with pytest.warns(
        AccuracyNotHeldWarning, match=r"1 of 1 members .* are beyond it; worst is member \d+ \(grav"
    ):
        found = ensemble(pendulum(), over=rows, accuracy={"position": LIMIT}, **GIVEN)
    assert found.accuracy is not None
    assert not found.accuracy.held


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"rtol": 1e-3}, "accuracy chooses integrator, rtol and dt itself"),
        ({"accuracy": {}}, "accuracy is empty"),
        ({"accuracy": {"posture": 1.0}}, "channel 'posture' does not exist"),
        ({"accuracy": {"position": 0.0}}, "position is 0.0; give a finite number above zero"),
        ({"accuracy": 0.1}, "accuracy is 0.1; give a mapping"),
    ],
)
def test_bad_input_is_named(given: dict[str, Any], message: str) -> None:
    usual: dict[str, Any] = {"over": STARTS, "accuracy": {"position": LIMIT}, **GIVEN}
    with pytest.raises(SceneError, match=message):
        ensemble(pendulum, **{**usual, **given})
