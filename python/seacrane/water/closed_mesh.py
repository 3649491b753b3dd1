"""Triangles of a part of a load, from a file or an array, once they enclose a volume in metres."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.meshes import MOST_TRIANGLES, READERS
from seacrane.errors import SceneError
from seacrane.hydro.hull.mesh import closed_below
from seacrane.inputs.checked import numbers_of, positive_of
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]

LARGEST, SMALLEST = 300.0, 0.01  # m, of what hangs on a crane
NO_VOLUME = 1e-9  # of the cube of the size


def closed_mesh(mesh: Any, scale: Any) -> tuple[str, Array]:
    """What messages call a mesh, and its triangles (n, 3, 3), m, anticlockwise from outside.

    Raises
    ------
    SceneError, FileFormatError : as `seacrane.water.from_mesh`.
    """
    what, triangles = _read(mesh)
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


def _read(mesh: Any) -> tuple[str, Array]:
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
