"""Triangle meshes from outside: joined vertices, and what has to be true of a surface before it is a hull."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

MERGE = 1e-7  # of the size: vertices closer than this are one


def merged_points(points: FloatArray, tolerance: float) -> IntArray:
    """Label (n,) of each point (n, d); points closer than ``tolerance`` share one."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(tolerance, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(points), len(points)))
    return np.asarray(connected_components(links, directed=False)[1], dtype=np.int64)


def mesh_triangles(name: str, vertices: ArrayLike, faces: ArrayLike) -> FloatArray:
    """Triangles (n, 3, 3) of a mesh of triangles or quadrilaterals.

    Raises ValueError: wrong shapes, a vertex that is not finite, or a face with an index out of range.
    """
    points, corners = np.asarray(vertices, dtype=float), np.asarray(faces)
    if points.ndim != 2 or points.shape[1] != 3 or len(points) == 0:
        raise ValueError(f"hull {name!r}: vertices have shape {points.shape}; give (n, 3), x y z in m")
    if corners.ndim != 2 or corners.shape[1] not in (3, 4) or len(corners) == 0:
        raise ValueError(f"hull {name!r}: faces have shape {corners.shape}; give (n, 3) or (n, 4) indices")
    if not np.issubdtype(corners.dtype, np.integer):
        raise ValueError(f"hull {name!r}: faces are {corners.dtype}; give integer indices of vertices")
    if corners.min() < 0 or corners.max() >= len(points):
        wrong = int(corners.min() if corners.min() < 0 else corners.max())
        raise ValueError(
            f"hull {name!r}: a face names vertex {wrong} of {len(points)}; indices start at 0 "
            "(files that start at 1 need 1 subtracted)"
        )
    if not np.all(np.isfinite(points)):
        bad = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise ValueError(f"hull {name!r}: vertex {bad} is {points[bad]}; give finite coordinates in m")
    if corners.shape[1] == 4:
        corners = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    return np.asarray(points[corners])


def require_closed(name: str, triangles: FloatArray) -> FloatArray:
    """The triangles (n, 3, 3) of a hull with joined vertices, once they are known to be closed below z = 0.

    Raises
    ------
    ValueError : an edge below the waterline with one face or more than two, or two faces that run along
        their common edge in the same direction; names the number of edges and the place of the first.
    """
    return closed_below(f"hull {name!r}", triangles, 0.0, " below the waterline")


def closed_below(what: str, triangles: FloatArray, level: float, where: str) -> FloatArray:
    """As `require_closed`, of any surface below z = `level`, m, which messages call `where`."""
    flat = triangles.reshape(-1, 3)
    tolerance = MERGE * float(np.ptp(flat, axis=0).max())
    labels = merged_points(flat, tolerance)
    points = flat[np.unique(labels, return_index=True)[1]]
    faces = labels.reshape(-1, 3)
    distinct = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces = _without_cancelling(faces[distinct])
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    wet = points[edges][..., 2].min(axis=1) < level - tolerance
    _require_pairs(what, where, points, edges[wet])
    return np.asarray(points[faces])


def _without_cancelling(faces: IntArray) -> IntArray:
    """The faces without back-to-back pairs on the same vertices: where both sides of a stem or fin meet."""
    sense = np.sign(np.prod(faces - np.roll(faces, 1, axis=1), axis=1))
    same, count = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)[1:]
    balance = np.bincount(same.ravel(), weights=sense)
    return np.asarray(faces[((count != 2) | (balance != 0.0))[same.ravel()]])


def _require_pairs(what: str, where: str, points: FloatArray, edges: IntArray) -> None:
    """Every edge run through once in each direction."""
    low, high = edges.min(axis=1), edges.max(axis=1)
    pairs, which, count = np.unique(
        np.column_stack([low, high]), axis=0, return_inverse=True, return_counts=True
    )
    balance = np.bincount(which.ravel(), weights=np.where(edges[:, 0] < edges[:, 1], 1.0, -1.0))
    problems = (
        (count == 1, f"have one face only: the surface is open; close it{where} (a mesh of one half needs "
                     "mirroring)"),
        (count > 2, "have more than two faces: surfaces overlap or touch; give one outer skin"),
        (balance != 0.0, "have two faces whose normals disagree; orient all faces outwards"),
    )  # fmt: skip
    for wrong, problem in problems:
        if np.any(wrong):
            at = points[pairs[int(np.flatnonzero(wrong)[0])]].mean(axis=0)
            raise ValueError(
                f"{what}: {int(wrong.sum())} edges{where}, the first near x = {at[0]:.4g}, y = {at[1]:.4g}, "
                f"z = {at[2]:.4g} m, {problem}"
            )
