"""What a fixed step can be at most, told when a run with one has failed."""

from __future__ import annotations

from seacrane._core import integrator as integrator_of


def step_advice(integrator: str, step: float, fastest: float | None) -> str:
    """A sentence on the step of an explicit fixed-step method; empty where it is not too long.

    Parameters
    ----------
    integrator : str
    step : float
        s.
    fastest : float or None
        Largest |eigenvalue| at the start, 1/s.
    """
    limit = integrator_of(integrator).stable_up_to
    if not limit or not fastest or fastest * step <= limit:
        return ""
    return (
        f"The fastest mode at the start is {fastest:.4g} per s: {integrator} is unstable with steps longer "
        f"than about {limit / fastest:.3g} s, and took {step:.3g} s; give dt={0.5 * limit / fastest:.1g}, or "
        "an adaptive integrator"
    )
