"""What makes a statistic less than it looks: each a warning with a name."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.caller import warn_caller
from seacrane.warnings import RepeatingSeaWarning, StartTransientWarning

Array = NDArray[np.float64]
PARTS = 20  # of a record, of which the first fifth is compared with the rest
CYCLES = 5.0  # that a part must hold at least
UNLIKELY = 0.002  # probability, for each of mean and variance, of a warning without cause
CLEAR_MEAN, CLEAR_SPREAD = 0.25, 0.1  # of the standard deviation: smaller changes are let pass


def start_differs(values: Array, cycles: float) -> bool | None:
    """Whether the first fifth differs from the rest in mean or standard deviation, beyond chance.

    Parameters
    ----------
    values : (n,)
    cycles : Of the record, in number.

    Returns
    -------
    bool or None
        None where the record is too short to tell: fewer than 50 cycles.
    """
    parts = PARTS if cycles >= CYCLES * PARTS else PARTS // 2
    if cycles < CYCLES * parts:
        return None
    rows = values[: values.size - values.size % parts].reshape(parts, -1)
    spread = float(values[values.size // 5 :].std()) or 1.0
    mean, variance = rows.mean(axis=1) / spread, rows.var(axis=1) / spread**2
    return _stands_out(mean, CLEAR_MEAN) or _stands_out(variance, 2.0 * CLEAR_SPREAD)


def _stands_out(numbers: Array, clear: float) -> bool:
    """Whether the first fifth differs from the rest by more than the rest's own scatter explains."""
    from scipy.stats import t

    first, rest = numbers[: numbers.size // 5], numbers[numbers.size // 5 :]
    difference = abs(float(first.mean() - rest.mean()))
    scatter = float(rest.std(ddof=1)) * np.sqrt(1.0 / first.size + 1.0 / rest.size)
    return bool(difference > clear and difference > scatter * t.ppf(1.0 - UNLIKELY / 2.0, rest.size - 1))


def warn_of_start(values: Array, cycles: float) -> None:
    """Warn with StartTransientWarning."""
    if start_differs(values, cycles):
        warn_caller(
            "the first fifth of the record differs from the rest in mean or standard deviation: leave the "
            "start out, with start= in s",
            StartTransientWarning,
        )


def warn_of_repeat(repeat: float | None, duration: float) -> None:
    """Warn with RepeatingSeaWarning if a sea comes back on itself within a record."""
    if repeat is not None and repeat < duration:
        warn_caller(
            f"the sea repeats after {repeat:g} s within a record of {duration:g} s: its maxima are those of "
            f"{repeat:g} s; take more components, or placement='jittered'",
            RepeatingSeaWarning,
        )
