"""Mass, centre of mass and inertia of bodies built from uniform tubes and boxes, in closed form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Point = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Tube:
    """Uniform circular tube from `start` to `end` in the crane plane.

    Attributes
    ----------
    name : str
    mass : float
        kg.
    start, end : (float, float)
        Ends of the centre line, m, (along, above) in the body's plane frame.
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
    name : str
    mass : float
        kg.
    start, end : (float, float)
        Ends of the centre line, m, (along, above) in the body's plane frame.
    width, depth : float
        Section across the crane plane and in it, m.
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
    mass = math.fsum(member.mass for member in members)
    centres = [
        plane @ ((np.asarray(m.start, dtype=float) + np.asarray(m.end, dtype=float)) / 2.0) for m in members
    ]
    center = np.sum([m.mass * c for m, c in zip(members, centres, strict=True)], axis=0) / mass
    inertia = np.zeros((3, 3))
    for member, centre in zip(members, centres, strict=True):
        delta = (np.asarray(member.end) - np.asarray(member.start)) / _length(member)
        axis = delta[0] * along + delta[1] * above
        normal = -delta[1] * along + delta[0] * above
        axial, lateral, vertical = member.principal_moments()
        inertia += axial * np.outer(axis, axis) + lateral * np.outer(across, across)
        inertia += vertical * np.outer(normal, normal)
        arm = centre - center
        inertia += member.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return MassProperties(mass, center, (inertia + inertia.T) / 2.0)
