"""Gusting wind as a curve of time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.description.curves import spline_curve
from seacrane.inputs.checked import positive_of

Array = NDArray[np.float64]
SLOWEST, FASTEST = 1.0 / 600.0, 0.5  # Hz: the spectrum is one of an hour's wind, fitted from 1/600 Hz on
FREQUENCY_STREAM, PHASE_STREAM = 2**32, 2**32 + 1  # of Philox; a sea counts its own up from 0


def npd_spectrum(frequency: ArrayLike, *, mean_speed: float, height: float = 10.0) -> Array:
    """Spectral density of the wind speed after the Norwegian Petroleum Directorate (ISO 19901-1, A.7).

    S(f) = 320 (U / 10)^2 (z / 10)^0.45 / (1 + g^n)^(5 / (3 n)), g = 172 f (z / 10)^(2/3) (U / 10)^(-3/4),
    n = 0.468.

    Parameters
    ----------
    frequency : Hz.
    mean_speed : U, one-hour mean at 10 m, m/s.
    height : z, m.

    Returns
    -------
    ndarray
        m2/s2/Hz, of the shape of `frequency`.
    """
    f, u, z = np.asarray(frequency, dtype=float), mean_speed / 10.0, height / 10.0
    scaled = 172.0 * f * z ** (2.0 / 3.0) * u**-0.75
    return np.asarray(320.0 * u**2 * z**0.45 / (1.0 + scaled**0.468) ** (5.0 / (3.0 * 0.468)))


def gust_curve(
    *, mean_speed: float, duration: float, height: float = 10.0, seed: int = 1, count: int = 200
) -> _core.Curve:
    """Wind speed over time: the mean and a realisation of the NPD spectrum from 1/600 to 0.5 Hz.

    Parameters
    ----------
    mean_speed : float
        One-hour mean at 10 m height, m/s; at other heights z it is multiplied by
        1 + 0.0573 sqrt(1 + 0.15 U) ln(z / 10).
    duration : float
        s; the curve holds its last speed afterwards.
    height : float
        m.
    seed, count : int
        Of phases and frequencies (one in each of `count` bins of equal ratio), by Philox as for waves, in
        streams of their own: wind and waves of one seed have nothing in common.

    Returns
    -------
    Curve
        m/s, through samples every 0.25 s.

    Raises
    ------
    SceneError
        For values that are not positive.
    """
    given = {"mean_speed": mean_speed, "duration": duration, "height": height, "count": count}
    for key, value in given.items():
        positive_of(f"gust: {key}", value)
    edges = np.geomspace(SLOWEST, FASTEST, count + 1)
    jitter, phase = (
        np.array([_core.philox_uniform(seed=seed, stream=stream, index=i) for i in range(count)])
        for stream in (FREQUENCY_STREAM, PHASE_STREAM)
    )
    frequency = edges[:-1] + jitter * np.diff(edges)
    density = npd_spectrum(frequency, mean_speed=mean_speed, height=height)
    amplitude = np.sqrt(2.0 * density * np.diff(edges))
    times = np.linspace(0.0, duration, max(6, int(np.ceil(4.0 * duration)) + 1))
    local = mean_speed * (1.0 + 0.0573 * np.sqrt(1.0 + 0.15 * mean_speed) * np.log(height / 10.0))
    speed = np.full(times.shape, local)
    for a, f, e in zip(amplitude, frequency, phase, strict=True):
        speed += a * np.cos(2.0 * np.pi * (f * times + e))
    return spline_curve(times=times, values=speed).then(
        time=duration, curve=_core.Curve.constant(value=float(speed[-1]))
    )
