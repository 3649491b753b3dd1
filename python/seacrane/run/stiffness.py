"""A run that an explicit method makes slow because one mode is far faster than all that is recorded."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from seacrane._core import integrator as integrator_of
from seacrane.analysis.linearise import LARGEST
from seacrane.description.loads import any_stiff, lines_of, whole_of
from seacrane.run.modes import Modes
from seacrane.validity.after_run import Finding
from seacrane.warnings import StiffWarning

MANY_STEPS = 10_000  # fewer are no matter
STATES_SQUARED_PER_STEP = 5.0  # so many steps cost ten times the eigenvalues of so many states
NEAR_THE_LIMIT = 1.0  # |eigenvalue| times step; explicit methods stay stable up to 2 to 6
SETTLES = 3.0  # |eigenvalue| times settling time: a quasi-static stretch is slower than the mode
UNSEEN = 20.0  # |eigenvalue| times output interval: three periods between two outputs


def fewest_steps(states: int, least: int = MANY_STEPS) -> int:
    """The steps of a run that is worth the eigenvalues of so many states."""
    return max(least, int(states**2 / STATES_SQUARED_PER_STEP))


def stiffness(
    loads: Mapping[str, Any],
    modes: Modes,
    stats: Mapping[str, Any],
    settings: Mapping[str, Any],
    *,
    near: float = 1.0,
) -> list[Finding]:
    """The mode that sets the steps of a slow run, looked for only where there are many steps.

    Parameters
    ----------
    loads : mapping
        Of the scene, by name.
    modes : Modes
        The fastest of them counts.
    stats, settings : mapping
        Of the run: `Result.stats`, `Result.settings`.
    near : float
        Share of the limits from which on it is told.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    method = integrator_of(integrator)
    adjusts = method.setting == "rtol" and not method.uses_jacobian
    states = modes.model.states
    if not adjusts or steps < fewest_steps(states) or states > LARGEST:
        return []
    step = float(stats["simulated_s"]) / steps
    mode, body, at = modes.fastest.mode, modes.fastest.body, modes.fastest.time
    shown = mode * float(settings["dt_out"]) < near * UNSEEN
    if mode * step < near * NEAR_THE_LIMIT or shown:
        return []
    return [
        (
            StiffWarning,
            f"run: {integrator} took {steps} steps of {step:.2g} s on average, about the longest with which "
            f"it is stable: the fastest mode, {mode:.4g} per s at t = {at:.6g} s, moves body {body!r} most, "
            "far faster than the outputs show. Soften the gain, spring or stop that holds that body, or take "
            f"integrator={_instead(loads, integrator)}, whose steps it does not limit"
            + _taut_lines(loads, body, mode),
        )
    ]


def _instead(loads: Mapping[str, Any], integrator: str) -> str:
    """What takes longer steps."""
    stiff = any_stiff(loads) and integrator != "dopri5-stiff"
    return "'dopri5-stiff', 'rosenbrock' or 'cvode-bdf'" if stiff else "'rosenbrock' or 'cvode-bdf'"


def _taut_lines(loads: Mapping[str, Any], body: str, mode: float) -> str:
    """The rung that takes the mode, where it may be that of an elastic line on the body."""
    fast = {
        whole_of(name, line)
        for name, line in lines_of(loads).items()
        if line.rung == "elastic" and body in line.bodies and mode * line.settling > SETTLES
    }
    names = [repr(name) for name in sorted(fast)]
    if not names:
        return ""
    return (
        f". If it is the stretch of line {' or '.join(names)} and the line stays taut, give it "
        "rung='quasi-static': with an explicit method it then costs what a soft line does. For motion of "
        f"omega rad/s the tension errs by less than (omega / {mode:.4g})^2 of what omega makes of it"
    )
