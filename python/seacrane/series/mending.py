"""What is done to a measured series: outliers found, gaps filled, an even grid, a low-pass filter."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import vector_of
from seacrane.series.clock import step_of

Array = NDArray[np.float64]
Places = NDArray[np.intp]
WINDOW = 1.0  # s around a sample whose median it is compared with
FEWEST = 5  # samples in it
AROUND = 20.0  # s around it whose spread counts, where it is larger than that of the whole: a decay
FAR = 5.0  # times the distance within which 95 % of all samples are
SHARE = 0.5  # of the standard deviation, by the median, that an outlier is away at least
ORDER = 4  # of the Butterworth filter, which runs in both directions
EVEN = 1e-3  # of a step by which times may be uneven
LARGEST = 10_000_000  # samples of a grid
ALIASED = 0.01  # of the variance that may be faster than a coarser grid can hold


def outliers(time: Array, values: Array) -> Places:
    """Places of single samples, or a few in a row, that are far from the median of those around them."""
    from scipy.ndimage import median_filter

    size = max(FEWEST, 2 * round(0.5 * WINDOW / step_of(time)) + 1)
    away = np.abs(values - median_filter(values, size=size, mode="nearest"))
    level = np.abs(values - np.median(values))
    whole = 1.4826 * float(np.median(level)) or float(values.std())
    wide = 2 * round(0.5 * AROUND / step_of(time)) + 1
    spread = np.maximum(whole, 1.4826 * median_filter(level, size=wide, mode="nearest"))
    limit = np.maximum(FAR * float(np.quantile(away, 0.95)), SHARE * spread)
    return np.flatnonzero((away > limit) & (limit > 0.0))


def filled(time: Array, values: Array, missing: NDArray[np.bool_]) -> Array:
    """Values with the missing ones taken from the cubic spline through the others."""
    from scipy.interpolate import CubicSpline

    if not missing.any():
        return values
    known = ~missing
    return np.asarray(np.where(missing, CubicSpline(time[known], values[known])(time), values))


def interpolated(time: Any, values: Any) -> Array:
    """Values with the masked ones, and those that are NaN, taken from the cubic spline through the others.

    Parameters
    ----------
    time : array_like, shape (n,)
        Increasing.
    values : array_like or masked array, shape (n,)
        Any unit.

    Returns
    -------
    ndarray, shape (n,)

    Raises
    ------
    SceneError
        Where fewer than four are known, or the first or last is not: nothing is taken beyond what is known.
    """
    data = np.ma.asarray(values)
    known = ~np.ma.getmaskarray(data) & np.isfinite(np.ma.getdata(data).astype(float))
    stamps = np.array(vector_of("interpolated: time", time))
    if data.shape != stamps.shape:
        raise SceneError(f"interpolated: values has shape {data.shape}, time {stamps.shape}; give as many")
    if known.sum() < 4 or not (known[0] and known[-1]):
        raise SceneError(
            f"interpolated: {int(known.sum())} of {known.size} values are known"
            f"{'' if known.sum() < 4 else ', and the first or the last is not'}; cut the ends off"
        )
    return filled(stamps, np.ma.getdata(data).astype(float), ~known)


def is_even(time: Array) -> bool:
    """Whether all steps are those of an even grid."""
    step = float(time[-1] - time[0]) / (time.size - 1)
    grid = time[0] + step * np.arange(time.size)
    return bool(np.abs(time - grid).max() <= EVEN * step)


def on_grid(
    what: str, time: Array, values: Array, step: float, *, most: int = LARGEST
) -> tuple[Array, Array]:
    """Times every `step` (s) from the first on, `most` at most, and the cubic splines (n, columns) there.

    Raises
    ------
    SceneError
        For more samples than fit, or where a coarser grid would take fast motion for slow.
    """
    from scipy.interpolate import CubicSpline

    count = np.floor((time[-1] - time[0]) / step * (1.0 + 1e-12)) + 1.0
    if not 2.0 <= count <= most:
        raise SceneError(
            f"{what}: an interval of {step:.6g} s makes {count:.4g} samples of {time[-1] - time[0]:.6g} s; "
            f"2 to {most} are allowed: give another interval, or cut the record at its gaps"
        )
    grid = np.minimum(time[0] + step * np.arange(int(count)), time[-1])
    return grid, np.asarray(CubicSpline(time, values)(grid))


def share_above(values: Array, step: float, frequency: float) -> float:
    """Largest share of a column's variance above a frequency, Hz; `values` (n, columns) on an even grid."""
    trend = np.linspace(0.0, 1.0, values.shape[0])[:, None]
    still = values - values[:1] - trend * (values[-1:] - values[:1])
    power = np.abs(np.fft.rfft(still - still.mean(axis=0), axis=0)) ** 2
    fast = power[np.fft.rfftfreq(values.shape[0], step) > frequency].sum(axis=0)
    return float((fast / np.maximum(power.sum(axis=0), np.finfo(float).tiny)).max(initial=0.0))


def low_passed(values: Array, step: float, frequency: float) -> Array:
    """Butterworth of fourth order in both directions, no lag. Amplitudes are taken times
    1 / (1 + (tan(pi f step) / tan(pi frequency step))^8).

    values (n, columns) on an even grid. Beyond its ends the record is continued by its mirror image turned
    about the end point, over three periods of `frequency`.
    """
    from scipy.signal import butter, sosfiltfilt

    sections = butter(ORDER, frequency, fs=1.0 / step, output="sos")
    beyond = min(values.shape[0] - 1, int(np.ceil(3.0 / (frequency * step))))
    return np.asarray(sosfiltfilt(sections, values, axis=0, padlen=beyond))
