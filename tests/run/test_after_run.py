"""What is worked out after a run never loses it: failures there are named warnings."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ensemble_studies import pendulum

import seacrane as sc
import seacrane.accuracy.choice
import seacrane.analysis.left_range
import seacrane.run.advance
import seacrane.run.run
from seacrane.warnings import NotFiniteWarning, UnjudgedWarning


def fails(*_: Any) -> Any:
    raise ValueError("no such thing")


LOOKS: dict[str, tuple[Any, str]] = {
    "a look at its range": (seacrane.analysis.left_range, "lifting"),
    "a look at events": (seacrane.run.run, "event_findings"),
    "modes": (seacrane.run.advance, "slow_findings"),
}
HALVES = [sc.Stage(name="one", duration=0.5), sc.Stage(name="two", duration=0.5)]


@pytest.mark.parametrize("place", list(LOOKS))
def test_a_look_that_fails_keeps_the_run(place: str, tmp_path: Path, monkeypatch: Any) -> None:
    module, name = LOOKS[place]
    expected = sc.simulate(pendulum(), 1.0)
    monkeypatch.setattr(module, name, fails)
    for run in (
        lambda: sc.simulate(pendulum(), 1.0),
        lambda: sc.simulate(pendulum(), 1.0, to=tmp_path / "run.nc").load(),
        lambda: sc.simulate(pendulum(), HALVES),
    ):
        with pytest.warns(UnjudgedWarning, match="which is kept: ValueError: no such thing"):
            result = run()
        assert not result.interrupted
        assert "no such thing" in result.stats["validity"]
        np.testing.assert_allclose(result["position"][-1], expected["position"][-1], rtol=1e-6)


def not_finite(run: sc.Run, arrays: Any, falls: Any) -> dict[str, Any]:
    """As `Run.wanted`, with a channel that is no number from its third output on."""
    out = {name: np.array(arrays[name]) for name in ("position", "energy_balance") if name in arrays}
    out["energy_balance" if "energy_balance" in out else "position"][2:] = np.nan
    return out


@pytest.mark.warns("FailedMembersWarning", sometimes=["NotFiniteWarning"])
def test_a_channel_that_is_not_finite_is_told_and_kept(tmp_path: Path, monkeypatch: Any) -> None:
    """No number is made of it, and a member is a failure."""
    monkeypatch.setattr(sc.Run, "wanted", not_finite)
    with pytest.warns(NotFiniteWarning, match="'energy_balance': is not finite from output 2 on"):
        result = sc.simulate(pendulum(), 1.0)
    assert np.isfinite(result["position"]).all() and np.isnan(result["energy_balance"][2:]).all()
    again = sc.Result.load(result.save(tmp_path / "run.nc"))
    assert again.stats["not_finite"] == "energy_balance" and not again.interrupted
    np.testing.assert_array_equal(again["energy_balance"], result["energy_balance"])
    with pytest.raises(sc.SimulationError, match="channels hold values that are not"):
        sc.simulate(pendulum(), 1.0, accuracy={"position": 1e-3})
    keep = {"x": sc.Kept(channel="position", what="maximum")}
    found = sc.ensemble(pendulum, over={"mass": [1.0]}, t_end=1.0, on_error="record", keep=keep)
    assert "not finite" in found.failures[0]
