"""Whether bodies, joints, roles and ropes of a crane fit together."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from seacrane.crane.data import CLOSING, FREEDOMS, CraneData, JointData
from seacrane.crane.pose import CLOSED, extent_of, pose_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.shown import listed, shown

ALIGNED = 1e-6  # cosine between the axes of a universal joint
KEYWORDS = ("foot", "payload_mass", "gravity")  # of methods that take coordinates by their labels


def check(source: str, data: CraneData) -> None:
    """FileFormatError that names the item which does not fit."""
    if not data.bodies:
        raise FileFormatError(f"{source}: has no bodies; write [[bodies]].")
    _different(source, "body", (body.name for body in data.bodies))
    _different(source, "joint", ("deck", "link", *(joint.name for joint in data.joints)))
    for joint in data.joints:
        _check_joint(source, joint)
    _check_tree(source, data)
    _check_closing(source, data)
    _check_roles(source, data)
    _check_ropes(source, data)
    try:
        pose_of(data, {})
    except SceneError as error:
        raise FileFormatError(f"{source}: {error}.") from error


def _different(source: str, what: str, names: Iterable[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise FileFormatError(f"{source}: the name {shown(name)} is that of two; rename one {what}.")
        seen.add(name)


def _check_joint(source: str, joint: JointData) -> None:
    what = f"{source}: joint {joint.name!r}"
    if joint.kind not in FREEDOMS:
        raise FileFormatError(f"{what}: kind is {shown(joint.kind)}; write one of {', '.join(FREEDOMS)}.")
    needs = {"revolute": 1, "prismatic": 1, "universal": 2}.get(joint.kind, 0)
    has = [joint.axis is not None, joint.second_axis is not None]
    if has != [needs > 0, needs > 1]:
        wanted = ("no axis", "axis alone", "axis and second_axis")[needs]
        raise FileFormatError(f"{what}: a {joint.kind} joint takes {wanted}; correct its axes.")
    if needs == 2 and abs(float(np.dot(joint.axis, joint.second_axis))) > ALIGNED:  # type: ignore[arg-type]
        raise FileFormatError(f"{what}: axis and second_axis are not perpendicular; turn one of them.")
    if joint.range is not None and joint.kind not in ("revolute", "prismatic"):
        raise FileFormatError(f"{what}: a {joint.kind} joint has no range; leave it out.")


def _check_tree(source: str, data: CraneData) -> None:
    there, names = {data.root}, {data.root, *(one.name for one in data.bodies)}
    for joint in data.tree.values():
        for role, body in (("first", joint.first), ("second", joint.second)):
            if body not in names:
                known = listed([one.name for one in data.bodies])
                raise FileFormatError(
                    f"{source}: joint {joint.name!r}: its {role} body is {shown(body)}; there are {known}."
                )
        if joint.first not in there:
            raise FileFormatError(
                f"{source}: joint {joint.name!r}: nothing carries its first body {joint.first!r} yet; write "
                "the joint that does before it."
            )
        if joint.second in there:
            raise FileFormatError(
                f"{source}: joint {joint.name!r} closes a loop: something carries its second body "
                f"{joint.second!r} already; write it as one of [[closing_joints]]."
            )
        there.add(joint.second)
    loose = [body.name for body in data.bodies if body.name not in there]
    if loose:
        raise FileFormatError(f"{source}: no joint carries body {loose[0]!r}; add one, or take it out.")


def _check_closing(source: str, data: CraneData) -> None:
    known = {data.root, *(body.name for body in data.bodies)}
    for joint in data.closing_joints:
        what = f"{source}: closing joint {joint.name!r}"
        if joint.kind not in CLOSING:
            raise FileFormatError(f"{what}: kind is {shown(joint.kind)}; write one of {', '.join(CLOSING)}.")
        if not {joint.first, joint.second} <= known or joint.first == joint.second:
            raise FileFormatError(
                f"{what}: joins {shown(joint.first)} and {shown(joint.second)}; name two bodies of the crane."
            )
        if joint.range is not None:
            raise FileFormatError(f"{what}: has a range; give one to a joint of the tree.")


def _check_roles(source: str, data: CraneData) -> None:
    kinds = {name: joint.kind for name, joint in data.tree.items()}
    wanted = {"luff": (data.luffs, "revolute"), "cylinder": (data.cylinders, "prismatic")}
    slew = {} if data.slew is None else {"slew": data.slew}
    for role, (joints, kind) in {"slew drive": (slew, "revolute"), **wanted}.items():
        for label, joint in joints.items():
            if kinds.get(joint) != kind:
                fitting = listed([name for name, one in kinds.items() if one == kind]) or "none"
                raise FileFormatError(
                    f"{source}: {role} {label!r} is joint {shown(joint)}, which is no {kind} joint of the "
                    f"tree; there are {fitting}."
                )
    _different(source, "coordinate", [*KEYWORDS, *slew, *data.luffs, *data.cylinders])
    if data.tip[0] not in {body.name for body in data.bodies}:
        raise FileFormatError(f"{source}: the tip is on {shown(data.tip[0])}; name a body of the crane.")


def _check_ropes(source: str, data: CraneData) -> None:
    _different(source, "rope's luff", (rope.luff for rope in data.ropes))
    for rope in data.ropes:
        what = f"{source}: rope {rope.name!r}"
        if rope.luff not in data.luffs:
            raise FileFormatError(
                f"{what}: holds luff {shown(rope.luff)}; the luffs are "
                f"{listed([repr(name) for name in data.luffs]) or 'none'}."
            )
        beyond = data.beyond(data.luffs[rope.luff])
        if rope.first[0] in beyond or rope.second[0] not in beyond:
            raise FileFormatError(
                f"{what}: runs from {shown(rope.first[0])} to {shown(rope.second[0])}; its first body must "
                f"be before hinge {data.luffs[rope.luff]!r} and its second beyond it."
            )
        if np.linalg.norm(rope.second[1] - rope.first[1]) < CLOSED * extent_of(data):
            raise FileFormatError(f"{what}: has no length at home; move one of its blocks.")
