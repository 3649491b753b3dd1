"""The six motions, and small helpers for rotations: quaternions, Euler angles and joint axes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of
from seacrane.inputs.shown import shown

MOTIONS = ("surge", "sway", "heave", "roll", "pitch", "yaw")
AXES_NOTE = (
    "Axes: x forward, y to port, z up. Positive roll lifts the port side, positive pitch lowers the bow, "
    "positive yaw turns the bow to port."
)


def rotation_matrix(quaternion: Any) -> Array:
    """Body-to-inertial matrices (..., 3, 3) of quaternions (..., 4), scalar first."""
    q = np.asarray(quaternion, dtype=float)
    if q.shape == (4,):  # without the cost of arrays
        w, x, y, z = q.tolist()
        size = math.sqrt(w * w + x * x + y * y + z * z)
        return np.array(_rows(w / size, x / size, y / size, z / size)) if size else np.full((3, 3), np.nan)
    q = q / np.sqrt((q * q).sum(axis=-1, keepdims=True))
    matrix: Array = np.empty((*q.shape[:-1], 3, 3))
    for at, row in enumerate(_rows(q[..., 0], q[..., 1], q[..., 2], q[..., 3])):
        for beside, values in enumerate(row):
            matrix[..., at, beside] = values
    return matrix


def _rows(w: Any, x: Any, y: Any, z: Any) -> Any:
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def cross(first: Array, second: Array) -> Array:
    """Cross products (..., 3), to the bit those of `numpy.cross`, without the cost of its general axes."""
    a, b, c = first[..., 0], first[..., 1], first[..., 2]
    x, y, z = second[..., 0], second[..., 1], second[..., 2]
    out: Array = np.empty(np.broadcast(first, second).shape)
    np.subtract(b * z, c * y, out=out[..., 0])
    np.subtract(c * x, a * z, out=out[..., 1])
    np.subtract(a * y, b * x, out=out[..., 2])
    return out


def heading_of(quaternion: Any) -> float:
    """Yaw of yaw-pitch-roll angles, rad."""
    w, x, y, z = (float(part) for part in quaternion)
    return math.atan2(2.0 * (x * y + w * z), w * w + x * x - y * y - z * z)


def rotation_about_z(angle: float) -> Array:
    """(3, 3), rad."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def quaternion_product(first: Any, second: Any) -> Array:
    """The quaternion of the rotation `second` followed by `first`, (4,), scalar first."""
    (w, *u), (p, *v) = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    return np.array([w * p - np.dot(u, v), *(w * np.array(v) + p * np.array(u) + np.cross(u, v))])


def euler_matrix(angles: Any) -> Array:
    """Body-to-inertial matrix (3, 3) of XYZ Euler angles (3,), R = Rx Ry Rz."""
    (cx, cy, cz), (sx, sy, sz) = np.cos(angles), np.sin(angles)
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return np.asarray(about_x @ about_y @ about_z)


def _direction(what: str, value: Any) -> Array:
    try:
        vector = numbers_of(what, value)
    except SceneError as error:
        raise SceneError(f"{what} is {shown(value)}; give three numbers") from error
    length = np.linalg.norm(vector) if vector.shape == (3,) else np.nan
    if not np.isfinite(length) or length == 0.0:
        raise SceneError(f"{what} is {value!r}; give three finite numbers, not all zero")
    return vector / float(length)


def axes_along(what: str, axis: Any) -> Array:
    """Right-handed axes (columns) with z along `axis`; x is as near as can be to a coordinate axis."""
    z = _direction(what, axis)
    nearest = np.zeros(3)
    nearest[np.argmin(np.abs(z))] = 1.0
    x = nearest - z * (z @ nearest)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def axes_across(what: str, first_axis: Array, axis: Any) -> Array:
    """Axes of the second side of a universal joint: z along `axis`, perpendicular to the first axis."""
    z = _direction(what, axis)
    slope = float(abs(z @ first_axis))
    if slope > 0.1:
        raise SceneError(
            f"{what} is {np.degrees(np.arccos(min(slope, 1.0))):.1f} deg from the first axis; "
            "the axes of a universal joint are perpendicular"
        )
    return axes_along(what, axis)


def quaternion_of(matrix: Array) -> Array:
    """Scalar first, (4,), of a rotation matrix (3, 3)."""
    m = np.asarray(matrix, dtype=float)
    products = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0]],
            [m[0, 2] - m[2, 0], m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1]],
            [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    largest = np.linalg.eigh(products)[1][:, -1]  # 4 q q^T - 1: its largest eigenvector is q
    return np.asarray(largest * (1.0 if largest[0] >= 0.0 else -1.0))


def heel_and_trim(quaternion: Array) -> tuple[float, float]:
    """Roll and pitch (rad) of a body, by its quaternion: positive lifts port, and lowers the bow."""
    turn = rotation_matrix(quaternion)
    return float(np.arctan2(turn[2, 1], turn[2, 2])), float(-np.arcsin(np.clip(turn[2, 0], -1.0, 1.0)))
