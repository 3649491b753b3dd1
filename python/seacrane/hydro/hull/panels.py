"""Panels of hulls: cut at a plane, lofted through half sections, closed at the ends, sliced across.

Panels are (n, 4, 3) in m with normals into the water; a triangle repeats its last vertex. A half section is
(p, 2), y and z from the waterline to the keel, port. Meshes from outside are triangles (n, 3, 3), whose
vertices are joined, and of which what has to be true before they are a hull is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array
from seacrane.inputs.checked import positive_of

IntArray = NDArray[np.int64]

MIRROR = np.array([1.0, -1.0, 1.0])
SAME_FRACTION = 1e-9  # of a section's length
MOST_RINGS = 20
NO_AREA = 1e-12  # of the square of the hull's size
MERGE = 1e-7  # of the size: vertices closer than this are one
ON_PLANE = 1e-7  # of the length: closer points are one, or on the waterline, or on the centre line
NEXT_TO_PLANE = 10.0  # of that: vertices this close to a slice are on it, so that their edges meet there


def triangles_of(panels: Array) -> Array:
    """Two triangles (2 n, 3, 3) of every quadrilateral (n, 4, 3)."""
    return np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]])


def area_vectors(triangles: Array) -> Array:
    """Area times normal (n, 3) of triangles (n, 3, 3), m2."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return 0.5 * np.cross(b - a, c - a)


def cut_panels(panels: Array, *, axis: int, side: int, tolerance: float) -> Array:
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


def _clipped(triangle: Array, axis: int, side: int) -> Array | None:
    """The part (4, 3) of a triangle where ``side`` times the coordinate is not negative."""
    kept: list[Array] = []
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


def mirrored(panels: Array) -> Array:
    """Panels of the other side, normals outwards."""
    return np.asarray((panels * MIRROR)[:, [0, 3, 2, 1]])


def lofted(x: Sequence[float], sections: Sequence[Array]) -> Array:
    """Panels between half sections at increasing stations ``x``, both sides, without the ends.

    Neighbours with as many points each are joined point by point, others by the share of the length from the
    first to the last point; every point of every section is kept.
    """
    port = []
    for i in range(len(sections) - 1):
        aft, fore = sections[i : i + 2]
        if len(aft) != len(fore):
            at = np.union1d(fractions(aft), fractions(fore))
            at = at[np.append(True, np.diff(at) > SAME_FRACTION)]
            aft, fore = along(aft, at), along(fore, at)
        a = np.column_stack([np.full(len(aft), x[i]), aft])
        b = np.column_stack([np.full(len(fore), x[i + 1]), fore])
        port.append(np.stack([a[:-1], b[:-1], b[1:], a[1:]], axis=1))
    side = without_slivers(np.concatenate(port))
    return np.concatenate([side, mirrored(side)])


def fractions(section: Array) -> Array:
    """Share (p,) of the length up to each point; a section that is one point has 0 and 1."""
    steps = np.hypot(*np.diff(section, axis=0).T)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    return arc / arc[-1] if arc[-1] > 0.0 else np.array([0.0, 1.0])


def along(section: Array, fraction: Array) -> Array:
    """Points (n, 2) at shares of a section's length."""
    if np.all(section == section[0]):
        return np.repeat(section[:1], len(fraction), axis=0)
    at = fractions(section)
    keep = np.append(True, np.diff(at) > 0.0)
    at, points = at[keep], section[keep]
    return np.column_stack([np.interp(fraction, at, points[:, i]) for i in (0, 1)])


def closed_loft(x: list[float], sections: list[Array]) -> Array:
    """`lofted`, with flat ends."""
    ends = [_end_cap(x[0], sections[0], forward=False), _end_cap(x[-1], sections[-1], forward=True)]
    return np.concatenate([lofted(x, sections), *ends])


def _end_cap(x: float, section: Array, *, forward: bool) -> Array:
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


def without_slivers(panels: Array) -> Array:
    """The panels that have an area."""
    if len(panels) == 0:
        return panels
    area = np.linalg.norm(area_vectors(triangles_of(panels)), axis=1).reshape(2, -1).sum(axis=0)
    return np.asarray(panels[area > NO_AREA * np.ptp(panels.reshape(-1, 3), axis=0).max() ** 2])


