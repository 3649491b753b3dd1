"""Gumbel's distribution by likelihood, and what its estimates scatter by for a number of maxima."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
DRAWS, FEWEST_DRAWS, VALUES = 4000, 500, 2_000_000  # samples that a bootstrap draws; values in all of them
BLOCK = 200_000  # values held at a time
SEED = 20250101
STEPS = 60  # of Newton's iteration, which has converged long before


def gumbel_fit(maxima: Array) -> tuple[Array, Array]:
    """Location and scale of every row by maximum likelihood.

    Parameters
    ----------
    maxima : (..., k) Rows whose values are not all equal.

    Returns
    -------
    location, scale : ndarray, shape (...)
    """
    shifted = maxima - maxima.min(axis=-1, keepdims=True)
    mean = shifted.mean(axis=-1)
    scale = shifted.std(axis=-1) * np.sqrt(6.0) / np.pi
    for _ in range(STEPS):
        weight = np.exp(-shifted / scale[..., None])
        total = weight.sum(axis=-1)
        first = (shifted * weight).sum(axis=-1) / total
        second = (shifted**2 * weight).sum(axis=-1) / total
        step = (scale - mean + first) / (1.0 + (second - first**2) / scale**2)
        scale = np.maximum(scale - step, 0.2 * scale)
        if np.all(np.abs(step) <= 1e-12 * scale):
            break
    weight = np.exp(-shifted / scale[..., None])
    return maxima.min(axis=-1) - scale * np.log(weight.mean(axis=-1)), scale


def anderson_darling(maxima: Array, location: Array, scale: Array) -> Array:
    """Anderson and Darling's distance of every row from the Gumbel distribution that was fitted to it."""
    reduced = np.sort((maxima - location[..., None]) / scale[..., None], axis=-1)
    log_below = -np.exp(-reduced)
    log_above = np.log(-np.expm1(log_below))
    odd = 2.0 * np.arange(1, maxima.shape[-1] + 1) - 1.0
    return np.asarray(-maxima.shape[-1] - (odd * (log_below + log_above[..., ::-1])).mean(axis=-1))


@lru_cache(maxsize=32)
def standard_fits(count: int) -> tuple[Array, Array, Array]:
    """Location, scale and Anderson-Darling distance fitted to samples of the standard distribution.

    Of a family of location and scale they depend on the number of values alone: what they scatter by is the
    parametric bootstrap of every fit to as many maxima.
    """
    random = np.random.Generator(np.random.Philox(SEED))
    left = min(DRAWS, max(FEWEST_DRAWS, VALUES // count))
    blocks = []
    while left > 0:
        rows = min(left, max(1, BLOCK // count))
        draws = random.gumbel(size=(rows, count))
        location, scale = gumbel_fit(draws)
        blocks.append(np.array([location, scale, anderson_darling(draws, location, scale)]))
        left -= rows
    location, scale, distance = np.concatenate(blocks, axis=1)
    fits = (location, scale, distance)
    for one in fits:
        one.setflags(write=False)
    return fits
