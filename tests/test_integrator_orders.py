"""Order of every integrator on constraints: the payload of a crane in the redundant formulation."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from test_convergence import payload_error, run
from test_convergence_case2 import error as error_afloat

from seacrane import integrator_names

# Order, and the longer of two steps (s), the other half of it; a pair takes it as max_step, with a tolerance
# that every step meets.
FIXED: dict[str, tuple[float, float]] = {
    "semi-implicit-euler": (1, 1 / 256),
    "generalized-alpha": (2, 1 / 128),
    "generalized-alpha-index2": (2, 1 / 128),
    "ark-mri": (3, 1 / 64),
    "rk4": (4, 1 / 64),
    "rk-low-storage": (4, 1 / 64),
}
PAIRS: dict[str, tuple[float, float]] = {
    "heun21": (2, 1 / 64),
    "bs32": (3, 1 / 32),
    "rosenbrock": (3, 1 / 64),
    "rk43": (4, 1 / 32),
    "dopri5": (5, 1 / 32),
    "tsit5": (5, 1 / 16),
    "ark-erk": (5, 1 / 32),
    "verner65": (6, 1 / 8),
    "verner76": (7, 1 / 12),
    "dop853": (8, 1 / 5),
}
# Methods that choose their order, or iterate to the tolerance: bounds of the slope of the error over the
# number of steps, and the two tolerances in between which it is taken.
FREE: dict[str, tuple[float, float, tuple[float, float]]] = {
    "ark-dirk": (3.6, 5.0, (1e-5, 1e-7)),
    "ark-imex": (3.6, 5.0, (1e-5, 1e-7)),
    "cvode-adams": (5.5, 8.0, (1e-5, 1e-9)),
    "cvode-bdf": (4.0, 5.5, (1e-5, 1e-8)),
    "ida": (4.5, 6.5, (1e-5, 1e-8)),
}
# Order, and the longer step (s), of a method that wants fluid: the payload of case 2 afloat.
AFLOAT = {"rk4-exact-memory": (4, 0.05)}


def observed(coarse: dict[str, Any], fine: dict[str, Any]) -> float:
    """Slope of the payload's error over the number of steps."""
    steps = fine["stats"]["steps"] / coarse["stats"]["steps"]
    return float(np.log(payload_error(coarse) / payload_error(fine)) / np.log(steps))


@pytest.mark.parametrize("integrator", [*FIXED, *PAIRS, *FREE, *AFLOAT])
def test_order_on_constraints(integrator: str) -> None:
    def at(**settings: Any) -> dict[str, Any]:
        return run(integrator=integrator, formulation="redundant", **settings)

    if integrator in FREE:
        least, most, tolerances = FREE[integrator]
        order = observed(*(at(rtol=rtol) for rtol in tolerances))
    elif integrator in AFLOAT:
        stated, step = AFLOAT[integrator]
        least, most = stated - 0.25, stated + 0.7
        errors = [error_afloat(integrator=integrator, dt=h) for h in (step, step / 2)]
        order = float(np.log2(errors[0] / errors[1]))
    else:
        stated, step = (FIXED | PAIRS)[integrator]
        # A lost order shows below. Above, the next term of the error is still felt from order 5 on: it is
        # most of the error of verner76, whose order seems 8.9 at the steps before rounding.
        least, most = stated - 0.25, stated + 2.2
        fixed = integrator in FIXED
        order = observed(
            *(at(rtol=1e-10, dt=h) if fixed else at(rtol=0.1, max_step=h) for h in (step, step / 2))
        )
    assert least < order < most, order


def test_no_integrator_is_left_out() -> None:
    assert sorted([*FIXED, *PAIRS, *FREE, *AFLOAT]) == sorted(integrator_names())
