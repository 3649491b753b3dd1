"""A long run with an oscillation of little damping that each step of an explicit method makes larger."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from seacrane import _core
from seacrane.analysis.linearise import LARGEST
from seacrane.run.modes import Modes, Oscillations
from seacrane.run.stiffness import fewest_steps
from seacrane.validity.after_run import Finding
from seacrane.warnings import GrowingModeWarning

HOUR = 3600.0  # s
FEWEST_STEPS = 2000  # fewer are no matter
LEAST_GROWTH = math.log(3.0)  # of the amplitude over the run
LOOSE = 1e-3  # rtol from which on step control lets a mode ring as much as matters
LEAST_SEEN = 0.1  # frequency times step: below, growth is rounding
ROUNDING = 1e-16  # of a scale: the least amplitude from which a mode grows
TINY = 1e-300  # in place of a factor of zero
LONGER = 1.15  # steps that step control tries now and then, over their mean
FIX = (
    "energy_balance hardly shows it, standard deviations do. Give a smaller {setting}, take another "
    "integrator ('verner65' or 'dop853' damp up to longer steps), or give the mode damping"
)


@dataclass(frozen=True, kw_only=True)
class _Growth:
    """What steps make of the amplitudes of oscillations: rates in 1/s, and whether longer steps feed them."""

    at: Oscillations
    rates: list[float]
    rings: list[bool]

    def fastest(self, most: float) -> float:
        """The fastest of the rates (1/s) that a run can have had."""
        return max((rate for rate in self.rates if rate <= most), default=-math.inf)

    def words(self, one: int) -> str:
        value = complex(self.at.values[one])
        damping = abs(max(-value.real / abs(value), 0.0))
        return f"a mode of {value.imag:.4g} rad/s with {damping:.2g} of critical damping"


def growing(
    modes: Modes,
    stats: Mapping[str, Any],
    settings: Mapping[str, Any],
    *,
    undamped: Collection[str] = (),
    near: float = 1.0,
) -> list[Finding]:
    """The mode that a method feeds, looked for only where there are many steps.

    A step h of y' = lambda y multiplies y by R(h lambda). Where log|R| exceeds the decay of the mode, its
    amplitude grows by that much in each step, though the solution's does not; step control ends that only
    where the amplitude has come to its tolerance. What would have grown from rounding beyond the tolerance
    has come there: it rings.

    Parameters
    ----------
    modes : At rest in the poses of the states; the mode counts that grows most.
    stats, settings : Of the run: `Result.stats`, `Result.settings`.
    undamped : collection of str
        Bodies whose damping the linear model lacks, whose modes are not judged.
    near : Share of the limits, and of what damps the modes, from which on it is told.
    """
    integrator, steps = str(stats["integrator"]), int(stats["steps"])
    polynomial = _core.stability_polynomial(integrator)
    states = modes.model.states
    if not polynomial or steps < fewest_steps(states, FEWEST_STEPS) or states > LARGEST:
        return []
    duration = float(stats["simulated_s"])
    step, tolerance = duration / steps, float(settings["rtol"])
    judged = [_judged(at, polynomial, step, near, undamped) for at in modes.oscillations]
    adapts = _core.integrator(integrator).setting == "rtol"
    fix = FIX.format(setting="rtol" if adapts else "dt")
    most = math.log(tolerance / ROUNDING) / duration if adapts else math.inf
    worst = max(judged, key=lambda one: one.fastest(most))
    fastest = worst.fastest(most)
    if fastest * duration >= near * LEAST_GROWTH:
        one = worst.rates.index(fastest)
        factor = math.exp(min(fastest * HOUR, 99.0))
        text = (
            f"run: {integrator} makes an oscillation of body {worst.at.bodies[one]!r} grow by a factor of "
            f"{factor:.3g} an hour: {worst.words(one)}, which its steps of {step:.3g} s on average outweigh. "
            f"{fix}"
        )
        return [(GrowingModeWarning, text)]
    ringing = next((one for one in judged if any(one.rings)), None)
    if ringing is not None and adapts and tolerance >= LOOSE:
        one = ringing.rings.index(True)
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
    rates, rings = [], []
    for mode, body in zip(at.values.tolist(), at.bodies, strict=True):
        own, judged = near * min(mode.real, 0.0), body not in undamped
        fed = added(polynomial, mode, step)
        longer = added(polynomial, mode, LONGER * step) if judged and fed > 0.0 else -math.inf
        rates.append(fed + own if judged else -math.inf)
        rings.append(longer + own > 0.0 and abs(mode) * step > LEAST_SEEN)
    return _Growth(at=at, rates=rates, rings=rings)


def added(polynomial: Sequence[float], mode: complex, step: float) -> float:
    """Rate (1/s) by which steps change an amplitude beyond what the mode does by itself."""
    z, factor = step * mode, 0j
    for coefficient in reversed(polynomial):
        factor = factor * z + coefficient
    return (math.log(abs(factor) or TINY) - z.real) / step
