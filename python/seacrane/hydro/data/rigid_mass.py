"""Mass matrix of a rigid body about any point, and what its weight restores."""

from __future__ import annotations

import numpy as np

from seacrane.arrays import Array


def rigid_mass_matrix(mass: float, center: Array, inertia: Array) -> Array:
    """Mass matrix (6, 6) about the reference point, equation (12) of the paper for any centre of mass."""
    cross = cross_matrix(center)
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = mass * np.eye(3)
    matrix[:3, 3:] = -mass * cross
    matrix[3:, :3] = mass * cross
    matrix[3:, 3:] = inertia - mass * cross @ cross
    return matrix


def weight_restoring(weight: float, position: Array) -> Array:
    """Share of a weight (N) at ``position`` in the restoring matrix (6, 6) about the reference point."""
    x, y, z = position
    c = np.zeros((6, 6))
    c[3, 3] = c[4, 4] = -weight * z
    c[3, 5], c[4, 5] = weight * x, weight * y
    return c


def cross_matrix(v: Array) -> Array:
    """S (3, 3) with ``S u = v x u``."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
