"""Bodies of a scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.scene import Description, insert
from seacrane.inputs.checked import name_of, numbers_of, shaped_of


def add_body(
    scene: Description,
    *,
    name: str,
    mass: float,
    inertia: Any,
    center_of_mass: Any = (0.0, 0.0, 0.0),
    position: Any = (0.0, 0.0, 0.0),
    quaternion: Any = (1.0, 0.0, 0.0, 0.0),
    velocity: Any = (0.0, 0.0, 0.0),
    angular_velocity: Any = (0.0, 0.0, 0.0),
    gravity: bool = True,
) -> _core.Body:
    """Add a rigid body.

    Parameters
    ----------
    name : str
    mass : float
        kg.
    inertia : array_like, shape (3, 3) or (3,)
        About the centre of mass in body axes, kg m2; three values are the diagonal.
    center_of_mass : array_like, shape (3,)
        From the body origin in body axes, m.
    position, quaternion : array_like
        Start pose of the body origin in the inertial frame; quaternion (w, x, y, z), body to inertial.
    velocity, angular_velocity : array_like, shape (3,)
        Of the body origin at the start, inertial axes, m/s and rad/s.
    gravity : bool
        Whether weight acts on it. The body of a vessel never gets weight: its restoring carries it.

    Raises
    ------
    SceneError
        For a duplicate name or a value that is not of that shape; values are checked at compile().
    """
    tensor = numbers_of(f"body {name_of('body', name)!r}: inertia", inertia)
    tensor = np.diag(tensor) if tensor.shape == (3,) else tensor
    body = _core.Body(
        name=name,
        mass=mass,
        inertia=shaped_of(f"body {name!r}: inertia", tensor, (3, 3)),
        center_of_mass=center_of_mass,
        position=position,
        quaternion=quaternion,
        velocity=velocity,
        angular_velocity=angular_velocity,
        gravity=gravity,
    )
    inserted: _core.Body = insert("body", scene.bodies, body)
    return inserted
