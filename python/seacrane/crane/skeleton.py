"""Lines that stand for the crane's bodies in a picture, from its joints and their points."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.builder import FOOT, KnuckleBoomCrane
from seacrane.crane.payload import Payload
from seacrane.crane.records import BodyRecord
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]

# Joint points that each body's lines run through; the tip is the crane's end of the payload's link.
THROUGH_JOINTS: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "tower": (("deck", "A"),),
    "king": (("A", "C", "B", "A"),),
    "main_jib": (("C", "F"), ("C", "D", "E", "F")),
    "knuckle_jib": (("F", "link"), ("F", "G", "link")),
}
# Each cylinder's ends, and the shares of its retracted length that barrel and rod cover.
CYLINDERS = {"main": ("B", "D"), "knuckle": ("E", "G")}
BARREL, ROD = (0.0, 0.95), (1.0, 0.1)
BARRELS = tuple(f"{cylinder}_barrel" for cylinder in CYLINDERS)  # drawn thick


def crane_skeleton(
    crane: KnuckleBoomCrane | None = None, *, foot: tuple[float, float, float] | None = None
) -> dict[str, list[Array]]:
    """Lines of the eight crane bodies for `seacrane.pictures.pose`.

    Parameters
    ----------
    crane : KnuckleBoomCrane, optional
        The shipped crane if None.
    foot : (float, float, float), optional
        Crane foot in the vessel frame, m; the shipped place if None.

    Returns
    -------
    dict of str to list of ndarray (k, 3)
        m, in each body's frame, relative to its centre of mass; the first line of `knuckle_jib` ends at the
        crane's tip.
    """
    crane = crane or KnuckleBoomCrane.load()
    foot = foot or FOOT
    records = {record.name: record for record in crane.bodies(foot=foot)}
    points = {joint.name: joint.point for joint in crane.joints(foot=foot, payload=Payload())}
    lines = {
        body: [_in_body(records[body], np.array([points[joint] for joint in path])) for path in paths]
        for body, paths in THROUGH_JOINTS.items()
    }
    for cylinder, (start, end) in CYLINDERS.items():
        for part, shares in (("barrel", BARREL), ("rod", ROD)):
            ends = points[start] + np.outer(shares, points[end] - points[start])
            lines[f"{cylinder}_{part}"] = [_in_body(records[f"{cylinder}_{part}"], ends)]
    return lines


def _in_body(record: BodyRecord, points: Array) -> Array:
    """Points of the vessel frame at the described pose, relative to the centre of mass, body axes."""
    relative: Array = (points - record.position) @ rotation_matrix(record.quaternion)
    return relative - record.center_of_mass
