"""Tables of a crane's data file: every value is asked for once and checked, and what is left is misspelt.

A key alone is in SI; with a unit at its end, as in a lift file, in that one.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NoReturn

import numpy as np

from seacrane._core import HydraulicCylinder
from seacrane.arrays import Array
from seacrane.crane.data import Placed
from seacrane.crane.mass_properties import Box, Member, Point, Tube
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.description.roles import Areas, Capacity, areas_of, capacity_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.shown import shown
from seacrane.inputs.units import into_si, spellings
from seacrane.inputs.values import entries_of

Frames = dict[str, tuple[str, Placed]]  # by name: the body that a frame is fixed to, and where it is at home
SCHEMA = 1
LARGEST = 1e12  # m, kg: no crane, and nothing that its squares overflow with
LONGEST_TEXT = 200
SMALLEST = 1e-9  # m, kg
THINNEST = 1e-6  # of a section


@contextmanager
def as_file_error(lead: str = "") -> Iterator[None]:
    """What is refused inside the block is refused of the file."""
    try:
        yield
    except SceneError as error:
        raise FileFormatError(f"{lead}{error}.") from error


def root_of(text: str, source: str) -> FileTable:
    """The outermost table of a file; FileFormatError where it is not TOML."""
    try:
        values = tomllib.loads(text)
    except RecursionError as error:
        raise FileFormatError(f"{source}: is nested too deeply for crane data; remove brackets.") from error
    except ValueError as error:  # TOMLDecodeError is one, a number of too many digits another
        reason = str(error)[:200]
        raise FileFormatError(f"{source}: not valid TOML: {reason}; correct that line.") from error
    return FileTable(source, "", values)


class FileTable:
    """One table of the file; every value is asked for once, leftovers are misspelt keys."""

    def __init__(self, source: str, where: str, values: object, frames: Frames | None = None) -> None:
        self.source, self.where = source, where
        self.frames: Frames = {} if frames is None else frames  # of the file, once they are known
        if not isinstance(values, Mapping):
            raise FileFormatError(f"{source}: {where} is {shown(values)}; write a table of keys and values.")
        self.values = dict(values)

    def label(self, key: str) -> str:
        return f"{self.where}.{key}" if self.where else key

    def take(self, key: str) -> Any:
        if key not in self.values:
            near = [one for one in self.values if one.startswith(f"{key}_")]
            wrong = f", and {near[0][:80]} is in no unit of its kind" if near else ""
            self.refuse(f"{self.label(key)} is missing{wrong}; add it")
        return self.values.pop(key)

    def spelt(self, key: str, *units: str) -> tuple[str, str] | None:
        """How a key of one of these units stands here, and in which; None where it does not."""
        known = spellings(key, *units) | ({key: ""} if len(units) < 2 else {})
        found = [one for one in known if one in self.values]
        if len(found) > 1:
            self.refuse(f"{self.where or 'the crane'} has {' and '.join(found)}; write one of them")
        return (found[0], known[found[0]]) if found else None

    def table(self, key: str) -> FileTable:
        return FileTable(self.source, self.label(key), self.take(key), self.frames)

    def refuse(self, says: str) -> NoReturn:
        raise FileFormatError(f"{self.source}: {says}.")

    def wrong(self, key: str, value: object, fix: str) -> NoReturn:
        self.refuse(f"{self.label(key)} is {shown(value)}; {fix}")

    def named(self) -> str:
        """The name of what the table describes, of which messages speak from now on."""
        name = self.text("name")
        self.where = f"{self.where} ({name})"
        return name

    def text(self, key: str) -> str:
        value = self.take(key)
        if not isinstance(value, str) or not 0 < len(value) <= LONGEST_TEXT:
            self.wrong(key, value, f"write a text of 1 to {LONGEST_TEXT} characters")
        return value

    def number(self, key: str, unit: str, *, positive: bool = True) -> float:
        """In SI."""
        name, own = self.spelt(key, unit) or (key, "")
        value = self._number(name, self.take(name), own)
        if value < 0.0 or (positive and value < SMALLEST):
            need = f"greater than zero, {SMALLEST:g} at least" if positive else "zero or more"
            self.refuse(f"{self.label(name)} is {value:g}{f' {unit}' * bool(own)}; it must be {need}")
        return value

    def _number(self, key: str, value: object, unit: str) -> float:
        known = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= LARGEST
        found = float(into_si(unit)(float(value))) if known else math.inf  # type: ignore[arg-type]
        if not abs(found) <= LARGEST:
            self.wrong(key, value, f"write a finite number, {LARGEST:g} at most")
        return found

    def flag(self, key: str) -> bool:
        """true or false; false where it is left out."""
        value = self.values.pop(key, False)
        if not isinstance(value, bool):
            self.wrong(key, value, "write true or false")
        return value

    def head(self) -> str:
        """The kind of crane, of a file whose schema this version reads."""
        schema = self.take("schema")
        if schema != SCHEMA:
            self.wrong("schema", schema, f"this version reads schema {SCHEMA}")
        return self.text("kind")

    def tables(self, key: str) -> list[FileTable]:
        """A list of tables, which may be left out."""
        value = self.values.pop(key, [])
        if not isinstance(value, list):
            self.wrong(key, value, f"write [[{key}]]")
        where = self.label(key)
        return [FileTable(self.source, f"{where}[{i}]", one, self.frames) for i, one in enumerate(value)]

    def numbers(self, key: str, count: int, *units: str) -> Point:
        """A list of so many of them, in SI."""
        name, own = self.spelt(key, *units) or (key, "")
        value = self.take(name)
        if not isinstance(value, list) or len(value) != count:
            self.wrong(name, value, f"write a list of {count} numbers")
        return tuple(self._number(name, item, own) for item in value)

    def capacity(self) -> Capacity:
        """An optional table of its own: rows of radius and load."""
        if "capacity" not in self.values:
            return ()
        table = self.table("capacity")
        rows = table.take("rows")
        table.finish()
        with as_file_error():
            return capacity_of(self.source, rows)

    def areas(self) -> Areas | None:
        """Both areas of a piston, or neither."""
        if not any(self.spelt(key, "m2") for key in ("full_area", "rod_side_area")):
            return None
        pair = self.number("full_area", "m2"), self.number("rod_side_area", "m2")
        with as_file_error():
            return areas_of(f"{self.source}: {self.where}", pair)

    def hydraulics(self) -> Mapping[str, Any] | None:
        """Keywords of a hydraulic cylinder: each of its values a table; None for none."""
        if "hydraulics" not in self.values:
            return None
        inner = self.table("hydraulics")
        found = {word: inner.table(word).value(word, VALUES[word]) for word in VALUES if word in inner.values}
        inner.finish()
        return found

    def value(self, word: str, kind: type[Any]) -> Any:
        """The whole table as a value of a cylinder's keyword, whose fields are numbers and flags."""
        units = {field.name: field.unit for field in HydraulicCylinder.FIELDS}
        given: dict[str, Any] = {}
        for key, entry in entries_of(word, kind).items():
            if (known := self.spelt(key, units[entry])) is not None:
                value = self.take(known[0])
                given[key] = value if isinstance(value, bool) else self._number(known[0], value, known[1])
        self.finish()
        return kind(**given)

    def members(self, key: str) -> tuple[Member, ...]:
        """Uniform bodies, one or more."""
        found = tuple(_member(table) for table in self.tables(key))
        if not found:
            self.refuse(f"{self.label(key)} needs at least one member; add one")
        return found

    def point_on(self, name: str) -> tuple[str, Array]:
        """The body that a frame is fixed to, and the table's point, given in the frame, at home, m."""
        body, frame = self._frame(name)
        return body, frame.point(np.array(self.numbers("point", 3, "m")))

    def axis_on(self, name: str, key: str) -> Array | None:
        """A unit vector, given in a frame, at home; None where it is left out."""
        if key not in self.values:
            return None
        given = np.array(self.numbers(key, 3))
        length = float(np.linalg.norm(given))
        if length == 0.0:
            self.refuse(f"{self.label(key)} is all zero; write a direction, such as [0.0, 0.0, 1.0]")
        return np.asarray(self._frame(name)[1].axes @ (given / length))

    def _frame(self, name: str) -> tuple[str, Placed]:
        if name not in self.frames:
            known = ", ".join(self.frames) or "none"
            self.refuse(f"{self.where} names body {shown(name)}; the crane has {known}")
        return self.frames[name]

    def finish(self) -> None:
        if self.values:
            self.refuse(f"unknown key {self.label(min(self.values))[:80]}; correct its spelling or remove it")


