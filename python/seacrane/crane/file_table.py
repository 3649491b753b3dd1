"""Tables of a crane's data file: every value is asked for once and checked, and what is left is misspelt."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from typing import Any, NoReturn

import numpy as np

from seacrane.arrays import Array
from seacrane.crane.data import Placed
from seacrane.crane.mass_properties import Box, Member, Point, Tube
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.description.roles import Areas, Capacity, areas_of, capacity_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.shown import shown

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
            self.refuse(f"{self.label(key)} is missing; add it")
        return self.values.pop(key)

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

    def number(self, key: str, *, positive: bool = True) -> float:
        value = self._number(key, self.take(key))
        if value < 0.0 or (positive and value < SMALLEST):
            need = f"greater than zero, {SMALLEST:g} at least" if positive else "zero or more"
            self.refuse(f"{self.label(key)} is {value:g}; it must be {need}")
        return value

    def _number(self, key: str, value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= LARGEST:
            self.wrong(key, value, f"write a finite number, {LARGEST:g} at most")
        return float(value)

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

    def numbers(self, key: str, count: int) -> Point:
        """A list of so many of them."""
        value = self.take(key)
        if not isinstance(value, list) or len(value) != count:
            self.wrong(key, value, f"write a list of {count} numbers")
        return tuple(self._number(key, item) for item in value)

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
        if not {"full_area", "rod_side_area"} & set(self.values):
            return None
        pair = self.number("full_area"), self.number("rod_side_area")
        with as_file_error():
            return areas_of(f"{self.source}: {self.where}", pair)

    def hydraulics(self) -> Mapping[str, Any] | None:
        """Keywords of a hydraulic cylinder: each of its values a table, SI units; None for none."""
        if "hydraulics" not in self.values:
            return None
        inner = self.table("hydraulics")
        found = {word: inner.table(word).value(kind) for word, kind in VALUES.items() if word in inner.values}
        inner.finish()
        return found

    def value(self, kind: type[Any]) -> Any:
        """The whole table as a value, whose fields are numbers and flags."""
        given: dict[str, Any] = {}
        for key in [one.name for one in fields(kind) if one.name in self.values]:
            value = self.take(key)
            given[key] = value if isinstance(value, bool) else self._number(key, value)
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
        return body, frame.point(np.array(self.numbers("point", 3)))

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
    name, shape, mass = table.named(), table.text("shape"), table.number("mass")
    start, end = table.numbers("start", 3), table.numbers("end", 3)
    if math.dist(start, end) == 0.0:
        table.refuse(f"{table.where} has length 0; move its start or its end")
    match shape:
        case "tube":
            return _tube(table, name=name, mass=mass, start=start, end=end)
        case "box":
            return _box(table, name=name, mass=mass, start=start, end=end)
    table.wrong("shape", shape, 'write "tube" or "box"')


def _tube(table: FileTable, **common: Any) -> Tube:
    outer, inner = table.number("outer_diameter"), table.number("inner_diameter", positive=False)
    table.finish()
    if inner >= outer:
        table.refuse(
            f"{table.label('inner_diameter')} is {inner:g} m, not below the outer diameter {outer:g} m; make "
            "it smaller (0: solid)"
        )
    return Tube(**common, outer_diameter=outer, inner_diameter=inner)


def _box(table: FileTable, **common: Any) -> Box:
    width, depth, wall = table.number("width"), table.number("depth"), table.number("wall", positive=False)
    table.finish()
    section = f"{table.label('wall')} is {wall:g} m"
    if 0.0 < wall < THINNEST * max(width, depth):
        table.refuse(f"{section} in a section of {width:g} x {depth:g} m; make it thicker (0: solid)")
    if 2.0 * wall >= min(width, depth):
        table.refuse(
            f"{section}, half the section ({width:g} x {depth:g} m) or more; make it thinner (0: solid)"
        )
    return Box(**common, width=width, depth=depth, wall=wall)
