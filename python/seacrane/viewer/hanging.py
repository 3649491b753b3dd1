"""The line of a wire: straight where it is taut, with its own length where it is slack; as in the page."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

POINTS = 33
SLACK = 1e-3  # of the length


def wire_line(start: Array, end: Array, length: float) -> tuple[Array, bool]:
    """Points (n, 3) from start to end, m, and whether the wire is slack; a length of 0 never is."""
    chord = float(np.linalg.norm(end - start))
    if not (length > 0.0 and chord < length * (1.0 - SLACK)):
        return np.array([start, end]), False
    return _half_wave(start, end, length), True


def _half_wave(start: Array, end: Array, length: float) -> Array:
    """Downwards or, under a vertical chord, sideways, as high as the length asks for."""
    along = end - start
    chord = max(float(np.linalg.norm(along)), 1e-6 * length)
    along = along / chord
    side = np.array([0.0, 0.0, -1.0]) + along * along[2]
    if np.linalg.norm(side) < 0.2:
        side = np.array([1.0, 0.0, 0.0]) - along * along[0]
    side /= np.linalg.norm(side)
    u = np.linspace(0.0, 1.0, POINTS)[:, None]
    low, high = 0.0, length
    for _ in range(30):
        depth = 0.5 * (low + high)
        points = start + along * chord * u + side * depth * np.sin(np.pi * u)
        if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() < length:
            low = depth
        else:
            high = depth
    return np.asarray(points)
