"""A body and a joint of a crane as plain values, in the frame of what carries it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False, kw_only=True)
class BodyRecord:
    """A body of the crane or its payload.

    Attributes
    ----------
    mass : float
        kg.
    inertia : ndarray, shape (3, 3)
        About the centre of mass, body axes, kg m2.
    center_of_mass : ndarray, shape (3,)
        From the body origin, body axes, m.
    position : ndarray, shape (3,)
        Body origin in the vessel frame, m.
    quaternion : ndarray, shape (4,)
        Scalar first, body to vessel frame.
    """

    name: str
    mass: float
    inertia: Array
    center_of_mass: Array
    position: Array
    quaternion: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class JointRecord:
    """A joint of the crane; points and axes in the vessel frame at the described pose, None where unused.

    Attributes
    ----------
    point : ndarray, shape (3,)
        Joint point, m; for "distance" the point on the first body.
    second_point : ndarray, shape (3,), or None
        Point on the second body of a "distance" joint.
    axis : ndarray, shape (3,), or None
        Joint axis; for "universal" the axis fixed on the first body.
    second_axis : ndarray, shape (3,), or None
        Axis of a "universal" joint fixed on the second body.
    length : float or None
        Of a "distance" joint, m.
    """

    name: str
    kind: str
    first: str
    second: str
    point: Array
    second_point: Array | None = None
    axis: Array | None = None
    second_axis: Array | None = None
    length: float | None = None
