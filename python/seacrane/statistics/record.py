"""One record: checked values, up-crossings of the mean, and the crest between each two of them."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, numbers_of

Array = NDArray[np.float64]
Places = NDArray[np.intp]
FEWEST_VALUES = 64
ROUNDING = 1e-12  # of its size by which a constant may vary


def positive(what: str, value: Any) -> float:
    """A number above zero, or a SceneError."""
    number = number_of(what, value)
    if not number > 0.0:
        raise SceneError(f"{what}={number:g}: must be above zero")
    return number


def record_of(values: Any) -> Array:
    """Values of a record that varies, or a SceneError.

    Parameters
    ----------
    values : (n,) At least 64, finite, any unit.
    """
    record = numbers_of("values", values)
    if record.ndim != 1 or record.size < FEWEST_VALUES:
        raise SceneError(
            f"values of shape {record.shape}: a record is one list of at least {FEWEST_VALUES} numbers"
        )
    if not np.isfinite(record).all():
        raise SceneError("values: not all are finite; take a part of the record without gaps")
    if np.ptp(record) <= ROUNDING * np.abs(record).max():
        raise SceneError(f"values: all are {record[0]:g}; a record that does not vary has no extremes")
    return record


def up_crossings(values: Array, level: float) -> Places:
    """Index of the last value at or below `level` before each up-crossing."""
    above = values > level
    return np.flatnonzero(~above[:-1] & above[1:])


def crests(values: Array, level: float) -> Array:
    """Largest value between each two up-crossings of `level`, by the parabola through its neighbours.

    Returns
    -------
    ndarray, shape (number of whole cycles,)
        In the order of time; as heights above `level`.
    """
    starts = up_crossings(values, level)
    if starts.size < 2:
        return np.empty(0)
    tops = np.array([a + 1 + int(np.argmax(values[a + 1 : b + 1])) for a, b in pairwise(starts.tolist())])
    return np.asarray(_vertex(values, tops) - level)


def _vertex(values: Array, tops: Places) -> Array:
    """Top of the parabola through each largest value and its two neighbours."""
    before, top, after = values[tops - 1], values[tops], values[tops + 1]
    bend = 2.0 * top - before - after
    slope = 0.5 * (after - before)
    rise = np.divide(slope**2, 2.0 * bend, out=np.zeros_like(top), where=bend > 0.0)
    return np.asarray(top + np.where(np.abs(slope) <= bend, rise, 0.0))
