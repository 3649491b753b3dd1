"""`Lift`: a whole lift - scene, method, outputs and length of the run - as a file that a person writes."""

from __future__ import annotations

import contextlib
import inspect
import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NoReturn

import numpy as np

from seacrane.accuracy.asked import EVENT_TIMES
from seacrane.accuracy.choice import refuse_what_is_chosen
from seacrane.accuracy.quantities import limits_of, quantities_of
from seacrane.ensembles.growing import growth_of
from seacrane.ensembles.kept import Kept, StageTime
from seacrane.ensembles.members import MOST_MEMBERS, LatinHypercube, Members, members_of
from seacrane.ensembles.study import checked_keep
from seacrane.ensembles.targets import targets_of
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.keywords import named
from seacrane.lift.answer_keys import ANSWERS
from seacrane.lift.asked_answers import Asked, asked_of
from seacrane.lift.build import SceneBuild, check_stages, made, refused_at, stages_of
from seacrane.lift.calls import Keywords, keywords
from seacrane.lift.check_keys import Entry, entries_of, only, plain, shipped_lift
from seacrane.lift.document import FORMAT, LARGEST_FILE, VERSION, Document, read_document
from seacrane.lift.inner_keys import LIFTS, STUDY
from seacrane.lift.keys import Key
from seacrane.lift.sheet import Sheet, sheet_of
from seacrane.result.result import Result
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate


@dataclass(frozen=True, kw_only=True)
class Study:
    """What a [study] says."""

    over: Any  # as `ensemble` takes it
    members: Members
    keep: Mapping[str, Kept | StageTime]
    until: Mapping[str, float] | None
    exposure: float | None  # of largest values, s; None: the length of a run
    _entry: Entry

    def fail_at(self, name: str, text: str) -> NoReturn:
        """Raise a FileFormatError about what varies."""
        self._entry.fail(text, *_table_of(self._entry.values), name)


def study_of(entry: Entry) -> Study:
    """The study of its table.

    Raises FileFormatError with the line of what is wrong in it.
    """
    given = keywords(STUDY, entry.values)
    if ("over" in given) == ("design" in given):
        entry.fail("a study has either [study.over] or [study.design]; give one of them")
    over: Any = {name: _values(entry, name, one) for name, one in given.get("over", {}).items()}
    if "design" in given:
        with refused_at(entry, "design"):
            over = LatinHypercube(**given["design"])
    with refused_at(entry, _table_of(given)[0]):
        members = members_of(over)
    keep = _keep(entry, given["keep"])
    for name, share in given.get("until", {}).items():
        with refused_at(entry, "until", name):
            targets_of({name: share}, keep)
    if "until" in given:
        with refused_at(entry, "until"):
            growth_of(members, None)
    return Study(
        over=over, members=members, keep=keep, until=given.get("until"), exposure=given.get("exposure"),
        _entry=entry,
    )  # fmt: skip


def _table_of(given: Mapping[str, Any]) -> tuple[str, ...]:
    return ("over",) if "over" in given else ("design", "ranges")


def _values(entry: Entry, name: str, value: Any) -> Sequence[Any]:
    """The values of a parameter."""
    if not isinstance(value, Mapping):
        return list(value)
    first, count = value["first"], value["count"]
    if "last" not in value:
        if first != int(first):
            entry.fail(f"first is {first:g} without last; give both, or a whole number", "over", name)
        return range(int(first), int(first) + count)
    if count > MOST_MEMBERS:
        return range(count)  # refused by its number, before values are made
    return [float(one) for one in np.linspace(first, value["last"], count)]


def _keep(entry: Entry, tables: Sequence[Keywords]) -> dict[str, Kept | StageTime]:
    """What each run leaves, by name; ``channel = "stage[lift].end"`` is a time of a stage."""
    found: dict[str, Kept | StageTime] = {}
    for place, table in enumerate(map(plain, tables)):
        with refused_at(entry, "keep", place):
            name = table.pop("name")
            if name in found:
                raise SceneError(f"name {name!r} is there twice")
            time = StageTime.of_text(table["channel"]) if table.keys() == {"channel"} else None
            found[name] = time or Kept(**table)
            checked_keep(found)
    if not found:
        entry.fail("keep is empty; give [[study.keep]] for each of what runs leave", "keep")
    return found


WIDTH = 100  # characters of a line of keys; longer tables get a heading
T_END = float(inspect.signature(simulate).parameters["t_end"].default)


