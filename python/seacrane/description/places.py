"""Where points of bodies are as a scene describes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import GROUND, Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import shaped_of, text_of
from seacrane.inputs.frames import rotation_matrix

ORIGIN = (0.0, 0.0, 0.0)


def apart(scene: Description, what: str, *ends: tuple[str, Any]) -> float:
    """Distance of two points of bodies as described, m; SceneError for a body that is not there."""
    for body, _ in ends:
        if body != GROUND and body not in scene.bodies:
            raise SceneError(f"{what}: there is no body {body!r}; add it first")
    first, second = (placed(scene, *end) for end in ends)
    return float(np.linalg.norm(second - first))


def place_of(scene: Description, body: str, point: Any = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """Where a point is in the pose described, in the inertial frame, m.

    What hangs below a crane's tip is placed by it: ``x, y, z = scene.place_of("tip")``.

    Parameters
    ----------
    body : str
        Of the scene, or "ground". In its place the name of one of the scene's points, or "tip", after the
        prefix of its crane; a body of that name comes first.
    point : array_like, shape (3,)
        In the coordinates of the body, m; default: its origin.

    Returns
    -------
    ndarray, shape (3,)

    Raises
    ------
    SceneError
        For a name that is not in the scene, or a point that is not three numbers.
    """
    return placed(scene, *on_body(scene, "place", body, point))


def on_body(scene: Description, what: str, name: str, point: Any) -> tuple[str, NDArray[np.float64]]:
    """A body and a point in its coordinates, m, of a body by its name or a point by its own.

    Raises SceneError as `place_of`.
    """
    name = text_of(f"{what}: body", name)
    offset = np.array(shaped_of(f"{what} on {name!r}: point", point, (3,)))
    if name == GROUND or name in scene.bodies:
        return name, offset
    named = _points(scene)
    if name in named:
        body, own = named[name]
        return body, np.asarray(own, dtype=float) + offset
    bodies = ", ".join(map(repr, scene.bodies)) or "none"
    points = f", and points {', '.join(map(repr, named))}" if named else ""
    raise SceneError(f"{what}: there is no body {name!r}, the scene has {bodies}{points}; add it first")


def _points(scene: Description) -> dict[str, tuple[str, Any]]:
    """Points by name: tips of cranes, and what is recorded."""
    tips = {f"{one.prefix}tip": one.tip for one in scene.roles.values() if one.tip is not None}
    return tips | {name: (one.body, one.point) for name, one in scene.points.items()}


def placed(scene: Description, body: str, point: Any) -> NDArray[np.float64]:
    """As `place_of`; whatever is no body is the ground."""
    local = np.asarray(point, dtype=float)
    if body not in scene.bodies:
        return local
    held = scene.bodies[body]
    return np.asarray(np.asarray(held.position) + rotation_matrix(held.quaternion) @ local)
