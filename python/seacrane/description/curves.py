"""Curves from samples and from sums of cosines; the curve type itself is `seacrane.Curve`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from seacrane._core import Curve
from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError

CLOSE = 1e-6  # of the root mean square of the sum: largest error of the splines
PER_PERIOD = 8  # samples of the fastest cosine that is tried first
SMALLEST_SHARE = 1e-6  # of the largest amplitude: faster cosines below it set no interval
MOST_HALVINGS = 6
MOST_PIECES = 200_000  # to bound the memory that they take: more than half a day of waves
PADDING = 16  # samples beyond both ends, where a spline is not as good
AT_ONCE = 4096  # times summed together, to bound the memory it takes


def spline_curve(*, times: Any, values: Any) -> Curve:
    """Quintic spline through samples, held at rest before the first of them and after the last.

    Parameters
    ----------
    times : array_like, shape (n,)
        s, strictly increasing, at least 6.
    values : array_like, shape (n,)
        In the unit of what the curve drives (m, rad, N or N m).

    Returns
    -------
    Curve
        With continuous derivatives up to the fourth between the samples; at the first and last of them
        its derivatives jump where the samples do not begin and end at rest.

    Raises
    ------
    SceneError
        If the samples are too few, not finite or out of order.
    """
    from scipy.interpolate import PPoly, make_interp_spline

    t, x = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
    if t.ndim != 1 or t.shape != x.shape or t.size < 6:
        raise SceneError(f"curve: times have shape {t.shape}, values {x.shape}; give at least 6 of each")
    if not (np.isfinite(t).all() and np.isfinite(x).all()) or np.any(np.diff(t) <= 0.0):
        raise SceneError("curve: times must increase and all samples be finite")
    pieces = PPoly.from_spline(make_interp_spline(t, x, k=5))
    kept = np.diff(pieces.x) > 0.0
    hold = [float(x[-1]), 0.0, 0.0, 0.0, 0.0, 0.0]
    return Curve.pieces(
        starts=[*pieces.x[:-1][kept].tolist(), float(t[-1])],
        coefficients=[*pieces.c[::-1].T[kept].tolist(), hold],
    )


def curves_of_sum(omega: Array, amplitude: Complex, *, ramp: float, duration: float) -> tuple[Curve, ...]:
    """Splines through ramp(t) Re sum amplitude exp(i omega t), one for each column.

    Quintic splines on an even grid, whose interval is halved until the largest error, measured midway between
    the samples, is 1e-6 of the sum's root mean square. Frequencies (k,) are in rad/s, amplitudes (k, n) in m
    or rad. The sum grows from rest over the ramp (s), is zero until t = 0 where there is one, and the curves
    hold their value from the duration (s) on. Raises SceneError for a duration of too many periods.
    """

    def values(times: Array) -> Array:
        return summed(omega, amplitude, times) * ramp_of(times, ramp)[:, None]

    size = np.abs(amplitude)
    scale = np.sqrt(0.5 * np.sum(size**2, axis=0))
    if not scale.any():
        return tuple(Curve.constant(value=0.0) for _ in scale)
    fastest = float(omega[np.any(size > SMALLEST_SHARE * size.max(axis=0), axis=1)].max())
    wanted = np.ceil(duration * PER_PERIOD * fastest / (2.0 * np.pi))
    if wanted > MOST_PIECES:
        raise SceneError(
            f"motion of {duration:.6g} s: takes {wanted:.3g} pieces of a curve, above {MOST_PIECES}; give a "
            "shorter duration"
        )
    count = max(int(wanted), 1)
    for _ in range(MOST_HALVINGS):
        fitted, error = _fitted(values, duration, count)
        if np.all(error <= CLOSE * scale):
            break
        count *= 2
    return fitted


def summed(omega: Array, amplitude: Complex, times: Array) -> Array:
    """Re sum amplitude exp(i omega t), shape (times, n)."""
    parts = [
        (np.exp(1j * np.outer(times[i : i + AT_ONCE], omega)) @ amplitude).real
        for i in range(0, times.size, AT_ONCE)
    ]
    return np.concatenate(parts)


def ramp_of(times: Array, ramp: float) -> Array:
    """From 0 at t = 0 to 1 at t = ramp, with four continuous derivatives; 1 at all times for a ramp of 0."""
    if ramp == 0.0:
        return np.ones_like(times)
    with np.errstate(over="ignore"):  # a ramp of next to nothing
        x = np.clip(times / ramp, 0.0, 1.0)
    return np.asarray(x**5 * (126.0 + x * (-420.0 + x * (540.0 + x * (-315.0 + 70.0 * x)))))


def _fitted(values: Callable[[Array], Array], duration: float, count: int) -> tuple[tuple[Curve, ...], Array]:
    """Splines of `count` pieces through some functions of time, and their largest errors."""
    from scipy.interpolate import make_interp_spline

    step = duration / count
    times: Array = step * np.arange(-PADDING, count + PADDING + 1, dtype=float)
    spline = make_interp_spline(times, values(times), k=5)
    midway: Array = step * (np.arange(count, dtype=float) + 0.5)
    error = np.abs(spline(midway) - values(midway)).max(axis=0)
    starts = step * np.arange(count)
    powers = [spline(starts, nu=order) / math.factorial(order) for order in range(6)]
    hold = np.zeros((1, 6, error.size))
    hold[0, 0] = spline(duration)
    coefficients = np.concatenate([np.stack(powers, axis=1), hold])
    curves = tuple(
        Curve.pieces(starts=[*starts.tolist(), duration], coefficients=coefficients[:, :, i].tolist())
        for i in range(error.size)
    )
    return curves, np.asarray(error)
