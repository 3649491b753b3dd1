"""What bodies look like: tubes, boxes and meshes in body axes, relative to the centre of mass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Triple = Sequence[float] | Array


@dataclass(frozen=True, kw_only=True, eq=False)
class TubeShape:
    """A round bar between two points, m."""

    start: Array
    end: Array
    radius: float
    colour: str = ""

    @property
    def points(self) -> Array:
        """(2, 3)."""
        return np.array([self.start, self.end])

    def data(self) -> dict[str, Any]:
        """For the page."""
        ends = [*plain(self.start), *plain(self.end)]
        return {"kind": "tube", "ends": ends, "radius": float(f"{self.radius:.4g}"), "colour": self.colour}


@dataclass(frozen=True, kw_only=True, eq=False)
class BoxShape:
    """A box of edges `size` (3,) along the columns of `axes` (3, 3) about `centre`, m."""

    centre: Array
    axes: Array
    size: Array
    colour: str = ""

    @property
    def points(self) -> Array:
        """(8, 3), its corners."""
        signs = np.array(np.meshgrid(*[(-0.5, 0.5)] * 3)).reshape(3, 8).T
        return np.asarray(self.centre + (signs * self.size) @ self.axes.T)

    def data(self) -> dict[str, Any]:
        """For the page."""
        numbers = {"centre": self.centre, "axes": np.asarray(self.axes).T, "size": self.size}
        return {"kind": "box", "colour": self.colour} | {key: plain(value) for key, value in numbers.items()}


@dataclass(frozen=True, kw_only=True, eq=False)
class HullShape:
    """Triangles `faces` (m, 3) of `vertices` (n, 3), m, with the still waterline at height `waterline`."""

    vertices: Array
    faces: NDArray[np.intp]
    waterline: float

    @property
    def points(self) -> Array:
        """(n, 3)."""
        return self.vertices


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshShape:
    """Triangles `faces` (m, 3) of `vertices` (n, 3), m, of one colour."""

    vertices: Array
    faces: NDArray[np.int64]
    colour: str = ""

    @property
    def points(self) -> Array:
        """(n, 3)."""
        return self.vertices


Shape = TubeShape | BoxShape | HullShape | MeshShape


def plain(values: Any) -> list[float]:
    """Numbers to a tenth of a millimetre."""
    return [round(float(value), 4) + 0.0 for value in np.ravel(values)]


def equivalent_box(mass: float, inertia: Array) -> BoxShape:
    """The uniform box with this mass (kg) and inertia (3, 3), kg m2, about its centre."""
    moments, axes = _principal(np.asarray(inertia, dtype=float))
    squares = 6.0 / mass * (moments.sum() - 2.0 * moments) if mass > 0.0 else np.zeros(3)
    return BoxShape(centre=np.zeros(3), axes=axes, size=np.sqrt(np.maximum(squares, 0.0)))


def _principal(inertia: Array) -> tuple[Array, Array]:
    """Moments and right-handed axes (columns); the body's own axes where the inertia is diagonal."""
    diagonal = np.diag(np.diag(inertia))
    if np.allclose(inertia, diagonal, rtol=0.0, atol=1e-9 * float(np.abs(inertia).max(initial=0.0))):
        return np.diag(inertia).copy(), np.eye(3)
    moments, axes = np.linalg.eigh(inertia)
    return moments, axes * np.array([1.0, 1.0, np.sign(np.linalg.det(axes))])


def framework(points: Array, radius: float) -> list[TubeShape]:
    """Tubes that join points (n, 3) by the shortest total length."""
    joined, left, tubes = [0], list(range(1, len(points))), []
    while left:
        gaps = np.linalg.norm(points[joined][:, None] - points[left][None], axis=-1)
        a, b = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
        start, end = joined[int(a)], left.pop(int(b))
        tubes.append(TubeShape(start=points[start], end=points[end], radius=radius))
        joined.append(end)
    return tubes


def distinct(points: Sequence[Any], apart: float = 1e-3) -> Array:
    """Points (n, 3) without those nearer than `apart` (m) to an earlier one."""
    kept: list[Array] = []
    for point in points:
        array = np.asarray(point, dtype=float).reshape(3)
        if all(float(np.linalg.norm(array - other)) > apart for other in kept):
            kept.append(array)
    return np.array(kept).reshape(-1, 3)