@named
@dataclass(frozen=True, init=False, eq=False, repr=False)
class Lift:
    """A lift as tables of keys with units: what `seacrane run my_lift.toml` reads. Immutable.

    A table is a call of the API, such as ``[line]`` of `Scene.add_line`; a key is a keyword of it with its
    unit, such as ``link_length_m``; docs/lift-files.md lists them.

    Parameters
    ----------
    tables : mapping of str to mapping, or to list of mapping
        By name, as the file has them, without format and version.
    folder : path-like
        From which the paths of files in them are taken; default: the current one.

    Attributes
    ----------
    t_end : float
        End time, s; without stages.
    start : "rest" or None
        Where the run or the first stage begins; None: as the scene is described.
    accuracy : mapping of str to float, or None
        Largest errors by quantity, as of `simulate`, which choose integrator and tolerance.
    stages : tuple of Stage
        In their order; none where one run is the whole lift.
    study : Study or None
        What its [study] says, which `seacrane study` runs.
    sheet : Sheet or None
        What its [sheet] says, which `seacrane sheet` makes.
    answers : tuple of Asked
        What its tables of answers ask for, such as [fatigue], which `seacrane answers` gives.

    Raises
    ------
    FileFormatError
        For a table, key or value that is none, with the nearest name.
    """

    method: Method
    outputs: Outputs
    t_end: float
    start: Literal["rest"] | None
    accuracy: Mapping[str, float] | None
    stages: tuple[Stage, ...]
    study: Study | None
    sheet: Sheet | None
    answers: tuple[Asked, ...]
    _entries: tuple[Entry, ...]

    def __init__(self, tables: Mapping[str, Any], *, folder: str | os.PathLike[str] = ".") -> None:
        data = {"format": FORMAT, "version": VERSION, **plain(tables)}
        self._check(entries_of(Document("lift", data), Path(folder).absolute()))

    def _check(self, entries: tuple[Entry, ...]) -> None:
        checked: dict[str, Any] = {"_entries": entries}
        checked["method"] = made(entries, "method", Method)
        checked["outputs"] = made(entries, "outputs", Outputs)
        checked["t_end"], checked["start"], checked["accuracy"] = made(entries, "run", _span)
        checked["stages"] = stages_of(entries)
        run, method, study, sheet = (only(entries, name) for name in ("run", "method", "study", "sheet"))
        checked["study"] = None if study is None else study_of(study)
        checked["sheet"] = None if sheet is None else sheet_of(sheet)
        checked["answers"] = tuple(asked_of(entry) for entry in entries if entry.table.name in ANSWERS)
        if method is not None and checked["accuracy"] is not None:
            with refused_at(method):
                refuse_what_is_chosen(checked["method"], {}, ())
        if run is not None and checked["stages"] and (end := run.spelling("t_end")):
            run.fail(f"{end} stands beside [[stage]]: a lift ends with its last stage; leave it out", end)
        if study is not None and checked["stages"] and (key := study.spelling("exposure")):
            study.fail(f"{key} is for runs without stages: extremes are those of one lift; leave it out", key)
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Lift:
        """Read a file; runs no code.

        Raises
        ------
        FileFormatError
            With file, line, key and the nearest name; for another kind of file, with what it looks like.
        OSError
            If it cannot be read.
        """
        lift = cls.__new__(cls)
        lift._check(entries_of(read_document(Path(path)), Path(path).absolute().parent))
        return lift

    @classmethod
    def shipped(cls, name: str) -> Lift:
        """One that comes with the package: "case1", "case2", "case3" or "vessel"."""
        if name not in LIFTS:
            raise SceneError(f"lift {name!r} does not come with seacrane; choose one of {', '.join(LIFTS)}")
        return cls.load(shipped_lift(name))

    @property
    def tables(self) -> dict[str, Any]:
        """The tables as plain data, to be changed and given to `Lift` again; paths of files are absolute."""
        return _listed((entry.table.name, plain(entry.values)) for entry in self._entries)

    def scene(self) -> Scene:
        """The scene, built anew.

        Raises
        ------
        FileFormatError
            With the line of the table that a scene refuses, or whose file cannot be read, and of a stage
            that does not fit the scene.
        """
        scene = SceneBuild(self._entries).scene()
        check_stages(self._entries, scene, self.stages)
        run = only(self._entries, "run")
        if self.accuracy is None or run is None:
            return scene
        model = None if self.stages else scene.compile()
        for name, limit in self.accuracy.items():
            with refused_at(run, "accuracy", name):
                known = [] if name == EVENT_TIMES else quantities_of(scene, model, [name])
                limits_of([EVENT_TIMES, *known], {name: limit})
        return scene

    def simulate(self, *, progress: bool = False) -> Result:
        """Simulate the scene with the method, the outputs and the end time of the lift; see `simulate`.

        A lift with stages is carried out stage by stage, without a progress bar.
        """
        return simulate(
            self.scene(), self.stages or self.t_end, start=self.start, method=self.method,
            outputs=self.outputs, progress=progress, accuracy=self.accuracy,
        )  # fmt: skip

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it as TOML, complete or not at all; paths of files from the folder of the file.

        Raises
        ------
        SceneError
            For a value that TOML has no word for, or a lift that is too large to be read back.
        OSError
            If the file cannot be written.
        """
        target, folder = Path(path), Path(path).absolute().parent
        tables = _listed(
            (entry.table.name, _from_folder(entry.table.keys, plain(entry.values), folder))
            for entry in self._entries
        )
        lines = [f'format = "{FORMAT}"', f"version = {VERSION}"]
        for name, given in tables.items():
            lines += _sections(name, given)
        try:
            data = ("\n".join(lines) + "\n").encode("utf-8")
        except UnicodeEncodeError as error:
            raise SceneError("lift: a text holds half of a surrogate pair, which UTF-8 has not") from error
        if len(data) > LARGEST_FILE:
            raise SceneError(f"lift: takes {len(data)} bytes, above {LARGEST_FILE}; shorten its tables")
        with atomic_write(target) as draft:
            draft.write_bytes(data)

    def __eq__(self, other: object) -> bool:
        return self.tables == other.tables if isinstance(other, Lift) else NotImplemented

    __hash__ = None  # type: ignore[assignment]  # its tables have none

    def __repr__(self) -> str:
        held = [f"{len(one)} {name}" if isinstance(one, list) else name for name, one in self.tables.items()]
        return f"<Lift: {', '.join(held) or 'empty'}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Lift, (self.tables,)


def _span(
    t_end: float = T_END, start: Literal["rest"] | None = None, accuracy: Mapping[str, float] | None = None
) -> tuple[float, Literal["rest"] | None, Mapping[str, float] | None]:
    return t_end, start, accuracy


def _listed(tables: Iterable[tuple[str, dict[str, Any]]]) -> dict[str, Any]:
    """Tables by name; those of which there are several in a list."""
    found: dict[str, list[dict[str, Any]]] = {}
    for name, table in tables:
        found.setdefault(name, []).append(table)
    return {name: one[0] if len(one) == 1 else one for name, one in found.items()}


def _from_folder(keys: Iterable[Key], values: dict[str, Any], folder: Path) -> dict[str, Any]:
    """A table with its paths of files from a folder."""
    for key in keys:
        value = values.get(key.name)
        if key.type == "file" and value is not None and value not in key.choices:
            with contextlib.suppress(ValueError):  # on another drive
                values[key.name] = Path(os.path.relpath(value, folder)).as_posix()
        elif key.type in ("table", "tables"):
            for one in value if isinstance(value, list) else [value]:
                if isinstance(one, dict):
                    _from_folder(key.keys, one, folder)
    return values


def _sections(heading: str, given: Any) -> Iterator[str]:
    """A table, or each of a list of tables, under its heading."""
    if isinstance(given, list):
        for one in given:
            yield from _section(f"[[{heading}]]", heading, one)
    else:
        yield from _section(f"[{heading}]", heading, given)


def _section(title: str, heading: str, table: Mapping[str, Any]) -> Iterator[str]:
    yield from ("", title)
    below = {}
    for key, value in table.items():
        line = f"{_key(key)} = {toml_value(value)}"
        inside = isinstance(value, list) and all(isinstance(one, Mapping) for one in value)
        if len(line) > WIDTH and (inside or isinstance(value, Mapping)):
            below[key] = value
        else:
            yield line
    for key, value in below.items():
        yield from _sections(f"{heading}.{_key(key)}", value)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_value(value: Any) -> str:
    """A value as TOML writes it; raises SceneError where it has no word."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return _text(value)
        case int() | float():
            return repr(value)
        case list():
            return f"[{', '.join(map(toml_value, value))}]"
        case Mapping():
            pairs = ", ".join(f"{_key(key)} = {toml_value(one)}" for key, one in value.items())
            return f"{{ {pairs} }}" if pairs else "{}"
    raise SceneError(f"lift: TOML has no word for {value!r}; leave it out")
