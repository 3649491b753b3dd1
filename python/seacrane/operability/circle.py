"""Values over directions, between those of a table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LARGEST_GAP = 90.0  # degrees between two directions that are taken as neighbours
ROUNDING = 1e-9  # degrees


def over_circle(directions: Array, values: Array, asked: Array) -> Array:
    """Values at directions, linear between neighbours.

    Parameters
    ----------
    directions : ndarray, shape (k,)
        Ascending, over less than a circle, degrees.
    values : ndarray, shape (k, ...)
        One for each direction and each of `asked`.
    asked : ndarray, shape (...)
        Degrees; 370 is 10.

    Returns
    -------
    ndarray, shape (...)
        NaN in gaps of more than a right angle.
    """
    first = directions[0]
    turned = first + (asked - first) % 360.0
    turned = np.where(turned > first + 360.0 - ROUNDING, first, turned)
    closed = np.append(directions, first + 360.0)
    below = np.clip(np.searchsorted(closed, turned, side="right") - 1, 0, directions.size - 1)
    width = closed[below + 1] - closed[below]
    share = (turned - closed[below]) / width
    lower, upper = (
        np.take_along_axis(values, (places % directions.size)[None], axis=0)[0]
        for places in (below, below + 1)
    )
    mixed = np.where(share <= ROUNDING, lower, (1.0 - share) * lower + share * upper)
    return np.asarray(np.where((width <= LARGEST_GAP + ROUNDING) | (share <= ROUNDING), mixed, np.nan))
