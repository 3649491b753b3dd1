"""Order of every integrator, measured on the payload of case 2 afloat in waves with memory and control."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from seacrane import Model, Run, Scene, cases

END = 10.0  # s


@lru_cache(maxsize=1)
def case2() -> tuple[Scene, Model]:
    """Waves by exact sum: the table is smooth to its second derivative only."""
    scene = cases.case2(evaluation="exact")
    return scene, scene.compile()


def payload(**settings: Any) -> np.ndarray:
    scene, model = case2()
    run = Run(scene, t_end=END, dt_out=END, model=model, channels=["position"], **settings)
    run.advance(END)
    return run.core.channels()["position"][-1, list(scene.bodies).index("payload")]


@lru_cache(maxsize=1)
def reference() -> np.ndarray:
    return payload(rtol=1e-12)


def error(**settings: Any) -> float:
    return float(np.linalg.norm(payload(**settings) - reference()))


def test_the_reference_does_not_depend_on_the_method() -> None:
    assert error(integrator="dop853", rtol=1e-12) < 1e-11


@pytest.mark.parametrize("integrator, order", [("rk4", 4), ("dopri5", 5), ("tsit5", 5)])
def test_one_step_methods_reach_their_order(integrator: str, order: int) -> None:
    steps = (0.1, 0.05, 0.025)  # shorter ones end in the rounding of the reference, 3e-13 m
    # A tolerance that never rejects leaves the step to maximum_step.
    settings = [{"dt": h} if integrator == "rk4" else {"rtol": 0.1, "maximum_step": h} for h in steps]
    errors = [error(integrator=integrator, **setting) for setting in settings]
    observed = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    # From above: the next term of the error is still felt at these steps.
    assert order - 0.15 < observed[-1] < order + 0.7, (observed, errors)
    assert np.all(observed > order - 0.15)


@pytest.mark.parametrize("integrator", ["dopri5", "tsit5", "cvode-adams", "cvode-bdf", "ida"])
def test_the_error_follows_the_tolerance(integrator: str) -> None:
    """Two decades of tolerance bring at least one of error, and 1e-6 means 10 micrometres."""
    loose, middle, tight = (error(integrator=integrator, rtol=rtol) for rtol in (1e-4, 1e-6, 1e-8))
    assert middle < loose / 10.0
    assert tight < middle / 10.0
    assert middle < 1e-5
