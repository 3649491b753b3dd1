"""What an atlas measures errors in: points on all bodies, which tell of their turning too."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seacrane.accuracy.case import Case
from seacrane.accuracy.quantities import Quantity
from seacrane.accuracy.row import UNKNOWN, Row
from seacrane.arrays import Array
from seacrane.inputs.frames import rotation_matrix
from seacrane.result.result import Result

LEAST_MOTION = 1e-9  # m: what rests within it has no relative error


def points_on_bodies(position: Array, quaternion: Array) -> Array:
    """The centre of mass, and one metre from it along each body axis: (n, bodies, 4, 3), m."""
    axes = np.swapaxes(rotation_matrix(quaternion), -1, -2)
    return np.concatenate([position[..., None, :], position[..., None, :] + axes], axis=-2)


def _points(result: Result) -> Array:
    points = points_on_bodies(np.asarray(result["position"]), np.asarray(result["quaternion"]))
    return points.reshape(len(points), -1, 3)


POINTS = Quantity(name="points", unit="m", channels=("position", "quaternion"), values=_points)
QUANTITIES = {POINTS.name: POINTS}


def relative_error(row: Row) -> float:
    """The error over the motion; NaN where it rests."""
    return _over_motion(row, row.error(POINTS.name))


def relative_uncertainty(row: Row) -> float:
    """How far tight runs differ, over the motion; NaN where that is not known."""
    return _over_motion(row, row.uncertainty.get(POINTS.name, UNKNOWN))


def _over_motion(row: Row, value: float) -> float:
    motion = row.motion.get(POINTS.name, UNKNOWN)
    return value / motion if motion > LEAST_MOTION else UNKNOWN


@dataclass(frozen=True, kw_only=True, eq=False)
class KnownCase(Case):
    """A case whose points are known otherwise than by tight runs of the same scene."""

    truth: Array
