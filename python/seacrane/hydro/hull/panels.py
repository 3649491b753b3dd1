"""Quadrilateral panels of hulls: cut at a plane, lofted through half sections, closed at the ends.

Panels are (n, 4, 3) in m with normals into the water; a triangle repeats its last vertex. A half section is
(p, 2), y and z from the waterline to the keel, port.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.hydrostatics import area_vectors, triangles_of

FloatArray = NDArray[np.float64]

MIRROR = np.array([1.0, -1.0, 1.0])
SAME_FRACTION = 1e-9  # of a section's length
MOST_RINGS = 20
NO_AREA = 1e-12  # of the square of the hull's size


def cut_panels(panels: FloatArray, *, axis: int, side: int, tolerance: float) -> FloatArray:
    """Panels on one side of a coordinate plane through the origin, those that cross it cut in triangles.

    ``side`` +1 keeps where the coordinate ``axis`` is above zero, -1 below. Vertices within ``tolerance``
    (m) of the plane are put on it, and panels that lie in the plane are left out.
    """
    points = panels.copy()
    near = np.abs(points[..., axis]) <= tolerance
    points[..., axis] = np.where(near, 0.0, points[..., axis])
    distance = side * points[..., axis]
    inside = (distance >= 0.0).all(axis=1) & (distance > 0.0).any(axis=1)
    crossing = (distance > 0.0).any(axis=1) & (distance < 0.0).any(axis=1)
    pieces = [_clipped(t, axis, side) for t in triangles_of(points[crossing])]
    return np.concatenate([points[inside], *[piece[None] for piece in pieces if piece is not None]])


def _clipped(triangle: FloatArray, axis: int, side: int) -> FloatArray | None:
    """The part (4, 3) of a triangle where ``side`` times the coordinate is not negative."""
    kept: list[FloatArray] = []
    for a, b in zip(triangle, np.roll(triangle, -1, axis=0), strict=True):
        da, db = side * a[axis], side * b[axis]
        if da >= 0.0:
            kept.append(a)
        if da * db < 0.0:
            crossing = a + (b - a) * (da / (da - db))
            crossing[axis] = 0.0
            kept.append(crossing)
    corners = np.array(kept).reshape(-1, 3)
    if len(corners) < 3 or not np.any(side * corners[:, axis] > 0.0):
        return None
    return corners[[0, 1, 2, 2]] if len(corners) == 3 else corners


def mirrored(panels: FloatArray) -> FloatArray:
    """Panels of the other side, normals outwards."""
    return np.asarray((panels * MIRROR)[:, [0, 3, 2, 1]])


def lofted(x: Sequence[float], sections: Sequence[FloatArray]) -> FloatArray:
    """Panels between half sections at increasing stations ``x``, both sides, without the ends.

    Neighbours with as many points each are joined point by point, others by the share of the length from the
    first to the last point; every point of every section is kept.
    """
    port = [_strip(x[i], sections[i], x[i + 1], sections[i + 1]) for i in range(len(sections) - 1)]
    side = without_slivers(np.concatenate(port))
    return np.concatenate([side, mirrored(side)])


def _strip(x_aft: float, aft: FloatArray, x_fore: float, fore: FloatArray) -> FloatArray:
    """Panels (n, 4, 3) of the port side between two sections."""
    if len(aft) != len(fore):
        at = np.union1d(fractions(aft), fractions(fore))
        at = at[np.append(True, np.diff(at) > SAME_FRACTION)]
        aft, fore = along(aft, at), along(fore, at)
    a = np.column_stack([np.full(len(aft), x_aft), aft])
    b = np.column_stack([np.full(len(fore), x_fore), fore])
    return np.stack([a[:-1], b[:-1], b[1:], a[1:]], axis=1)


def fractions(section: FloatArray) -> FloatArray:
    """Share (p,) of the length up to each point; a section that is one point has 0 and 1."""
    steps = np.hypot(*np.diff(section, axis=0).T)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    return arc / arc[-1] if arc[-1] > 0.0 else np.array([0.0, 1.0])


def along(section: FloatArray, fraction: FloatArray) -> FloatArray:
    """Points (n, 2) at shares of a section's length."""
    if np.all(section == section[0]):
        return np.repeat(section[:1], len(fraction), axis=0)
    at = fractions(section)
    keep = np.append(True, np.diff(at) > 0.0)
    at, points = at[keep], section[keep]
    return np.column_stack([np.interp(fraction, at, points[:, i]) for i in (0, 1)])


def end_cap(x: float, section: FloatArray, *, forward: bool) -> FloatArray:
    """Flat end of both sides: rings from the outline towards the middle of its waterline."""
    radius = np.hypot(*section.T)
    steps = np.hypot(*np.diff(section, axis=0).T)
    rings = max(1, round(min(float(radius.mean() / max(steps.mean(), 1e-300)), MOST_RINGS)))
    scale = np.linspace(1.0, 0.0, rings + 1)[:, None, None]
    grid = np.concatenate([np.full((rings + 1, len(section), 1), x), scale * section], axis=2)
    corners = [grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]]
    port = without_slivers(np.stack(corners, axis=2).reshape(-1, 4, 3))
    port = port if forward else port[:, [0, 3, 2, 1]]
    return np.concatenate([port, mirrored(port)])


def without_slivers(panels: FloatArray) -> FloatArray:
    """The panels that have an area."""
    if len(panels) == 0:
        return panels
    area = np.linalg.norm(area_vectors(triangles_of(panels)), axis=1).reshape(2, -1).sum(axis=0)
    return np.asarray(panels[area > NO_AREA * np.ptp(panels.reshape(-1, 3), axis=0).max() ** 2])
