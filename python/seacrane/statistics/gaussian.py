"""The maximum of a Gaussian process by its up-crossings, singly or in clumps."""

from __future__ import annotations

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.statistics.estimate import P90_COUNT, Estimate, Maximum
from seacrane.statistics.record import positive

THREE_HOURS = 10800.0  # s


def expected_crossings(level: float, *, cycles: float, bandwidth: float | None) -> float:
    """Mean number of up-crossings of a level, or of clumps of them, by a Gaussian process.

    Parameters
    ----------
    level : In standard deviations above the mean.
    cycles : Mean number of up-crossings of the mean.
    bandwidth : Vanmarcke's, which gathers crossings into clumps; None: every crossing counts.
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

    return float(brentq(beyond, 0.0, top))


def gaussian_maximum(
    *,
    std: float,
    rate: float,
    exposure: float = THREE_HOURS,
    mean: float = 0.0,
    bandwidth: float | None = None,
) -> Maximum:
    """Estimate the largest value of a Gaussian process in an exposure time, by its up-crossings.

    Parameters
    ----------
    std, mean : float
        Standard deviation and mean, any unit.
    rate : float
        Up-crossings of the mean, 1/s.
    exposure : float
        s; default 3 h.
    bandwidth : float, optional
        Vanmarcke's sqrt(1 - m1^2 / (m0 m2)), which lets neighbouring crests of a narrow-band process count as
        one. By default they count as independent: the usual sqrt(2 ln N), which is too high there.

    Returns
    -------
    Maximum
        Without intervals. Its `mpm` is the level crossed once on average.

    Raises
    ------
    SceneError
        For a number out of range.
    """
    spread, cycles = positive("std", std), positive("rate", rate) * positive("exposure", exposure)
    centre = number_of("mean", mean)
    width = None if bandwidth is None else positive("bandwidth", bandwidth)
    if width is not None and width > 1.0:
        raise SceneError(f"bandwidth={width:g}: is at most 1")

    def level(count: float) -> float:
        return centre + spread * level_crossed(count, cycles=cycles, bandwidth=width)

    return Maximum(
        mpm=Estimate(value=level(1.0)),
        mean=Estimate(value=centre + spread * _mean_level(cycles, width)),
        p90=Estimate(value=level(P90_COUNT)),
        exposure=float(exposure),
    )


def _mean_level(cycles: float, bandwidth: float | None) -> float:
    """Integral over levels of the probability that one is crossed at all."""
    from scipy.integrate import quad

    def crossed(level: float) -> float:
        return float(-np.expm1(-expected_crossings(level, cycles=cycles, bandwidth=bandwidth)))

    top = float(np.sqrt(2.0 * np.log(max(cycles, 1.0)))) + 4.0
    return float(quad(crossed, 0.0, top, limit=200)[0])
