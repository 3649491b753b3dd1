"""The cranes of a scene: their roles are written here by whoever builds them, and looked up here by name.

Labels are a crane's prefix and the role, such as "main" or "aft main". What a role names and the scene no
longer has is left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.description import GROUND, Description
from seacrane.description.given import floating_bodies
from seacrane.description.roles import Areas, CraneRoles, LuffingRope, Vector
from seacrane.errors import SceneError
from seacrane.inputs.frames import cross, rotation_matrix


def _of_cranes(scene: Description, role: str, label: str = "") -> dict[str, Any]:
    """What cranes have in a role, by the prefix and the label, or the labels of several."""
    found: dict[str, Any] = {}
    for roles in scene.roles.values():
        part = getattr(roles, role)
        parts = {label: part} if label and part else part or {}
        found |= {roles.prefix + name: one for name, one in parts.items()}
    return found


def _there(found: Mapping[str, Any], table: Mapping[str, Any]) -> dict[str, Any]:
    """Those of which the scene has the element that they name, by itself or first."""
    return {label: one for label, one in found.items() if (one if isinstance(one, str) else one[0]) in table}


def cylinders(scene: Description) -> dict[str, str]:
    """Sliding joints of all cylinders, by label."""
    return _there(_of_cranes(scene, "cylinders"), scene.joints)


def drive_named(scene: Description, label: str) -> tuple[str, str] | None:
    """Joint and coordinate of a slew drive, luff or cylinder by its label, such as "slew" or "aft main"."""
    strokes = {name: (joint, "displacement") for name, joint in cylinders(scene).items()}
    return {**strokes, **luffs(scene), **slews(scene)}.get(label)


def piston_areas(scene: Description) -> dict[str, Areas]:
    """Full side and rod side of the pistons that are known, m2, by the cylinders' labels."""
    known = cylinders(scene)
    return {label: areas for label, areas in _of_cranes(scene, "areas").items() if label in known}


def slews(scene: Description) -> dict[str, tuple[str, str]]:
    """Joint and coordinate of every slew drive, by label."""
    return _there(_of_cranes(scene, "slew", "slew"), scene.joints)


def luffs(scene: Description) -> dict[str, tuple[str, str]]:
    """Joint and coordinate of every hinge that luffs, by label."""
    return _there(_of_cranes(scene, "luffs"), scene.joints)


def luffing_ropes(scene: Description) -> dict[str, LuffingRope]:
    """Ropes that hold hinges, by the label of the hinge."""
    known = luffs(scene)
    return {label: rope for label, rope in _of_cranes(scene, "ropes").items() if label in known}


def hooks(scene: Description) -> dict[str, str]:
    """Distance joints that payloads hang on, by label."""
    return _there(_of_cranes(scene, "link", "hook"), scene.joints)


def payloads(scene: Description) -> dict[str, str]:
    """Bodies that hang on cranes, by label."""
    return _there(_of_cranes(scene, "payload", "payload"), scene.bodies)


def tips(scene: Description) -> dict[str, tuple[str, Vector]]:
    """Body and point in its coordinates (m) of every tip, by label."""
    return _there(_of_cranes(scene, "tip", "tip"), scene.bodies)


def crane_bodies(scene: Description) -> set[str]:
    """Bodies of the scene's cranes: what joints connect with their tips, without bases and payloads."""
    apart = {GROUND, *payloads(scene).values(), *floating_bodies(scene)}
    decks = {f"{prefix}deck" for prefix in scene.roles} & scene.joints.keys()
    apart |= {scene.joints[deck].first for deck in decks}
    found = {body for body, _ in tips(scene).values()} - apart
    while True:
        ends = [{joint.first, joint.second} for joint in scene.joints.values()]
        more = {body for pair in ends if pair & found for body in pair} - apart - found
        if not more:
            return found
        found |= more


def placed(
    scene: Description, body: str, point: Any, position: Array, quaternion: Array
) -> tuple[Array, Array]:
    """A point of a body (its coordinates, m) in inertial axes (..., 3), and the body's rotation, by the
    centres of mass (..., bodies, 3) and attitudes (..., bodies, 4) of all bodies in the scene's order."""
    at = np.asarray(point, dtype=float)
    if body not in scene.bodies:
        return at, np.eye(3)
    i = list(scene.bodies).index(body)
    turn = rotation_matrix(quaternion[..., i, :])
    return position[..., i, :] + turn @ (at - np.asarray(scene.bodies[body].center_of_mass)), turn


def tip_radius(scene: Description, roles: CraneRoles, position: Array, quaternion: Array) -> Array:
    """Distance (...) of the tip from the slew axis, m; SceneError for a crane without either."""
    if roles.slew is None or roles.tip is None:
        missing = "slew drive" if roles.slew is None else "tip"
        raise SceneError(
            f"crane {roles.prefix!r}: a radius is from the slew axis to the tip, and it has no {missing}; "
            "tell it by add_roles"
        )
    joint, (tip_body, tip_point) = scene.joints[roles.slew[0]], roles.tip
    foot, turn = placed(scene, joint.first, joint.first_frame.point, position, quaternion)
    tip, _ = placed(scene, tip_body, tip_point, position, quaternion)
    upward = turn @ np.asarray(joint.first_frame.axes)[:, 2]
    return np.asarray(np.linalg.norm(cross(upward, tip - foot), axis=-1))
