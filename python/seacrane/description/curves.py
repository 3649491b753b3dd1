"""Reference curves from samples; the curve type itself is `seacrane.Curve`."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane._core import Curve
from seacrane.errors import SceneError


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
