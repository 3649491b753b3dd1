"""Direct evaluation of retardation functions and of the memory integral, equation (28) of the paper."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .rotation import Array

# Gregory's end corrections of the trapezoidal rule, exact for cubics (error of order h^4 and better)
GREGORY = np.array([3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0])


def kernel_of_damping(times: ArrayLike, omega: ArrayLike, damping: ArrayLike) -> Array:
    """K(t) = 2/pi integral of B(w) cos(w t) dw (k, 6, 6), B linear between its frequencies, zero outside.

    The integral is exact for piecewise linear B, so it stays right for w t beyond the frequency spacing.
    """
    t = np.asarray(times, dtype=float)[:, None]
    w, b = np.asarray(omega, dtype=float), np.asarray(damping, dtype=float)
    step = np.diff(w)
    slope = np.diff(b, axis=0) / step[:, None, None]
    # integral of (b0 + s (w - w0)) cos(w t): both parts by parts, in forms that hold at t = 0
    center, half = 0.5 * (w[1:] + w[:-1]) * t, 0.5 * step * t
    even = step * np.cos(center) * np.sinc(half / np.pi)
    odd = -0.5 * step**2 * np.sin(center) * _odd_moment(half)
    middle = 0.5 * (b[1:] + b[:-1])
    total = np.einsum("ti,ijk->tjk", even, middle) + np.einsum("ti,ijk->tjk", odd, slope)
    return np.asarray(2.0 / np.pi * total)


def _odd_moment(x: Array) -> Array:
    """(sin x - x cos x) / x^2, by series near zero."""
    small = np.abs(x) < 1e-2
    safe = np.where(small, 1.0, x)
    series = x / 3.0 - x**3 / 30.0 + x**5 / 840.0
    return np.asarray(np.where(small, series, (np.sin(safe) - safe * np.cos(safe)) / safe**2))


def memory_force(velocity: ArrayLike, kernel: ArrayLike, step: float) -> Array:
    """mu(t_i) = integral_0^t_i K(t_i - tau) u(tau) dtau (k, 6) of samples of u (k, 6) and K (k, 6, 6).

    Trapezoidal sum with Gregory end corrections (fourth order) once six samples are in reach, plain before.
    """
    u, k = np.asarray(velocity, dtype=float), np.asarray(kernel, dtype=float)
    out = np.zeros_like(u)
    for i in range(1, len(u)):
        weight = np.ones(i + 1)
        if i >= 5:
            weight[:3], weight[-3:] = GREGORY, GREGORY[::-1]
        else:
            weight[0] = weight[-1] = 0.5
        out[i] = step * np.einsum("n,njk,nk->j", weight, k[: i + 1], u[i::-1])
    return out
