"""What limits the numbers of a summary: a record that is short, a transient or a move inside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane.answers.curves import Curve
from seacrane.result import Result

Array = NDArray[np.float64]
ENOUGH_WAVES = 100  # peak periods: fewer tell of an extreme no more than what happened once
FIRST, LAST = 0.2, 0.5  # parts of the record that are compared
FEWEST_OUTPUTS = 20
DRIFTED = 2.0  # standard deviations of the last part, between the means
CALMED = 2.0  # times the standard deviation of the last part


def remarks_on(result: Result, time: Array, curves: Sequence[Curve]) -> list[str]:
    """One sentence each, for the part of a run from the first to the last of `time`."""
    stopped = [f"The run was interrupted: the record ends at {time[-1]:g} s."] if result.interrupted else []
    return [*stopped, *_short(result, time), *_transient(time, curves)]


def _short(result: Result, time: Array) -> list[str]:
    period, span = result.settings.get("tp"), float(time[-1] - time[0])
    if not isinstance(period, (int, float)) or not period or span >= ENOUGH_WAVES * period:
        return []
    return [
        f"Too short for statistics: {span:g} s are {span / period:.0f} peak periods. Largest and smallest "
        f"are those of these waves alone; run {ENOUGH_WAVES * period:g} s or more, or several seeds."
    ]


def _transient(time: Array, curves: Sequence[Curve]) -> list[str]:
    """The curve whose first part is most unlike its last part."""
    if time.size < FEWEST_OUTPUTS or not curves:
        return []
    excess = [_unlike(one.values) for one in curves]
    worst = int(np.argmax(excess))
    if excess[worst] <= 1.0:
        return []
    return [
        f"A starting transient or a move is inside: {curves[worst].name} does not behave in the first fifth "
        f"of {time[0]:g} to {time[-1]:g} s as in the second half. Pass start= to leave the beginning out."
    ]


def _unlike(values: Array) -> float:
    """How much a record's beginning differs from its end, over what is allowed."""
    finite = values[np.isfinite(values)]
    first, last = finite[: int(FIRST * finite.size)], finite[finite.size - int(LAST * finite.size) :]
    if not first.size or np.ptp(finite) <= 1e-9 * np.abs(finite).max():
        return 0.0
    spread = max(float(last.std()), 1e-9 * float(np.ptp(finite)))
    drift = abs(float(first.mean() - last.mean())) / (DRIFTED * spread)
    return max(drift, float(first.std()) / (CALMED * spread))
