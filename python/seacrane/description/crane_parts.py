"""The cranes of a scene: their roles are written here by whoever builds them, and looked up here by name.

Labels are a crane's prefix and the role, such as "main" or "aft main". What a role names and the scene no
longer has is left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane.description.capacity import capacity_of, design_factor_of
from seacrane.description.cylinder_areas import Areas, areas_by_label
from seacrane.description.description import GROUND, Description, coordinate_of
from seacrane.description.given import floating_bodies
from seacrane.description.loads import lines_of, path_of, whole_of
from seacrane.description.luffing_rope import LuffingRope
from seacrane.description.roles import CraneRoles, Vector
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, shaped_of, text_of
from seacrane.inputs.shown import shown


def add_roles(
    scene: Description,
    *,
    prefix: str = "",
    slew: str | tuple[str, str] | None = None,
    cylinders: Mapping[str, str] | None = None,
    link: str | None = None,
    line: str | None = None,
    payload: str | None = None,
    tip: tuple[str, Vector] | None = None,
    capacity: Any = (),
    areas: Mapping[str, Any] | None = None,
    luffs: Mapping[str, str | tuple[str, str]] | None = None,
    ropes: Mapping[str, LuffingRope] | None = None,
    design_factor: float = 1.0,
    held: bool = False,
    structure: str | None = None,
) -> CraneRoles:
    """Tell which elements are the parts of a crane that was described by hand; `add_crane` does it by itself.

    From the roles come the channels stroke, stroke_rate, cylinder_force, slew_angle, slew_torque and
    link_tension, the quantities of `seacrane.trade`, and what pictures draw.

    Parameters
    ----------
    prefix : str
        Of the crane's labels, such as "aft "; it tells several cranes apart.
    slew : str or (str, str)
        Joint of the slew drive, or joint and coordinate.
    cylinders : mapping of str to str
        Sliding joint of every cylinder by its label, such as ``{"main": "main_cylinder"}``.
    link : str
        Distance joint from the tip to the payload.
    line : str
        In its place, the line from the tip that the payload hangs on, by itself or below a block.
    payload : str
        Body that hangs; default: the second body of the link, or the body that the line reaches last.
    tip : (str, array_like of shape (3,))
        Body and point in its coordinates, m; default: where the link begins.
    capacity : array_like, shape (n, 2), optional
        Allowable load (kg) over radii of the tip from the slew axis (m, increasing): linear in between, none
        beyond the last.
    areas : mapping of str to (float, float), optional
        Full side and rod side of the piston, m2, by the cylinder's label: the channel cylinder_pressure.
    luffs : mapping of str to str or (str, str), optional
        Hinge that raises and lowers the jib, or hinge and coordinate, by its label.
    ropes : mapping of str to LuffingRope, optional
        That holds a hinge, by the hinge's label.
    design_factor : float
        Dynamic factor that the capacity contains, 1 or more: the channel utilisation allows a hook load,
        block and rigging included, of so many times the capacity.
    held : bool
        Whether a slew drive, luff or cylinder on which nothing acts when the scene is compiled is held where
        it is described, as those of `add_crane` are.
    structure : str, optional
        Hinge and spring, of one name, that stand for what the crane's structure gives: N/m at the tip. What
        `add_hoist` hangs there preloads the spring.

    Raises
    ------
    SceneError
        For a part that is not in the scene, a link that is no distance joint, or a prefix used twice.
    """
    what = f"crane {text_of('crane: prefix', prefix)!r}" if prefix else "crane"
    if prefix in scene.roles:
        raise SceneError(f"{what}: its prefix {prefix!r} is used twice; give each crane its own")
    if link is not None:
        _require(what, "link", link, scene.joints, "joint")
        if scene.joints[link].kind != "distance":
            raise SceneError(
                f"{what}: link {link!r} is a {scene.joints[link].kind} joint; give a distance joint"
            )
        payload = scene.joints[link].second if payload is None else payload
        tip = _start_of(scene, link) if tip is None else tip
    if line is not None:
        if link is not None:
            raise SceneError(f"{what}: has link {link!r} and line {line!r}; its payload hangs on one of them")
        path = _path(scene, what, line)
        payload = path[-1][0] if payload is None else payload
        tip = path[0] if tip is None else tip
    if structure is not None:
        _require(what, "structure", structure, scene.joints, "joint")
        _require(what, "structure", structure, scene.springs, "spring")
    for label, joint in (cylinders or {}).items():
        _require(what, f"cylinder {label!r}", joint, scene.joints, "joint")
    if payload is not None:
        _require(what, "payload", payload, scene.bodies, "body")
    hinges = {label: _drive(scene, f"{what}: luff {label!r}", one) for label, one in (luffs or {}).items()}
    for label, rope in (ropes or {}).items():
        _check_rope(scene, what, label, rope, hinges)
    roles = CraneRoles(
        prefix=prefix,
        luffs=hinges,
        ropes=ropes or {},
        slew=None if slew is None else _drive(scene, f"{what}: slew", slew),
        cylinders=cylinders or {},
        link=link,
        line=line,
        payload=payload,
        tip=None if tip is None else _tip(scene, what, tip),
        capacity=capacity_of(what, capacity),
        areas=areas_by_label(what, {} if areas is None else areas, cylinders or {}),
        held=flag_of(f"{what}: held", held),
        design_factor=design_factor_of(what, design_factor),
        structure=structure,
    )
    scene.roles[prefix] = roles
    return roles


def _require(what: str, part: str, name: str, table: Mapping[str, object], kind: str) -> None:
    if text_of(f"{what}: {part}", name) not in table:
        raise SceneError(f"{what}: its {part} is {kind} {name!r}, which is not in the scene; add it first")


def _drive(scene: Description, what: str, drive: str | tuple[str, str]) -> tuple[str, str]:
    joint, coordinate = (drive, None) if isinstance(drive, str) else drive
    return joint, coordinate_of(scene, what, joint, coordinate)


def _check_rope(
    scene: Description, what: str, label: str, rope: Any, hinges: Mapping[str, tuple[str, str]]
) -> None:
    if not isinstance(rope, LuffingRope):
        raise SceneError(f"{what}: rope {label!r} is {shown(rope)}; give a LuffingRope")
    if label not in hinges:
        known = ", ".join(map(repr, hinges)) or "none"
        raise SceneError(f"{what}: a rope holds hinge {label!r}; the luffs are {known}")
    for body, _ in (rope.first, rope.second):
        if body != GROUND:
            _require(what, f"rope {rope.name!r}: block", body, scene.bodies, "body")
    if not (rope.falls >= 1 and np.isfinite(rope.EA) and rope.EA > 0.0):
        raise SceneError(
            f"{what}: rope {rope.name!r} has {rope.falls} falls of EA {rope.EA:g} N; give one fall or "
            "more, and an EA above zero"
        )


def _tip(scene: Description, what: str, tip: tuple[str, Vector]) -> tuple[str, Vector]:
    body, point = tip
    _require(what, "tip", body, scene.bodies, "body")
    x, y, z = (float(value) for value in shaped_of(f"{what}: tip", point, (3,)))
    return body, (x, y, z)


def _path(scene: Description, what: str, line: str) -> list[tuple[str, Vector]]:
    """Bodies and points of a line by name, or of the segments of one with mass."""
    lines = lines_of(scene.loads)
    parts = [one for name, one in lines.items() if line in (name, whole_of(name, one))]
    if not parts:
        known = ", ".join(dict.fromkeys(whole_of(name, one) for name, one in lines.items())) or "none"
        raise SceneError(f"{what}: its line is {line!r}, which is not in the scene, that has {known}")
    return [(body, tuple(map(float, at))) for one in parts for body, at in path_of(one)]  # type: ignore[misc]


def _start_of(scene: Description, link: str) -> tuple[str, Vector] | None:
    """Where a link begins, on its first body; None on the ground."""
    joint = scene.joints[link]
    x, y, z = np.asarray(joint.first_frame.point).tolist()
    return (joint.first, (x, y, z)) if joint.first in scene.bodies else None


def cylinders(scene: Description) -> dict[str, str]:
    """Sliding joints of all cylinders, by label."""
    return {
        roles.prefix + label: joint
        for roles in scene.roles.values()
        for label, joint in roles.cylinders.items()
        if joint in scene.joints
    }


def drive_named(scene: Description, label: str) -> tuple[str, str] | None:
    """Joint and coordinate of a slew drive, luff or cylinder by its label, such as "slew" or "aft main"."""
    strokes = {name: (joint, "displacement") for name, joint in cylinders(scene).items()}
    return {**strokes, **luffs(scene), **slews(scene)}.get(label)


def piston_areas(scene: Description) -> dict[str, Areas]:
    """Full side and rod side of the pistons that are known, m2, by the cylinders' labels."""
    known = cylinders(scene)
    found = {
        roles.prefix + label: areas for roles in scene.roles.values() for label, areas in roles.areas.items()
    }
    return {label: areas for label, areas in found.items() if label in known}


