"""Closed meshes of simple shapes, triangles anticlockwise from outside."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import ConvexHull

from seacrane.arrays import Array


def hull_of(points: ArrayLike) -> Array:
    """Triangles (n, 3, 3) of the convex hull of points."""
    place = np.asarray(points, dtype=float)
    hull = ConvexHull(place)
    triangles = place[hull.simplices]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inwards = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0.0
    triangles[inwards] = triangles[inwards][:, ::-1]
    return np.asarray(triangles)


def volume_of(triangles: Array) -> float:
    return float(np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2]))) / 6.0


def box(size: ArrayLike) -> Array:
    """About the origin."""
    half = 0.5 * np.asarray(size, dtype=float)
    corners = np.stack(np.meshgrid([-1, 1], [-1, 1], [-1, 1], indexing="ij"), axis=-1).reshape(-1, 3)
    return hull_of(corners * half)


def sphere(radius: float, count: int = 162) -> Array:
    """With corners on a spiral, about the origin; of the volume of the sphere."""
    k = np.arange(count) + 0.5
    polar, around = np.arccos(1.0 - 2.0 * k / count), np.pi * (1.0 + np.sqrt(5.0)) * k
    z, across = np.cos(polar), np.sin(polar)
    triangles = hull_of(np.stack([across * np.cos(around), across * np.sin(around), z], axis=1))
    return np.asarray(radius * triangles * (4.0 / 3.0 * np.pi / volume_of(triangles)) ** (1.0 / 3.0))


def prism(section: ArrayLike, length: float) -> Array:
    """Along x about the origin, from a convex section (n, 2) in y and z."""
    outline = np.asarray(section, dtype=float)
    ends = [np.column_stack([np.full(len(outline), x), outline]) for x in (-0.5 * length, 0.5 * length)]
    return hull_of(np.concatenate(ends))


def wedge(deadrise_deg: float, height: float) -> Array:
    """A section (3, 2), its edge below."""
    half = height / np.tan(np.radians(deadrise_deg))
    return np.array([[0.0, 0.0], [half, height], [-half, height]])
