"""Where a crane's tip, foot and load are, from the poses of all bodies."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import Description
from seacrane.description.roles import CraneRoles
from seacrane.errors import SceneError
from seacrane.inputs.frames import cross, rotation_matrix

Array = NDArray[np.float64]


def placed(
    scene: Description, body: str, point: Any, position: Array, quaternion: Array
) -> tuple[Array, Array]:
    """A point of a body (body coordinates, m) in inertial axes (..., 3), and the body's rotation.

    Parameters
    ----------
    position, quaternion : ndarray, shape (..., bodies, 3) and (..., bodies, 4)
        Centres of mass and attitudes of all bodies, in the scene's order.
    """
    at = np.asarray(point, dtype=float)
    if body not in scene.bodies:
        return at, np.eye(3)
    i = list(scene.bodies).index(body)
    turn = rotation_matrix(quaternion[..., i, :])
    return position[..., i, :] + turn @ (at - np.asarray(scene.bodies[body].center_of_mass)), turn


def tip_radius(scene: Description, roles: CraneRoles, position: Array, quaternion: Array) -> Array:
    """Distance (...) of the tip from the slew axis, m; SceneError for a crane without either."""
    if roles.slew is None or roles.tip is None:
        missing = "slew drive" if roles.slew is None else "tip"
        raise SceneError(
            f"crane {roles.prefix!r}: a radius is from the slew axis to the tip, and it has no {missing}; "
            "tell it by add_roles"
        )
    joint, (tip_body, tip_point) = scene.joints[roles.slew[0]], roles.tip
    foot, turn = placed(scene, joint.first, joint.first_frame.point, position, quaternion)
    tip, _ = placed(scene, tip_body, tip_point, position, quaternion)
    upward = turn @ np.asarray(joint.first_frame.axes)[:, 2]
    return np.asarray(np.linalg.norm(cross(upward, tip - foot), axis=-1))
