"""Linear dispersion of water waves: wavenumber from frequency, any depth."""

from __future__ import annotations

import numpy as np

from seacrane.arrays import Array

ITERATIONS = 50  # far more than Newton's method needs from either limit


def wavenumber(omega: Array, *, g: float, depth: float) -> Array:
    """k (n,) in 1/m of ``omega^2 = g k tanh(k depth)``, by Newton's method from the deep or shallow limit;
    rad/s, m/s2 and m, an infinite depth is deep water."""
    k = np.asarray(omega, dtype=float) ** 2 / g
    if np.isinf(depth):
        return np.asarray(k)
    k = np.maximum(k, omega / np.sqrt(g * depth))
    for _ in range(ITERATIONS):
        t = np.tanh(k * depth)
        k = k - (g * k * t - omega**2) / (g * t + g * k * depth * (1.0 - t**2))
    return np.asarray(k)
