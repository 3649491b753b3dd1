"""The grid of equal steps that frequencies lie on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
OFF_GRID = 1e-9  # of a step: a phase of 6e-9 rad at the end of the period
FINEST = 8  # parts of the smallest distance between frequencies that a step may be
LARGEST_NUMBER = 2**18  # of a component on the grid: a week of waves, 100 MB of knots


def grid_of(omega: Array) -> tuple[float, NDArray[np.int64]]:
    """The widest step of which all frequencies are multiples, and the multiples.

    Parameters
    ----------
    omega : (n,) rad/s, positive.

    Returns
    -------
    step : float
        rad/s; the sea repeats after 2 pi / step.
    number : ndarray of int, shape (n,)

    Raises ValueError if the frequencies are on no such grid.
    """
    distinct = np.unique(omega)
    distance = np.diff(distinct)
    # Frequencies that differ by rounding only are one.
    distance = distance[distance > 1e-9 * distinct[-1]]
    widest = float(distance.min()) if distance.size else float(distinct[0])
    for parts in range(1, FINEST + 1):
        step = widest / parts
        number = np.rint(omega / step)
        if number.max() > LARGEST_NUMBER or number.min() < 1.0:
            continue
        # The least-squares step removes the rounding of the smallest distance.
        step = float(number @ omega / (number @ number))
        if np.abs(omega / step - number).max() < OFF_GRID:
            return step, number.astype(np.int64)
    raise ValueError(
        "evaluation 'fft' needs frequencies that are multiples of one step; realise the sea with "
        "placement='uniform', or choose evaluation='table'"
    )
