"""Clearances between named points and boxes: added and measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import GROUND, Description, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, shaped_of, text_of, texts_of

Array = NDArray[np.float64]
Vector = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class Clearance:
    """A box on a body, and the points whose distance from it is recorded; it exerts no load.

    Attributes
    ----------
    points : Named by `Scene.add_point`.
    body : That carries the box, or "ground".
    center : Of the box, coordinates of the body, m.
    size : Of the box, along the axes of the body, m; zero: a point, an edge or a plate.
    """

    name: str
    points: tuple[str, ...]
    body: str
    center: Vector
    size: Vector


def add_clearance(
    scene: Description,
    name: str,
    *,
    points: str | Sequence[str],
    body: str = GROUND,
    center: Any = (0.0, 0.0, 0.0),
    size: Any = (0.0, 0.0, 0.0),
) -> Clearance:
    """Record the distance of points from a box on another body: the channel clearance, negative inside.

    Parameters
    ----------
    name : str
        Along the dimension "gap" of the channel.
    points : str or sequence of str
        Named by `add_point`; of several the nearest counts.
    body : str
        That carries the box; default: the ground.
    center : array_like, shape (3,)
        Of the box, coordinates of the body, m.
    size : array_like, shape (3,)
        Of the box, along the axes of the body, m; default: none, the distance from a point.

    Raises
    ------
    SceneError
        For points or a body that are not there, or a size that is negative.
    """
    what = f"clearance {name_of('clearance', name)!r}"
    names = tuple(texts_of(f"{what}: points", [points] if isinstance(points, str) else points))
    if not names:
        raise SceneError(f"{what}: has no points; name at least one of add_point")
    for point in names:
        if point not in scene.points:
            known = ", ".join(map(repr, scene.points)) or "none"
            raise SceneError(
                f"{what}: there is no point {point!r}; add_point it first, the scene has {known}"
            )
    if text_of(f"{what}: body", body) not in scene.bodies and body != GROUND:
        raise SceneError(f"{what}: there is no body {body!r}; add it first")
    place, extent = (
        shaped_of(f"{what}: {key}", value, (3,)) for key, value in (("center", center), ("size", size))
    )
    if not np.all(np.isfinite(place)):
        raise SceneError(f"{what}: center is {place.tolist()}; give three finite numbers, m")
    if not (np.all(np.isfinite(extent)) and np.all(extent >= 0.0)):
        raise SceneError(f"{what}: size is {extent.tolist()} m; give three numbers that are not negative")
    element = Clearance(name=name, points=names, body=body, center=_vector(place), size=_vector(extent))
    inserted: Clearance = insert("clearance", scene.clearances, element)
    return inserted


def distance_from_box(points: Array, size: Vector) -> Array:
    """Distance of points (..., 3) in a box's frame about its centre, m; inside it is negative."""
    beyond = np.abs(points) - 0.5 * np.asarray(size)
    outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=-1)
    return np.asarray(outside + np.minimum(beyond.max(axis=-1), 0.0))


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z
