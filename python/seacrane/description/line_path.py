"""Where a line runs: its straight parts and its arcs over sheaves, for given poses of its bodies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.places import described_pose

Pose = tuple[Array, Array]  # of a body's origin, m, and its axes as columns
TURN = 2.0 * np.pi
STEPS = 12  # of Newton's method
LARGEST_PIECE = np.radians(15.0)  # of an arc that is drawn


@dataclass(frozen=True, kw_only=True)
class Sheave:
    """A point of a path in inertial axes; a sheave if its radius (m) is not zero."""

    center: Array  # m
    radius: float
    axis: Array  # of length one; the line runs about it by the right hand; zero at a point
    turns: float  # whole ones on it besides


@dataclass(frozen=True, kw_only=True)
class Laid:
    """A line as it runs over n points: starts and ends (n - 1, 3) of its straight parts, inertial axes, m,
    and the angles (n,) on its sheaves, rad; 0 at points."""

    starts: Array
    ends: Array
    wraps: Array
    sheaves: list[Sheave]

    @property
    def length(self) -> float:
        """Of all of it, m."""
        arcs = sum(one.radius * wrap for one, wrap in zip(self.sheaves, self.wraps, strict=True))
        return float(np.linalg.norm(self.ends - self.starts, axis=1).sum() + arcs)

    def arc(self, at: int) -> Array:
        """Points along the arc on the sheave at a point of the path, shape (m, 3), without whole turns."""
        sheave, start = self.sheaves[at], self.ends[at - 1]
        wrap = max(self.wraps[at] - TURN * sheave.turns, 0.0)
        angles = np.linspace(0.0, wrap, 2 + int(wrap / LARGEST_PIECE))[:, None]
        first = start - sheave.center
        second = np.cross(sheave.axis, first)
        return np.asarray(sheave.center + np.cos(angles) * first + np.sin(angles) * second)


def laid(line: _core.Line, pose_of: Callable[[str], Pose]) -> Laid:
    """A line over its points, for the pose of each body that it names."""
    radii = line.radii if len(line.radii) else np.zeros(len(line.points))
    axes = line.axes if len(line.axes) else np.zeros((len(line.points), 3))
    turns = line.turns if len(line.turns) else np.zeros(len(line.points))
    sheaves = []
    for body, point, radius, axis, turn in zip(line.bodies, line.points, radii, axes, turns, strict=True):
        origin, rotation = pose_of(body)
        along = rotation @ axis / np.linalg.norm(axis) if radius > 0.0 else np.zeros(3)
        sheaves.append(Sheave(center=origin + rotation @ point, radius=radius, axis=along, turns=turn))
    outs, ins = np.zeros((2, len(sheaves), 3))
    for i in range(len(sheaves) - 1):
        outs[i], ins[i + 1] = _radii(sheaves[i], sheaves[i + 1])
    places = np.array([one.center for one in sheaves])
    reach = np.array([[one.radius] for one in sheaves])
    wraps = np.array([_wrap(one, ins[i], outs[i]) for i, one in enumerate(sheaves)])
    return Laid(
        starts=(places + reach * outs)[:-1], ends=(places + reach * ins)[1:], wraps=wraps, sheaves=sheaves
    )


def described_poses(scene: Description) -> Callable[[str], Pose]:
    """The poses that bodies are described with."""
    return partial(described_pose, scene)


def path_length(scene: Description, line: _core.Line) -> float:
    """Length of a line's path with bodies as described, m."""
    return laid(line, described_poses(scene)).length


def _radii(first: Sheave, second: Sheave) -> tuple[Array, Array]:
    """Unit vectors from both centres to where the straight part touches; zero at points."""
    apart = second.center - first.center
    alike = float(first.axis @ second.axis)
    n1 = _radius_at(first, apart, first.radius - alike * second.radius)
    n2 = _radius_at(second, apart, alike * first.radius - second.radius)
    for _ in range(STEPS if first.radius > 0.0 and second.radius > 0.0 else 0):
        t1, t2 = np.cross(first.axis, n1), np.cross(second.axis, n2)
        d = apart + second.radius * n2 - first.radius * n1
        rows = np.array([[t1 @ d, second.radius * n1 @ t2], [-first.radius * n2 @ t1, t2 @ d]])
        a1, a2 = np.linalg.solve(rows, [-n1 @ d, -n2 @ d])
        n1, n2 = np.cos(a1) * n1 + np.sin(a1) * t1, np.cos(a2) * n2 + np.sin(a2) * t2
    return n1, n2


def _radius_at(sheave: Sheave, apart: Array, reach: float) -> Array:
    """The radius n with n . apart = reach from which the line runs along `apart`."""
    if sheave.radius == 0.0:
        return np.zeros(3)
    flat = apart - sheave.axis * (sheave.axis @ apart)
    beside = np.sqrt(max(float(flat @ flat) - reach * reach, 0.0))
    return np.asarray((reach * flat + beside * np.cross(flat, sheave.axis)) / (flat @ flat))


def _wrap(sheave: Sheave, arrives: Array, leaves: Array) -> float:
    """As the engine's: from -90 to 270 degrees, and the whole turns."""
    if sheave.radius == 0.0:
        return 0.0
    angle = np.arctan2(sheave.axis @ np.cross(arrives, leaves), arrives @ leaves)
    return float(angle + (TURN if angle < -0.25 * TURN else 0.0) + TURN * sheave.turns)
