"""What is worked out after a run never loses it: failures there are named warnings."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seacrane.accuracy.choice
import seacrane.run.advance
import seacrane.run.run
import seacrane.validity.left_range
from seacrane import (
    Result,
    Run,
    Scene,
    SimulationError,
    Stage,
    ensemble,
    simulate,
    simulate_stages,
    simulate_to_file,
)
from seacrane.warnings import NotFiniteWarning, UnjudgedWarning


def pendulum() -> Scene:
    scene = Scene(name="pendulum")
    scene.add_body(name="bob", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.0, 0.0))
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    return scene


def fails(*_: Any) -> Any:
    raise ValueError("no such thing")


LOOKS: dict[str, tuple[Any, str]] = {
    "a look at its range": (seacrane.validity.left_range, "lifting"),
    "a look at what follows": (seacrane.validity.left_range, "following"),
    "a look at oil": (seacrane.run.run, "boiled"),
    "modes": (seacrane.run.advance, "slow_findings"),
}


def in_memory(_: Path) -> Result:
    return simulate(pendulum(), 1.0)


def to_a_file(folder: Path) -> Result:
    return simulate_to_file(pendulum(), folder / "run.nc", 1.0).load()


def in_stages(_: Path) -> Result:
    return simulate_stages(pendulum(), [Stage(name="one", duration=0.5), Stage(name="two", duration=0.5)])


@pytest.mark.parametrize("how", [in_memory, to_a_file, in_stages])
@pytest.mark.parametrize("place", list(LOOKS))
def test_a_look_that_fails_keeps_the_run(
    place: str, how: Callable[[Path], Result], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module, name = LOOKS[place]
    expected = in_memory(tmp_path)
    monkeypatch.setattr(module, name, fails)
    with pytest.warns(
        UnjudgedWarning, match="failed after the run, which is kept: ValueError: no such thing"
    ):
        result = how(tmp_path)
    assert not result.interrupted
    assert "no such thing" in result.stats["validity"]
    np.testing.assert_allclose(result["position"][-1], expected["position"][-1], rtol=1e-6)


def test_derived_channels_that_fail_leave_the_recorded_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    run = Run(pendulum(), 1.0)
    run.advance(1.0)
    monkeypatch.setattr(seacrane.run.run, "named_channels", fails)
    result, found = run.judged_result()
    assert [kind for kind, _ in found] == [UnjudgedWarning]
    assert result["position"].shape == (result.time.size, 1, 3)


def test_an_estimate_of_the_model_that_fails_keeps_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(seacrane.accuracy.choice, "model_errors", fails)
    with pytest.warns(UnjudgedWarning, match="estimating the error of the model"):
        result = simulate(pendulum(), 1.0, accuracy={"position": 1e-3})
    assert result.stats["error_estimate_position"] <= 1e-3


def not_finite(run: Run, arrays: Any) -> dict[str, Any]:
    """As `Run.wanted`, with a channel that is no number from its third output on."""
    out = {
        name: np.array(values) for name, values in arrays.items() if name in ("position", "energy_balance")
    }
    out["energy_balance" if "energy_balance" in out else "position"][2:] = np.nan
    return out


def test_a_channel_that_is_not_finite_is_told_and_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Run, "wanted", not_finite)
    with pytest.warns(NotFiniteWarning, match="'energy_balance': is not finite from output 2 on"):
        result = simulate(pendulum(), 1.0)
    assert np.isfinite(result["position"]).all() and np.isnan(result["energy_balance"][2:]).all()
    result.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc")
    assert again.stats["not_finite"] == "energy_balance" and not again.interrupted
    np.testing.assert_array_equal(again["energy_balance"], result["energy_balance"])


def test_no_number_is_made_of_a_run_that_is_not_finite(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Run, "wanted", not_finite)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotFiniteWarning)
        with pytest.raises(SimulationError, match="of its channels hold values that are not"):
            simulate(pendulum(), 1.0, accuracy={"position": 1e-3})


@pytest.mark.warns("FailedMembersWarning")
def test_a_member_that_is_not_finite_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    from seacrane import Kept

    monkeypatch.setattr(Run, "wanted", not_finite)
    found = ensemble(
        lambda mass: pendulum(), over={"mass": [1.0]}, t_end=1.0, on_error="record",
        keep={"x": Kept(channel="position", what="maximum")},
    )  # fmt: skip
    assert "not finite" in found.failures[0]
