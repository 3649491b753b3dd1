"""What a crane brings into a scene at one pose: plain values, in the frame of what carries it.

Its bodies and joints, what hangs on it, and the spring at its slew bearing by which it leans.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.data import MeshData, RopeData
from seacrane.description.roles import Areas, Capacity
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, positive_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import warn_of_density

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
SWING_RATIO = 0.005  # of critical damping of a swinging load: an estimate
BOX_DRAG = 1.05  # C_D of a cube with a face to the flow: Hoerner, Fluid-Dynamic Drag (1965)
FOOT, STRUCTURE = "structure foot", "structure"  # a body; and joint and spring
SHARE = 1e-3  # of the column's mass, which its foot has: it slews with it, and leans with nothing
DAMPING = 0.02  # of critical, of the lean; an estimate
FAR = 2e5  # m, of the spring's upper end: it keeps its direction, and is no part of pictures
LEAST_RADIUS = 0.1  # m
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False, kw_only=True)
class BodyRecord:
    """A body of the crane or its payload.

    Attributes
    ----------
    mass : kg.
    inertia : (3, 3) about the centre of mass, body axes, kg m2.
    center_of_mass : (3,) from the body origin, body axes, m.
    position : (3,) body origin, m.
    quaternion : (4,) scalar first, body to base frame.
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
    point : (3,) joint point, m; for "distance" the point on the first body.
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


