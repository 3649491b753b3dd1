"""What a crane is made of: bodies, joints and the roles of its parts, as drawn in its home pose."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.crane.mass_properties import MassProperties, Member
from seacrane.description.roles import Areas, Capacity
from seacrane.errors import SceneError
from seacrane.inputs.frames import euler_matrix
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown

FREEDOMS: Mapping[str, int] = {"weld": 0, "revolute": 1, "prismatic": 1, "universal": 2, "spherical": 3}
"""Coordinates of the kinds of joints that a crane may have."""
CLOSING = ("revolute", "universal", "spherical")


@dataclass(frozen=True, eq=False)
class Placed:
    """A frame by its axes (columns) and its origin, m; or a motion, x to axes x + origin."""

    axes: Array
    origin: Array

    def point(self, at: Array) -> Array:
        """A point of this frame in the frame that it is given in."""
        return np.asarray(self.axes @ at + self.origin)

    def inner(self, other: Placed) -> Placed:
        """A frame that is given in this one."""
        return Placed(self.axes @ other.axes, self.point(other.origin))


def placed(origin: Array, turns: Array) -> Placed:
    """A frame by its origin (m) and its turns about the fixed axes x, y, z (rad), as URDF has them."""
    return Placed(euler_matrix(-turns).T, origin)


HOME = Placed(np.eye(3), np.zeros(3))
"""The frame of the crane foot, and no motion."""


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshData:
    """What a body is drawn by, in a frame of the body's: a file with its scale to m, or triangles (n, 3), m,
    with faces (m, 3)."""

    name: str
    file: Path | None = None
    vertices: Array | None = None
    faces: NDArray[np.int64] | None = None
    scale: float = 1.0
    frame: Placed


@dataclass(frozen=True, kw_only=True, eq=False)
class BodyData:
    """A rigid part of a crane, in its own frame, which is given in that of the crane foot at home.

    It is made of and drawn by its members, which are empty where only its mass is known; `meshes` draw it in
    their place.
    """

    name: str
    properties: MassProperties
    frame: Placed = HOME
    members: tuple[Member, ...] = ()
    meshes: tuple[MeshData, ...] = ()

    @property
    def center(self) -> Array:
        """Centre of mass from the crane foot at home, m."""
        return self.frame.point(self.properties.center_of_mass)

    def shifted(self, origin: Array) -> BodyData:
        """With the origin of its frame, which was the crane foot, elsewhere (m)."""
        given = self.properties

        def moved(point: Iterable[float]) -> tuple[float, ...]:
            return tuple((np.array(point) - origin).tolist())

        return replace(
            self, properties=replace(given, center_of_mass=given.center_of_mass - origin),
            frame=Placed(np.eye(3), origin),
            members=tuple(replace(one, start=moved(one.start), end=moved(one.end)) for one in self.members),
            meshes=tuple(
                replace(one, frame=Placed(one.frame.axes, one.frame.origin - origin)) for one in self.meshes
            ),
        )  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class JointData:
    """A joint of a crane, in the crane-foot frame at home, or at a pose in the frame of its base.

    Attributes
    ----------
    name, kind, first, second : The kind is one of `FREEDOMS`; a joint of the tree carries its second body.
    point : (3,) m.
    second_point : (3,) Of the link of a payload, a distance joint, on the payload.
    axis, second_axis : ndarray, shape (3,), or None
        Unit vectors; the second one of a universal joint alone, fixed on the second body.
    range : Of its coordinate from home, rad or m.
    closes : Whether it closes a loop, and carries nothing.
    """

    name: str
    kind: str
    first: str
    second: str
    point: Array
    second_point: Array | None = None
    axis: Array | None = None
    second_axis: Array | None = None
    range: tuple[float, float] | None = None
    closes: bool = False

    @cached_property
    def crossing(self) -> tuple[tuple[Array, Array], ...]:
        """Axes at home, one on each body, that a closing joint keeps perpendicular."""
        if self.axis is None:
            return ()
        if self.second_axis is not None:
            return ((self.axis, self.second_axis),)
        across = np.eye(3)[np.argmin(np.abs(self.axis))]
        beside = np.cross(self.axis, across) / np.linalg.norm(np.cross(self.axis, across))
        return (beside, self.axis), (np.cross(self.axis, beside), self.axis)


@dataclass(frozen=True, kw_only=True, eq=False)
class RopeData:
    """As `LuffingRope`, by the label of the hinge that it holds; blocks at home, crane-foot frame, m."""

    name: str
    luff: str
    falls: int
    EA: float
    first: tuple[str, Array]
    second: tuple[str, Array]


@dataclass(frozen=True, kw_only=True, eq=False)
class CraneData:
    """A crane as a tree of bodies and joints, joints that close loops, and the roles of its parts.

    Attributes
    ----------
    root : What stands on the base: a body, or a frame without mass that is the base itself.
    joints : tuple of JointData
        Of the tree one for each body but the root, each after what carries its first body; and those that
        close loops.
    slew : Joint of the slew drive.
    luffs, cylinders : Hinges that raise and lower the jib, and sliding joints, by label.
    tip : Its body, and its place at home, m.
    capacity, areas
        As of `CraneRoles`.
    hydraulics : mapping of str to mapping
        Keywords of `add_hydraulic_cylinder` by the labels of cylinders that the file says are hydraulic.
    """

    name: str
    root: str
    bodies: tuple[BodyData, ...]
    joints: tuple[JointData, ...]
    slew: str | None = None
    luffs: Mapping[str, str] = field(default_factory=dict)
    cylinders: Mapping[str, str] = field(default_factory=dict)
    tip: tuple[str, Array]
    ropes: tuple[RopeData, ...] = ()
    capacity: Capacity = ()
    areas: Mapping[str, Areas] = field(default_factory=dict)
    hydraulics: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    @cached_property
    def tree(self) -> dict[str, JointData]:
        """Joints that carry a body, by name."""
        return ReadOnly({joint.name: joint for joint in self.joints if not joint.closes})

    @cached_property
    def closing_joints(self) -> tuple[JointData, ...]:
        """Joints that close loops."""
        return tuple(joint for joint in self.joints if joint.closes)

    @property
    def coordinates(self) -> dict[str, str]:
        """Joint of every coordinate by its label: "slew", and those of luffs and cylinders."""
        slew = {} if self.slew is None else {"slew": self.slew}
        return slew | dict(self.luffs) | dict(self.cylinders)

    def led_by(self, label: str) -> JointData:
        """Joint of a coordinate by its label, of cylinders also "s1", "s2"; SceneError for none."""
        known = self.coordinates
        short = {f"s{place}": joint for place, joint in enumerate(self.cylinders.values(), 1)}
        name = (short | known).get(label)
        if name is None:
            raise SceneError(
                f"crane {self.name!r}: has no coordinate {shown(label)}; it has "
                f"{', '.join(map(repr, known)) or 'none'}"
            )
        return self.tree[name]

    def beyond(self, joint: str) -> set[str]:
        """Bodies beyond a joint of the tree."""
        found: set[str] = set()
        for one in self.tree.values():
            if one.name == joint or one.first in found:
                found.add(one.second)
        return found

    def at_joints(self) -> CraneData:
        """With the frames of bodies that have none of their own at the joints that carry them."""
        carried = {joint.second: joint.point for joint in self.tree.values()}
        bodies = tuple(
            one.shifted(carried.get(one.name, np.zeros(3))) if one.frame is HOME else one
            for one in self.bodies
        )
        return replace(self, bodies=bodies)
