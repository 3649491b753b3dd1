"""load_crane: reads a crane's data file, of whatever kind it says (TOML; see docs/crane.md)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.check import check
from seacrane.crane.crane import Crane
from seacrane.crane.data import HOME, BodyData, CraneData, JointData, RopeData
from seacrane.crane.file_table import FileTable, Frames, read_text, root_of
from seacrane.crane.knuckle_boom import knuckle_boom
from seacrane.crane.mass_properties import MassProperties, combine
from seacrane.crane.urdf import read_urdf
from seacrane.description.roles import Areas

Array = NDArray[np.float64]
TOTAL = 1e-9  # of the mass, by which the members may miss it
SHIPPED = Path(__file__).resolve().parent.parent / "data" / "cranes"
DEFAULT = "knuckle_boom_250t"


def load_crane(path: str | Path = DEFAULT) -> Crane:
    """Read a crane's data file.

    Parameters
    ----------
    path : path-like
        TOML with kind "knuckle-boom" (default), "jointed" or "urdf"; or the name of a crane that comes with
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
    file = SHIPPED / f"{path}.toml" if str(path) in shipped_cranes() else Path(path)
    return parse_crane(read_text(file), source=str(file), folder=file.parent)


def shipped_cranes() -> list[str]:
    """Names of the cranes that come with seacrane."""
    return sorted(path.stem for path in SHIPPED.glob("*.toml"))


def parse_crane(text: str, *, source: str = "crane data", folder: Path | None = None) -> Crane:
    """Read a crane from TOML text.

    Parameters
    ----------
    source : Name used in messages.
    folder : In which a URDF file is; default: the working directory.

    Raises
    ------
    FileFormatError
        As of `load_crane`.
    """
    root = root_of(text, source)
    kind = root.head(default="knuckle-boom")
    match kind:
        case "knuckle-boom":
            data = knuckle_boom(root)
        case "jointed":
            data = _jointed(root)
        case "urdf":
            data = _beside_urdf(root, folder or Path())
        case _:
            root.wrong("kind", kind, 'write "knuckle-boom", "jointed" or "urdf"')
    if kind != "urdf":  # which has the masses of its links alone
        total, mass = root.number("total_mass"), math.fsum(body.properties.mass for body in data.bodies)
        if abs(mass - total) > TOTAL * total:
            root.refuse(
                f"the bodies add up to {mass:g} kg, total_mass is {total:g} kg; correct a mass or total_mass"
            )
    root.finish()
    check(source, data)
    return Crane(data)


def _jointed(root: FileTable) -> CraneData:
    name, bodies = root.text("name"), tuple(_body(table) for table in root.tables("bodies"))
    here = Frames({body.name: HOME for body in bodies})
    joints = tuple(_joint(table, here) for table in root.tables("joints"))
    stands = bodies[0].name if bodies else ""
    return _with_roles(root, name, stands, bodies, joints, here)


def _beside_urdf(root: FileTable, folder: Path) -> CraneData:
    """Bodies and joints are the URDF's, closing joints and roles those of the table."""
    name = root.text("name")
    return _with_roles(root, name, *read_urdf(folder / root.text("urdf")))


def _with_roles(
    root: FileTable,
    name: str,
    stands: str,
    bodies: tuple[BodyData, ...],
    joints: tuple[JointData, ...],
    frames: Frames,
) -> CraneData:
    closing = tuple(_joint(table, frames, closes=True) for table in root.tables("closing_joints"))
    roles = root.table("roles")
    slew = roles.text("slew") if "slew" in roles.values else None
    luffs, cylinders = _names(roles, "luffs"), _names(roles, "cylinders")
    tip = _place(roles.table("tip"), frames)
    roles.finish()
    areas, oil = _pistons(root, cylinders)
    return CraneData(
        name=name,
        root=stands,
        bodies=bodies,
        joints=joints + closing,
        slew=slew,
        luffs=luffs,
        cylinders=cylinders,
        tip=tip,
        ropes=tuple(_rope(table, frames) for table in root.tables("ropes")),
        capacity=root.capacity(),
        areas=areas,
        hydraulics=oil,
    ).at_joints()


def _body(table: FileTable) -> BodyData:
    """By its members, or by mass, centre of mass and inertia."""
    name = table.named()
    if "members" in table.values:
        members = table.members("members")
        properties = combine(members)
    else:
        members, properties = (), _given_mass(table)
    table.finish()
    return BodyData(name=name, properties=properties, members=members)


def _given_mass(table: FileTable) -> MassProperties:
    mass = table.number("mass")
    center = np.array(table.space_point("center_of_mass"))
    rows = table.take("inertia")
    try:
        inertia = np.array(rows, dtype=float)
    except (TypeError, ValueError, OverflowError):
        inertia = np.zeros(0)
    if inertia.shape != (3, 3) or not np.all(np.isfinite(inertia)):
        table.wrong("inertia", rows, "write three rows of three numbers, kg m2, about the centre of mass")
    return MassProperties(mass, center, inertia)


def _joint(table: FileTable, frames: Frames, *, closes: bool = False) -> JointData:
    name, kind = table.named(), table.text("kind")
    first, second = table.text("first"), table.text("second")
    point = frames.point(table, first, table.space_point("point"))
    axes = {
        key: frames.axis(table, first, key) if key in table.values else None
        for key in ("axis", "second_axis")
    }
    limits = _range(table)
    table.finish()
    return JointData(
        name=name, kind=kind, first=frames.body(first), second=frames.body(second), point=point, range=limits,
        closes=closes, **axes,
    )  # fmt: skip


def _range(table: FileTable) -> tuple[float, float] | None:
    """In rad or m: a hinge may have degrees."""
    found = [key for key in ("range_m", "range_deg", "range_rad") if key in table.values]
    if not found:
        return None
    if len(found) > 1:
        table.refuse(f"{table.where} has {' and '.join(found)}; write one of them")
    low, high = table.point(found[0])
    if not low < high:
        table.refuse(f"{table.label(found[0])} is {low:g} to {high:g}; write the lower end first")
    return (math.radians(low), math.radians(high)) if found[0] == "range_deg" else (low, high)


def _names(roles: FileTable, key: str) -> dict[str, str]:
    """Joints by label."""
    if key not in roles.values:
        return {}
    table = roles.table(key)
    found = {str(label): table.text(label) for label in list(table.values)}
    table.finish()
    return found


def _place(table: FileTable, frames: Frames) -> tuple[str, Array]:
    """A body and a point of it at home."""
    body = table.text("body")
    point = frames.point(table, body, table.space_point("point"))
    table.finish()
    return frames.body(body), point


def _rope(table: FileTable, frames: Frames) -> RopeData:
    name, falls = table.named(), table.number("falls")
    if falls != int(falls) or falls < 1:
        table.refuse(f"{table.label('falls')} is {falls:g}; write a whole number, 1 or more")
    rope = RopeData(
        name=name,
        luff=table.text("luff"),
        falls=int(falls),
        EA=table.number("stiffness" if "stiffness" in table.values else "EA"),  # as in 0.2, or since
        first=_place(table.table("first"), frames),
        second=_place(table.table("second"), frames),
    )
    table.finish()
    return rope


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
            table.refuse(f"{table.where} has no areas; write full_area and rod_side_area, m2")
        areas |= {} if pair is None else {label: pair}
        oil |= {} if entries is None else {label: entries}
        table.finish()
    return areas, oil
