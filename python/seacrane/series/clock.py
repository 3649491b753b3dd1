"""The times of a measured series: that they increase, what is missing, drift, and what a clock counts in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError

Array = NDArray[np.float64]
BROKEN = 1.5  # steps: more between two samples is a gap, or a jump of the clock
AROUND = 4  # samples before and after a break that tell which
WINDOWS = 200  # elsewhere in the record that tell how well a cubic fits
WORSE = 9.0  # times their median: the square of three times
RATE = 0.05  # by which samples may be off the nominal rate before one of both is wrong
POSIX = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
FIRST, LAST = 1.5e8, 7.0e9  # s since 1970: from 1974 to 2191
FORMS = {8: "%Y%m%d", 10: "%Y%m%d%H", 12: "%Y%m%d%H%M", 14: "%Y%m%d%H%M%S"}


@dataclass(frozen=True, kw_only=True)
class Break:
    """More than a step and a half between the samples `at` and `at` + 1; s of it, and what it looks like."""

    at: int
    length: float
    jump: bool


def step_of(time: Array) -> float:
    """The sampling interval, s: the mean of all steps that are not broken."""
    steps = np.diff(time)
    return float(steps[steps <= BROKEN * np.median(steps)].mean())


def breaks_of(time: Array, values: Array) -> Iterator[Break]:
    """Each gap and each jump forward, in order; `values` (n, columns).

    Where the values go on as if one sample had passed, in every column, the clock has jumped.
    """
    step = step_of(time)
    places = np.flatnonzero(np.diff(time) > BROKEN * step)
    for at in places.tolist():
        length = float(time[at + 1] - time[at])
        yield Break(at=at, length=length, jump=_goes_on(values, at))


def _goes_on(values: Array, at: int) -> bool:
    """Whether a cubic over evenly spaced samples fits across a break as well as it does elsewhere."""
    starts = np.arange(values.shape[0] - 2 * AROUND + 1)
    here = at + 1 - AROUND
    if here < 0 or here > starts[-1:].max(initial=-1):
        return False
    others = starts[:: max(1, starts.size // WINDOWS)]
    windows = np.stack([values[start : start + 2 * AROUND] for start in (here, *others.tolist())])
    place = np.linspace(-1.0, 1.0, 2 * AROUND)
    basis, _ = np.linalg.qr(np.vander(place, 4))
    rest = windows - np.einsum("ij,kj,wkc->wic", basis, basis, windows)
    squares = np.square(rest).sum(axis=1)  # (windows, columns)
    size = np.square(values - values.mean(axis=0)).mean(axis=0)
    usual = np.median(squares[1:], axis=0) + 1e-12 * size
    return bool(np.any(size > 0.0) and np.all(squares[0] <= WORSE * usual))


def drift_of(time: Array, other: Array) -> float:
    """By how much of a second a clock gains on another in a second: the slope of a line, less 1."""
    centred = other - other.mean()
    return float(centred @ (time - time.mean() - centred) / (centred @ centred))


def counted(time: Array, interval: float) -> Array:
    """The times that samples would have by their number, s, with those that are missing counted."""
    steps = np.maximum(1.0, np.round(np.diff(time) / step_of(time)))
    return np.asarray(np.concatenate([[0.0], np.cumsum(steps)]) * interval)


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
