"""Where points of a contact are beside its surface."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from seacrane import _core

Array = NDArray[np.float64]
Pose = tuple[Array, Array]  # position (m), rotation


def beside_surface(contact: _core.Contact, point: int, pose: Callable[[str], Pose]) -> tuple[float, Array]:
    """How far a point is outside the surface (m; negative: inside), and the way out, inertial axes."""
    (at, turned), (base, tilted) = pose(contact.body), pose(contact.on)
    axes = tilted @ np.asarray(contact.axes)
    place = base + tilted @ np.asarray(contact.place)
    local = axes.T @ (at + turned @ np.asarray(contact.points[point]) - place)
    distance, way = contact.distance(local)
    return float(distance), axes @ np.asarray(way)


def elastic_force(contact: _core.Contact, depth: float) -> float:
    """N, of a point that is inside by `depth` (m); beyond a table its last slope goes on."""
    if depth <= 0.0:
        return 0.0
    if not len(contact.forces):
        return float(contact.stiffness) * depth
    x, f = np.asarray(contact.compressions), np.asarray(contact.forces)
    beyond = max(depth - float(x[-1]), 0.0)
    return float(np.interp(depth, x, f) + beyond * (f[-1] - f[-2]) / (x[-1] - x[-2]))
