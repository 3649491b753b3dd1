"""Rotations: cross products, matrices, quaternions (scalar first) and yaw-pitch-roll angles."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

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


def dot(a: Array, b: Array) -> Array:
    """Over the last axis."""
    return np.asarray(np.einsum("...i,...i->...", a, b))


def skew(a: Array) -> Array:
    """Matrices S (..., 3, 3) with S(a) b = a x b."""
    s = np.zeros((*a.shape[:-1], 3, 3))
    s[..., 0, 1], s[..., 0, 2], s[..., 1, 2] = -a[..., 2], a[..., 1], -a[..., 0]
    s[..., 1, 0], s[..., 2, 0], s[..., 2, 1] = a[..., 2], -a[..., 1], a[..., 0]
    return s


def rotation_exponential(angle: Array) -> Array:
    """Rotation matrices of rotation vectors (..., 3), Rodrigues' formula."""
    s = skew(angle)
    theta = np.sqrt(dot(angle, angle))[..., None, None]
    # np.sinc is sin(pi x)/(pi x): both factors stay exact at zero angle
    first = np.sinc(theta / np.pi)
    second = 0.5 * np.sinc(0.5 * theta / np.pi) ** 2
    return np.asarray(np.eye(3) + first * s + second * (s @ s))


def nearest_rotation(matrix: Array) -> Array:
    """Closest proper rotation matrices in the Frobenius norm, by singular value decomposition."""
    u, _, vt = np.linalg.svd(matrix)
    u[..., :, 2] *= np.linalg.det(u @ vt)[..., None]
    return np.asarray(u @ vt)


def matrix_from_quaternion(quaternion: ArrayLike) -> Array:
    """Rotation matrix (3, 3), body to inertial, of a quaternion w, x, y, z (normalised here)."""
    q = np.asarray(quaternion, dtype=float)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternions_from_matrices(matrices: Array) -> Array:
    """Quaternions (..., 4) of any sign: eigenvectors of Bar-Itzhack's symmetric 4x4 matrices."""
    m = matrices
    k = np.empty((*m.shape[:-2], 4, 4))
    xx, yy, zz = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    k[..., 0, 0], k[..., 1, 1] = xx + yy + zz, xx - yy - zz
    k[..., 2, 2], k[..., 3, 3] = yy - xx - zz, zz - xx - yy
    k[..., 1, 0], k[..., 2, 0] = m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0]
    k[..., 3, 0], k[..., 2, 1] = m[..., 1, 0] - m[..., 0, 1], m[..., 1, 0] + m[..., 0, 1]
    k[..., 3, 1], k[..., 3, 2] = m[..., 0, 2] + m[..., 2, 0], m[..., 1, 2] + m[..., 2, 1]
    return np.asarray(np.linalg.eigh(k)[1][..., -1])  # eigh reads the lower triangle


def yaw_pitch_roll(matrix: Array) -> tuple[float, float, float]:
    """Roll, pitch, yaw of R = Rz(yaw) Ry(pitch) Rx(roll)."""
    roll = math.atan2(matrix[2, 1], matrix[2, 2])
    pitch = math.atan2(-matrix[2, 0], math.hypot(matrix[2, 1], matrix[2, 2]))
    return roll, pitch, math.atan2(matrix[1, 0], matrix[0, 0])


def angle_rate_matrix(pitch: float, yaw: float) -> Array:
    """Matrix G (3, 3): rates of roll, pitch, yaw = G omega, with omega in the inertial frame."""
    c, s, t = math.cos(yaw), math.sin(yaw), math.tan(pitch)
    return np.array([[c / math.cos(pitch), s / math.cos(pitch), 0.0], [-s, c, 0.0], [t * c, t * s, 1.0]])
