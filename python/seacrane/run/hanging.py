"""Where the tip of a crane is, and how its payload hangs from it, out of what the core records of bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.body_motion import MOTION, POSE, position_of, velocity_of
from seacrane.description.crane_parts import tips
from seacrane.description.roles import CraneRoles

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]


def tip_velocities(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Velocities of all tips, m/s, inertial frame, shape (time, tip, axis); None where there is none."""
    found = tips(scene)
    if not found or not all(name in arrays for name in MOTION):
        return None
    return np.stack([velocity_of(scene, arrays, body, point) for body, point in found.values()], axis=1)


def lead_angles(scene: Description, arrays: Mapping[str, Array]) -> tuple[Array, Array] | None:
    """Offlead and sidelead of every link, rad, shape (time, hook) each; None where no crane slews.

    Both are angles of the link from the vertical: offlead in the vertical plane through slew axis and tip,
    positive away from the crane; sidelead across it, positive towards increasing slew angles about a vertical
    axis that points up. NaN for a crane without a slew drive, and while the tip is on the slew axis.
    """
    cranes = [crane for crane in scene.roles.values() if crane.link in scene.joints]
    slewing = [_slews(scene, crane) for crane in cranes]
    if not any(slewing) or not all(name in arrays for name in POSE):
        return None
    unknown = np.full(len(arrays["position"]), np.nan)
    angles = [
        _angles_of(scene, arrays, crane) if known else (unknown, unknown)
        for crane, known in zip(cranes, slewing, strict=True)
    ]
    offlead, sidelead = (np.stack(both, axis=1) for both in zip(*angles, strict=True))
    return offlead, sidelead


def _slews(scene: Description, crane: CraneRoles) -> bool:
    known = crane.slew is not None and crane.slew[0] in scene.joints
    return known and crane.tip is not None and crane.tip[0] in scene.bodies


def _angles_of(scene: Description, arrays: Mapping[str, Array], crane: CraneRoles) -> tuple[Array, Array]:
    assert crane.tip is not None and crane.slew is not None and crane.link is not None
    link, slew = scene.joints[crane.link], scene.joints[crane.slew[0]]
    tip = position_of(scene, arrays, *crane.tip)
    hook = position_of(scene, arrays, link.second, link.second_frame.point)
    out = tip - position_of(scene, arrays, slew.first, slew.first_frame.point)
    out[:, 2] = 0.0
    with np.errstate(invalid="ignore"):  # a tip on the slew axis has no plane: NaN
        out /= np.linalg.norm(out, axis=1, keepdims=True)
    across = np.stack([-out[:, 1], out[:, 0], np.zeros(len(out))], axis=1)
    hang = hook - tip
    down = -hang[:, 2]
    return (
        np.arctan2(np.einsum("ij,ij->i", hang, out), down),
        np.arctan2(np.einsum("ij,ij->i", hang, across), down),
    )
