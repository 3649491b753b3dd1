"""Where loads hang in a recorded run: from the tip to the load, output by output."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from seacrane.figures.overview import payload_bodies
from seacrane.inputs.frames import rotation_matrix
from seacrane.result import Result

Array = NDArray[np.float64]
POSES = ("position", "quaternion")


def hanging_vectors(result: Result) -> dict[str, Array]:
    """From the upper to the lower end of the one link that each load hangs on, (n, 3), m, inertial axes.

    By body. Empty where the poses were not recorded, or a result notes no links.
    """
    if not set(POSES) <= set(result.channels):
        return {}
    links = result.about.outline.get("links", [])
    found = {}
    for body in payload_bodies(result):
        own = [link for link in links if link[2] == body]
        if len(own) == 1:
            first, first_point, _, point = own[0]
            found[body] = _place(result, body, point) - _place(result, first, first_point)
    return found


def swing(vector: Array) -> Array:
    """Angle (n,) of hanging vectors (n, 3) from straight down, rad."""
    return np.arctan2(np.hypot(vector[:, 0], vector[:, 1]), -vector[:, 2])


def _place(result: Result, body: str, point: Sequence[float]) -> Array:
    """Of a point given from a body's centre of mass; of the ground as it is."""
    at = np.asarray(point, dtype=float)
    if body not in result.coords["body"]:
        return at
    turn = rotation_matrix(result.select("quaternion", body=body))
    return np.asarray(result.select("position", body=body) + turn @ at)
