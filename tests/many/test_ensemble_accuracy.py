"""One method for an ensemble by the error that its runs may have."""

from __future__ import annotations

import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from ensemble_studies import pendulum

from seacrane import Kept, ensemble, simulate
from seacrane.ensembles import Ensemble
from seacrane.warnings import AccuracyNotHeldWarning

LIMIT = 1e-4
TRACK = {"track": Kept(channel="position", names={"body": "bob"})}
GIVEN = {"keep": TRACK, "t_end": 3.0, "dt_out": 0.1}
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


def test_one_method_is_chosen_at_little_cost(chosen: Ensemble, tmp_path: Path) -> None:
    """And alike on threads and resumed."""
    told = chosen.accuracy
    assert told is not None and told.held
    assert told.cost < 1.2
    assert (len(told.probes), len(told.checks)) == (1, 2)
    assert not set(told.probes) & set(told.checks)
    method = {"integrator": told.method.integrator, "rtol": told.method.used_rtol}
    assert ensemble(pendulum, over=STARTS, **method, **GIVEN).dataset.identical(chosen.dataset)
    asked = {"over": STARTS, "accuracy": {"position": LIMIT}, "store": tmp_path / "s", **GIVEN}
    with ThreadPoolExecutor(2) as executor:
        there = ensemble(pendulum, executor=executor, **asked)
    for one in (there, ensemble(pendulum, **asked)):
        assert one.dataset.identical(chosen.dataset)
        assert one.accuracy == told


def test_members_wilder_than_their_probes_are_found() -> None:
    rows = [{"gravity": 1e-3 if place == 15 else 1e5} for place in range(30)]
    with pytest.warns(AccuracyNotHeldWarning, match=r"1 of 1 members .*worst is member \d+ \(grav"):
        found = ensemble(pendulum(), over=rows, accuracy={"position": LIMIT}, **GIVEN)
    assert found.accuracy is not None and not found.accuracy.held
