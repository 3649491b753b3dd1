"""The numerical settings that an atlas runs: formulation, integrator, and tolerance or step."""

from __future__ import annotations

from collections.abc import Iterator

from seacrane import _core
from seacrane.run.method import Method

FORMULATIONS = ("recursive", "redundant")
STEPS = (0.02, 0.005)  # s
TOLERANCES = (1e-3, 1e-6)
LOOSE = (1e-3,)  # of a method of low order

DEFAULT = Method(formulation="auto", integrator="dopri5")

QUICK = (
    DEFAULT,
    Method(formulation="recursive", integrator="tsit5", rtol=1e-3),
    Method(formulation="redundant", integrator="dop853", rtol=1e-9),
    Method(formulation="redundant", integrator="rk4", dt=0.02),
    Method(formulation="recursive", integrator="semi-implicit-euler", dt=0.005),
    Method(formulation="redundant", integrator="cvode-bdf", rtol=1e-6),
)


def every() -> Iterator[Method]:
    """The default, then each formulation, integrator, and tolerance or step.

    What a formulation does not have at all is left out: methods of the residual form solve the redundant
    equations only.
    """
    yield DEFAULT
    for formulation in FORMULATIONS:
        for method in _core.integrators():
            if formulation == "recursive" and method.residual_form:
                continue
            tolerances = TOLERANCES if method.order > 3 else LOOSE
            for value in STEPS if method.setting == "dt" else tolerances:
                yield Method(formulation=formulation, integrator=method.name, **{method.setting: value})
