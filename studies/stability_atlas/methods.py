"""The methods that an atlas runs: formulation, integrator, and tolerance or step."""

from __future__ import annotations

from collections.abc import Iterator

from seacrane import Method
from seacrane._core import Integrator, integrators
from seacrane.accuracy.methods import methods

STEPS = (0.02, 0.005)  # s
TOLERANCES = (1e-3, 1e-6)
LOOSE = (1e-3,)  # of a method of low order

DEFAULT = Method()

QUICK = (
    DEFAULT,
    Method(formulation="recursive", integrator="tsit5", rtol=1e-3),
    Method(formulation="redundant", integrator="dop853", rtol=1e-9),
    Method(formulation="redundant", integrator="rk4", dt=0.02),
    Method(formulation="recursive", integrator="semi-implicit-euler", dt=0.005),
    Method(formulation="redundant", integrator="cvode-bdf", rtol=1e-6),
)

TIGHT = (
    Method(formulation="redundant", integrator="verner76", rtol=1e-11),
    Method(formulation="recursive", integrator="dop853", rtol=1e-11),
    Method(formulation="redundant", integrator="dop853", rtol=1e-9),
    Method(formulation="recursive", integrator="verner76", rtol=1e-9),
)
"""Of the references; they differ in equations and in method."""


def every() -> Iterator[Method]:
    """The default, then each formulation, integrator, and tolerance or step that exists."""
    yield DEFAULT
    redundant = {one.name for one in integrators() if one.residual_form}  # which solve no other equations
    for method in methods(_values):
        if method.formulation != "recursive" or method.integrator not in redundant:
            yield method


def _values(method: Integrator) -> tuple[float, ...]:
    if method.setting == "dt":
        return STEPS
    return TOLERANCES if method.order > 3 else LOOSE
