"""The tables of a document against the tables of the API: every key known, every value of its type."""

from __future__ import annotations

import difflib
import math
import operator
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType
from typing import Any, NoReturn, TypeVar

from seacrane.accuracy.choice import CHOSEN
from seacrane.errors import SceneError
from seacrane.inputs.node import Node
from seacrane.inputs.plain_data import plain_notes
from seacrane.inputs.shown import shown
from seacrane.lift.document import Document, Place, read_document
from seacrane.lift.inner_keys import CURVES, FROM, LIFTS, RANGE
from seacrane.lift.keys import EITHER, UNIT_OF_SUFFIX, Key
from seacrane.lift.tables import TABLES, Table

LEAST, MOST_NEAR = 0.5, 2  # alike, and names that are told
MOST_TOLD = 12  # spellings of one key
ENDLESS = ("mooring_period", "depth")  # inf, for which TOML has a word, stands for none, or deep water
LONGEST_NAME = 60  # characters of a name that is compared with those that are known
Number = TypeVar("Number", int, float)
BOUNDS: Mapping[str, tuple[Callable[[float, float], bool], str]] = {
    "minimum": (operator.ge, "from"), "exclusiveMinimum": (operator.gt, "above"),
    "maximum": (operator.le, "up to"), "exclusiveMaximum": (operator.lt, "below"),
}  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """One table of a file: its keys as they are spelled, and where it stands."""

    table: Table
    values: Mapping[str, Any]
    path: Place = field(compare=False)
    document: Document = field(compare=False)

    @property
    def title(self) -> str:
        """As the file has it, with its place among several."""
        return titled(self.path)

    def spelling(self, name: str) -> str:
        """How the file spells a key, with its unit; no text where it has not got it."""
        spelled = (one for key in self.table.keys if key.name == name for one in key.spellings)
        return next((one for one in spelled if one in self.values), "")

    def fail(self, text: str, *inside: str | int) -> NoReturn:
        """Raise a FileFormatError about the table, or about what is inside."""
        self.document.fail((*self.path, *inside), text)


def titled(path: Place) -> str:
    """A path of tables as a file has it."""
    name = ".".join(str(part) for part in path if isinstance(part, str))
    places = [part for part in path if isinstance(part, int)]
    return f"[[{name}]] {places[-1] + 1}" if places and isinstance(path[-1], int) else f"[{name}]"


def entries_of(document: Document, folder: Path) -> tuple[Entry, ...]:
    """All tables of a document, in the order in which they are added to a scene.

    Paths of files become absolute, from `folder`.

    Raises FileFormatError with file, line, key and the nearest name.
    """
    document.require_version()
    checker = Checker(document, folder)
    known = ("format", "version", *TABLES)
    for name in document.data:
        if name not in known:
            document.fail((name,), f"[{short(name)}] is unknown; {nearest(name, tuple(TABLES))}")
    own = tuple(
        Entry(table, checker.table(path, table.keys, given), path, document)
        for table in TABLES.values()
        if table.name in document.data
        for path, given in _given(document, table)
    )
    study = only(own, "study")
    return own if study is None or "lift" not in study.values else _with_lift(own, study)


def only(entries: Iterable[Entry], table: str) -> Entry | None:
    """The table of a name that occurs once; None where there is none."""
    return next((entry for entry in entries if entry.table.name == table), None)


def shipped_lift(name: str) -> Path:
    """Where a lift that comes with the package is."""
    return Path(str(files("seacrane") / "data" / "lifts" / f"{name}.toml"))


def _with_lift(own: tuple[Entry, ...], study: Entry) -> tuple[Entry, ...]:
    """The tables of a study with those of its lift of which it has none; of [run] with the lift's keys.

    An accuracy of the study chooses what the lift says in [method].
    """
    named = study.values["lift"]
    path = shipped_lift(named) if named in LIFTS else Path(named)
    if not path.is_file():
        study.fail(f"lift is {shown(named)}: there is no file {path}", "lift")
    document = read_document(path)
    if "study" in document.data:
        study.fail(f"lift is {path.name}, a study itself; give the lift that is to vary", "lift")
    given = {entry.table.name: entry for entry in own}
    chosen = CHOSEN if "run" in given and "accuracy" in given["run"].values else ()
    found = [_without(one, "lift") if one is study else one for one in own]
    for entry in entries_of(document, path.parent):
        if entry.table.name == "run" and "run" in given:
            run = given["run"]
            others = _without(entry, *(key.name for key in run.table.keys if run.spelling(key.name)))
            found[found.index(run)] = replace(run, values=MappingProxyType({**others.values, **run.values}))
        elif entry.table.name not in given:
            found.append(_without(entry, *chosen) if entry.table.name == "method" else entry)
    order = [*TABLES]
    return tuple(sorted(found, key=lambda entry: order.index(entry.table.name)))


