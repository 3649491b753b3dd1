"""What the atlas found at stiff stops: methods whose error estimate is blind there do not leap through."""

from __future__ import annotations

import pytest

from seacrane.extremes.axes import AXES
from seacrane.extremes.measure import Reference, measure, reference
from seacrane.extremes.methods import Method
from seacrane.extremes.workers import Group


@pytest.fixture(scope="module", params=[1e7, 1e9, 1e11])
def stop(request: pytest.FixtureRequest) -> tuple[float, Reference]:
    """A stiffness, and the reference of a load that falls onto it."""
    return request.param, reference(AXES["soft-stop"].case(request.param), 5.0)


@pytest.mark.parametrize(
    "integrator", ["heun21", "dopri5", "tsit5", "verner65", "verner76", "dop853", "cvode-bdf", "ida"]
)
def test_a_damped_stop_throws_nothing_back_higher(integrator: str, stop: tuple[float, Reference]) -> None:
    stiffness, truth = stop
    assert truth.uncertainty < 1e-8
    for rtol, bound in ((1e-4, 2e-2), (1e-6, 1e-3)):
        method = Method(formulation="redundant", integrator=integrator, rtol=rtol)
        empty = Group(axis="soft-stop", value=stiffness, methods=(method,), limit_s=5.0).empty(method)
        row = measure(AXES["soft-stop"].case(stiffness), method, truth, 5.0, empty)
        assert row.verdict == "completed", row.message
        assert row.error < bound
