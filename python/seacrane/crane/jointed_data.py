"""What a crane of bodies and joints is made of, as drawn in its home pose."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.mass_properties import MassProperties, Member
from seacrane.description.capacity import Capacity
from seacrane.description.cylinder_areas import Areas

Array = NDArray[np.float64]

FREEDOMS: Mapping[str, int] = {"weld": 0, "revolute": 1, "prismatic": 1, "universal": 2, "spherical": 3}
"""Coordinates of the kinds of joints that a crane may have."""
CLOSING = ("revolute", "universal", "spherical")


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshData:
    """What a body is drawn by: a file, or triangles.

    Attributes
    ----------
    vertices, faces : ndarray (n, 3) and (m, 3), or None
        m, in place of a file.
    scale : By which coordinates are multiplied to be m.
    origin, axes : ndarray (3,) and (3, 3)
        Of the mesh in the crane-foot frame at home.
    """

    name: str
    file: Path | None = None
    vertices: Array | None = None
    faces: NDArray[np.int64] | None = None
    scale: float = 1.0
    origin: Array
    axes: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class BodyData:
    """A rigid part of a crane, in the crane-foot frame at home.

    Attributes
    ----------
    properties : Its centre of mass from the crane foot, its inertia along the foot's axes.
    members : tuple of Tube or Box
        That it is made of and drawn by; empty where only its mass is known.
    meshes : That it is drawn by in their place.
    """

    name: str
    properties: MassProperties
    members: tuple[Member, ...] = ()
    meshes: tuple[MeshData, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class JointData:
    """A joint of a crane, in the crane-foot frame at home.

    Attributes
    ----------
    name, kind, first, second : str
        The kind is one of `FREEDOMS`; a joint of the tree carries its second body.
    point : (3,) m.
    axis, second_axis : ndarray, shape (3,), or None
        Unit vectors; the second one of a universal joint alone, fixed on the second body.
    range : (float, float) or None
        Of its coordinate from home, rad or m.
    """

    name: str
    kind: str
    first: str
    second: str
    point: Array
    axis: Array | None = None
    second_axis: Array | None = None
    range: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class RopeData:
    """A luffing rope between two bodies on both sides of a hinge.

    Attributes
    ----------
    name, luff : Its own, and the label of the hinge that it holds.
    falls : Parts of rope between the two blocks.
    EA : Axial stiffness of one part, N.
    first, second : (str, ndarray (3,))
        Bodies and blocks at home, crane-foot frame, m; the second one is beyond the hinge.
    """

    name: str
    luff: str
    falls: int
    EA: float
    first: tuple[str, Array]
    second: tuple[str, Array]


@dataclass(frozen=True, kw_only=True, eq=False)
class JointedData:
    """A crane as a tree of bodies and joints, joints that close loops, and the roles of its parts.

    Attributes
    ----------
    root : What stands on the base: a body, or a frame without mass that is the base itself.
    joints : tuple of JointData
        One for each body but the root, in an order in which each joint's first body is there already.
    slew : Joint of the slew drive.
    luffs, cylinders : mapping of str to str
        Hinges that raise and lower the jib, and sliding joints, by label.
    tip : (str, ndarray (3,))
        Its body, and its place at home, m.
    capacity, areas
        As of `CraneRoles`.
    hydraulics : mapping of str to mapping
        Keywords of `add_hydraulic_cylinder` by the labels of cylinders that the file says are hydraulic.
    """

    name: str
    root: str
    bodies: tuple[BodyData, ...]
    joints: tuple[JointData, ...]
    closing_joints: tuple[JointData, ...] = ()
    slew: str | None = None
    luffs: Mapping[str, str] = field(default_factory=dict)
    cylinders: Mapping[str, str] = field(default_factory=dict)
    tip: tuple[str, Array]
    ropes: tuple[RopeData, ...] = ()
    capacity: Capacity = ()
    areas: Mapping[str, Areas] = field(default_factory=dict)
    hydraulics: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    @property
    def coordinates(self) -> dict[str, str]:
        """Joint of every coordinate by its label: "slew", and those of luffs and cylinders."""
        slew = {} if self.slew is None else {"slew": self.slew}
        return slew | dict(self.luffs) | dict(self.cylinders)
