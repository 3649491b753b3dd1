"""load_crane: reads a crane's data file, of whatever kind it says (TOML; see docs/crane.md)."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.crane.crane import Crane
from seacrane.crane.data import (
    CLOSING,
    FREEDOMS,
    HOME,
    BodyData,
    CraneData,
    JointData,
    RopeData,
    placed,
)
from seacrane.crane.file_table import FileTable, as_file_error, root_of
from seacrane.crane.mass_properties import MassProperties, combine
from seacrane.crane.pose import CLOSED, extent_of, pose_of
from seacrane.crane.urdf import read_urdf
from seacrane.description.roles import Areas
from seacrane.errors import FileFormatError
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import listed, shown
from seacrane.inputs.units import UNITS, into_si
from seacrane.inputs.whole_file import read_whole

LARGEST_FILE = 2**20  # bytes
TOTAL = 1e-9  # of the mass, by which the members may miss it
SHIPPED = Path(__file__).resolve().parent.parent / "data" / "cranes"
DEFAULT = "knuckle_boom_250t"
ALIGNED = 1e-6  # cosine between the axes of a universal joint
KEYWORDS = ("foot", "payload_mass", "gravity")  # of methods that take coordinates by their labels


def load_crane(path: str | Path = DEFAULT) -> Crane:
    """Read a crane's data file.

    Parameters
    ----------
    path : path-like
        TOML with kind "jointed" or "urdf"; or the name of a crane that comes with
        seacrane, one of `shipped_cranes`. Default: the 250 t knuckle boom among them.

    Returns
    -------
    Crane
        For `Scene.add_crane`.

    Raises
    ------
    FileFormatError
        The file cannot be read, is malformed, or describes a crane that cannot work; the message names the
        item.
    """
    return _shipped(str(path)) if str(path) in shipped_cranes() else _read(Path(path))


@cache
def _shipped(name: str) -> Crane:
    """Nearly every scene has the same one, which takes as long to read as the rest of it."""
    return _read(SHIPPED / f"{name}.toml")


def _read(file: Path) -> Crane:
    try:
        text = read_whole(file, LARGEST_FILE, "no crane file is").decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(f"crane data file {file} cannot be read ({error}); check the path.") from error
    return parse_crane(text, source=str(file), folder=file.parent)


def shipped_cranes() -> list[str]:
    """Names of the cranes that come with seacrane."""
    return sorted(path.stem for path in SHIPPED.glob("*.toml"))


def parse_crane(text: str, *, source: str = "crane data", folder: Path | None = None) -> Crane:
    """Read a crane from TOML text; `source` is its name in messages, a URDF file is in the `folder`, by
    default the working directory. FileFormatError as of `load_crane`."""
    root = root_of(text, source)
    kind, name = root.head(), root.text("name")
    match kind:
        case "jointed":
            bodies = tuple(_body(table) for table in root.tables("bodies"))
            root.frames |= {body.name: (body.name, body.frame) for body in bodies}
            joints = tuple(_joint(table) for table in root.tables("joints"))
            stands = bodies[0].name if bodies else ""
            total, mass = root.number("total_mass", "kg"), math.fsum(body.properties.mass for body in bodies)
            if abs(mass - total) > TOTAL * total:
                root.refuse(
                    f"the bodies add up to {mass:g} kg, total_mass is {total:g} kg; correct one of them"
                )
        case "urdf":  # which has the masses of its links alone
            stands, bodies, joints, frames = read_urdf((folder or Path()) / root.text("urdf"))
            root.frames |= frames
        case _:
            root.wrong("kind", kind, 'write "jointed", as the shipped knuckle boom has it, or "urdf"')
    closing = tuple(_joint(table, closes=True) for table in root.tables("closing_joints"))
    roles = root.table("roles")
    slew = roles.text("slew") if "slew" in roles.values else None
    luffs, cylinders = _names(roles, "luffs"), _names(roles, "cylinders")
    tip = _place(roles.table("tip"))
    roles.finish()
    areas, oil = _pistons(root, cylinders)
    data = CraneData(
        name=name, root=stands, bodies=bodies, joints=joints + closing, slew=slew,
        luffs=ReadOnly(luffs), cylinders=ReadOnly(cylinders), tip=tip,
        ropes=tuple(_rope(table) for table in root.tables("ropes")), capacity=root.capacity(),
        areas=ReadOnly(areas), hydraulics=ReadOnly(oil),
    ).at_joints()  # fmt: skip
    root.finish()
    _check(root, data)
    return Crane(data)


def _body(table: FileTable) -> BodyData:
    """By its members, or by mass, centre of mass and inertia."""
    name = table.named()
    members = table.members("members") if "members" in table.values else ()
    properties = combine(members) if members else _given_mass(table)
    frame = HOME
    if "frame" in table.values:
        own = table.table("frame")
        frame = placed(np.array(own.numbers("xyz", 3, "m")), np.array(own.numbers("rpy", 3, "rad")))
        own.finish()
    table.finish()
    return BodyData(name=name, properties=properties, frame=frame, members=members)


def _given_mass(table: FileTable) -> MassProperties:
    mass = table.number("mass", "kg")
    center = np.array(table.numbers("center_of_mass", 3, "m"))
    name, unit = table.spelt("inertia", "kg m2") or ("inertia", "")
    rows = table.take(name)
    try:
        inertia = np.array(rows, dtype=float)
    except (TypeError, ValueError, OverflowError):
        inertia = np.zeros(0)
    if inertia.shape != (3, 3) or not np.all(np.isfinite(inertia)):
        table.wrong(name, rows, "write three rows of three numbers, kg m2, about the centre of mass")
    return MassProperties(mass, center, np.vectorize(into_si(unit))(inertia))


def _joint(table: FileTable, *, closes: bool = False) -> JointData:
    name, kind = table.named(), table.text("kind")
    frame, second = table.text("first"), table.text("second")
    first, point = table.point_on(frame)
    axis, second_axis = (table.axis_on(frame, key) for key in ("axis", "second_axis"))
    closes, limits = closes or table.flag("closes"), _range(table, kind)
    table.finish()
    return JointData(
        name=name, kind=kind, first=first, second=table.frames.get(second, (second,))[0], point=point,
        axis=axis, second_axis=second_axis, range=limits, closes=closes,
    )  # fmt: skip


def _range(table: FileTable, kind: str) -> tuple[float, float] | None:
    """In rad of a hinge, m of a slide."""
    found = table.spelt("range", "m", "rad")
    if found is None:
        return None
    own = {"revolute": "rad", "prismatic": "m"}.get(kind, found[1])
    if UNITS[found[1]][1] != UNITS[own][1]:
        table.refuse(f"{table.label(found[0])} is of a {kind} joint; write range_{own}")
    low, high = table.numbers("range", 2, "m", "rad")
    if not low < high:
        table.refuse(f"{table.label(found[0])} is {low:g} to {high:g}, in SI; write the lower end first")
    return low, high


def _names(roles: FileTable, key: str) -> dict[str, str]:
    """Joints by label."""
    if key not in roles.values:
        return {}
    table = roles.table(key)
    found = {str(label): table.text(label) for label in list(table.values)}
    table.finish()
    return found


def _place(table: FileTable) -> tuple[str, Array]:
    """A body and a point of it at home."""
    found = table.point_on(table.text("body"))
    table.finish()
    return found


def _rope(table: FileTable) -> RopeData:
    name, falls = table.named(), table.number("falls", "1")
    if falls != int(falls) or falls < 1:
        table.refuse(f"{table.label('falls')} is {falls:g}; write a whole number, 1 or more")
    stiffness = table.number("EA", "N")
    luff, ends = table.text("luff"), [_place(table.table(key)) for key in ("first", "second")]
    table.finish()
    return RopeData(name=name, luff=luff, falls=int(falls), EA=stiffness, first=ends[0], second=ends[1])


def _pistons(
    root: FileTable, cylinders: Mapping[str, str]
) -> tuple[dict[str, Areas], dict[str, Mapping[str, Any]]]:
    """Areas of the pistons and keywords of their oil, by the labels of cylinders."""
    areas: dict[str, Areas] = {}
    oil: dict[str, Mapping[str, Any]] = {}
    for table in root.tables("pistons"):
        label = table.text("cylinder")
        if label not in cylinders:
            known = ", ".join(map(repr, cylinders)) or "none"
            table.wrong("cylinder", label, f"the cylinders are {known}")
        pair, entries = table.areas(), table.hydraulics()
        if pair is None and entries is None:
            table.refuse(f"{table.where} has no areas; write full_area and rod_side_area")
        areas |= {} if pair is None else {label: pair}
        oil |= {} if entries is None else {label: ReadOnly(entries)}
        table.finish()
    return areas, oil


def _check(root: FileTable, data: CraneData) -> None:
    """FileFormatError that names the item which does not fit."""
    for checked in (_names_twice, _unlike_kinds, _no_tree, _no_loops, _no_roles, _no_ropes):
        for says in checked(data):
            root.refuse(says)
    with as_file_error(f"{root.source}: "):
        pose_of(data, {})


def _names_twice(data: CraneData) -> Iterator[str]:
    if not data.bodies:
        yield "has no bodies; write [[bodies]]"
    for what, names in {
        "body": [body.name for body in data.bodies],
        "joint": ["deck", "link", *(joint.name for joint in data.joints)],
        "coordinate": [*KEYWORDS, *([] if data.slew is None else ["slew"]), *data.luffs, *data.cylinders],
        "rope's luff": [rope.luff for rope in data.ropes],
    }.items():
        for name, count in Counter(names).items():
            if count > 1:
                yield f"the name {shown(name)} is that of two; rename one {what}"


def _unlike_kinds(data: CraneData) -> Iterator[str]:
    for joint in data.joints:
        what = f"joint {joint.name!r}"
        if joint.kind not in FREEDOMS:
            yield f"{what}: kind is {shown(joint.kind)}; write one of {', '.join(FREEDOMS)}"
        needs = {"revolute": 1, "prismatic": 1, "universal": 2}.get(joint.kind, 0)
        axes = [one for one in (joint.axis, joint.second_axis) if one is not None]
        if len(axes) != needs or (joint.axis is None) != (needs == 0):
            wanted = ("no axis", "axis alone", "axis and second_axis")[needs]
            yield f"{what}: a {joint.kind} joint takes {wanted}; correct its axes"
        if needs == 2 and abs(float(axes[0] @ axes[1])) > ALIGNED:
            yield f"{what}: axis and second_axis are not perpendicular; turn one of them"
        if joint.range is not None and (joint.closes or joint.kind not in ("revolute", "prismatic")):
            yield f"{what}: has a range; give one to a hinge or a slide that carries a body"


def _no_tree(data: CraneData) -> Iterator[str]:
    there, bodies = {data.root}, [one.name for one in data.bodies]
    known = {data.root, *bodies}
    for joint in data.tree.values():
        for role, body in (("first", joint.first), ("second", joint.second)):
            if body not in known:
                yield f"joint {joint.name!r}: its {role} body is {shown(body)}; there are {listed(bodies)}"
        if joint.first not in there:
            yield (
                f"joint {joint.name!r}: nothing carries its first body {joint.first!r} yet; write the joint "
                "that does before it"
            )
        if joint.second in there:
            yield (
                f"joint {joint.name!r} closes a loop: something carries its second body {joint.second!r} "
                "already; write it as one of [[closing_joints]]"
            )
        there.add(joint.second)
    for name in bodies:
        if name not in there:
            yield f"no joint carries body {name!r}; add one, or take it out"


def _no_loops(data: CraneData) -> Iterator[str]:
    known = {data.root, *(body.name for body in data.bodies)}
    for joint in data.closing_joints:
        what, ends = f"closing joint {joint.name!r}", f"{shown(joint.first)} and {shown(joint.second)}"
        if joint.kind not in CLOSING:
            yield f"{what}: kind is {shown(joint.kind)}; write one of {', '.join(CLOSING)}"
        if not {joint.first, joint.second} <= known or joint.first == joint.second:
            yield f"{what}: joins {ends}; name two bodies of the crane"


def _no_roles(data: CraneData) -> Iterator[str]:
    kinds = {name: joint.kind for name, joint in data.tree.items()}
    slew = {} if data.slew is None else {"slew": data.slew}
    for role, joints, kind in (
        ("slew drive", slew, "revolute"), ("luff", data.luffs, "revolute"),
        ("cylinder", data.cylinders, "prismatic"),
    ):  # fmt: skip
        for label, joint in joints.items():
            if kinds.get(joint) != kind:
                fitting = listed([name for name, one in kinds.items() if one == kind]) or "none"
                yield (
                    f"{role} {label!r} is joint {shown(joint)}, which is no {kind} joint of the tree; there "
                    f"are {fitting}"
                )
    if data.tip[0] not in {body.name for body in data.bodies}:
        yield f"the tip is on {shown(data.tip[0])}; name a body of the crane"


def _no_ropes(data: CraneData) -> Iterator[str]:
    for rope in data.ropes:
        what, (first, start), (second, end) = f"rope {rope.name!r}", rope.first, rope.second
        if rope.luff not in data.luffs:
            known = listed([repr(name) for name in data.luffs]) or "none"
            yield f"{what}: holds luff {shown(rope.luff)}; the luffs are {known}"
        beyond = data.beyond(data.luffs[rope.luff])
        if first in beyond or second not in beyond:
            yield (
                f"{what}: runs from {shown(first)} to {shown(second)}; its first body must be before hinge "
                f"{data.luffs[rope.luff]!r} and its second beyond it"
            )
        if np.linalg.norm(end - start) < CLOSED * extent_of(data):
            yield f"{what}: has no length at home; move one of its blocks"
