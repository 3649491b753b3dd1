"""A crane of bodies and joints: lattice booms, A-frames, gantries, robots' arms."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.jointed_data import BodyData, JointData, JointedData, MeshData, RopeData
from seacrane.crane.jointed_pose import UNITS, Moved, pose_of
from seacrane.crane.mass_properties import MassProperties, Member
from seacrane.crane.parts import CraneParts
from seacrane.crane.records import BodyRecord, JointRecord
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import numbers_of
from seacrane.inputs.frames import quaternion_of

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
ROUNDING = 1e-9  # rad or m


@dataclasses.dataclass(frozen=True, eq=False)
class JointedCrane:
    """A crane of bodies and joints, from its data. Make one with `load_crane`.

    Coordinates are those of its joints from the pose in which it is drawn, its home: rad and m, by the labels
    "slew" and those of its luffs and cylinders. Body frames have their origins at the joints that carry them
    and lie along the crane-foot frame at home.

    Attributes
    ----------
    mass_properties : mapping of str to MassProperties
        Of every body, in its own frame.
    """

    data: JointedData
    mass_properties: Mapping[str, MassProperties] = dataclasses.field(init=False)

    __repr__ = brief

    def __post_init__(self) -> None:
        found = {}
        for body in self.data.bodies:
            given = body.properties
            found[body.name] = MassProperties(
                given.mass, given.center_of_mass - self._origin(body.name), given.inertia
            )
        object.__setattr__(self, "mass_properties", found)

    @property
    def mass(self) -> float:
        """The mass of all bodies, kg."""
        return math.fsum(body.properties.mass for body in self.data.bodies)

    def tip(self, *, coordinates: Mapping[str, float] | None = None) -> Array:
        """The tip in the crane-foot frame, shape (3,), m.

        Raises
        ------
        SceneError
            As of `parts`.
        """
        body, point = self.data.tip
        return pose_of(self.data, coordinates or {})[body].point(point)

    def parts(self, *, foot: Vector | Array, coordinates: Mapping[str, float] | None = None) -> CraneParts:
        """All that it brings into a scene, at a pose.

        Parameters
        ----------
        foot : array_like, shape (3,)
            Crane foot in the frame of its base, m.
        coordinates : mapping of str to float, optional
            From home, rad or m, by label; those that are not given stay there or follow a loop.

        Raises
        ------
        SceneError
            For an unknown coordinate, a value out of its range, or a loop that cannot close.
        """
        at, given = _point("foot", foot), coordinates or {}
        moved = pose_of(self.data, given)
        decks = [
            JointRecord(name="deck", kind="weld", first="", second=body.name, point=at.copy())
            for body in self.data.bodies
            if body.name == self.data.root
        ]
        joints = [*self.data.joints, *self.data.closing_joints]
        body, tip = self.data.tip
        return CraneParts(
            bodies=[self._body(one, at, moved[one.name]) for one in self.data.bodies],
            joints=[*decks, *(self._joint(joint, at, moved) for joint in joints)],
            tip=(body, at + moved[body].point(tip)),
            slew=self.data.slew,
            luffs=dict(self.data.luffs),
            cylinders=dict(self.data.cylinders),
            ranges=self._ranges(moved),
            ropes=tuple(_rope(rope, at, moved) for rope in self.data.ropes),
            meshes={
                one.name: tuple(self._mesh(one.name, mesh) for mesh in one.meshes)
                for one in self.data.bodies
                if one.meshes
            },
            capacity=self.data.capacity,
            areas=dict(self.data.areas),
        )

    def members(self) -> dict[str, tuple[Member, ...]]:
        """That bodies are made of, from each body's origin along its own axes."""
        return {
            body.name: tuple(self._member(body.name, member) for member in body.members)
            for body in self.data.bodies
            if body.members
        }

    def slide(self, label: str) -> tuple[str, str]:
        """Barrel and rod of a cylinder, by its label."""
        name = self.data.cylinders[label]
        return next((joint.first, joint.second) for joint in self.data.joints if joint.name == name)

    def member_of(self, body: str) -> tuple[Member, ...]:
        """Members of a body, as drawn; none of one that is not drawn by members."""
        return next((one.members for one in self.data.bodies if one.name == body), ())

    def in_body(self, body: str, point: Array) -> Array:
        """A point of the home pose in the coordinates of a body, m."""
        return np.asarray(point - self._origin(body))

    def _origin(self, body: str) -> Array:
        """The origin of a body's frame at home, m."""
        carried = [joint.point for joint in self.data.joints if joint.second == body]
        return carried[0] if carried else np.zeros(3)

    def _body(self, body: BodyData, foot: Array, moved: Moved) -> BodyRecord:
        properties = self.mass_properties[body.name]
        return BodyRecord(
            name=body.name,
            mass=properties.mass,
            inertia=properties.inertia.copy(),
            center_of_mass=properties.center_of_mass.copy(),
            position=foot + moved.point(self._origin(body.name)),
            quaternion=quaternion_of(moved.rotation),
        )

    def _member(self, body: str, member: Member) -> Member:
        origin = self._origin(body)
        start, end = (tuple((np.array(p) - origin).tolist()) for p in (member.start, member.end))
        return dataclasses.replace(member, start=start, end=end)

    def _mesh(self, body: str, mesh: MeshData) -> MeshData:
        return dataclasses.replace(mesh, origin=mesh.origin - self._origin(body))

    def _joint(self, joint: JointData, foot: Array, moved: Mapping[str, Moved]) -> JointRecord:
        first, second = moved[joint.first], moved[joint.second]
        massless = {self.data.root: ""} if self.data.root not in self.mass_properties else {}
        return JointRecord(
            name=joint.name,
            kind=joint.kind,
            first=massless.get(joint.first, joint.first),
            second=massless.get(joint.second, joint.second),
            point=foot + first.point(joint.point),
            axis=None if joint.axis is None else first.rotation @ joint.axis,
            second_axis=None if joint.second_axis is None else second.rotation @ joint.second_axis,
        )

    def _ranges(self, moved: Mapping[str, Moved]) -> dict[str, tuple[float, float]]:
        """From the pose on; SceneError for a pose that is out of one."""
        found = {}
        for joint in self.data.joints:
            if joint.range is not None:
                value, (low, high) = _coordinate(joint, moved), joint.range
                if not low - ROUNDING <= value <= high + ROUNDING:
                    raise SceneError(
                        f"crane {self.data.name!r}: joint {joint.name!r} is at {value:g} {UNITS[joint.kind]} "
                        f"in this pose, outside its range of {low:g} to {high:g}; give coordinates within"
                    )
                found[joint.name] = (min(low - value, 0.0), max(high - value, 0.0))
        return found