def _member(table: FileTable) -> Member:
    name, shape, mass = table.named(), table.text("shape"), table.number("mass", "kg")
    start, end = table.numbers("start", 3, "m"), table.numbers("end", 3, "m")
    if math.dist(start, end) == 0.0:
        table.refuse(f"{table.where} has length 0; move its start or its end")
    match shape:
        case "tube":
            return _tube(table, name=name, mass=mass, start=start, end=end)
        case "box":
            return _box(table, name=name, mass=mass, start=start, end=end)
    table.wrong("shape", shape, 'write "tube" or "box"')


def _tube(table: FileTable, **common: Any) -> Tube:
    outer, inner = table.number("outer_diameter", "m"), table.number("inner_diameter", "m", positive=False)
    table.finish()
    if inner >= outer:
        table.refuse(
            f"{table.label('inner_diameter')} is {inner:g} m, not below the outer diameter {outer:g} m; make "
            "it smaller (0: solid)"
        )
    return Tube(**common, outer_diameter=outer, inner_diameter=inner)


def _box(table: FileTable, **common: Any) -> Box:
    width, depth = table.number("width", "m"), table.number("depth", "m")
    wall = table.number("wall", "m", positive=False)
    table.finish()
    section = f"{table.label('wall')} is {wall:g} m"
    if 0.0 < wall < THINNEST * max(width, depth):
        table.refuse(f"{section} in a section of {width:g} x {depth:g} m; make it thicker (0: solid)")
    if 2.0 * wall >= min(width, depth):
        table.refuse(
            f"{section}, half the section ({width:g} x {depth:g} m) or more; make it thinner (0: solid)"
        )
    return Box(**common, width=width, depth=depth, wall=wall)
