"""Mass, centre of mass and inertia of bodies built from uniform tubes and boxes, in closed form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
UPRIGHT = 1e-9  # level part of a unit vector, below which it is upright
Point = tuple[float, ...]
"""(along, above) in the crane plane of a body, or (x, y, z); m."""


@dataclass(frozen=True, kw_only=True)
class Tube:
    """Uniform circular tube from `start` to `end` in the crane plane.

    Attributes
    ----------
    mass : float
        kg.
    start, end : (float, float) or (float, float, float)
        Ends of the centre line, m, (along, above) in the body's plane frame, or (x, y, z) in its own.
    outer_diameter, inner_diameter : float
        m; inner 0 means a solid cylinder.
    """

    name: str
    mass: float
    start: Point
    end: Point
    outer_diameter: float
    inner_diameter: float

    def principal_moments(self) -> tuple[float, float, float]:
        """Moments about the member's own centre: along it, across the crane plane, normal in it, kg m2."""
        squares = (self.outer_diameter**2 + self.inner_diameter**2) / 4.0
        axial = self.mass * squares / 2.0
        transverse = self.mass * (3.0 * squares + _length(self) ** 2) / 12.0
        return axial, transverse, transverse


@dataclass(frozen=True, kw_only=True)
class Box:
    """Uniform rectangular box, solid or hollow with open ends, from `start` to `end` in the crane plane.

    Attributes
    ----------
    mass : float
        kg.
    start, end : (float, float) or (float, float, float)
        Ends of the centre line, m, (along, above) in the body's plane frame, or (x, y, z) in its own.
    width, depth : float
        Section across the crane plane and in it, m; in space, across the vertical plane of the member and
        in it, of an upright one along y and along x.
    wall : float
        Wall thickness, m; 0 means solid.
    """

    name: str
    mass: float
    start: Point
    end: Point
    width: float
    depth: float
    wall: float

    def principal_moments(self) -> tuple[float, float, float]:
        """Moments about the member's own centre: along it, across the crane plane, normal in it, kg m2."""
        w, d = self.width, self.depth
        hole_w, hole_d = (w - 2.0 * self.wall, d - 2.0 * self.wall) if self.wall > 0.0 else (0.0, 0.0)
        area = w * d - hole_w * hole_d
        across = (d * w**3 - hole_d * hole_w**3) / (12.0 * area)  # mean of the squared lateral distance
        normal = (w * d**3 - hole_w * hole_d**3) / (12.0 * area)
        along = _length(self) ** 2 / 12.0
        return (
            self.mass * (across + normal),
            self.mass * (along + normal),
            self.mass * (along + across),
        )


Member = Tube | Box


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass properties of a body, in body axes.

    Attributes
    ----------
    mass : float
        kg.
    center_of_mass : ndarray, shape (3,)
        From the body origin, m.
    inertia : ndarray, shape (3, 3)
        About the centre of mass, kg m2.
    """

    mass: float
    center_of_mass: Array
    inertia: Array


def _length(member: Member) -> float:
    return math.dist(member.start, member.end)


def combine(members: Sequence[Member], plane: Array) -> MassProperties:
    """Add up members that form one rigid body.

    Parameters
    ----------
    members : sequence of Tube or Box
        At least one.
    plane : ndarray, shape (3, 2)
        Columns: the unit vectors "along" and "above" of the crane plane in body axes; body y is across it.

    Returns
    -------
    MassProperties
        In body axes; the parallel-axis theorem carries each member to the common centre of mass.
    """
    along, above = plane[:, 0], plane[:, 1]
    across = np.array([0.0, 1.0, 0.0])
    centres = [
        plane @ ((np.asarray(m.start, dtype=float) + np.asarray(m.end, dtype=float)) / 2.0) for m in members
    ]
    triads = []
    for member in members:
        delta = (np.asarray(member.end) - np.asarray(member.start)) / _length(member)
        axis = delta[0] * along + delta[1] * above
        triads.append((axis, across, -delta[1] * along + delta[0] * above))
    return _sum(members, centres, triads)


def combine_in_space(members: Sequence[Member]) -> MassProperties:
    """Add up members whose ends have three coordinates, in body axes; see `combine`."""
    centres = [(np.asarray(m.start, dtype=float) + np.asarray(m.end, dtype=float)) / 2.0 for m in members]
    return _sum(members, centres, [member_axes(member) for member in members])


def member_axes(member: Member) -> tuple[Array, Array, Array]:
    """Unit vectors along a member in space, across its vertical plane, and in that normal to it."""
    axis = (np.asarray(member.end, dtype=float) - np.asarray(member.start, dtype=float)) / _length(member)
    across = np.array([-axis[1], axis[0], 0.0])
    level = float(np.linalg.norm(across))
    across = np.array([0.0, 1.0, 0.0]) if level < UPRIGHT else across / level
    return axis, across, np.cross(axis, across)


def _sum(
    members: Sequence[Member], centres: Sequence[Array], triads: Sequence[tuple[Array, Array, Array]]
) -> MassProperties:
    """The sum of members by their centres and their principal axes, in body axes."""
    mass = math.fsum(member.mass for member in members)
    center = np.sum([m.mass * c for m, c in zip(members, centres, strict=True)], axis=0) / mass
    inertia = np.zeros((3, 3))
    for member, centre, (axis, across, normal) in zip(members, centres, triads, strict=True):
        axial, lateral, vertical = member.principal_moments()
        inertia += axial * np.outer(axis, axis) + lateral * np.outer(across, across)
        inertia += vertical * np.outer(normal, normal)
        arm = centre - center
        inertia += member.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return MassProperties(mass, center, (inertia + inertia.T) / 2.0)
