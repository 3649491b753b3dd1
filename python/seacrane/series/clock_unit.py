"""What a clock counts in that does not say so, by the size and the step of its numbers."""

from __future__ import annotations

from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError

Array = NDArray[np.float64]
POSIX = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
FIRST, LAST = 1.5e8, 7.0e9  # s since 1970: from 1974 to 2191
FORMS = {8: "%Y%m%d", 10: "%Y%m%d%H", 12: "%Y%m%d%H%M", 14: "%Y%m%d%H%M%S"}


def unit_since_1970(times: Array) -> str | None:
    """ "s", "ms", "us" or "ns" of numbers that count from 1970; None: they do not."""
    known = np.abs(times[np.isfinite(times)])
    if not known.size:
        return None
    ends = np.array([known.min(), known.max()])
    inside = (unit for unit, one in POSIX.items() if np.all((ends * one >= FIRST) & (ends * one <= LAST)))
    return next(inside, None)


def dates_of_numbers(what: str, numbers: Array) -> NDArray[np.datetime64]:
    """Dates of whole numbers: time since 1970, or digits such as 2020013112.

    Raises SceneError: neither, so that nothing tells what they count.
    """
    values = np.asarray(numbers, dtype=float)
    if values.size and np.all(np.isfinite(values)):
        digits, unit = _of_digits(values), unit_since_1970(values)
        if digits is not None:
            return digits
        if unit is not None:
            return np.round(values * POSIX[unit]).astype("datetime64[s]")
    first = f"{values[0]:.10g}" if values.size else "nothing"
    raise SceneError(
        f"{what} begins with {first}, a number that does not say what it counts from; give dates, such as "
        "2020-01-31T12:00, or seconds since 1970"
    )


def _of_digits(values: Array) -> NDArray[np.datetime64] | None:
    """Dates of numbers whose digits are year (of 1900 to 2099), month, day and so on; None: they are not."""
    texts = [f"{value:.0f}" for value in values]
    form = FORMS.get(len(texts[0]))
    if form is None or np.any(values != np.round(values)) or {text[:2] for text in texts} - {"19", "20"}:
        return None
    try:
        return np.array([datetime.strptime(text, form) for text in texts], dtype="datetime64[s]")
    except ValueError:
        return None
