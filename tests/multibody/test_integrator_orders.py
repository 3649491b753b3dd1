"""Order of every integrator on constraints: the payload of a crane in the redundant formulation."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import pytest
from multibody_runs import GAINS, Array, crane_scene, record, swing_out

from seacrane import Scene, _core, integrator_names

T_END = 2.0
# By order: the longer of two steps (s) at which the error of a one-step method is neither rounding nor
# beyond its leading term, the other half of it. A pair takes it as maximum_step, with a tolerance that every
# step meets.
STEPS = {1: 1 / 256, 2: 1 / 128, 3: 1 / 32, 4: 1 / 64, 5: 1 / 32, 6: 1 / 8, 7: 1 / 12, 8: 1 / 5}
STEPS_BY_NAME = {"rosenbrock": 1 / 64, "tsit5": 1 / 16}
# Methods that choose their order, or iterate to the tolerance: bounds of the slope of the error over the
# number of steps, and the two tolerances in between which it is taken.
FREE: dict[str, tuple[float, float, tuple[float, float]]] = {
    "cvode-bdf": (4.0, 5.5, (1e-5, 1e-8)),
    "ida": (4.5, 6.5, (1e-5, 1e-8)),
}  # fmt: skip


def scene(baumgarte: float = 0.0) -> Scene:
    """The references move for longer than the run, so that they are smooth in it; the payload swings."""
    assert all(damping > 0.0 for _, damping in GAINS.values())
    out = crane_scene(payload=True, references=swing_out(10.0), s1=1.0, s2=1.0)
    out.baumgarte = baumgarte
    out.replace("payload", velocity=(0.8, 0.5, 0.0))
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


def observed(coarse: dict[str, Any], fine: dict[str, Any]) -> float:
    """Slope of the payload's error over the number of steps."""
    steps = fine["stats"]["steps"] / coarse["stats"]["steps"]
    return float(np.log(payload_error(coarse) / payload_error(fine)) / np.log(steps))


def measured_order(integrator: str) -> float:
    """Observed order; of a method that chooses its own, between the two tolerances of FREE."""

    def at(**settings: Any) -> dict[str, Any]:
        return run(integrator=integrator, formulation="redundant", **settings)

    if integrator in FREE:
        _, _, tolerances = FREE[integrator]
        return observed(*(at(rtol=rtol) for rtol in tolerances))
    method = _core.integrator(integrator)
    step = STEPS_BY_NAME.get(integrator, STEPS[method.order])
    fixed = method.setting == "dt"
    return observed(
        *(at(rtol=1e-10, dt=h) if fixed else at(rtol=0.1, maximum_step=h) for h in (step, step / 2))
    )


@pytest.mark.parametrize("integrator", integrator_names())
def test_order_on_constraints(integrator: str) -> None:
    # A lost order shows below. Above, the next term of the error is still felt from order 5 on: it is most of
    # the error of verner76, whose order seems 8.9 at the steps before rounding.
    order = _core.integrator(integrator).order
    least, most = FREE[integrator][:2] if integrator in FREE else (order - 0.25, order + 2.2)
    assert least < measured_order(integrator) < most


def test_baumgarte_stabilisation_keeps_the_order_and_the_motion() -> None:
    coarse, fine = (payload_error(run(5.0, integrator="rk4", dt=h)) for h in (1 / 32, 1 / 64))
    assert np.log2(coarse / fine) > 3.6


def test_energy_balance_falls_at_the_methods_order() -> None:
    steps = [1 / 16, 1 / 32, 1 / 64]
    defects = [abs(float(run(integrator="rk4", dt=h)["energy_balance"][-1])) for h in steps]
    assert np.all(np.diff(np.log2(defects)) < -3.5), defects
    default = run(rtol=1e-6)
    assert abs(default["energy_balance"][-1]) < 1e-6 * float(default["absolute_work"][-1])
