"""Forces that the page shows as arrows, in groups of one scale each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description
from seacrane.pictures.packing import Blob
from seacrane.pictures.pose_curves import Motion, linear_rows
from seacrane.pictures.wires import end_of
from seacrane.result import Result

Array = NDArray[np.float64]
FINENESS = 2.0**-14  # step of a force over the largest of its group

GROUPS = {"link": "link and wire tension", "wave": "wave force", "joint": "joint reaction"}


def arrows_of(
    scene: Description, result: Result | None, motion: Motion, bodies: Sequence[str], blob: Blob
) -> list[dict[str, Any]]:
    """Arrows with their point of application and their force over the frames, N, inertial axes."""
    if result is None:
        return []
    found = [*_reactions(scene, result, motion, bodies), *_waves(scene, result, motion, bodies)]
    largest = {group: 0.0 for group in GROUPS}
    for arrow, rows in found:
        largest[arrow["group"]] = max(largest[arrow["group"]], float(np.linalg.norm(rows, axis=0).max()))
    return [
        arrow
        | {"force": blob.series(rows, largest[arrow["group"]] * FINENESS), "largest": largest[arrow["group"]]}
        for arrow, rows in found
        if largest[arrow["group"]] > 0.0
    ]


def _reactions(
    scene: Description, result: Result, motion: Motion, bodies: Sequence[str]
) -> list[tuple[dict[str, Any], Array]]:
    """What each joint exerts on its second body."""
    if "reaction_force" not in result.channels:
        return []
    out = []
    for name in result.coords["joint"]:
        if name not in scene.joints:
            continue
        joint = scene.joints[name]
        hangs = joint.kind == "distance"
        slides = "displacement" in _core.joint_kinds()[joint.kind].coordinates
        first = slides and not hangs
        body, frame = (joint.first, joint.first_frame) if first else (joint.second, joint.second_frame)
        arrow = {
            "name": name,
            "group": "link" if hangs else "joint",
            "at": end_of(scene, bodies, body, frame.point),
        }
        out.append((arrow, linear_rows(motion, result.time, result.select("reaction_force", joint=name))))
    return out


def _waves(
    scene: Description, result: Result, motion: Motion, bodies: Sequence[str]
) -> list[tuple[dict[str, Any], Array]]:
    """Wave forces at the reference points of vessels, turned by yaw out of the axes that follow it."""
    if "wave_force" not in result.channels:
        return []
    out = []
    for vessel in scene.vessels.values():
        several = "vessel" in result.dims["wave_force"]
        pick = {"vessel": vessel.name} if several else {}
        if several and vessel.name not in result.coords["vessel"]:
            continue
        force, yaw = result.select("wave_force", **pick)[:, :3].copy(), np.zeros(len(result.time))
        if vessel.kinematics == "yaw_following":
            yaw = _yaw(result.select("quaternion", body=vessel.body))
        turn = np.exp(1j * yaw) * (force[:, 0] + 1j * force[:, 1])
        force[:, 0], force[:, 1] = turn.real, turn.imag
        arrow = {"name": vessel.name, "group": "wave", "at": end_of(scene, bodies, vessel.body, np.zeros(3))}
        out.append((arrow, linear_rows(motion, result.time, force)))
    return out


def _yaw(quaternion: Array) -> Array:
    w, x, y, z = np.moveaxis(quaternion, -1, 0)
    return np.asarray(np.arctan2(2.0 * (x * y + w * z), w * w + x * x - y * y - z * z))