def merged_points(points: Array, tolerance: float) -> IntArray:
    """Label (n,) of each point (n, d); points closer than ``tolerance`` share one."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(tolerance, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(points), len(points)))
    return np.asarray(connected_components(links, directed=False)[1], dtype=np.int64)


def mesh_triangles(name: str, vertices: ArrayLike, faces: ArrayLike) -> Array:
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
        return triangles_of(points[corners])
    return np.asarray(points[corners])


def afloat(name: str, triangles: Array, draught: float | None) -> Array:
    """The triangles with their lowest point ``draught`` (m) below z = 0; as they are where it is None."""
    if draught is None:
        return triangles
    depth = positive_of(f"hull {name!r}: draught", draught, "m")
    return np.asarray(triangles - np.array([0.0, 0.0, triangles[..., 2].min() + depth]))


def closed_below(
    what: str, triangles: Array, level: float = 0.0, where: str = " below the waterline"
) -> Array:
    """The triangles (n, 3, 3) of a surface with joined vertices, once they are known to be closed below z =
    `level` (m), which messages call `where`.

    Raises ValueError: an edge there with one face or more than two, or two faces that run along their common
    edge in the same direction; names the number of edges and the place of the first.
    """
    flat = triangles.reshape(-1, 3)
    tolerance = MERGE * float(np.ptp(flat, axis=0).max())
    labels = merged_points(flat, tolerance)
    points = flat[np.unique(labels, return_index=True)[1]]
    faces = labels.reshape(-1, 3)
    distinct = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces = faces[distinct]
    # without back-to-back pairs on the same vertices: where both sides of a stem or fin meet
    sense = np.sign(np.prod(faces - np.roll(faces, 1, axis=1), axis=1))
    same, count = np.unique(np.sort(faces, axis=1), axis=0, return_inverse=True, return_counts=True)[1:]
    balance = np.bincount(same.ravel(), weights=sense)
    faces = faces[((count != 2) | (balance != 0.0))[same.ravel()]]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    wet = points[edges][..., 2].min(axis=1) < level - tolerance
    _require_pairs(what, where, points, edges[wet])
    return np.asarray(points[faces])


def _require_pairs(what: str, where: str, points: Array, edges: IntArray) -> None:
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


@dataclass(frozen=True, kw_only=True, eq=False)
class Slice:
    """Half section (p, 2) of y and z in m, waterline to keel, and the area (m2) of the half that hangs apart.

    ``section`` is three points at the origin where nothing pierces the surface. ``apart`` is the area of what
    is wholly under water: a bulb ahead of the stem, a pod.
    """

    section: Array
    apart: float


def slices(name: str, panels: Array, x: Array) -> list[Slice]:
    """Slices of a symmetric wetted surface (n, 4, 3) at the stations ``x`` (s,) in m.

    Stations on the foremost and aftmost point give the hull's ends. Raises ValueError: a section that pierces
    the surface more than once on each side (several hulls), or whose outline does not close.
    """
    length = float(np.ptp(panels[..., 0]))
    tolerance = ON_PLANE * length
    port = triangles_of(cut_panels(panels, axis=1, side=1, tolerance=tolerance))
    middle = 0.5 * float(panels[..., 0].min() + panels[..., 0].max())
    return [_slice(name, port, float(station), station < middle, tolerance) for station in x]


def _slice(name: str, triangles: Array, x: float, aft: bool, tolerance: float) -> Slice:
    """One slice; vertices on the plane count to the nearer end, so that the end itself is a section."""
    chains = _chains(name, x, _segments(triangles, x, aft, tolerance), tolerance)
    piercing, apart = [], 0.0
    for chain in chains:
        if max(chain[0, 1], chain[-1, 1]) < -tolerance:
            y, z = np.append(chain[:, 0], [0.0, 0.0]), np.append(chain[:, 1], chain[[-1, 0], 1])
            apart += float(0.5 * abs(np.sum(y * np.roll(z, -1) - z * np.roll(y, -1))))
        elif chain[:, 1].min() < -tolerance:  # else: a bottom that just comes up
            piercing.append(chain if chain[0, 1] >= chain[-1, 1] else chain[::-1].copy())
    if not piercing:
        return Slice(section=np.zeros((3, 2)), apart=apart)
    if len(piercing) > 1 or piercing[0][-1, 0] > tolerance:
        raise ValueError(
            f"hull {name!r}: the section at x = {x:.6g} m meets the waterline more than once on each side, "
            "or does not end on the centre line; strip theory and remeshing take one hull: use "
            "method='capytaine' with the mesh as it is"
        )
    section = piercing[0]
    section[0, 1] = section[-1, 0] = 0.0
    if len(section) == 2:
        section = np.array([section[0], section.mean(axis=0), section[1]])
    return Slice(section=np.column_stack([np.maximum(section[:, 0], 0.0), section[:, 1]]), apart=apart)


def _segments(triangles: Array, x: float, aft: bool, tolerance: float) -> Array:
    """Directed segments (m, 2, 2) of y, z in which the triangles meet the plane."""
    distance = triangles[..., 0] - x
    distance[np.abs(distance) <= NEXT_TO_PLANE * tolerance] = 0.0
    ahead = distance > 0.0 if aft else distance >= 0.0
    cut = ahead.any(axis=1) & ~ahead.all(axis=1)
    t, d, front = triangles[cut], distance[cut], ahead[cut]
    out = np.empty((len(t), 2, 2))
    for i in range(3):
        j = (i + 1) % 3
        for slot, leaves in ((0, front[:, i] & ~front[:, j]), (1, ~front[:, i] & front[:, j])):
            share = d[leaves, i] / (d[leaves, i] - d[leaves, j])
            a, b = t[leaves, i, 1:], t[leaves, j, 1:]
            out[leaves, slot] = a + share[:, None] * (b - a)
    return out


def _chains(name: str, x: float, segments: Array, tolerance: float) -> list[Array]:
    """Segments joined end to start; a closed chain repeats its first point."""
    if len(segments) == 0:
        return []
    labels = merged_points(segments.reshape(-1, 2), tolerance).reshape(-1, 2)
    real = labels[:, 0] != labels[:, 1]
    labels, segments = labels[real], segments[real]
    following = {int(start): i for i, start in enumerate(labels[:, 0])}
    if len(following) < len(labels):
        raise ValueError(
            f"hull {name!r}: the outline of the section at x = {x:.6g} m touches itself; repair the surface "
            "there"
        )
    ends = set(labels[:, 1].tolist())
    heads = [i for start, i in following.items() if start not in ends]
    chains = []
    while following:
        i = heads.pop() if heads else next(iter(following.values()))
        chain = [segments[i, 0]]
        while (found := following.pop(int(labels[i, 0]), None)) is not None:
            chain.append(segments[found, 1])
            if (after := following.get(int(labels[found, 1]))) is None:
                break
            i = after
        chains.append(np.array(chain))
    return chains