def _without(entry: Entry, *names: str) -> Entry:
    left_out = {spelling for key in entry.table.keys if key.name in names for spelling in key.spellings}
    kept = {spelling: value for spelling, value in entry.values.items() if spelling not in left_out}
    return replace(entry, values=MappingProxyType(kept))


def _given(document: Document, table: Table) -> Iterable[tuple[Place, Any]]:
    """Each of the tables of a name, with its place."""
    name = table.name
    given = document.data[name]
    if isinstance(given, Mapping):
        yield (name,), given
    elif table.several and isinstance(given, list):
        yield from (((name, i), one) for i, one in enumerate(given))
    else:
        more = f", or [[{name}]] for each of several" if table.several else ", once"
        document.fail((name,), f"{name} is {shown(given)}; write [{name}]{more}")


@dataclass(frozen=True)
class Checker:
    """Tables of a document, checked key by key; paths of files are taken from a folder."""

    document: Document
    folder: Path

    def table(self, path: Place, keys: Iterable[Key], given: Any) -> Mapping[str, Any]:
        """The table with what it holds checked."""
        if not isinstance(given, Mapping):
            self.document.fail(path, f"{titled(path)} is {shown(given)}; give a table of keys and values")
        keys = tuple(keys)
        if any(key.type == "notes" for key in keys):
            try:
                plain_notes(self.document.source, given)
            except SceneError as error:
                self.document.fail(path, str(error))
            return MappingProxyType(dict(given))
        spelled = {spelling: key for key in keys for spelling in key.spellings}
        found: dict[str, Any] = {}
        for spelling, value in given.items():
            if spelling not in spelled:
                self.document.fail((*path, spelling), _unknown(spelling, keys, titled(path)))
            found[spelling] = self._value((*path, spelling), spelled[spelling], value)
        for key in keys:
            present = [spelling for spelling in key.spellings if spelling in found]
            if len(present) > 1:
                told = f"{present[1]} stands beside {present[0]} in {titled(path)}; give one"
                self.document.fail((*path, present[1]), told)
            if key.required and not present:
                own = [one for one, unit in key.spellings.items() if unit in key.unit.split(EITHER)]
                told = " or ".join(own or key.spellings)
                self.document.fail(path, f"{titled(path)} has no {told}; add it")
        return MappingProxyType(found)

    def _value(self, path: Place, key: Key, value: Any) -> Any:
        if key.type == "table":
            return self.table(path, key.keys, value)
        if key.type == "tables":
            listed = enumerate(self._node(path, value).values())
            return tuple(self.table((*path, i), key.keys, one) for i, one in listed)
        if key.type == "curve" and isinstance(value, Mapping | list):
            return self._curve(path, value, of_speed=key.unit == "m/s")
        if key.type in ("names", "limits", "ranges", "values"):
            found = dict(self._named(path, value, key.type))
            if not found:
                self.document.fail(path, f"{path[-1]} is empty; name one, or leave it out")
            return MappingProxyType(found)
        bounds = key.bounds_in(key.spellings[str(path[-1])])
        return _checked(self._node(path, value), key, bounds, self.folder)

    def _named(self, path: Place, value: Any, kind: str) -> Iterator[tuple[str, Any]]:
        """Values by dotted name, whether its parts are quoted together or not."""
        if not isinstance(value, Mapping):
            self._node(path, value).fail("give a table of names and values")
        for name, one in value.items():
            inside = (*path, name)
            if isinstance(one, Mapping) and not (kind == "values" and any(key.name in one for key in RANGE)):
                yield from ((f"{name}.{rest}", found) for rest, found in self._named(inside, one, kind))
            else:
                yield name, self._leaf(inside, one, kind)

    def _leaf(self, path: Place, value: Any, kind: str) -> Any:
        """A text, a number, the ends of a range, or values: a list or a table."""
        node = self._node(path, value)
        match kind:
            case "names":
                return node.text()
            case "limits":
                return node.number()
            case "ranges":
                return tuple(node.array((2,)).tolist())
        if isinstance(value, Mapping):
            return self.table(path, RANGE, value)
        return tuple(value) if isinstance(value, list) else node.fail("give a list of values")

    def _node(self, path: Place, value: Any) -> Node:
        where = titled(path[:-1]) if path[:-1] else "the file"
        return Node(value, f"{self.document.place(path)}: {short(str(path[-1]))} in {where}")

    def _curve(self, path: Place, value: Any, *, of_speed: bool) -> Any:
        """One piece, or several with the time from which each after the first holds."""
        if isinstance(value, Mapping):
            return self._piece(path, value, first=True, of_speed=of_speed)
        if not value:
            self._node(path, value).fail("give a number or a table for each of its pieces")
        return tuple(
            self._piece((*path, i), one, first=i == 0, of_speed=of_speed) for i, one in enumerate(value)
        )

    def _piece(self, path: Place, value: Any, *, first: bool, of_speed: bool) -> Mapping[str, Any]:
        kinds = tuple(kind for kind in CURVES if of_speed or kind != "gust")
        kind = value.get("kind") if isinstance(value, Mapping) else None
        if kind not in kinds:
            self.document.fail(path, f"{titled(path)} has kind {shown(kind)}; give one of {', '.join(kinds)}")
        word = Key("kind", "text", choices=kinds, required=True)
        return self.table(path, (word, *(() if first else (FROM,)), *CURVES[kind]), value)


