"""What a crane brings into a scene at one pose: plain values, in the frame of what carries it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.data import MeshData, RopeData
from seacrane.description.roles import Areas, Capacity

Array = NDArray[np.float64]


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
        Body origin, m.
    quaternion : ndarray, shape (4,)
        Scalar first, body to base frame.
    """

    name: str
    mass: float
    inertia: Array
    center_of_mass: Array
    position: Array
    quaternion: Array


@dataclass(frozen=True, eq=False, kw_only=True)
class JointRecord:
    """A joint of the crane; points and axes at the described pose, None where unused.

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


@dataclass(frozen=True, kw_only=True, eq=False)
class CraneParts:
    """A crane at a pose, without its payload.

    Attributes
    ----------
    bodies, joints : The first joint welds it to its base, whose name is "".
    tip : (str, ndarray (3,))
        Its body, and its place, m.
    slew : Joint of the slew drive.
    luffs, cylinders : mapping of str to str
        Joints by label.
    ranges : mapping of str to (float, float)
        Where coordinates are meant to stay from the pose on, by joint.
    ropes : With their blocks at the pose.
    meshes : mapping of str to tuple of MeshData
        That bodies are drawn by.
    capacity, areas
        As of `CraneRoles`.
    """

    bodies: list[BodyRecord]
    joints: list[JointRecord]
    tip: tuple[str, Array]
    slew: str | None
    luffs: Mapping[str, str] = field(default_factory=dict)
    cylinders: Mapping[str, str] = field(default_factory=dict)
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    ropes: tuple[RopeData, ...] = ()
    meshes: Mapping[str, tuple[MeshData, ...]] = field(default_factory=dict)
    capacity: Capacity = ()
    areas: Mapping[str, Areas] = field(default_factory=dict)

    @property
    def drives(self) -> tuple[str, ...]:
        """Joints that something has to hold."""
        slew = () if self.slew is None else (self.slew,)
        return (*slew, *self.luffs.values(), *self.cylinders.values())
