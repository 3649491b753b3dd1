"""A long run with an oscillation of little damping that each step of an explicit method makes larger."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linearise import LARGEST, jacobian
from seacrane.run.stiffness import fewest_steps
from seacrane.validity.range import Finding

HOUR = 3600.0  # s
LEAST_GROWTH = np.log(2.0)  # of the amplitude over the run
MOST_DAMPING = 0.05  # ratio: what is damped more, waves and drives keep in bounds


class GrowingModeWarning(UserWarning):
    """The method made an oscillation with little damping grow over a long run."""


@dataclass(frozen=True, kw_only=True)
class _Growth:
    """What a method adds to a mode: rates of the amplitude, 1/s."""

    rate: float
    frequency: float
    damping_ratio: float
    body: str


def growing(
    model: _core.Model, bodies: list[str], states: list[_core.State], stats: Mapping[str, Any]
) -> list[Finding]:
    """The mode that a method feeds, looked for only where there are many steps.

    A step h of y' = lambda y multiplies y by R(h lambda). Where log|R| exceeds the decay of the mode, its
    amplitude grows by that much in each step, though the solution's does not.

    Parameters
    ----------
    model : Model
    bodies : list of str
        Their names, in the order of the model.
    states : list of State
        Where to look, with speeds of zero; a mode counts that grows at all of them.
    stats : mapping
        Of the run: `Result.stats`.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    polynomial = _core.stability_polynomial(integrator)
    if not polynomial or steps < fewest_steps(model.states) or model.states > LARGEST:
        return []
    duration = float(stats["simulated_s"])
    step = duration / steps
    found = [_fastest_growth(model, bodies, state, Polynomial(polynomial), step) for state in states]
    worst = min(found, key=lambda one: one.rate)
    if worst.rate * duration < LEAST_GROWTH:
        return []
    setting = "rtol" if _core.integrator(integrator).setting == "rtol" else "dt"
    return [
        (
            GrowingModeWarning,
            f"run: {integrator} makes an oscillation of body {worst.body!r} grow by a factor of "
            f"{np.exp(min(worst.rate * HOUR, 99.0)):.3g} an hour: a mode of {worst.frequency:.4g} rad/s with "
            f"{worst.damping_ratio:.2g} of critical damping, which its steps of {step:.3g} s on average "
            "outweigh. energy_balance hardly shows it, standard deviations do. Give a smaller "
            f"{setting}, take another integrator ('verner65' or 'dop853' damp up to longer steps), or give "
            "the mode damping",
        )
    ]


def _fastest_growth(
    model: _core.Model, bodies: list[str], state: _core.State, polynomial: Polynomial, step: float
) -> _Growth:
    """The mode that a method with this stability polynomial makes grow fastest, at rest in a pose."""
    first = (6 if model.euler_angles else 7) * len(bodies)
    speeds = slice(first, first + 6 * len(bodies))
    values = np.array(state.values)
    values[speeds] = 0.0
    matrix = jacobian(model, state=values, time=state.time)
    none = _Growth(rate=-np.inf, frequency=0.0, damping_ratio=0.0, body="")
    if not bodies or not np.all(np.isfinite(matrix)):
        return none
    modes, shapes = np.linalg.eig(matrix)
    little = (modes.imag > 0.0) & (np.abs(modes.real) < MOST_DAMPING * np.abs(modes))
    if not np.any(little):
        return none
    modes, shapes = modes[little], shapes[:, little]
    rates = added(polynomial, modes, step) + np.minimum(modes.real, 0.0)
    worst = int(rates.argmax())
    scale = np.array(model.scale)
    sizes = (np.abs(shapes[:, worst]) / scale[np.isfinite(scale)])[speeds]
    return _Growth(
        rate=float(rates[worst]),
        frequency=float(modes[worst].imag),
        damping_ratio=float(-modes[worst].real / np.abs(modes[worst])),
        body=bodies[int(sizes.argmax()) // 6],
    )


def added(polynomial: Polynomial, modes: NDArray[np.complex128], step: float) -> NDArray[np.float64]:
    """Rates (1/s) by which steps change amplitudes beyond what the modes do by themselves."""
    z = step * modes
    return np.asarray(np.log(np.abs(polynomial(z))) - z.real) / step
