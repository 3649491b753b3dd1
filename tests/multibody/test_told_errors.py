"""The error of a fixed step that is told, against runs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from kink_scenes import sprung
from trade_scenes import pendulum

from seacrane import Scene, cases, simulate, step_error
from seacrane.accuracy.quantities import compare


def error_of(scene: Scene, **setting: Any) -> float:
    """Largest difference of positions from a run at a tight tolerance."""
    run = simulate(scene, **setting)
    truth = simulate(scene, integrator="verner76", rtol=1e-12, t_end=setting["t_end"])
    return compare(np.asarray(truth["position"]), np.asarray(run["position"])).largest


def thrown() -> Scene:
    """Two bodies on pins that turn over: the smallest differences grow to all of the motion."""
    scene = pendulum()
    scene.add_body(name="second", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.0, 1.0))
    scene.add_joint(kind="revolute", name="p2", first="bob", second="second", point=(1, 0, 0), axis=(0, 1, 0))
    return scene


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
