"""Where the tip of a crane is, and how its load hangs from it, out of what the core records of bodies."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.crane_parts import tip_radius, tips
from seacrane.description.places import MOTION, POSE, position_of, velocity_of
from seacrane.description.roles import CraneRoles, allowed_at
from seacrane.description.suspension import Hung, hung_loads, names_of_suspensions, suspensions

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
    """Offlead and sidelead of what hangs on cranes, rad, (time, hook) each; None where no crane slews.

    Both are angles from the vertical, of the line from the tip to where the rod or wire ends: offlead in the
    vertical plane through slew axis and tip, positive away from the crane; sidelead across it, positive
    towards increasing slew angles about a vertical axis that points up. NaN for a crane without a slew drive,
    and while the tip is on the slew axis.
    """
    every = on_cranes(scene)
    slewing = [_slews(scene, one.crane) for one in every]
    if not any(slewing) or not all(name in arrays for name in POSE):
        return None
    unknown = np.full(len(arrays["position"]), np.nan)
    angles = [
        _angles_of(scene, arrays, one) if known else (unknown, unknown)
        for one, known in zip(every, slewing, strict=True)
    ]
    offlead, sidelead = (np.stack(both, axis=1) for both in zip(*angles, strict=True))
    return offlead, sidelead


def swings(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Angles of the loads on cranes from straight below their tips, rad, (time, hook); None without poses."""
    every = on_cranes(scene)
    if not every or not all(name in arrays for name in POSE):
        return None
    hangs = [
        position_of(scene, arrays, one.load, one.point) - position_of(scene, arrays, *one.hangs_from)
        for one in every
    ]
    return np.stack([swing_of(hang) for hang in hangs], axis=1)


def sling_angles(scene: Description, arrays: Mapping[str, Array]) -> Array | None:
    """Angle of the last straight part of rods and lines above the horizontal, rad, (time, suspension)."""
    found: dict[str, Array] = {}
    if not all(name in arrays for name in POSE):
        return None
    for one in suspensions(scene):
        up = position_of(scene, arrays, *one.upper) - position_of(scene, arrays, *one.lower)
        angle = np.arctan2(up[:, 2], np.hypot(up[:, 0], up[:, 1]))
        found |= dict.fromkeys((one.channel, *one.parts), angle)
    columns = [found[name] for name in names_of_suspensions(scene)]
    return np.stack(columns, axis=1) if columns else None


def utilisations(scene: Description, arrays: Mapping[str, Array], loads: Array) -> Array | None:
    """Hook loads over what the cranes' tables allow there with their design factors, (time, hook).

    NaN of a crane without a table; infinite beyond its last radius. None where no crane has one.
    """
    every, names = on_cranes(scene), names_of_suspensions(scene)
    if not all(name in arrays for name in POSE) or not rated_hooks(scene):
        return None
    return np.stack(
        [_utilisation(scene, arrays, one, loads[:, names.index(one.suspension.channel)]) for one in every],
        axis=1,
    )


def _rated(crane: CraneRoles | None) -> bool:
    return crane is not None and bool(crane.capacity) and crane.slew is not None and crane.tip is not None


def _utilisation(scene: Description, arrays: Mapping[str, Array], one: Hung, load: Array) -> Array:
    if one.crane is None or not _rated(one.crane):
        return np.full(len(load), np.nan)
    radius = tip_radius(scene, one.crane, arrays["position"], arrays["quaternion"])
    allowed = allowed_at(one.crane.capacity, radius) * one.crane.design_factor * scene.gravity
    with np.errstate(divide="ignore"):
        return np.asarray(load / allowed)


def swing_of(hang: Array) -> Array:
    """Angle (n,) of hanging vectors (n, 3) from straight down, rad."""
    return np.asarray(np.arctan2(np.hypot(hang[:, 0], hang[:, 1]), -hang[:, 2]))


def on_cranes(scene: Description) -> list[Hung]:
    """What hangs on the cranes, in their order."""
    return [one for one in hung_loads(scene) if one.crane is not None]


def rated_hooks(scene: Description) -> list[Hung]:
    """Those on cranes whose capacity is known."""
    return [one for one in on_cranes(scene) if _rated(one.crane)]


def slewing_hooks(scene: Description) -> list[Hung]:
    """Those on cranes that slew."""
    return [one for one in on_cranes(scene) if _slews(scene, one.crane)]


def _slews(scene: Description, crane: CraneRoles | None) -> bool:
    if crane is None or crane.slew is None or crane.tip is None:
        return False
    return crane.slew[0] in scene.joints and crane.tip[0] in scene.bodies


def _angles_of(scene: Description, arrays: Mapping[str, Array], one: Hung) -> tuple[Array, Array]:
    assert one.crane is not None and one.crane.slew is not None
    slew = scene.joints[one.crane.slew[0]]
    tip = position_of(scene, arrays, *one.hangs_from)
    hook = position_of(scene, arrays, *one.suspension.lower)
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
