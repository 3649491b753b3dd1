"""What the atlas found at stiff stops: methods whose error estimate is blind there do not leap through."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import Method, simulate
from seacrane.result import Result
from seacrane.trading.case import Case
from seacrane.trading.reference import Reference
from stability_atlas.axes import AXES
from stability_atlas.measure import measure, reference_of
from stability_atlas.points import POINTS
from stability_atlas.workers import Group


@pytest.fixture(scope="module", params=[1e7, 1e9, 1e11])
def stop(request: pytest.FixtureRequest) -> tuple[float, Reference]:
    """A stiffness, and the reference of a load that falls onto it."""
    return request.param, reference_of(AXES["soft-stop"].case(request.param), 5.0)


@pytest.mark.parametrize(
    "integrator",
    ["dopri5", "tsit5", "verner65", "verner76", "dop853", "cvode-bdf", "ida", "rosenbrock"],
)
def test_a_damped_stop_throws_nothing_back_higher(integrator: str, stop: tuple[float, Reference]) -> None:
    stiffness, truth = stop
    assert truth.uncertainty[POINTS.name] < 1e-8 * truth.motion[POINTS.name]
    for rtol, bound in ((1e-4, 2e-2), (1e-6, 1e-3)):
        method = Method(formulation="redundant", integrator=integrator, rtol=rtol)
        empty = Group(axis="soft-stop", value=stiffness, methods=(method,), limit_s=5.0).empty(method)
        row = measure(AXES["soft-stop"].case(stiffness), method, truth, 5.0, empty)
        assert row.verdict == "completed", row.message
        assert row.relative_error(POINTS.name) < bound


def ended(case: Case, integrator: str, **settings: Any) -> Result:
    return simulate(case.scene, t_end=case.t_end, dt_out=case.dt_out, integrator=integrator, **settings)


def test_methods_of_low_order_do_not_take_the_error_of_a_gap_for_an_impact() -> None:
    """A wire that has just gone slack: its gap grows with the cube of time, less than any error."""
    case = AXES["snatch"].case(3.0)
    expected = ended(case, "dopri5", rtol=1e-9).events
    assert len(expected) == 7
    settings: tuple[tuple[str, dict[str, float]], ...] = (
        ("cvode-bdf", {"rtol": 1e-5}),
        ("semi-implicit-euler", {"dt": 1e-3}),
    )
    for integrator, setting in settings:
        found = ended(case, integrator, **setting).events
        assert [e.kind for e in found] == [e.kind for e in expected], integrator
        assert max(abs(a.time - b.time) for a, b in zip(found, expected, strict=True)) < 5e-3


def test_rebounds_that_a_fixed_step_cannot_resolve_come_to_rest() -> None:
    case = AXES["rebound"].case(0.3)
    tight, found = ended(case, "dopri5", rtol=1e-9), ended(case, "semi-implicit-euler", dt=1e-3)
    assert tight.events[-1].kind == found.events[-1].kind == "contact"
    assert found.events[-1].time == pytest.approx(tight.events[-1].time, abs=2e-2)
    assert np.abs(found["position"][-1] - tight["position"][-1]).max() < 5e-3
