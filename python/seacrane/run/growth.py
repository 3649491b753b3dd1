"""A long run with an oscillation of little damping that each step of an explicit method makes larger."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linearise import LARGEST
from seacrane.run.modes import Modes, Oscillations
from seacrane.run.stiffness import fewest_steps
from seacrane.validity.range import Finding

Array = NDArray[np.float64]
HOUR = 3600.0  # s
FEWEST_STEPS = 2000  # fewer are no matter
LEAST_GROWTH = np.log(3.0)  # of the amplitude over the run
LOOSE = 1e-3  # rtol from which on step control lets a mode ring as much as matters
LEAST_SEEN = 0.1  # frequency times step: below, growth is rounding
LONGER = 1.15  # steps that step control tries now and then, over their mean
FIX = (
    "energy_balance hardly shows it, standard deviations do. Give a smaller {setting}, take another "
    "integrator ('verner65' or 'dop853' damp up to longer steps), or give the mode damping"
)


class GrowingModeWarning(UserWarning):
    """The method made an oscillation with little damping grow over a long run, or kept it ringing."""


@dataclass(frozen=True, kw_only=True)
class _Growth:
    """What steps make of the amplitudes of oscillations: rates in 1/s, and whether longer steps feed them."""

    at: Oscillations
    rates: Array
    rings: NDArray[np.bool_]

    def words(self, one: int) -> str:
        value = self.at.values[one]
        damping = abs(max(float(-value.real / np.abs(value)), 0.0))
        return f"a mode of {float(value.imag):.4g} rad/s with {damping:.2g} of critical damping"


def growing(
    modes: Modes, stats: Mapping[str, Any], *, undamped: Collection[str] = (), near: float = 1.0
) -> list[Finding]:
    """The mode that a method feeds, looked for only where there are many steps.

    A step h of y' = lambda y multiplies y by R(h lambda). Where log|R| exceeds the decay of the mode, its
    amplitude grows by that much in each step, though the solution's does not; step control ends that only
    where the amplitude has come to its tolerance.

    Parameters
    ----------
    modes : Modes
        At rest in the poses of the states; the mode counts that grows most.
    stats : mapping
        Of the run: `Result.stats`.
    undamped : collection of str
        Bodies whose damping the linear model lacks, whose modes are not judged.
    near : float
        Share of the limits, and of what damps the modes, from which on it is told.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    polynomial = _core.stability_polynomial(integrator)
    states = modes.model.states
    if not polynomial or steps < fewest_steps(states, FEWEST_STEPS) or states > LARGEST:
        return []
    duration = float(stats["simulated_s"])
    step, tolerance = duration / steps, float(stats["settings"]["rtol"])
    judged = [_judged(at, polynomial, step, near, undamped) for at in modes.oscillations]
    adapts = _core.integrator(integrator).setting == "rtol"
    fix = FIX.format(setting="rtol" if adapts else "dt")
    worst = max((one for one in judged if one.rates.size), key=lambda one: one.rates.max(), default=None)
    if worst is not None and worst.rates.max() * duration >= near * LEAST_GROWTH:
        one = int(worst.rates.argmax())
        factor = np.exp(min(float(worst.rates[one]) * HOUR, 99.0))
        text = (
            f"run: {integrator} makes an oscillation of body {worst.at.bodies[one]!r} grow by a factor of "
            f"{factor:.3g} an hour: {worst.words(one)}, which its steps of {step:.3g} s on average outweigh. "
            f"{fix}"
        )
        return [(GrowingModeWarning, text)]
    ringing = next((one for one in judged if one.rings.any()), None)
    if ringing is not None and adapts and tolerance >= LOOSE:
        one = int(ringing.rings.argmax())
        text = (
            f"run: {integrator} at rtol {tolerance:g} keeps an oscillation of body "
            f"{ringing.at.bodies[one]!r} ringing: {ringing.words(one)}, which grows with steps a little "
            f"longer than those of {step:.3g} s on average, until it comes to the tolerance. {fix}"
        )
        return [(GrowingModeWarning, text)]
    return []


def _judged(
    at: Oscillations, polynomial: Sequence[float], step: float, near: float, undamped: Collection[str]
) -> _Growth:
    """What steps of a method with this stability polynomial make of them."""
    modes = at.values
    own = near * np.minimum(modes.real, 0.0)
    fed = added(polynomial, modes, step)
    judged = np.array([body not in undamped for body in at.bodies], dtype=bool)
    rings = (fed > 0.0) & (np.abs(modes) * step > LEAST_SEEN) & judged
    rings[rings] = added(polynomial, modes[rings], LONGER * step) + own[rings] > 0.0
    return _Growth(at=at, rates=np.where(judged, fed + own, -np.inf), rings=rings)


def added(polynomial: Sequence[float], modes: NDArray[np.complex128], step: float) -> Array:
    """Rates (1/s) by which steps change amplitudes beyond what the modes do by themselves."""
    z = step * modes
    factor = np.zeros_like(z)
    for coefficient in reversed(polynomial):
        factor = factor * z + coefficient
    return np.asarray(np.log(np.abs(factor)) - z.real) / step
