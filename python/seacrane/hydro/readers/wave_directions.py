"""Wave directions of a source, and the phases of its forces."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.sea.dispersion import wavenumber

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

SAME_DIRECTION = 1e-9  # rad


def rising_directions(raw: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
    """Directions (rad) in [0, 2 pi), rising, and their places in ``raw``; a full turn beside 0 is dropped."""
    wrapped = np.mod(raw, 2.0 * np.pi)
    wrapped[2.0 * np.pi - wrapped < SAME_DIRECTION] = 0.0
    order = np.argsort(wrapped, kind="stable")
    new = np.append(True, np.diff(wrapped[order]) > SAME_DIRECTION)
    return wrapped[order][new], order[new]


def phase_at(
    centre: FloatArray, omega: FloatArray, direction: FloatArray, g: float, depth: float
) -> ComplexArray:
    """Factor (m, n, 1) that gives waves of zero phase at the centre: exp(+i k (x cos b + y sin b))."""
    along = centre[0] * np.cos(direction) + centre[1] * np.sin(direction)
    return np.asarray(np.exp(1j * np.outer(along, wavenumber(omega, g=g, depth=depth))))[:, :, None]
