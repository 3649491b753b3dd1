"""A long run with an oscillation of little damping that each step of an explicit method makes larger."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linearise import LARGEST
from seacrane.run.modes import Modes, Oscillations
from seacrane.run.stiffness import fewest_steps
from seacrane.validity.range import Finding

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
    """What steps make of a mode's amplitude: rates in 1/s, at the mean step and at longer ones."""

    rate: float
    rings: bool
    frequency: float
    damping_ratio: float
    body: str

    @property
    def words(self) -> str:
        damping = abs(max(self.damping_ratio, 0.0))
        return f"a mode of {self.frequency:.4g} rad/s with {damping:.2g} of critical damping"


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
    judged = [_judged(at, Polynomial(polynomial), step, near, undamped) for at in modes.oscillations]
    every = [one for found in judged for one in found]
    adapts = _core.integrator(integrator).setting == "rtol"
    fix = FIX.format(setting="rtol" if adapts else "dt")
    worst = max(every, key=lambda one: one.rate, default=None)
    if worst is not None and worst.rate * duration >= near * LEAST_GROWTH:
        text = (
            f"run: {integrator} makes an oscillation of body {worst.body!r} grow by a factor of "
            f"{np.exp(min(worst.rate * HOUR, 99.0)):.3g} an hour: {worst.words}, which its steps of "
            f"{step:.3g} s on average outweigh. {fix}"
        )
        return [(GrowingModeWarning, text)]
    ringing = next((one for one in every if one.rings), None)
    if ringing is not None and adapts and tolerance >= LOOSE:
        text = (
            f"run: {integrator} at rtol {tolerance:g} keeps an oscillation of body {ringing.body!r} ringing: "
            f"{ringing.words}, which grows with steps a little longer than those of {step:.3g} s on average, "
            f"until it comes to the tolerance. {fix}"
        )
        return [(GrowingModeWarning, text)]
    return []


def _judged(
    at: Oscillations, polynomial: Polynomial, step: float, near: float, undamped: Collection[str]
) -> list[_Growth]:
    """What steps of a method with this stability polynomial make of them."""
    modes = at.values
    own = near * np.minimum(modes.real, 0.0)
    fed, longer = added(polynomial, modes, step), added(polynomial, modes, LONGER * step)
    found = [
        _Growth(
            rate=float(fed[i] + own[i]),
            rings=bool(fed[i] > 0.0 and longer[i] + own[i] > 0.0 and abs(modes[i]) * step > LEAST_SEEN),
            frequency=float(modes[i].imag),
            damping_ratio=float(-modes[i].real / np.abs(modes[i])),
            body=at.bodies[i],
        )
        for i in range(modes.size)
    ]
    return [one for one in found if one.body not in undamped]


def added(polynomial: Polynomial, modes: NDArray[np.complex128], step: float) -> NDArray[np.float64]:
    """Rates (1/s) by which steps change amplitudes beyond what the modes do by themselves."""
    z = step * modes
    return np.asarray(np.log(np.abs(polynomial(z))) - z.real) / step
