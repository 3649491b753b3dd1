"""By how much a record is later than a run: where their correlation is largest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import UncertainShiftWarning

Array = NDArray[np.float64]
LEAST_OVERLAP = 0.5  # of the shorter of both
FEWEST = 8  # samples that lie side by side
LEAST_CORRELATION = 0.5
AS_GOOD = 1.1, 1e-4  # times, and plus, the variance that is left by the best shift
MOST = 4_000_000  # samples of a grid
FINENESS = 1e-4  # of a step


def correlation(first: Array, second: Array) -> float:
    """Pearson's; 0 where one of both does not vary."""
    a, b = first - first.mean(), second - second.mean()
    size = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / size if size > 0.0 else 0.0


def found_shift(time: Array, run: Array, times: Array, record: Array, most: float) -> float:
    """s by which a record (times, record) is later than a run (time, run), `most` at most.

    Pearson's correlation over what overlaps, at every step of a grid, then between the steps by the cubic
    spline through the run.

    Raises
    ------
    SceneError
        Where they do not overlap by half of the shorter within `most`, or one of both does not vary.

    Warns
    -----
    UncertainShiftWarning
    """
    step = min(float(np.median(np.diff(time))), float(np.median(np.diff(times))))
    longest = float(max(np.ptp(time), np.ptp(times)))
    if longest / step > MOST:
        raise SceneError(f"compare: {longest:.4g} s in steps of {step:.4g} s; resample the record")
    if min(run.std(), record.std()) == 0.0:
        raise SceneError("compare: one of both does not vary, which tells no shift; give maximum_shift=0")
    shifts, found = _correlations(*_grid(time, run, step), *_grid(times, record, step), step=step, most=most)
    best = int(found.argmax())
    _warn_of_doubt(shifts, found, best)
    return _between(time, run, times, record, float(shifts[best]), step)


def _grid(time: Array, values: Array, step: float) -> tuple[float, Array]:
    from scipy.interpolate import CubicSpline

    even = time[0] + step * np.arange(int(np.ptp(time) / step * (1.0 + 1e-12)) + 1)
    return float(time[0]), np.asarray(CubicSpline(time, values - values.mean())(np.minimum(even, time[-1])))


def _correlations(
    start: float, run: Array, begin: float, record: Array, *, step: float, most: float
) -> tuple[Array, Array]:
    """Shifts, s, and the correlation at each."""
    from scipy.signal import correlate

    def sums(first: Array, second: Array) -> Array:
        return np.asarray(correlate(first, second, mode="full", method="fft"))

    ones, others = np.ones_like(run), np.ones_like(record)
    shifts = begin - start + step * np.arange(1 - run.size, record.size)
    count = np.maximum(np.round(sums(others, ones)), 1.0)
    mean_record, mean_run = sums(record, ones) / count, sums(others, run) / count
    left = sums(record**2, ones) / count - mean_record**2, sums(others, run**2) / count - mean_run**2
    size = np.sqrt(np.maximum(left[0], 0.0) * np.maximum(left[1], 0.0))
    usual = 1e-9 * record.std() * run.std()
    found = (sums(record, run) / count - mean_record * mean_run) / np.maximum(size, usual)
    shorter = min(run.size, record.size)
    kept = (np.abs(shifts) <= most + 0.5 * step) & (count >= max(FEWEST, LEAST_OVERLAP * shorter))
    if not kept.any():
        raise SceneError(
            f"compare: the run begins at {start:.6g} s and the record at {begin:.6g} s, and within shifts of "
            f"{most:.4g} s they do not overlap by half of the shorter; give a larger maximum_shift, or a "
            "record whose times begin elsewhere: dataclasses.replace(record, time=record.time - ...)"
        )
    return shifts[kept], found[kept]


def _warn_of_doubt(shifts: Array, found: Array, best: int) -> None:
    top = _vertex(found, best)
    inner = np.flatnonzero((found[1:-1] >= found[:-2]) & (found[1:-1] > found[2:])) + 1
    left = AS_GOOD[0] * (1.0 - top**2) + AS_GOOD[1]
    good = [at for at in inner.tolist() if at != best and 1.0 - max(0.0, _vertex(found, at)) ** 2 <= left]
    if top < LEAST_CORRELATION:
        words = f"the correlation is {top:.3f} at best: these may not be the same curves, or of other sign"
    elif best in (0, found.size - 1) and found.size > 1:
        words = f"the correlation still grows at {shifts[best]:+.4g} s, the longest shift that was looked at"
    elif good:
        other = min(good, key=lambda at: abs(at - best))
        words = (
            f"{shifts[other]:+.4g} s is as good: correlation {_vertex(found, other):.4f} against {top:.4f}"
        )
    else:
        return
    warn_caller(
        f"compare: a shift of {shifts[best]:+.4g} s is not sure: {words}. Give maximum_shift, 0 where both "
        "have the same clock",
        UncertainShiftWarning,
    )


def _vertex(found: Array, at: int) -> float:
    """Top of the parabola through a value and its two neighbours, where it has two."""
    if not 0 < at < found.size - 1:
        return float(found[at])
    before, top, after = found[at - 1 : at + 2].tolist()
    bend = 2.0 * top - before - after
    return float(top + (after - before) ** 2 / (8.0 * bend)) if bend > 0.0 else float(top)


def _between(time: Array, run: Array, times: Array, record: Array, near: float, step: float) -> float:
    """The shift within a step of one of the grid."""
    from scipy.interpolate import CubicSpline
    from scipy.optimize import minimize_scalar

    inside = (times - near - step >= time[0]) & (times - near + step <= time[-1])
    if inside.sum() < FEWEST:
        return near
    curve, kept, values = CubicSpline(time, run), times[inside], record[inside]
    found = minimize_scalar(
        lambda shift: -correlation(curve(kept - shift), values), bounds=(near - step, near + step),
        method="bounded", options={"xatol": FINENESS * step},
    )  # fmt: skip
    return float(found.x)
