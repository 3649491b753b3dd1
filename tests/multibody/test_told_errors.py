"""Errors that are told: of a fixed step, and of a fitted fluid memory, against runs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from kink_scenes import sprung
from trade_scenes import pendulum, thrown

from seacrane import Scene, SceneError, cases, simulate, step_error
from seacrane.accuracy import model_error
from seacrane.accuracy.quantities import compare
from seacrane.description.databases import without_databases
from seacrane.hydro import shipped_database
from seacrane.warnings import ModelErrorWarning


def error_of(scene: Scene, **setting: Any) -> float:
    """Largest difference of positions from a run at a tight tolerance."""
    run = simulate(scene, **setting)
    truth = simulate(scene, integrator="verner76", rtol=1e-12, t_end=setting["t_end"])
    return compare(np.asarray(truth["position"]), np.asarray(run["position"])).largest


def stiff() -> Scene:
    """A cart on a spring, 200 rad/s, 1 cm off: "rk4" is stable up to 2.83/200 s."""
    return sprung(200.0, rest=0.01)


@pytest.mark.parametrize(
    ("make", "integrator", "dt", "t_end"),
    [
        (pendulum, "semi-implicit-euler", 1e-3, 6.0), (pendulum, "rk4", 5e-3, 6.0),
        (pendulum, "rk-low-storage", 0.01, 6.0), (pendulum, "generalized-alpha", 4e-3, 6.0),
        (thrown, "rk4", 1e-3, 1.0),  # before its error has grown
        (stiff, "rk4", 5e-4, 2.0), (cases.case2, "rk4", 0.025, 20.0),
    ],
)  # fmt: skip
def test_the_error_told_is_the_error(
    make: Callable[[], Scene], integrator: str, dt: float, t_end: float
) -> None:
    scene = make()
    setting: dict[str, Any] = {"integrator": integrator, "dt": dt, "t_end": t_end}
    told = step_error(scene, **setting, quantities=["position"])["position"]
    assert told.error is not None and not told.sensitive and told.stable_step is None
    wide = 2.5 if make is cases.case2 else 2.0
    assert 1.0 / wide < told.error / error_of(scene, **setting) < wide
    if t_end == 6.0:
        assert told.order == pytest.approx(told.method_order, abs=0.7)


def test_a_run_whose_energy_closes_and_whose_motion_is_wrong_is_called_sensitive() -> None:
    setting: dict[str, Any] = {"integrator": "rk4", "dt": 0.005, "t_end": 20.0}
    run = simulate(thrown(), **setting)
    assert error_of(thrown(), **setting) > 1.0  # m: as large as the motion
    exchanged = 2.0 * 9.80665 * np.ptp(run["position"][:, 0, 2])
    assert np.abs(run["energy_balance"]).max() < 1e-4 * exchanged
    told = step_error(thrown(), **setting)["position"]
    assert told.sensitive and told.error is None


def test_an_unstable_longer_step_is_named() -> None:
    told = step_error(stiff(), integrator="rk4", dt=0.008, t_end=2.0, quantities=["position"])["position"]
    assert told.stable_step == pytest.approx(2.828 / 200.0, rel=0.06)


SEA: dict[str, Any] = {"hs": 0.2, "tp": 9.0, "count": 40}


def by_convolution(scene: Scene) -> Scene:
    """The same vessel and springs with the retardation functions in place of the fit."""
    out, moored = cases.vessel(memory="convolution", **SEA), scene.vessels["vessel"]
    springs = {name: getattr(moored, name) for name in ("mooring_stiffness", "mooring_damping")}
    out.vessels["vessel"] = type(moored)(**out.vessels["vessel"].__getstate__() | springs)
    return out


@pytest.mark.parametrize(("memory", "nearness"), [("per-pair", 0.2), ("by-motion", 0.4)])
def test_it_is_the_difference_of_two_runs(memory: str, nearness: float) -> None:
    scene = cases.vessel(memory=memory, **SEA)
    options = {"t_end": 40.0, "dt_out": 0.25, "rtol": 1e-8, "channels": ["vessel_motion"]}
    run, truth = simulate(scene, **options), simulate(by_convolution(scene), **options)
    apart = np.abs(run["vessel_motion"] - truth["vessel_motion"]).reshape(-1, 6).max(axis=0)
    found = model_error(scene, body="vessel", times=run.time)
    largest = np.abs(found).max(axis=0)
    np.testing.assert_allclose(largest, apart, rtol=nearness, atol=3e-6)
    assert largest[2] / apart[2] == pytest.approx(1.0, abs=0.1)
    np.testing.assert_allclose(found[0], 0.0, atol=1e-12)


def test_a_run_to_an_accuracy_tells_it_beside_its_own_error() -> None:
    """Not of a convolution, which fits nothing, nor in calm water, which moves nothing."""
    scene = cases.vessel(memory="per-pair", **SEA)
    options = {"t_end": 20.0, "dt_out": 0.5}
    with pytest.warns(ModelErrorWarning, match="roll of 1e-06 was asked.*by-motion"):
        result = simulate(scene, accuracy={"roll": 1e-6}, **options)
    assert result.stats["error_estimate_roll"] <= 1e-6
    expected = np.abs(model_error(scene, body="vessel", times=result.time)[:, 3]).max()
    wide = simulate(scene, accuracy={"roll": 1e-3}, **options)
    for told in (result, wide):
        assert told.stats["model_error_roll"] == pytest.approx(expected, rel=0.02)
    with pytest.warns(ModelErrorWarning, match="memory='convol"):
        simulate(cases.vessel(memory="by-motion", **SEA), t_end=5.0, dt_out=0.5, accuracy={"roll": 1e-7})
    for scene in (cases.vessel(memory="convolution", **SEA), cases.vessel(hs=0.0)):
        silent = simulate(scene, t_end=5.0, dt_out=0.5, accuracy={"roll": 1e-3})
        assert "model_error_roll" not in silent.stats


def test_a_database_given_to_the_matrices_is_as_good_as_their_own_and_what_has_no_error_is_named() -> None:
    scene, given = cases.vessel(**SEA), {"body": "vessel", "times": np.arange(0.0, 5.0, 0.5)}
    bare = without_databases(scene)
    for one, words in (
        (bare, "no database"), (cases.vessel(hs=0.0), "waves on one vessel"),
        (cases.vessel(memory="convolution", **SEA), "no fitted memory"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            model_error(one, **given)
    bare.replace("vessel", kind="vessel", database=shipped_database())
    np.testing.assert_array_equal(model_error(bare, **given), model_error(scene, **given))
