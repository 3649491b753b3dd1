"""What a crane brings into a scene at one pose: plain values, in the frame of what carries it.

Its bodies and joints, what hangs on it, and the spring at its slew bearing by which it leans.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.crane.data import JointData, RopeData
from seacrane.description.loads import changed
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, positive_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import warn_of_density

Vector = tuple[float, float, float]
SWING_RATIO = 0.005  # of critical damping of a swinging load: an estimate
BOX_DRAG = 1.05  # C_D of a cube with a face to the flow: Hoerner, Fluid-Dynamic Drag (1965)
FOOT, STRUCTURE = "structure foot", "structure"  # a body; and joint and spring
SHARE = 1e-3  # of the column's mass, which its foot has: it slews with it, and leans with nothing
DAMPING = 0.02  # of critical, of the lean; an estimate
FAR = 2e5  # m, of the spring's upper end: it keeps its direction, and is no part of pictures
LEAST_RADIUS = 0.1  # m
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, kw_only=True, eq=False)
class CraneParts:
    """A crane at a pose, without its payload: what differs from its data; in the frame of its base, m, rad.

    The first joint welds it to its base, whose name is "". `tip` is a body and a place; `ranges` are where
    coordinates are meant to stay from the pose on, by joint.
    """

    bodies: list[_core.Body]
    joints: list[JointData]
    tip: tuple[str, Array]
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    ropes: tuple[RopeData, ...] = ()


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
        Of critical damping of its swing, as in `Scene.add_spring`; 0 is none. Default: an estimate.
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

    def under(self, tip: Array) -> _core.Body:
        """Hanging at rest under a tip, its frame at its centre, along the frame of the tip's coordinates."""
        drop = self.link_length + self.size[2] / 2.0
        return _core.Body(name="payload", mass=self.mass, inertia=self.inertia, position=tip - drop * UP)

    def link(self, tip: Array, body: str) -> JointData:
        """From a tip and its body to the centroid of the top."""
        return JointData(
            name="link", kind="distance", first=body, second="payload", point=tip,
            second_point=tip - np.array([0.0, 0.0, self.link_length]),
        )  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Lean:
    """How a crane leans, at its described pose, in the frame of its base."""

    first: str  # what stands; "" the base
    second: str  # what leans
    point: Array  # where the spring pulls: as far out as the tip, at the hinge's height, m
    weight: float  # of a mass at the tip that has the moment of all that leans, kg
    inertia: float  # mass at the tip with the moment of inertia of all that leans, kg

    def damping(self, stiffness: float) -> float:
        """Of the spring, N s/m."""
        return 2.0 * DAMPING * math.sqrt(stiffness * self.inertia)


def leaning(parts: CraneParts, slew: str | None) -> tuple[CraneParts, Lean]:
    """The crane with a hinge at the slew bearing, or at its foot, across the plane through axis and tip.

    The hinge stands on a foot that slews, or takes the place of the first joint of a crane that does not.
    SceneError for a tip over the hinge, which no lean moves up or down.
    """
    bodies, joints = list(parts.bodies), list(parts.joints)
    bearing = next((joint for joint in joints if joint.name == slew), joints[0])
    beyond = _beyond(parts, bearing)
    turned = bearing.second not in beyond  # the bearing has what leans as its first body
    upper, lower = (bearing.first, bearing.second) if turned else (bearing.second, bearing.first)
    out = parts.tip[1] - bearing.point
    out[2] = 0.0
    radius = float(np.linalg.norm(out))
    if radius < LEAST_RADIUS:
        raise SceneError(
            "crane: its tip is over its foot, where a stiffness at the tip says nothing; luff it out"
        )
    out /= radius
    axis = np.cross(out, UP)
    first = lower if slew is None else FOOT
    hinge = JointData(
        name=STRUCTURE, kind="revolute", first=first, second=upper, point=bearing.point, axis=axis
    )
    at = joints.index(bearing)
    if slew is None:
        joints[at] = hinge
    else:
        k = next(i for i, body in enumerate(bodies) if body.name == upper)
        body, shares = bodies[k], {FOOT: SHARE, upper: 1.0 - SHARE}  # of the same mass, centre and inertia
        bodies[k : k + 1] = [
            changed(body, name=name, mass=share * body.mass, inertia=share * body.inertia)
            for name, share in shares.items()
        ]
        standing = replace(bearing, first=FOOT) if turned else replace(bearing, second=FOOT)
        joints[at : at + 1] = [standing, hinge]
    weight = inertia = 0.0
    for body in bodies:
        if body.name in beyond:
            turn = rotation_matrix(body.quaternion)
            lever = body.position + turn @ body.center_of_mass - bearing.point
            own = turn.T @ axis
            inertia += body.mass * float(np.sum(np.cross(axis, lever) ** 2)) + float(own @ body.inertia @ own)
            weight += body.mass * float(out @ lever) / radius
    lean = Lean(
        first=first, second=upper, point=bearing.point + radius * out, weight=weight,
        inertia=inertia / radius**2,
    )  # fmt: skip
    return replace(parts, bodies=bodies, joints=joints), lean


def _beyond(parts: CraneParts, bearing: JointData) -> set[str]:
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