def _checked(node: Node, key: Key, bounds: Mapping[str, float], folder: Path) -> Any:
    """A value that is no table."""
    match key.type:
        case "text":
            text = node.text()
            if key.choices and text not in key.choices:
                node.fail(nearest(text, key.choices))
            return text
        case "number" | "curve" if node.value in key.choices:
            return node.value
        case "number" | "curve" if node.value == math.inf and key.name in ENDLESS:
            return math.inf
        case "number" | "curve":
            return _bounded(node, bounds, node.number())
        case "whole":
            return _bounded(node, bounds, node.whole())
        case "flag":
            return node.flag()
        case "array":
            return _array(node, key, bounds)
        case "texts":
            return tuple(item.text() for item in node.items())
        case "file":
            path = node.text()
            if not path or not path.isprintable():
                node.fail("give the path of a file")
            return path if path in key.choices else os.path.normpath(folder.absolute() / path)
    raise TypeError(f"no lift file holds a {key.type}")


def _bounded(node: Node, bounds: Mapping[str, float], number: Number) -> Number:
    """The number, which keeps the bounds of its key."""
    if not all(BOUNDS[word][0](number, bound) for word, bound in bounds.items()):
        node.fail(
            f"give one {' and '.join(f'{BOUNDS[word][1]} {bound:g}' for word, bound in bounds.items())}"
        )
    return number


def _array(node: Node, key: Key, bounds: Mapping[str, float]) -> Any:
    """An array of the shape that fits; lists become tuples, so that what is checked stays as it is."""
    if () in key.shapes and not isinstance(node.value, list):
        return _bounded(node, bounds, node.number())
    shapes = [shape for shape in key.shapes if shape and _deep(node.value) == len(shape)] or [
        one for one in key.shapes if one
    ]
    shape = next((one for one in shapes if one[0] == len(node.values())), shapes[0])
    array = node.array(shape)
    for number in array.flat if bounds else ():
        _bounded(Node(number, f"{node.path} holds a number that"), bounds, number)
    return _fixed(array.tolist())


def _deep(value: Any) -> int:
    return 1 + _deep(value[0]) if isinstance(value, list) and value else int(isinstance(value, list))


def _fixed(value: Any) -> Any:
    return tuple(map(_fixed, value)) if isinstance(value, list) else value


def nearest(name: str, known: tuple[str, ...]) -> str:
    """What a message adds to an unknown name."""
    near = difflib.get_close_matches(name[:LONGEST_NAME], known, MOST_NEAR, LEAST)
    return f"nearest: {' or '.join(near)}" if near else f"known are {', '.join(known)}"


def _unknown(spelling: str, keys: Iterable[Key], title: str) -> str:
    """Of a key with the unit of another dimension those that fit it, else names that are alike."""
    keys = tuple(keys)
    for key in sorted(keys, key=lambda one: -len(one.name)):
        unit = UNIT_OF_SUFFIX.get(spelling.removeprefix(f"{key.name}_"))
        if key.units and unit and spelling.startswith(f"{key.name}_"):
            is_in, fits = key.unit, " or ".join(key.spellings)
            if len(key.spellings) > MOST_TOLD:  # of whatever a channel is in
                like = nearest(spelling, tuple(key.spellings))
                is_in, fits = "that of its channel", f"{key.name}_kN, {key.name}_deg or so; {like}"
            return f"{short(spelling)} in {title} is in {unit}, and {key.name} in {is_in}; give {fits}"
    near = nearest(spelling, tuple(one for key in keys for one in key.spellings))
    return f"{short(spelling)} is unknown in {title}; {near}"


def plain(value: Any) -> Any:
    """A checked value as new dicts and lists."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    return [plain(item) for item in value] if isinstance(value, list | tuple) else value


def short(name: str) -> str:
    """A name that a file gave, as messages show it."""
    return name if name.isprintable() and len(name) <= LONGEST_NAME else shown(name)
