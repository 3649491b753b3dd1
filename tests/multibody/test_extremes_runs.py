"""What the atlas found: far from the origin of time, at large heel, over a day."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import simulate
from seacrane.accuracy.case import Case
from seacrane.result import Result
from stability_atlas.axes import AXES
from stability_atlas.points import KnownCase


def ended(case: Case, integrator: str, **settings: Any) -> Result:
    return simulate(case.scene, t_end=case.t_end, dt_out=case.dt_out, integrator=integrator, **settings)


def test_methods_of_low_order_do_not_take_the_error_of_a_gap_for_an_impact() -> None:
    """A wire that has just gone slack: its gap grows with the cube of time, less than any error."""
    case = AXES["snatch"].case(3.0)
    expected = ended(case, "dopri5", rtol=1e-9).events
    assert len(expected) == 7
    for integrator, setting in (("cvode-bdf", {"rtol": 1e-5}), ("semi-implicit-euler", {"dt": 1e-3})):
        found = ended(case, integrator, **setting).events
        assert [e.kind for e in found] == [e.kind for e in expected], integrator
        assert max(abs(a.time - b.time) for a, b in zip(found, expected, strict=True)) < 5e-3


def test_rebounds_that_a_fixed_step_cannot_resolve_come_to_rest() -> None:
    case = AXES["rebound"].case(0.3)
    tight, found = ended(case, "dopri5", rtol=1e-9), ended(case, "semi-implicit-euler", dt=1e-3)
    assert tight.events[-1].kind == found.events[-1].kind == "contact"
    assert found.events[-1].time == pytest.approx(tight.events[-1].time, abs=2e-2)
    assert np.abs(found["position"][-1] - tight["position"][-1]).max() < 5e-3


def test_a_heeled_vessel_loses_energy_and_never_gains_any() -> None:
    for degrees in (20.0, 89.0, 120.0):
        scene = AXES["heel"].case(degrees).scene
        result = simulate(scene, t_end=120.0, dt_out=0.5, channels=["quaternion"])
        w, x = result["quaternion"][:, 0, 0], result["quaternion"][:, 0, 1]
        heel = np.degrees(2.0 * np.arctan2(x, w))
        assert np.max(np.abs(heel)) <= degrees * (1.0 + 1e-9)
        assert np.max(np.abs(heel[-40:])) < 0.9 * degrees


@pytest.mark.parametrize("integrator", ["cvode-bdf", "ida", "dop853"])
def test_methods_start_30_years_from_zero(integrator: str) -> None:
    """Solvers of SUNDIALS begin with steps of few roundings of the time there, and may."""
    case = AXES["time-origin"].case(1e9)
    run = simulate(case.scene, t_end=case.t_end, dt_out=case.dt_out, start=case.start, integrator=integrator,
                   channels=["position"])  # fmt: skip
    assert isinstance(case, KnownCase)
    points = case.truth.reshape(run.time.size, -1, 4, 3)  # the first of each body is its centre
    np.testing.assert_allclose(run["position"], points[:, :, 0], atol=1e-4)
