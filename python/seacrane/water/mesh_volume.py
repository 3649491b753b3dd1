"""A closed mesh as a volume: below a level exactly, by the divergence theorem over its clipped triangles."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.hydro.hull.hydrostatics import area_vectors
from seacrane.hydro.hull.mesh import closed_below
from seacrane.inputs.checked import numbers_of, positive_of
from seacrane.inputs.mesh_files import MOST_TRIANGLES, READERS
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]

FLAT = 1e-3  # of the size: what lies within it of one level is flat
MOST_FLATS = 12  # levels at which a volume may change its slope
LARGEST, SMALLEST = 300.0, 0.01  # m, of what hangs on a crane
NO_VOLUME = 1e-9  # of the cube of the size


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


def closed_mesh(mesh: Any, scale: Any) -> tuple[str, Array]:
    """What messages call a mesh, and its triangles (n, 3, 3), m, anticlockwise from outside.

    Raises
    ------
    SceneError, FileFormatError : as `seacrane.water.from_mesh`.
    """
    what, triangles = _triangles_of(mesh)
    factor = positive_of(f"{what}: scale", scale)
    with np.errstate(over="ignore", invalid="ignore"):
        triangles = factor * triangles
        size = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
    if not size <= LARGEST:
        raise SceneError(
            f"{what}: is {size:.4g} m large, above {LARGEST:g} m; if it is in mm give scale={1e-3 * factor:g}"
        )
    if size < SMALLEST:
        raise SceneError(f"{what}: is {size:.4g} m large, below {SMALLEST:g} m; check scale={factor:g}")
    try:
        triangles = closed_below(what, triangles, np.inf, "")
    except ValueError as error:
        raise SceneError(str(error)) from None
    return what, _outwards(what, triangles, size)


def _triangles_of(mesh: Any) -> tuple[str, Array]:
    if isinstance(mesh, str | os.PathLike):
        path = Path(mesh)
        reader = READERS.get(path.suffix.lower())
        if reader is None:
            raise SceneError(f"mesh: file is {shown(path.name)}; give {', '.join(READERS)}")
        return f"mesh {path.name!r}", np.asarray(reader(path, most=MOST_TRIANGLES), dtype=float)
    what = "mesh of triangles"
    triangles = numbers_of(what, mesh)
    if triangles.ndim != 3 or triangles.shape[1:] != (3, 3) or not len(triangles):
        raise SceneError(f"{what}: has shape {triangles.shape}; give a file, or (n, 3, 3) in m")
    if len(triangles) > MOST_TRIANGLES:
        raise SceneError(f"{what}: has {len(triangles)} triangles, above {MOST_TRIANGLES}; decimate it")
    if not np.isfinite(triangles).all():
        raise SceneError(f"{what}: holds a coordinate that is not finite; repair it")
    return what, triangles


def _outwards(what: str, triangles: Array, size: float) -> Array:
    """The triangles, once their faces point outwards."""
    near = triangles - triangles[:1, :1]
    volume = float(np.einsum("ij,ij->", near[:, 0], np.cross(near[:, 1], near[:, 2]))) / 6.0
    if volume < -NO_VOLUME * size**3:
        raise SceneError(
            f"{what}: encloses {volume:.4g} m3, so its faces point inwards; reverse the order of the "
            "vertices of each triangle"
        )
    if not volume > NO_VOLUME * size**3:
        raise SceneError(f"{what}: encloses {volume:.4g} m3, which is nothing; give one closed outer skin")
    return triangles
