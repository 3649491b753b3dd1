"""Distances of points from boxes, out of what the core records of bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.clearances import Clearance, distance_from_box
from seacrane.inputs.frames import rotation_matrix
from seacrane.run.hanging import position_of

if TYPE_CHECKING:
    from seacrane.description.scene import Description

Array = NDArray[np.float64]
NEEDED = ("position", "quaternion")


def clearances(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Clearances (time, gap), m; None where there is none, or the core recorded too little."""
    if not scene.clearances or not all(name in arrays for name in NEEDED):
        return None
    return np.stack([_clearance(scene, arrays, one) for one in scene.clearances.values()], axis=1)


def _clearance(scene: Description, arrays: Mapping[str, Array], gap: Clearance) -> Array:
    center = position_of(scene, arrays, gap.body, gap.center)
    turn = np.eye(3)[None]
    if gap.body in scene.bodies:
        turn = rotation_matrix(arrays["quaternion"][:, list(scene.bodies).index(gap.body)])
    found = []
    for name in gap.points:
        point = scene.points[name]
        away = position_of(scene, arrays, point.body, point.point) - center
        found.append(distance_from_box((away[:, None, :] @ turn)[:, 0], gap.size))
    return np.asarray(np.min(found, axis=0))
