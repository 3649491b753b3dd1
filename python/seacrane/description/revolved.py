"""Round surfaces as triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array


def revolved(profile: Array, around: int, *, closed: bool = False) -> tuple[Array, NDArray[np.int64]]:
    """Vertices (n, 3) and triangles (m, 3), anticlockwise from outside, of a profile turned about z: radii
    and heights (k, 2), m, from the lower end outside to the upper one; `closed`: back to the first."""
    angle = 2.0 * np.pi * np.arange(around) / around
    circle = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(around)])
    rings = profile[:, 0, None, None] * circle + profile[:, 1, None, None] * np.array([0.0, 0.0, 1.0])
    here = np.arange(len(profile) if closed else len(profile) - 1)[:, None] * around + np.arange(around)
    beside = here // around * around + (here + 1) % around
    above, across = ((one + around) % (len(profile) * around) for one in (here, beside))
    faces = np.stack([here, beside, across, here, across, above], axis=-1).reshape(-1, 3)
    vertices = rings.reshape(-1, 3)
    radius = np.hypot(*vertices[faces].reshape(-1, 3)[:, :2].T).reshape(-1, 3)
    return vertices, faces[(radius > 1e-9 * radius.max()).sum(axis=1) > 1]
