"""The methods that a trade measures."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from seacrane._core import Integrator, integrators
from seacrane.run.method import Method

COARSE = (1e-1, 1e-2, 1e-3, 1e-4)
MIDDLE = (*COARSE, 1e-5, 1e-6)
FINE = (*MIDDLE, 1e-7, 1e-8, 1e-9)
STEPS_OF_ORDER_1 = (0.1, 0.05, 0.02, 0.01, 0.005)  # s
STEPS = (0.2, 0.1, 0.05, 0.025, 0.0125)  # s
STEPS_IMPLICIT = (0.1, 0.05, 0.02)  # s
TIGHT = (
    Method(formulation="recursive", integrator="dop853", rtol=1e-12),
    Method(formulation="redundant", integrator="verner76", rtol=1e-12),
    Method(formulation="recursive", integrator="verner76", rtol=1e-12),
    Method(formulation="redundant", integrator="dop853", rtol=1e-12),
)
"""The reference and its check, which differ in equations and in method, so that their difference is its
error; the last two stand in for what does not run."""
PHYSICS = Method(formulation="auto", integrator="dop853", rtol=1e-8)
"""How the physics rungs are run: an error far below what leaving physics out brings."""
LINES = tuple(Method(integrator="dopri5", rtol=tolerance) for tolerance in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6))
"""How the rungs of lines are run: they differ in cost more than in error, so that each is a line."""
FORMULATIONS = ("recursive", "redundant")


def measured_methods() -> Iterator[Method]:
    """All methods of the grid."""
    return methods(_values)


def _values(method: Integrator) -> tuple[float, ...]:
    """Tolerances or steps to try: no tighter than a method of this order, at this cost of a step, pays."""
    if method.setting == "dt":
        explicit = STEPS_OF_ORDER_1 if method.order == 1 else STEPS
        return STEPS_IMPLICIT if method.uses_jacobian else explicit
    if method.lowest_order < method.order:
        return MIDDLE
    if method.uses_jacobian:
        return COARSE
    return MIDDLE if method.order < 4 else FINE


def methods(
    values: Callable[[Integrator], Sequence[float]],
    *,
    tried: Iterable[Integrator] | None = None,
    formulations: Sequence[str] = FORMULATIONS,
    only_possible: bool = False,
) -> Iterator[Method]:
    """Every formulation, integrator, and tolerance or step.

    Parameters
    ----------
    values : callable
        Tolerances or steps (s) of an integrator.
    tried : iterable of Integrator, optional
        Default: all of the core.
    only_possible : bool
        Leave out what a formulation does not have at all: methods of the residual form solve the redundant
        equations only.
    """
    chosen = integrators() if tried is None else list(tried)
    for formulation in formulations:
        for one in chosen:
            if only_possible and formulation == "recursive" and one.residual_form:
                continue
            for value in values(one):
                yield method_of(one, value, formulation)


def method_of(integrator: Integrator, value: float, formulation: str) -> Method:
    """The method with a tolerance or a step, whichever sets the integrator's accuracy."""
    if integrator.setting == "dt":
        return Method(formulation=formulation, integrator=integrator.name, dt=value)
    return Method(formulation=formulation, integrator=integrator.name, rtol=value)
