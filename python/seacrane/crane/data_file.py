"""Reads and checks the data file of a knuckle-boom crane (TOML; see docs/crane.md)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from types import MappingProxyType
from typing import Any

from seacrane.crane.file_table import FileTable, number_at, read_text, root_of
from seacrane.crane.mass_properties import Member, Point
from seacrane.description.capacity import Capacity
from seacrane.description.cylinder_areas import Areas
from seacrane.description.hydraulic_values import VALUES
from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown

DEFAULT_PATH = Path(__file__).resolve().parent.parent / "data" / "knuckle_boom_250t.toml"
KIND = "knuckle-boom"
APART = 1e-6  # m: pivots nearer than that are one


@dataclass(frozen=True, kw_only=True)
class CylinderData:
    """A hydraulic cylinder: length between its pivots at stroke 0 and largest stroke, m; its members.

    Areas of the piston's full side and rod side, m2, and keywords of `add_hydraulic_cylinder`, where the file
    has them.
    """

    retracted_length: float
    stroke: float
    barrel: tuple[Member, ...]
    rod: tuple[Member, ...]
    areas: Areas | None = None
    hydraulics: Mapping[str, Any] | None = None


@dataclass(frozen=True, kw_only=True)
class CraneData:
    """Everything a crane data file says; units m and kg, points in the plane frames of the file's header.

    Attributes
    ----------
    tower_height : float
        Slew bearing A above the crane foot.
    main_jib_pivot, main_cylinder_pivot : (float, float)
        C and B on the king, (outward, up) from A.
    main_jib_length, knuckle_jib_length : float
        C to F, F to the tip.
    main_cylinder_head, knuckle_cylinder_pivot : (float, float)
        D and E on the main jib, (along, above) from C.
    knuckle_cylinder_head : (float, float)
        G on the knuckle jib, (along, above) from F.
    minimum_lever_arm : float
        Least distance of a cylinder's line from its jib's pivot, over all strokes.
    capacity : tuple of (float, float)
        Allowable load, kg, over the radius of the tip from the slew axis, m; empty: the file has none.
    """

    name: str
    total_mass: float
    minimum_lever_arm: float
    tower_height: float
    tower: tuple[Member, ...]
    main_jib_pivot: Point
    main_cylinder_pivot: Point
    king: tuple[Member, ...]
    main_jib_length: float
    main_cylinder_head: Point
    knuckle_cylinder_pivot: Point
    main_jib: tuple[Member, ...]
    knuckle_jib_length: float
    knuckle_cylinder_head: Point
    knuckle_jib: tuple[Member, ...]
    main_cylinder: CylinderData
    knuckle_cylinder: CylinderData
    capacity: Capacity = ()

    def members(self) -> dict[str, tuple[Member, ...]]:
        """Members of each of the eight bodies, by body name."""
        return {
            "tower": self.tower,
            "king": self.king,
            "main_barrel": self.main_cylinder.barrel,
            "main_rod": self.main_cylinder.rod,
            "main_jib": self.main_jib,
            "knuckle_barrel": self.knuckle_cylinder.barrel,
            "knuckle_rod": self.knuckle_cylinder.rod,
            "knuckle_jib": self.knuckle_jib,
        }


def hydraulics_of(table: FileTable) -> Mapping[str, Any] | None:
    """Keywords of a hydraulic cylinder, from a table of tables: one for each of its values, SI units."""
    if "hydraulics" not in table.values:
        return None
    inner = table.table("hydraulics")
    found = {word: _value(inner.table(word), kind) for word, kind in VALUES.items() if word in inner.values}
    inner.finish()
    return MappingProxyType(found)


def _value(table: FileTable, kind: type[Any]) -> Any:
    given = {}
    for key in [one.name for one in fields(kind) if one.name in table.values]:
        value = table.take(key)
        given[key] = value if isinstance(value, bool) else number_at(table.source, table.label(key), value)
    table.finish()
    return kind(**given)


def _cylinder(table: FileTable) -> CylinderData:
    data = CylinderData(
        retracted_length=table.number("retracted_length"),
        stroke=table.number("stroke"),
        barrel=table.members("barrel"),
        rod=table.members("rod"),
        areas=table.areas(),
        hydraulics=hydraulics_of(table),
    )
    table.finish()
    return data


def _crane(root: FileTable) -> CraneData:
    kind = root.head(default=KIND)
    if kind != KIND:
        raise FileFormatError(
            f"{root.source}: kind is {shown(kind)}, which is no {KIND} crane; read it with load_crane."
        )
    tower, king = root.table("tower"), root.table("king")
    main_jib, knuckle_jib = root.table("main_jib"), root.table("knuckle_jib")
    data = CraneData(
        name=root.text("name"),
        total_mass=root.number("total_mass"),
        minimum_lever_arm=root.number("minimum_lever_arm"),
        tower_height=tower.number("height"),
        tower=tower.members("members"),
        main_jib_pivot=king.point("main_jib_pivot"),
        main_cylinder_pivot=king.point("main_cylinder_pivot"),
        king=king.members("members"),
        main_jib_length=main_jib.number("length"),
        main_cylinder_head=main_jib.point("main_cylinder_head"),
        knuckle_cylinder_pivot=main_jib.point("knuckle_cylinder_pivot"),
        main_jib=main_jib.members("members"),
        knuckle_jib_length=knuckle_jib.number("length"),
        knuckle_cylinder_head=knuckle_jib.point("knuckle_cylinder_head"),
        knuckle_jib=knuckle_jib.members("members"),
        main_cylinder=_cylinder(root.table("main_cylinder")),
        knuckle_cylinder=_cylinder(root.table("knuckle_cylinder")),
        capacity=root.capacity("capacity"),
    )
    for table in (tower, king, main_jib, knuckle_jib, root):
        table.finish()
    return data


def _check_total(source: str, data: CraneData) -> None:
    total = math.fsum(member.mass for body in data.members().values() for member in body)
    if abs(total - data.total_mass) > 1e-9 * data.total_mass:
        raise FileFormatError(
            f"{source}: the members add up to {total:g} kg, total_mass is {data.total_mass:g} kg; "
            "correct a member's mass or total_mass."
        )


def _check_triangle(source: str, name: str, cylinder: CylinderData, sides: Point, least: float) -> None:
    """The triangle of jib pivot, cylinder pivot and rod head must close at both ends of the stroke.

    The squared lever arm is concave in the squared length, so its least value is at an end of the stroke.
    """
    first, second = sides
    shortest, longest = abs(first - second), first + second
    for stroke in (0.0, cylinder.stroke):
        length = cylinder.retracted_length + stroke
        if not shortest <= length <= longest:
            raise FileFormatError(
                f"{source}: {name} cannot reach stroke {stroke:g} m: its length there is {length:g} m, its "
                f"pivots allow {shortest:.4g} to {longest:.4g} m; change retracted_length, stroke or a pivot."
            )
        cosine = (first**2 + second**2 - length**2) / (2.0 * first * second)
        lever = first * second * math.sqrt(max(0.0, 1.0 - cosine**2)) / length
        if lever < least:
            raise FileFormatError(
                f"{source}: {name} has a lever arm of {lever:.4g} m at stroke {stroke:g} m, near its dead "
                f"centre; minimum_lever_arm is {least:g} m: change retracted_length, stroke or a pivot."
            )


def _check_reach(source: str, data: CraneData) -> None:
    elbow = (data.main_jib_length, 0.0)
    triangles = {
        "main_cylinder": (
            data.main_cylinder,
            math.dist(data.main_jib_pivot, data.main_cylinder_pivot),
            math.hypot(*data.main_cylinder_head),
        ),
        "knuckle_cylinder": (
            data.knuckle_cylinder,
            math.dist(elbow, data.knuckle_cylinder_pivot),
            math.hypot(*data.knuckle_cylinder_head),
        ),
    }
    for name, (cylinder, first, second) in triangles.items():
        if min(first, second) < APART:
            raise FileFormatError(
                f"{source}: {name} is pinned at its jib's own pivot; move its pivot or head."
            )
        _check_triangle(source, name, cylinder, (first, second), data.minimum_lever_arm)


def parse(text: str, *, source: str = "crane data") -> CraneData:
    """Read crane data from TOML text.

    Parameters
    ----------
    source : Name used in messages.

    Raises
    ------
    FileFormatError
        The text is not TOML, a key is missing or unknown, a value is out of range, the masses do not add up,
        a stroke cannot be reached, or a cylinder comes too near its dead centre.
    """
    data = _crane(root_of(text, source))
    _check_total(source, data)
    _check_reach(source, data)
    return data


def load(path: str | Path | None = None) -> CraneData:
    """Read a crane data file; without a path, the 250 t crane that comes with seacrane.

    Raises
    ------
    FileFormatError
        As `parse`, or the file cannot be read.
    """
    path = DEFAULT_PATH if path is None else Path(path)
    return parse(read_text(path), source=str(path))
