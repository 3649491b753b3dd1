"""Frequencies and directions over which the response of a linear model to a sea is summed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.modal_analysis import natural_modes
from seacrane.inputs.caller import warn_caller
from seacrane.sea.spreading import Spreading
from seacrane.warnings import UndampedModeWarning

Array = NDArray[np.float64]
UNDAMPED = 1e-6  # damping ratio below which the variance of a resonance has no meaning
BROAD = 0.2  # damping ratio above which the even grid resolves a resonance
GRID = 1500  # frequencies over a band
GRID_OF_MODE = 120  # more on either side of each resonance
DIRECTIONS = 48


def quadrature_frequencies(linear: LinearModel, low: float, high: float) -> Array:
    """Even over a band, rad/s, and about each resonance."""
    omega = np.unique(np.concatenate([np.linspace(low, high, GRID), about_resonances(linear, low, high)]))
    return omega[(omega >= low) & (omega <= high)]


def directions_of(spreading: Spreading | None, main: float) -> tuple[Array, Array]:
    """Directions (q,), rad, and their shares of the energy."""
    if spreading is None:
        return np.array([main]), np.ones(1)
    angles, shares = spreading.quadrature(DIRECTIONS)
    return np.asarray(main + angles), np.asarray(shares)


def weights_of(omega: Array) -> Array:
    """Weights of the trapezoidal rule."""
    steps = np.diff(omega)
    return np.asarray(0.5 * (np.append(steps, 0.0) + np.append(0.0, steps)))


def about_resonances(linear: LinearModel, low: float, high: float) -> Array:
    """Frequencies about each resonance, geometrically away from a tenth of its half width."""
    modes = natural_modes(linear)
    parts = [np.zeros(0)]
    for i, value in enumerate(modes.eigenvalues):
        if not low < value.imag < high or modes.damping_ratio[i] > BROAD:
            continue
        if modes.damping_ratio[i] < UNDAMPED:
            warn_caller(
                f"scene {linear.scene.name!r}: mode {modes.label(i)!r} at {value.imag:.4g} rad/s has a "
                f"damping ratio of {modes.damping_ratio[i]:.2g}: the variance of its resonance has no "
                "finite value; add damping",
                UndampedModeWarning,
            )
            continue
        width = abs(value.real)
        away = np.geomspace(0.1 * width, max(0.5 * value.imag, width), GRID_OF_MODE)
        parts.append(np.concatenate([value.imag - away, [value.imag], value.imag + away]))
    return np.concatenate(parts)
