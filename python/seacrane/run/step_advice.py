"""What a fixed step can be at most, told when a run with one has failed."""

from __future__ import annotations

# |eigenvalue| times step up to which an oscillation does not grow: rk4 sqrt(8), the others likewise along the
# imaginary axis, semi-implicit Euler exactly 2.
STABLE_UP_TO = {
    "semi-implicit-euler": 2.0,
    "rk4": 2.8,
    "rk4-exact-memory": 2.8,
    "rk-low-storage": 3.3,
}


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
    limit = STABLE_UP_TO.get(integrator)
    if limit is None or not fastest or fastest * step <= limit:
        return ""
    return (
        f"The fastest mode at the start is {fastest:.4g} per s: {integrator} is unstable with steps longer "
        f"than about {limit / fastest:.3g} s, and took {step:.3g} s; give dt={0.5 * limit / fastest:.1g}, or "
        "an adaptive integrator"
    )
