"""A crane that gives: it leans by a spring at its slew bearing, as stiff as its structure at the tip."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.parts import BodyRecord, CraneParts, JointRecord
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]
FOOT, STRUCTURE = "structure foot", "structure"  # a body; and joint and spring
SHARE = 1e-3  # of the column's mass, which its foot has: it slews with it, and leans with nothing
DAMPING = 0.02  # of critical, of the lean; an estimate
FAR = 2e5  # m, of the spring's upper end: it keeps its direction, and is no part of pictures
LEAST_RADIUS = 0.1  # m
UP = np.array([0.0, 0.0, 1.0])


@dataclasses.dataclass(frozen=True, kw_only=True, eq=False)
class Lean:
    """How a crane leans, at its described pose, in the frame of its base.

    Attributes
    ----------
    first, second : str
        What stands ("" the base), and what leans.
    point : ndarray, shape (3,)
        Where the spring pulls: as far out as the tip, at the hinge's height, m.
    weight : float
        Of a mass at the tip that has the moment of all that leans, kg.
    inertia : float
        Mass at the tip with the moment of inertia of all that leans, kg.
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
        hinge = dataclasses.replace(hinge, first=lower)
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
        standing = (
            dataclasses.replace(bearing, first=FOOT) if below else dataclasses.replace(bearing, second=FOOT)
        )
        joints[at : at + 1] = [standing, hinge]
    return dataclasses.replace(parts, bodies=bodies, joints=joints)


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
        dataclasses.replace(body, name=name, mass=share * body.mass, inertia=share * np.asarray(body.inertia))
        for name, share in shares.items()
    ]


def _center(body: BodyRecord) -> Array:
    return np.asarray(body.position + rotation_matrix(body.quaternion) @ body.center_of_mass)


def _along(body: BodyRecord, axis: Array) -> float:
    """Moment of inertia about its centre along an axis, kg m2."""
    own = rotation_matrix(body.quaternion).T @ axis
    return float(own @ np.asarray(body.inertia) @ own)
