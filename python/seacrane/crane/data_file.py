"""Reads and checks the data file of a knuckle-boom crane (TOML; see docs/crane.md)."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from seacrane import _core
from seacrane.crane.mass_properties import Box, Member, Point, Tube
from seacrane.description.capacity import Capacity, capacity_of
from seacrane.description.cylinder_areas import Areas, areas_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.files.whole_file import read_whole
from seacrane.inputs.shown import shown

DEFAULT_PATH = Path(__file__).resolve().parent.parent / "data" / "knuckle_boom_250t.toml"
SCHEMA = 1
LARGEST = 1e12  # m, kg: no crane, and nothing that its squares overflow with
LARGEST_FILE = 2**20  # bytes
LONGEST_TEXT = 200
SMALLEST = 1e-9  # m, kg
THINNEST = 1e-6  # of a section
GEOMETRY = {"full_area", "rod_side_area", "retracted_length", "stroke"}
HYDRAULIC_KEYS = {
    field.name for field in _core.HydraulicCylinder.FIELDS if field.type in ("number", "flag")
} - GEOMETRY
APART = 1e-6  # m: pivots nearer than that are one


@dataclass(frozen=True, kw_only=True)
class CylinderData:
    """A hydraulic cylinder: length between its pivots at stroke 0 and largest stroke, m; its members.

    Areas of the piston's full side and rod side, m2, and entries of `add_hydraulic_cylinder`, where the file
    has them.
    """

    retracted_length: float
    stroke: float
    barrel: tuple[Member, ...]
    rod: tuple[Member, ...]
    areas: Areas | None = None
    hydraulics: Mapping[str, float] | None = None


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


class _Table:
    """One table of the file; every value is asked for once, leftovers are misspelt keys."""

    def __init__(self, source: str, where: str, values: object) -> None:
        self.source, self.where = source, where
        if not isinstance(values, Mapping):
            raise FileFormatError(f"{source}: {where} is {shown(values)}; write a table of keys and values.")
        self.values = dict(values)

    def label(self, key: str) -> str:
        return f"{self.where}.{key}" if self.where else key

    def take(self, key: str) -> Any:
        if key not in self.values:
            raise FileFormatError(f"{self.source}: {self.label(key)} is missing; add it.")
        return self.values.pop(key)

    def table(self, key: str) -> _Table:
        return _Table(self.source, self.label(key), self.take(key))

    def text(self, key: str) -> str:
        value = self.take(key)
        if not isinstance(value, str) or not 0 < len(value) <= LONGEST_TEXT:
            raise FileFormatError(
                f"{self.source}: {self.label(key)} is {shown(value)}; write a text of 1 to {LONGEST_TEXT} "
                "characters."
            )
        return value

    def number(self, key: str, *, positive: bool = True) -> float:
        value = _number(self.source, self.label(key), self.take(key))
        if value < 0.0 or (positive and value < SMALLEST):
            need = f"greater than zero, {SMALLEST:g} at least" if positive else "zero or more"
            raise FileFormatError(f"{self.source}: {self.label(key)} is {value:g}; it must be {need}.")
        return value

    def point(self, key: str) -> Point:
        value = self.take(key)
        if not isinstance(value, list) or len(value) != 2:
            raise FileFormatError(
                f"{self.source}: {self.label(key)} is {shown(value)}; write two numbers [along, above], in m."
            )
        first, second = (_number(self.source, self.label(key), item) for item in value)
        return first, second

    def capacity(self, key: str) -> Capacity:
        """An optional table of its own: rows of radius and load."""
        if key not in self.values:
            return ()
        table = self.table(key)
        rows = table.take("rows")
        table.finish()
        if not isinstance(rows, list):
            raise FileFormatError(
                f"{self.source}: {table.label('rows')} is {shown(rows)}; write rows [radius, load], m and kg."
            )
        try:
            return capacity_of(self.source, rows)
        except SceneError as error:
            raise FileFormatError(f"{error}.") from error

    def areas(self) -> Areas | None:
        """Both areas of a piston, or neither."""
        if not {"full_area", "rod_side_area"} & set(self.values):
            return None
        pair = self.number("full_area"), self.number("rod_side_area")
        try:
            return areas_of(f"{self.source}: {self.where}", pair)
        except SceneError as error:
            raise FileFormatError(f"{error}.") from error

    def hydraulics(self) -> Mapping[str, float] | None:
        """Entries of a hydraulic cylinder, SI units, in a table of its own."""
        if "hydraulics" not in self.values:
            return None
        table, found = self.table("hydraulics"), {}
        for key in HYDRAULIC_KEYS & set(table.values):
            value = table.take(key)
            found[key] = value if isinstance(value, bool) else _number(self.source, table.label(key), value)
        table.finish()
        return MappingProxyType(found)

    def members(self, key: str) -> tuple[Member, ...]:
        value = self.take(key)
        if not isinstance(value, list) or not value:
            raise FileFormatError(f"{self.source}: {self.label(key)} needs at least one member; add one.")
        return tuple(
            _member(_Table(self.source, f"{self.label(key)}[{index}]", item))
            for index, item in enumerate(value)
        )

    def finish(self) -> None:
        if self.values:
            unknown = self.label(min(self.values))[:80]
            raise FileFormatError(f"{self.source}: unknown key {unknown}; correct its spelling or remove it.")


def _number(source: str, label: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= LARGEST:
        raise FileFormatError(
            f"{source}: {label} is {shown(value)}; write a finite number, {LARGEST:g} at most."
        )
    return float(value)


def _member(table: _Table) -> Member:
    name = table.text("name")
    table.where = f"{table.where} ({name})"
    shape = table.text("shape")
    mass = table.number("mass")
    start, end = table.point("start"), table.point("end")
    if math.dist(start, end) == 0.0:
        raise FileFormatError(f"{table.source}: {table.where} has length 0; move its start or its end.")
    member: Member
    if shape == "tube":
        member = _tube(table, name, mass, start, end)
    elif shape == "box":
        member = _box(table, name, mass, start, end)
    else:
        raise FileFormatError(
            f'{table.source}: {table.label("shape")} is {shown(shape)}; write "tube" or "box".'
        )
    table.finish()
    return member


def _tube(table: _Table, name: str, mass: float, start: Point, end: Point) -> Tube:
    outer = table.number("outer_diameter")
    inner = table.number("inner_diameter", positive=False)
    if inner >= outer:
        raise FileFormatError(
            f"{table.source}: {table.label('inner_diameter')} is {inner:g} m, not below the outer diameter "
            f"{outer:g} m; make it smaller (0: solid)."
        )
    return Tube(name=name, mass=mass, start=start, end=end, outer_diameter=outer, inner_diameter=inner)


def _box(table: _Table, name: str, mass: float, start: Point, end: Point) -> Box:
    width, depth = table.number("width"), table.number("depth")
    wall = table.number("wall", positive=False)
    if 0.0 < wall < THINNEST * max(width, depth):
        raise FileFormatError(
            f"{table.source}: {table.label('wall')} is {wall:g} m in a section of {width:g} x {depth:g} m; "
            "make it thicker (0: solid)."
        )
    if 2.0 * wall >= min(width, depth):
        raise FileFormatError(
            f"{table.source}: {table.label('wall')} is {wall:g} m, half the section ({width:g} x {depth:g} m)"
            " or more; make it thinner (0: solid)."
        )
    return Box(name=name, mass=mass, start=start, end=end, width=width, depth=depth, wall=wall)


def _cylinder(table: _Table) -> CylinderData:
    data = CylinderData(
        retracted_length=table.number("retracted_length"),
        stroke=table.number("stroke"),
        barrel=table.members("barrel"),
        rod=table.members("rod"),
        areas=table.areas(),
        hydraulics=table.hydraulics(),
    )
    table.finish()
    return data


def _crane(root: _Table) -> CraneData:
    schema = root.take("schema")
    if schema != SCHEMA:
        raise FileFormatError(
            f"{root.source}: schema is {shown(schema)}; this version reads schema {SCHEMA}."
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
    text : str
    source : str
        Name used in messages.

    Raises
    ------
    FileFormatError
        The text is not TOML, a key is missing or unknown, a value is out of range, the masses do not add up,
        a stroke cannot be reached, or a cylinder comes too near its dead centre.
    """
    try:
        values = tomllib.loads(text)
    except RecursionError as error:
        raise FileFormatError(f"{source}: is nested too deeply for crane data; remove brackets.") from error
    except ValueError as error:  # TOMLDecodeError is one, a number of too many digits another
        reason = str(error)[:200]
        raise FileFormatError(f"{source}: not valid TOML: {reason}; correct that line.") from error
    data = _crane(_Table(source, "", values))
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
    try:
        text = read_whole(path, LARGEST_FILE, "no crane file is").decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(f"crane data file {path} cannot be read ({error}); check the path.") from error
    return parse(text, source=str(path))
