"""All that a crane brings into a scene, at one pose, in the frame of what carries it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.jointed_data import MeshData, RopeData
from seacrane.crane.records import BodyRecord, JointRecord
from seacrane.description.capacity import Capacity
from seacrane.description.cylinder_areas import Areas

Array = NDArray[np.float64]


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
        That bodies are drawn by, in body coordinates.
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
