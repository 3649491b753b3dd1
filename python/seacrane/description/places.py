"""Where points of bodies are as a scene describes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import GROUND, Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import shaped_of, text_of
from seacrane.inputs.frames import rotation_matrix


def place_of(scene: Description, *, body: str, point: Any = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """Where a point of a body is in the pose described, in the inertial frame, m.

    What hangs below a crane's tip is placed by it: ``body, point = scene.roles[""].tip``.

    Parameters
    ----------
    body : str
        Of the scene, or "ground".
    point : array_like, shape (3,)
        In the coordinates of the body, m; default: its origin.

    Returns
    -------
    ndarray, shape (3,)

    Raises
    ------
    SceneError
        For a body that is not in the scene, or a point that is not three numbers.
    """
    name = text_of("place: body", body)
    local = np.array(shaped_of(f"place on {name!r}: point", point, (3,)))
    if name != GROUND and name not in scene.bodies:
        known = ", ".join(map(repr, scene.bodies)) or "none"
        raise SceneError(f"place: there is no body {name!r}, the scene has {known}; add it first")
    return placed(scene, name, local)


def placed(scene: Description, body: str, point: Any) -> NDArray[np.float64]:
    """As `place_of`; whatever is no body is the ground."""
    local = np.asarray(point, dtype=float)
    if body not in scene.bodies:
        return local
    held = scene.bodies[body]
    return np.asarray(np.asarray(held.position) + rotation_matrix(held.quaternion) @ local)
