"""Where vessels of a group left the places beside each other for which their hydrodynamics hold."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro import HydroDatabase
from seacrane.inputs.frames import heading_of, rotation_about_z
from seacrane.validity.hull_range import motions, peak_of, slowly
from seacrane.warnings import RelativePlaceWarning

if TYPE_CHECKING:
    from collections.abc import Mapping

    from seacrane.description.description import Description

Array = NDArray[np.float64]
Finding = tuple[type[Warning], str]

SHARE = 0.1  # of the gap
LARGEST_TURN = np.radians(2.0)


def relative_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> list[Finding]:
    """Pairs of a group whose mean relative place or heading is out of range."""
    moved = {vessel.name: motion for vessel, motion in motions(scene, channels)}
    return [
        finding
        for name, group in scene.groups.items()
        for one, other in combinations(group.vessels, 2)
        if {one, other} <= moved.keys()
        for finding in _of_pair(scene, name, (one, other), time, (moved[one], moved[other]))
    ]


def _of_pair(
    scene: Description, group: str, pair: tuple[str, str], time: Array, moved: tuple[Array, Array]
) -> list[Finding]:
    if scene.waves is not None and time[-1] - time[0] < peak_of(scene).period:
        return []  # within one wave there is no mean
    fast = _relative(scene, pair, moved)
    if scene.waves is None:
        slow = np.broadcast_to(fast.mean(axis=0), fast.shape)
    else:
        slow = slowly(time, fast, peak_of(scene).period)
    gap = gap_between(scene, *pair)
    far, turned = np.hypot(*slow[:, :2].T), np.abs(slow[:, 2])
    if far.max() <= SHARE * gap and turned.max() <= LARGEST_TURN:
        return []
    at, turn = int(far.argmax()), int(turned.argmax())
    place, swing = np.hypot(*(fast - slow)[:, :2].T).max(), np.degrees(np.abs(fast - slow)[:, 2].max())
    return [
        (
            RelativePlaceWarning,
            f"group {group!r}: {pair[1]!r} leaves its place beside {pair[0]!r} by {far[at]:.3g} m on the "
            f"average at t = {time[at]:.6g} s and its heading by {np.degrees(turned[turn]):.3g} deg (limits: "
            f"{SHARE * gap:.3g} m, a tenth of the gap of {gap:.3g} m, and {np.degrees(LARGEST_TURN):.0f} "
            f"deg), about which they move by {place:.3g} m and {swing:.3g} deg with the waves: what they do "
            "to each other is that of the places in the group's data. Moor them closer to these, or compute "
            "the group where they go",
        )
    ]


def _relative(scene: Description, pair: tuple[str, str], moved: tuple[Array, Array]) -> Array:
    """The second from its place beside the first: m in axes that follow the first, and rad, shape (n, 3)."""
    bodies = [scene.bodies[scene.vessels[name].body] for name in pair]
    starts = [np.asarray(body.position)[:2] for body in bodies]
    places = [
        start + motion[:, :2] @ rotation_about_z(heading_of(body.quaternion))[:2, :2].T
        for start, body, motion in zip(starts, bodies, moved, strict=True)
    ]
    apart, yaw = places[1] - places[0], moved[0][:, 5]
    cosine, sine = np.cos(yaw), np.sin(yaw)
    followed = np.column_stack(
        [cosine * apart[:, 0] + sine * apart[:, 1], cosine * apart[:, 1] - sine * apart[:, 0]]
    )
    turn = np.unwrap(moved[1][:, 5]) - np.unwrap(yaw)
    return np.column_stack([followed - (starts[1] - starts[0]), turn])


def gap_between(scene: Description, one: str, other: str) -> float:
    """Least distance (m) of the rectangles of length and breadth of two vessels at the start.

    Of hulls whose rectangles overlap, as a float about a spar, the smaller breadth.
    """
    corners, breadths = [], []
    for name in (one, other):
        vessel = scene.vessels[name]
        hull, body = vessel.database, scene.bodies[vessel.body]
        if not isinstance(hull, HydroDatabase):
            return float("inf")
        half = 0.5 * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * [hull.length, hull.breadth]
        turn = rotation_about_z(heading_of(body.quaternion))[:2, :2]
        corners.append(half @ turn.T + np.asarray(body.position)[:2])
        breadths.append(hull.breadth)
    gap = max(_apart(*corners), _apart(*reversed(corners)))
    return min(_distance(*corners), _distance(*reversed(corners))) if gap > 0.0 else float(min(breadths))


def _apart(one: Array, other: Array) -> float:
    """The largest distance that an edge of one keeps from all of the other; negative where they overlap."""
    edges = np.roll(one, -1, axis=0) - one
    outwards = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.hypot(*edges.T)[:, None]
    return float(max(np.min((other - corner) @ out) for corner, out in zip(one, outwards, strict=True)))


def _distance(one: Array, other: Array) -> float:
    """Of the corners of one from the edges of the other, at least."""
    edges = np.roll(other, -1, axis=0) - other
    from_start = one[:, None] - other
    share = np.clip(np.sum(from_start * edges, axis=2) / np.sum(edges**2, axis=1), 0.0, 1.0)
    return float(np.linalg.norm(from_start - share[..., None] * edges, axis=2).min())
