"""Mass matrix of a rigid body about any point."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def rigid_mass_matrix(mass: float, center: FloatArray, inertia: FloatArray) -> FloatArray:
    """Mass matrix (6, 6) about the reference point, equation (12) of the paper for any centre of mass."""
    cross = cross_matrix(center)
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = mass * np.eye(3)
    matrix[:3, 3:] = -mass * cross
    matrix[3:, :3] = mass * cross
    matrix[3:, 3:] = inertia - mass * cross @ cross
    return matrix


def cross_matrix(v: FloatArray) -> FloatArray:
    """S (3, 3) with ``S u = v x u``."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
