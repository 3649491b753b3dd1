"""Classic mechanisms against published or independent solutions: both formulations, several integrators.

Limits are a few times what was measured. tests/reference_problems/README.md tells what each problem is and
where its solution comes from.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from reference_problems import four_bars
from reference_problems.problems import MECHANISMS, run, squeezer

LIMITS: dict[str, list[tuple[dict[str, Any], float]]] = {
    "pendulum": [({"rtol": 1e-10}, 2e-9), ({"integrator": "cvode-bdf", "rtol": 1e-8}, 2e-5)],
    "four-bars": [({"rtol": 1e-8}, 1e-6)],
    # Every loop could fold in each of ten flat positions; joints hold each motion once, up to there.
    "four-bars spatial": [({"loops": 4, "rtol": 1e-8}, 2e-6)],
    "squeezer": [
        ({"integrator": "verner76", "rtol": 1e-8}, 1e-11),
        # Tolerances are absolute, 1e-13 of 1,000 rad/s below what evaluations and projections resolve.
        ({"integrator": "dop853", "rtol": 1e-13}, 1e-11),
        ({"integrator": "cvode-bdf", "rtol": 1e-8}, 1e-7),
        ({"integrator": "rk4", "dt": 1e-5}, 1e-9),
        # Ten hinges: nine rows of fifty are more than needed.
        ({"planar": True, "integrator": "dop853", "rtol": 1e-6}, 1e-8),
    ],
    "bricard": [({"integrator": "dop853", "rtol": 1e-9}, 1e-9)],
    "governor": [({"integrator": "cvode-bdf", "rtol": 1e-7}, 1e-6), ({"rtol": 1e-6}, 1e-9)],
    "top": [
        ({"integrator": "dop853", "rtol": 1e-9}, 2e-8),
        # 1.2e-6 m from a second-order method's, 4e-9 m from the elliptic integrals.
        ({"published": True, "integrator": "dop853", "rtol": 1e-9}, 2e-6),
    ],
    "nut": [({"integrator": "verner65", "rtol": 1e-10}, 1e-7)],
    "crank": [({"rtol": 1e-10}, 1e-8), ({"integrator": "rosenbrock", "rtol": 1e-6}, 1e-4)],
}
CASES = [(name, settings, limit) for name, rows in LIMITS.items() for settings, limit in rows]


@pytest.mark.parametrize(
    ("name", "settings", "limit"), CASES, ids=[f"{n}-{s.get('integrator', 'dopri5')}" for n, s, _ in CASES]
)
def test_problem(name: str, settings: dict[str, Any], limit: float, formulation: str) -> None:
    found = MECHANISMS[name](formulation=formulation, **settings)
    assert 0.0 < found.difference < limit, found


def test_the_published_squeezer_is_right_to_nine_digits() -> None:
    """Two solutions without anything in common agree to 3e-12 rad, both 1.4e-9 rad from the published one."""
    assert 1e-9 < squeezer(integrator="verner76", rtol=1e-8, published=True).difference < 2e-9


@pytest.mark.parametrize(
    ("loops", "formulation"),
    [(60, "redundant"), pytest.param(40, "recursive", marks=pytest.mark.slow("forty loops"))],
)
@pytest.mark.filterwarnings("ignore:.*are redundant")
def test_many_loops_of_redundant_joints_move_as_one_pendulum(loops: int, formulation: str) -> None:
    """Sixty have 905 rows, of which 180 are left out; in the recursive form 200 rows of loops of forty are to
    be told apart."""
    result = run(four_bars.scene(loops), 0.3, 0.1, {"rtol": 1e-8, "formulation": formulation}, "position")
    angle, _ = four_bars.turned(loops, result.time)
    posts = result["position"][:, : loops + 1, 0] - np.arange(loops + 1.0)
    np.testing.assert_allclose(posts, np.outer(0.5 * np.sin(angle), np.ones(loops + 1)), atol=1e-7)