def slews(scene: Description) -> dict[str, tuple[str, str]]:
    """Joint and coordinate of every slew drive, by label."""
    found = {f"{roles.prefix}slew": roles.slew for roles in scene.roles.values() if roles.slew}
    return {label: slew for label, slew in found.items() if slew[0] in scene.joints}


def luffs(scene: Description) -> dict[str, tuple[str, str]]:
    """Joint and coordinate of every hinge that luffs, by label."""
    return {
        roles.prefix + label: place
        for roles in scene.roles.values()
        for label, place in roles.luffs.items()
        if place[0] in scene.joints
    }


def luffing_ropes(scene: Description) -> dict[str, LuffingRope]:
    """Ropes that hold hinges, by the label of the hinge."""
    known = luffs(scene)
    found = {
        roles.prefix + label: rope for roles in scene.roles.values() for label, rope in roles.ropes.items()
    }
    return {label: rope for label, rope in found.items() if label in known}


def hooks(scene: Description) -> dict[str, str]:
    """Distance joints that payloads hang on, by label."""
    found = {f"{roles.prefix}hook": roles.link for roles in scene.roles.values() if roles.link}
    return {label: link for label, link in found.items() if link in scene.joints}


def payloads(scene: Description) -> dict[str, str]:
    """Bodies that hang on cranes, by label."""
    found = {f"{roles.prefix}payload": roles.payload for roles in scene.roles.values() if roles.payload}
    return {label: body for label, body in found.items() if body in scene.bodies}


def tips(scene: Description) -> dict[str, tuple[str, Vector]]:
    """Body and point in its coordinates (m) of every tip, by label."""
    found = {f"{roles.prefix}tip": roles.tip for roles in scene.roles.values() if roles.tip}
    return {label: tip for label, tip in found.items() if tip[0] in scene.bodies}


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
