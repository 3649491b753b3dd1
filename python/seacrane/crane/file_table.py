"""Tables of a crane's data file: every value is asked for once and checked, and what is left is misspelt."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.mass_properties import Box, Member, Point, Tube
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.description.roles import Areas, Capacity, areas_of, capacity_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole

Array = NDArray[np.float64]
SCHEMA = 1
LARGEST = 1e12  # m, kg: no crane, and nothing that its squares overflow with
LARGEST_FILE = 2**20  # bytes
LONGEST_TEXT = 200
SMALLEST = 1e-9  # m, kg
THINNEST = 1e-6  # of a section


def read_text(path: Path) -> str:
    """Text of a crane's file; FileFormatError where it cannot be read."""
    try:
        return read_whole(path, LARGEST_FILE, "no crane file is").decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(f"crane data file {path} cannot be read ({error}); check the path.") from error


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

    def table(self, key: str) -> FileTable:
        return FileTable(self.source, self.label(key), self.take(key))

    def text(self, key: str) -> str:
        value = self.take(key)
        if not isinstance(value, str) or not 0 < len(value) <= LONGEST_TEXT:
            raise FileFormatError(
                f"{self.source}: {self.label(key)} is {shown(value)}; write a text of 1 to {LONGEST_TEXT} "
                "characters."
            )
        return value

    def number(self, key: str, *, positive: bool = True) -> float:
        value = number_at(self.source, self.label(key), self.take(key))
        if value < 0.0 or (positive and value < SMALLEST):
            need = f"greater than zero, {SMALLEST:g} at least" if positive else "zero or more"
            raise FileFormatError(f"{self.source}: {self.label(key)} is {value:g}; it must be {need}.")
        return value

    def head(self, *, default: str) -> str:
        """The kind of crane, of a file whose schema this version reads."""
        schema = self.take("schema")
        if schema != SCHEMA:
            raise FileFormatError(
                f"{self.source}: schema is {shown(schema)}; this version reads schema {SCHEMA}."
            )
        return self.text("kind") if "kind" in self.values else default

    def tables(self, key: str) -> list[FileTable]:
        """A list of tables, which may be left out."""
        value = self.values.pop(key, [])
        if not isinstance(value, list):
            raise FileFormatError(f"{self.source}: {self.label(key)} is {shown(value)}; write [[{key}]].")
        return [FileTable(self.source, f"{self.label(key)}[{i}]", item) for i, item in enumerate(value)]

    def space_point(self, key: str) -> Point:
        """Three numbers."""
        value = self.take(key)
        if not isinstance(value, list) or len(value) != 3:
            raise FileFormatError(
                f"{self.source}: {self.label(key)} is {shown(value)}; write three numbers [x, y, z]."
            )
        return tuple(number_at(self.source, self.label(key), item) for item in value)

    def point(self, key: str) -> tuple[float, float]:
        """Two numbers."""
        value = self.take(key)
        if not isinstance(value, list) or len(value) != 2:
            raise FileFormatError(
                f"{self.source}: {self.label(key)} is {shown(value)}; write two numbers [along, above], in m."
            )
        first, second = (number_at(self.source, self.label(key), item) for item in value)
        return first, second

    def capacity(self) -> Capacity:
        """An optional table of its own: rows of radius and load."""
        if "capacity" not in self.values:
            return ()
        table = self.table("capacity")
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

    def hydraulics(self) -> Mapping[str, Any] | None:
        """Keywords of a hydraulic cylinder: each of its values a table, SI units; None for none."""
        if "hydraulics" not in self.values:
            return None
        inner = self.table("hydraulics")
        found = {word: inner.table(word).value(kind) for word, kind in VALUES.items() if word in inner.values}
        inner.finish()
        return MappingProxyType(found)

    def value(self, kind: type[Any]) -> Any:
        """The whole table as a value, whose fields are numbers and flags."""
        given: dict[str, Any] = {}
        for key in [one.name for one in fields(kind) if one.name in self.values]:
            value = self.take(key)
            given[key] = value if isinstance(value, bool) else number_at(self.source, self.label(key), value)
        self.finish()
        return kind(**given)

    def members(self, key: str, plane: Array | None = None) -> tuple[Member, ...]:
        """Uniform bodies, their ends three numbers, or two along the axes (3, 2) of a plane."""
        value = self.take(key)
        if not isinstance(value, list) or not value:
            raise FileFormatError(f"{self.source}: {self.label(key)} needs at least one member; add one.")
        return tuple(
            _member(FileTable(self.source, f"{self.label(key)}[{index}]", item), plane)
            for index, item in enumerate(value)
        )

    def finish(self) -> None:
        if self.values:
            unknown = self.label(min(self.values))[:80]
            raise FileFormatError(f"{self.source}: unknown key {unknown}; correct its spelling or remove it.")


def number_at(source: str, label: str, value: object) -> float:
    """A finite number that no crane is beyond."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= LARGEST:
        raise FileFormatError(
            f"{source}: {label} is {shown(value)}; write a finite number, {LARGEST:g} at most."
        )
    return float(value)


def _member(table: FileTable, plane: Array | None) -> Member:
    """A tube or a box."""
    name = table.text("name")
    table.where = f"{table.where} ({name})"
    shape = table.text("shape")
    mass = table.number("mass")
    start, end = (
        table.space_point(key) if plane is None else tuple((plane @ table.point(key)).tolist())
        for key in ("start", "end")
    )
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


def _tube(table: FileTable, name: str, mass: float, start: Point, end: Point) -> Tube:
    outer = table.number("outer_diameter")
    inner = table.number("inner_diameter", positive=False)
    if inner >= outer:
        raise FileFormatError(
            f"{table.source}: {table.label('inner_diameter')} is {inner:g} m, not below the outer diameter "
            f"{outer:g} m; make it smaller (0: solid)."
        )
    return Tube(name=name, mass=mass, start=start, end=end, outer_diameter=outer, inner_diameter=inner)


def _box(table: FileTable, name: str, mass: float, start: Point, end: Point) -> Box:
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
