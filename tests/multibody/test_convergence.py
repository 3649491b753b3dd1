"""Orders of all integrators, measured on the payload of a crane that swings on a fixed base."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from multibody_runs import GAINS, Array, crane_scene, record, swing_out

from seacrane import Scene

T_END = 2.0


def scene(baumgarte: float = 0.0) -> Scene:
    """The references move for longer than the run, so that they are smooth in it; the payload swings."""
    assert all(damping > 0.0 for _, damping in GAINS.values())
    out = crane_scene(payload=True, references=swing_out(10.0), s1=1.0, s2=1.0)
    out.baumgarte = baumgarte
    payload = out.bodies["payload"]
    out.bodies = {name: body for name, body in out.bodies.items() if name != "payload"}
    out.add_body(
        name="payload", mass=payload.mass, inertia=payload.inertia, position=payload.position,
        velocity=(0.8, 0.5, 0.0)
    )  # fmt: skip
    return out


def run(baumgarte: float = 0.0, **settings: Any) -> dict[str, Any]:
    return record(scene(baumgarte), T_END, dt_out=T_END, **settings)


@lru_cache(maxsize=1)
def exact() -> Array:
    fine = run(integrator="dopri5", rtol=1e-12)["position"][-1, -1]
    other = run(integrator="rk4", dt=1.0 / 1024.0)["position"][-1, -1]
    assert np.linalg.norm(fine - other) < 1e-10  # two methods, one answer
    return np.asarray(fine)


def payload_error(out: dict[str, Any]) -> float:
    return float(np.linalg.norm(out["position"][-1, -1] - exact()))


def slopes(steps: list[float], errors: list[float]) -> Array:
    return np.asarray(np.diff(np.log(errors)) / np.diff(np.log(steps)))


def test_rk4_has_order_four_on_the_payload() -> None:
    steps = [1 / 32, 1 / 64, 1 / 128]
    order = slopes(steps, [payload_error(run(integrator="rk4", dt=h)) for h in steps])
    assert np.all((order > 3.6) & (order < 4.6)), order


def test_dopri5_has_order_five_on_the_payload() -> None:
    steps = [1 / 16, 1 / 32, 1 / 64]
    # A tolerance that every step meets leaves maximum_step as the step.
    runs = [run(integrator="dopri5", rtol=0.1, maximum_step=h, formulation="redundant") for h in steps]
    for h, out in zip(steps, runs, strict=True):
        assert T_END / h <= out["stats"]["steps"] <= T_END / h + 4
    errors = [payload_error(out) for out in runs]
    order = slopes(steps, errors)
    assert np.all((order > 4.6) & (order < 6.4)), order


@pytest.mark.parametrize("integrator", ["dopri5", "cvode-adams", "cvode-bdf", "ida"])
def test_error_falls_with_the_tolerance(integrator: str) -> None:
    errors = [payload_error(run(integrator=integrator, rtol=rtol)) for rtol in (1e-4, 1e-6, 1e-8)]
    # Error per unit time follows the tolerance to a power between p / (p + 1) and 1: a hundredth of the
    # tolerance leaves less than a fifth of the error with any order from 1 on.
    assert errors[1] < 0.2 * errors[0], errors
    assert errors[2] < 0.2 * errors[1], errors
    assert errors[2] < 1e-5, errors


def test_baumgarte_stabilisation_keeps_the_order_and_the_motion() -> None:
    steps = [1 / 32, 1 / 64]
    errors = [payload_error(run(5.0, integrator="rk4", dt=h)) for h in steps]
    assert slopes(steps, errors)[0] > 3.6
    adams = run(5.0, integrator="cvode-adams", rtol=1e-9)
    assert payload_error(adams) < 1e-6
    # Recorded states are projected whatever stabilises the steps; the drift before that is bounded.
    assert adams["constraint_error"].max() < 1e-9
    assert adams["constraint_error_before_projection"].max() < 1e-6


def test_energy_balance_falls_at_the_methods_order() -> None:
    steps = [1 / 16, 1 / 32, 1 / 64]
    defects = [abs(float(run(integrator="rk4", dt=h)["energy_balance"][-1])) for h in steps]
    order = slopes(steps, defects)
    assert np.all(order > 3.5), (order, defects)
    coarse, default, fine = (run(rtol=rtol) for rtol in (1e-4, 1e-6, 1e-8))
    work = float(default["absolute_work"][-1])
    assert abs(default["energy_balance"][-1]) < 1e-6 * work
    assert abs(default["energy_balance"][-1]) < 0.2 * abs(coarse["energy_balance"][-1])
    assert abs(fine["energy_balance"][-1]) < 0.2 * abs(default["energy_balance"][-1])
