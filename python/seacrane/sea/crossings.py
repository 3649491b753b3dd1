"""How often a Gaussian process crosses a level: singly, or in clumps of a narrow band."""

from __future__ import annotations

import numpy as np


def expected_crossings(level: float, *, cycles: float, bandwidth: float | None) -> float:
    """Mean number of up-crossings of a level (standard deviations above the mean) by a Gaussian process, of
    which `cycles` cross the mean.

    `bandwidth` is Vanmarcke's, which gathers crossings into clumps; None: every crossing counts.
    """
    single = float(cycles * np.exp(-0.5 * level**2))
    if bandwidth is None or level <= 0.0:
        return single
    alone = -np.expm1(-np.sqrt(2.0 * np.pi) * bandwidth * level)
    return min(single, float(cycles * alone / np.expm1(0.5 * level**2)))


def level_crossed(count: float, *, cycles: float, bandwidth: float | None) -> float:
    """The level in standard deviations that is crossed `count` times on average; 0 where none is."""
    from scipy.optimize import brentq

    if count >= cycles:
        return 0.0
    top = float(np.sqrt(2.0 * np.log(cycles / count)))
    if bandwidth is None:
        return top

    def beyond(level: float) -> float:
        return float(np.log(expected_crossings(level, cycles=cycles, bandwidth=bandwidth) / count))

    if beyond(top) >= 0.0:  # of so few cycles none gather into clumps: the level is that of single ones
        return top
    return float(brentq(beyond, 0.0, top))
