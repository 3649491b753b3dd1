"""A closed mesh as a volume: below a level exactly, by the divergence theorem over its clipped triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.hull.hydrostatics import area_vectors

Array = NDArray[np.float64]

FLAT = 1e-3  # of the size: what lies within it of one level is flat
MOST_FLATS = 12  # levels at which a volume may change its slope


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshShape:
    """A closed mesh with the centre of its volume over the origin, its lowest point at z = 0.

    Attributes
    ----------
    triangles : (n, 3, 3) m, anticlockwise from outside.
    size : (3,) its extent, m.
    center : (3,) half its height above its lowest point, in the coordinates that it was given in, m.
    flat : area of what is flat at its lowest level, m2.
    kinks : (k,) levels of its largest horizontal faces, m.
    """

    triangles: Array
    size: Array
    center: Array
    flat: float
    kinks: Array

    @staticmethod
    def of(triangles: Array) -> MeshShape:
        corners = triangles.reshape(-1, 3)
        size, lowest = np.ptp(corners, axis=0), float(corners[:, 2].min())
        x, y, _ = centroid(triangles)
        moved = triangles - np.array([x, y, lowest])
        return MeshShape(
            triangles=moved, size=size, center=np.array([x, y, lowest + 0.5 * size[2]]),
            flat=flat_bottom(moved), kinks=flat_levels(moved),
        )  # fmt: skip


def volumes_below(triangles: Array, levels: Array) -> Array:
    """Volume (m,) of a closed mesh (n, 3, 3) below each level (m,), m3.

    The flux of (0, 0, z - level) through what of the surface is wet; there is none through the lid that the
    level is. Over a triangle it is n_z times the integral of the depth where that is positive.
    """
    rise = area_vectors(triangles)[:, 2]
    counted = rise != 0.0
    rise = rise[counted]
    heights = -np.sort(-triangles[counted][..., 2], axis=1)  # the highest corner first
    out = np.array([-float(rise @ _mean_depths(level - heights)) for level in levels])
    return np.maximum.accumulate(np.maximum(out, 0.0))  # rounding alone makes it fall


def _mean_depths(corners: Array) -> Array:
    """Mean over triangles of the depth where it is positive, from increasing depths (n, 3) of corners."""
    least, middle, most = corners.T
    with np.errstate(divide="ignore", invalid="ignore"):
        low = most**2 / ((most - least) * (most - middle)) * most / 3.0  # one corner is wet
        dry = least**2 / ((middle - least) * (most - least)) * least / 3.0  # one corner is dry
    mean = corners.mean(axis=1)
    return np.select([least >= 0.0, middle > 0.0, most > 0.0], [mean, mean - dry, low], 0.0)


def centroid(triangles: Array) -> Array:
    """Centre (3,) of the volume of a closed mesh, m."""
    middle = triangles.reshape(-1, 3).mean(axis=0)
    near = triangles - middle
    parts = np.einsum("ij,ij->i", near[:, 0], np.cross(near[:, 1], near[:, 2]))
    return np.asarray(middle + parts @ near.sum(axis=1) / (4.0 * parts.sum()))


def flat_bottom(triangles: Array) -> float:
    """Area of what is flat at the lowest level of a mesh, m2."""
    low = triangles[..., 2].min() + FLAT * np.ptp(triangles.reshape(-1, 3), axis=0).max()
    bottom = triangles[(triangles[..., 2] <= low).all(axis=1)]
    return max(0.0, -float(area_vectors(bottom)[:, 2].sum()))


def flat_levels(triangles: Array) -> Array:
    """Levels of the largest horizontal faces, where the volume below a level has a kink, m."""
    areas = area_vectors(triangles)
    level = np.ptp(triangles[..., 2], axis=1) <= 1e-9 * np.ptp(triangles[..., 2])
    at, which = np.unique(np.round(triangles[level][:, 0, 2], 9), return_inverse=True)
    size = np.bincount(which.ravel(), weights=np.abs(areas[level][:, 2]), minlength=len(at))
    return np.asarray(np.sort(at[np.argsort(-size)[:MOST_FLATS]]))
