"""Mass, centre of mass and inertia of bodies built from uniform tubes and boxes, in closed form."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from seacrane.arrays import Array

UPRIGHT = 1e-9  # level part of a unit vector, below which it is upright
Point = tuple[float, ...]
"""(x, y, z), m."""


@dataclass(frozen=True, kw_only=True)
class _Member:
    name: str
    mass: float
    start: Point
    end: Point

    @property
    def length(self) -> float:
        """From end to end, m."""
        return math.dist(self.start, self.end)


@dataclass(frozen=True, kw_only=True)
class Tube(_Member):
    """Uniform circular tube from `start` to `end`, the ends of its centre line in the body's frame, m; kg.

    Attributes
    ----------
    outer_diameter, inner_diameter : m; inner 0 means a solid cylinder.
    """

    outer_diameter: float
    inner_diameter: float

    def principal_moments(self) -> tuple[float, float, float]:
        """Moments about the member's own centre: along it, across its vertical plane, normal in it, kg m2."""
        squares = (self.outer_diameter**2 + self.inner_diameter**2) / 4.0
        axial = self.mass * squares / 2.0
        transverse = self.mass * (3.0 * squares + self.length**2) / 12.0
        return axial, transverse, transverse


@dataclass(frozen=True, kw_only=True)
class Box(_Member):
    """Uniform rectangular box, solid or hollow with open ends, as `Tube`.

    Attributes
    ----------
    width, depth : float
        Section across the vertical plane of the member and in it, m; of an upright one along y and along x.
    wall : Wall thickness, m; 0 means solid.
    """

    width: float
    depth: float
    wall: float

    def principal_moments(self) -> tuple[float, float, float]:
        """Moments about the member's own centre: along it, across its vertical plane, normal in it, kg m2."""
        w, d = self.width, self.depth
        hole_w, hole_d = (w - 2.0 * self.wall, d - 2.0 * self.wall) if self.wall > 0.0 else (0.0, 0.0)
        area = w * d - hole_w * hole_d
        across = (d * w**3 - hole_d * hole_w**3) / (12.0 * area)  # mean of the squared lateral distance
        normal = (w * d**3 - hole_w * hole_d**3) / (12.0 * area)
        along = self.length**2 / 12.0
        return self.mass * (across + normal), self.mass * (along + normal), self.mass * (along + across)


Member = Tube | Box


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Mass (kg), its centre from the body origin (3,), m, and inertia about that (3, 3), kg m2; body axes."""

    mass: float
    center_of_mass: Array
    inertia: Array


def combine(members: Sequence[Member]) -> MassProperties:
    """Add up members, at least one, that form one rigid body, in the axes of their ends."""
    centres = [(np.array(one.start) + np.array(one.end)) / 2.0 for one in members]
    mass = math.fsum(member.mass for member in members)
    center = np.sum([one.mass * c for one, c in zip(members, centres, strict=True)], axis=0) / mass
    inertia = np.zeros((3, 3))
    for member, centre in zip(members, centres, strict=True):
        axis, across, normal = member_axes(member)
        axial, lateral, vertical = member.principal_moments()
        inertia += axial * np.outer(axis, axis) + lateral * np.outer(across, across)
        inertia += vertical * np.outer(normal, normal)
        arm = centre - center
        inertia += member.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return MassProperties(mass, center, (inertia + inertia.T) / 2.0)


def member_axes(member: Member) -> tuple[Array, Array, Array]:
    """Unit vectors along a member in space, across its vertical plane, and in that normal to it."""
    axis = (np.array(member.end) - np.array(member.start)) / member.length
    across = np.array([-axis[1], axis[0], 0.0])
    level = float(np.linalg.norm(across))
    across = np.array([0.0, 1.0, 0.0]) if level < UPRIGHT else across / level
    return axis, across, np.cross(axis, across)