def _coordinate(joint: JointData, moved: Mapping[str, Moved]) -> float:
    """The coordinate of a hinge or a slide, from home."""
    first, second = moved[joint.first], moved[joint.second]
    assert joint.axis is not None
    relative = first.rotation.T @ second.rotation
    if joint.kind == "prismatic":
        shift = first.rotation.T @ (second.point(joint.point) - first.point(joint.point))
        return float(shift @ joint.axis)
    sine = 0.5 * np.array([relative[2, 1] - relative[1, 2], relative[0, 2] - relative[2, 0],
                           relative[1, 0] - relative[0, 1]]) @ joint.axis  # fmt: skip
    return math.atan2(float(sine), 0.5 * (float(np.trace(relative)) - 1.0))


def _rope(rope: RopeData, foot: Array, moved: Mapping[str, Moved]) -> RopeData:
    ends = [(body, foot + moved[body].point(at)) for body, at in (rope.first, rope.second)]
    return dataclasses.replace(rope, first=ends[0], second=ends[1])


def _point(name: str, value: Vector | Array) -> Array:
    point = numbers_of(f"crane: {name}", value).copy()
    if point.shape != (3,) or not np.all(np.isfinite(point)):
        raise SceneError(f"crane: {name} is {value!r}; give three finite numbers (x, y, z) in m.")
    return point