@named
@dataclass(frozen=True, kw_only=True)
class Payload:
    """A uniform box hanging on a link of constant length from the crane tip, attached at its top's centroid.

    Attributes
    ----------
    mass : float
        kg.
    size : (float, float, float)
        Edges along body x, y and z, m.
    link_length : float
        Tip to the centroid of the top, m.
    swing_damping_ratio : float
        Of critical damping of its swing, as in `Scene.add_pendulum_damping`; 0 is none. Default: an estimate.
    drag_coefficient : float
        C_D of the box in still air, as in `Scene.add_wind`; 0 is no drag. Default 1.05 (Hoerner 1965).

    Warns
    -----
    MassUnitWarning
        Lighter than foam: tonnes given for kg.
    """

    mass: float = 10.0e3
    size: Vector = (6.0, 6.0, 4.0)
    link_length: float = 8.0
    swing_damping_ratio: float = SWING_RATIO
    drag_coefficient: float = BOX_DRAG

    def __post_init__(self) -> None:
        values = {"mass": self.mass, "link_length": self.link_length}
        values |= {f"size[{index}]": edge for index, edge in enumerate(self.size)}
        for name, given in values.items():
            positive_of(f"payload: {name}", given)
        for name in ("swing_damping_ratio", "drag_coefficient"):
            not_negative_of(f"payload: {name}", getattr(self, name))
        warn_of_density("payload", self.mass, math.prod(self.size))

    @property
    def inertia(self) -> Array:
        """About the centre of mass, body axes, shape (3, 3), kg m2."""
        x, y, z = (edge**2 for edge in self.size)
        return np.diag([y + z, z + x, x + y]) * (self.mass / 12.0)

    def under(self, tip: Array) -> BodyRecord:
        """Hanging at rest under a tip, its frame at its centre, along the frame of the tip's coordinates."""
        drop = self.link_length + self.size[2] / 2.0
        return BodyRecord(
            name="payload",
            mass=self.mass,
            inertia=self.inertia,
            center_of_mass=np.zeros(3),
            position=tip - np.array([0.0, 0.0, drop]),
            quaternion=np.array([1.0, 0.0, 0.0, 0.0]),
        )

    def link(self, tip: Array, body: str) -> JointRecord:
        """From a tip and its body to the centroid of the top."""
        return JointRecord(
            name="link",
            kind="distance",
            first=body,
            second="payload",
            point=tip.copy(),
            second_point=tip - np.array([0.0, 0.0, self.link_length]),
            length=self.link_length,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Lean:
    """How a crane leans, at its described pose, in the frame of its base.

    Attributes
    ----------
    first, second : What stands ("" the base), and what leans.
    point : (3,) where the spring pulls: as far out as the tip, at the hinge's height, m.
    weight : Of a mass at the tip that has the moment of all that leans, kg.
    inertia : Mass at the tip with the moment of inertia of all that leans, kg.
    """

    first: str
    second: str
    point: Array
    weight: float
    inertia: float

    def damping(self, stiffness: float) -> float:
        """Of the spring, N s/m."""
        return 2.0 * DAMPING * math.sqrt(stiffness * self.inertia)


def leaning(parts: CraneParts) -> tuple[CraneParts, Lean]:
    """The crane with a hinge at the slew bearing, or at its foot, across the plane through axis and tip.

    Raises
    ------
    SceneError
        For a tip over the hinge, which no lean moves up or down.
    """
    bearing = next((joint for joint in parts.joints if joint.name == parts.slew), parts.joints[0])
    beyond = _beyond(parts, bearing)
    upper, lower = (
        (bearing.second, bearing.first) if bearing.second in beyond else (bearing.first, bearing.second)
    )
    out = parts.tip[1] - bearing.point
    out[2] = 0.0
    radius = float(np.linalg.norm(out))
    if radius < LEAST_RADIUS:
        raise SceneError(
            "crane: its tip is over its foot, where a stiffness at the tip says nothing; luff it out"
        )
    out /= radius
    axis = np.cross(out, UP)
    hinge = JointRecord(
        name=STRUCTURE, kind="revolute", first=FOOT, second=upper, point=bearing.point.copy(), axis=axis
    )
    if parts.slew is None:
        hinge = replace(hinge, first=lower)
    hinged = _hinged(parts, bearing, hinge)
    moved = [body for body in hinged.bodies if body.name in beyond]
    levers = [_center(body) - bearing.point for body in moved]
    about = sum(
        body.mass * float(np.sum(np.cross(axis, lever) ** 2)) + float(_along(body, axis))
        for body, lever in zip(moved, levers, strict=True)
    )
    moment = sum(body.mass * float(out @ lever) for body, lever in zip(moved, levers, strict=True))
    lean = Lean(
        first=hinge.first, second=upper, point=bearing.point + radius * out, weight=moment / radius,
        inertia=about / radius**2,
    )  # fmt: skip
    return hinged, lean


def _hinged(parts: CraneParts, bearing: JointRecord, hinge: JointRecord) -> CraneParts:
    """With the hinge over a foot that slews, or in place of the first joint of a crane that does not."""
    bodies, joints = list(parts.bodies), list(parts.joints)
    at = joints.index(bearing)
    if parts.slew is None:
        joints[at] = hinge
    else:
        k = next(i for i, body in enumerate(bodies) if body.name == hinge.second)
        bodies[k : k + 1] = _parted(bodies[k])
        below = bearing.first == hinge.second
        standing = replace(bearing, first=FOOT) if below else replace(bearing, second=FOOT)
        joints[at : at + 1] = [standing, hinge]
    return replace(parts, bodies=bodies, joints=joints)


def _beyond(parts: CraneParts, bearing: JointRecord) -> set[str]:
    """Bodies that hold together with the tip's without the bearing."""
    found, ahead = set[str](), [parts.tip[0]]
    others = [joint for joint in parts.joints if joint is not bearing]
    while ahead:
        body = ahead.pop()
        if body not in found:
            found.add(body)
            for joint in others:
                if body in (joint.first, joint.second):
                    ahead += [joint.first, joint.second]
    return found


def _parted(body: BodyRecord) -> list[BodyRecord]:
    """Its foot, and the rest: together of the same mass, centre and inertia."""
    shares = {FOOT: SHARE, body.name: 1.0 - SHARE}
    return [
        replace(body, name=name, mass=share * body.mass, inertia=share * np.asarray(body.inertia))
        for name, share in shares.items()
    ]


def _center(body: BodyRecord) -> Array:
    return np.asarray(body.position + rotation_matrix(body.quaternion) @ body.center_of_mass)


def _along(body: BodyRecord, axis: Array) -> float:
    """Moment of inertia about its centre along an axis, kg m2."""
    own = rotation_matrix(body.quaternion).T @ axis
    return float(own @ np.asarray(body.inertia) @ own)
