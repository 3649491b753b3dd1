"""step_error(): the error of a fixed step, told only where the order of the method shows."""

from __future__ import annotations

import numpy as np
import pytest
from trade_scenes import pendulum

from seacrane import Result, Scene, SceneError, cases, simulate, step_error
from seacrane.accuracy.quantities import compare

METHODS = {"semi-implicit-euler": 1e-3, "rk4": 5e-3, "rk-low-storage": 0.01, "generalized-alpha": 4e-3}


def error_of(result: Result, reference: Result) -> float:
    return compare(np.asarray(reference["position"]), np.asarray(result["position"])).largest


@pytest.mark.parametrize("integrator", METHODS)
def test_the_error_told_is_the_error(integrator: str) -> None:
    scene, dt = pendulum(), METHODS[integrator]
    told = step_error(scene, integrator=integrator, dt=dt, t_end=6.0)["position"]
    run = simulate(scene, integrator=integrator, dt=dt, t_end=6.0)
    truth = simulate(scene, integrator="verner76", rtol=1e-12, t_end=6.0)
    assert told.error is not None and not told.sensitive
    assert 0.5 < told.error / error_of(run, truth) < 2.0
    assert told.order == pytest.approx(told.method_order, abs=0.7)


def thrown() -> Scene:
    """Two bodies on pins that turn over: the smallest differences grow to all of the motion."""
    scene = pendulum()
    scene.add_body(name="second", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.0, 1.0))
    scene.add_joint(kind="revolute", name="p2", first="bob", second="second", point=(1, 0, 0), axis=(0, 1, 0))
    return scene


def test_a_run_whose_energy_closes_and_whose_motion_is_wrong_is_called_sensitive() -> None:
    scene, setting = thrown(), {"integrator": "rk4", "dt": 0.005, "t_end": 20.0}
    run = simulate(scene, **setting)  # type: ignore[arg-type]
    truth = simulate(scene, integrator="verner76", rtol=1e-12, t_end=20.0)
    exchanged = 2.0 * 9.80665 * np.ptp(np.asarray(truth["position"])[:, 0, 2])
    assert error_of(run, truth) > 1.0  # m: as large as the motion
    assert np.abs(run["energy_balance"]).max() < 1e-4 * exchanged
    told = step_error(scene, **setting)["position"]  # type: ignore[arg-type]
    assert told.sensitive and told.error is None
    assert str(told).startswith("sensitive")


def test_the_same_motion_has_its_error_told_before_it_has_grown() -> None:
    scene = thrown()
    told = step_error(scene, integrator="rk4", dt=1e-3, t_end=1.0)["position"]
    truth = simulate(scene, integrator="verner76", rtol=1e-12, t_end=1.0)
    run = simulate(scene, integrator="rk4", dt=1e-3, t_end=1.0)
    assert told.error is not None
    assert 0.5 < told.error / error_of(run, truth) < 2.0


def test_a_motion_without_error_says_so() -> None:
    scene = Scene(name="fall")
    scene.add_body(name="stone", mass=1.0, inertia=(0.1, 0.1, 0.1))
    told = step_error(scene, integrator="rk4", dt=0.1, t_end=2.0, quantities=["position"])["position"]
    assert told.error is not None and told.error < 1e-9


def stiff(stiffness: float = 4e4) -> Scene:
    """A mass on a spring, 200 rad/s: "rk4" is stable up to 2.83/200 s."""
    scene = Scene(name="stiff", gravity=0.0)
    scene.add_body(name="bob", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0.0, 0.0, -1.01))
    scene.add_spring(name="spring", first="ground", second="bob", stiffness=stiffness, natural_length=1.0)
    return scene


def test_an_unstable_longer_step_is_named_and_the_error_told_by_shorter_ones() -> None:
    scene, setting = stiff(), {"integrator": "rk4", "dt": 0.008, "t_end": 2.0}
    told = step_error(scene, **setting, quantities=["position"])["position"]  # type: ignore[arg-type]
    assert told.stable_step == pytest.approx(2.828 / 200.0, rel=0.06)
    assert "unstable" in str(told)
    finer = step_error(scene, **setting | {"dt": 5e-4}, quantities=["position"])["position"]  # type: ignore[arg-type]
    run = simulate(scene, **setting | {"dt": 5e-4})  # type: ignore[arg-type]
    truth = simulate(scene, integrator="verner76", rtol=1e-12, t_end=2.0)
    assert finer.stable_step is None and finer.error is not None
    assert 0.5 < finer.error / error_of(run, truth) < 2.0


def test_case_2_tells_the_error_of_its_own_step() -> None:
    scene = cases.case2()
    told = step_error(scene, integrator="rk4", dt=0.025, t_end=20.0, quantities=["position"])["position"]
    run = simulate(scene, integrator="rk4", dt=0.025, t_end=20.0)
    truth = simulate(scene, integrator="verner76", rtol=1e-11, t_end=20.0)
    assert told.error is not None
    assert 0.4 < told.error / error_of(run, truth) < 2.5


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"integrator": "dopri5", "dt": 0.1}, "'dopri5' chooses its own steps"),
        ({"integrator": "rk4", "dt": 0.0}, "dt is 0.0 s"),
        ({"integrator": "rk4", "dt": float("nan")}, "dt is nan s"),
        ({"integrator": "rk4", "dt": 0.1, "quantities": ["roll"]}, "'roll' is unknown"),
    ],
)
def test_what_cannot_be_told_is_refused(given: dict[str, object], says: str) -> None:
    with pytest.raises(SceneError, match=says):
        step_error(pendulum(), t_end=1.0, **given)  # type: ignore[arg-type]
