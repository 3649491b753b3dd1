"""Methods to try: formulations, integrators, tolerances or steps."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from seacrane._core import Integrator, integrators
from seacrane.run.method import Method

FORMULATIONS = ("recursive", "redundant")


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
    formulations : sequence of str
    only_possible : bool
        Leave out what a formulation does not have at all: methods of the residual form solve the redundant
        equations only.
    """
    chosen = integrators() if tried is None else list(tried)
    for formulation in formulations:
        for integrator in chosen:
            if only_possible and formulation == "recursive" and integrator.residual_form:
                continue
            for value in values(integrator):
                yield method_of(integrator, value, formulation)


def method_of(integrator: Integrator, value: float, formulation: str) -> Method:
    """The method with a tolerance or a step, whichever sets the integrator's accuracy."""
    if integrator.setting == "dt":
        return Method(formulation=formulation, integrator=integrator.name, dt=value)
    return Method(formulation=formulation, integrator=integrator.name, rtol=value)
