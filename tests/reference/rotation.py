"""Rotations beside those of SciPy: cross products, quaternions (scalar first), rates of yaw-pitch-roll."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]


def cross(a: Array, b: Array) -> Array:
    """Over the last axis (several times faster than `np.cross` on small arrays)."""
    a0, a1, a2 = a[..., 0], a[..., 1], a[..., 2]
    b0, b1, b2 = b[..., 0], b[..., 1], b[..., 2]
    out = np.empty(np.broadcast(a, b).shape)
    out[..., 0] = a1 * b2 - a2 * b1
    out[..., 1] = a2 * b0 - a0 * b2
    out[..., 2] = a0 * b1 - a1 * b0
    return out


def skew(a: Array) -> Array:
    """Matrices S (..., 3, 3) with S(a) b = a x b."""
    s = np.zeros((*a.shape[:-1], 3, 3))
    s[..., 0, 1], s[..., 0, 2], s[..., 1, 2] = -a[..., 2], a[..., 1], -a[..., 0]
    s[..., 1, 0], s[..., 2, 0], s[..., 2, 1] = a[..., 2], -a[..., 1], a[..., 0]
    return s


def nearest_rotation(matrix: Array) -> Array:
    """Closest proper rotation matrices in the Frobenius norm, by singular value decomposition."""
    u, _, vt = np.linalg.svd(matrix)
    u[..., :, 2] *= np.linalg.det(u @ vt)[..., None]
    return np.asarray(u @ vt)


def quaternions_from_matrices(matrices: Array) -> Array:
    """Quaternions (..., 4) of any sign, scalar first."""
    return np.roll(Rotation.from_matrix(matrices).as_quat(), 1, axis=-1)


def angle_rate_matrix(pitch: float, yaw: float) -> Array:
    """Matrix G (3, 3): rates of roll, pitch, yaw = G omega, with omega in the inertial frame."""
    c, s, t = math.cos(yaw), math.sin(yaw), math.tan(pitch)
    return np.array([[c / math.cos(pitch), s / math.cos(pitch), 0.0], [-s, c, 0.0], [t * c, t * s, 1.0]])
