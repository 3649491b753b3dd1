"""A study file: a lift, what varies in it, what each run leaves, and when it is enough."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal, NoReturn

import numpy as np

from seacrane.accuracy.asked import EVENT_TIMES
from seacrane.accuracy.choice import refuse_what_is_chosen, without_what_is_chosen
from seacrane.accuracy.quantities import limits_of, quantities_of
from seacrane.ensembles.growing import growth_of
from seacrane.ensembles.kept import Kept, StageTime
from seacrane.ensembles.members import MOST_MEMBERS, LatinHypercube, Members, members_of
from seacrane.ensembles.study import checked_keep
from seacrane.ensembles.targets import targets_of
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.lift.calls import keywords
from seacrane.lift.check_keys import Checker, nearest, plain, short
from seacrane.lift.document import LIFT, VERSION, Document, read_document
from seacrane.lift.keys import Key
from seacrane.lift.lift import LIFTS, Lift, lift_of
from seacrane.lift.study_keys import DESIGN, FROM_LIFTS, KEEP, RANGE, STATISTICS, STUDY, TEXTS
from seacrane.lift.tables import TABLES
from seacrane.lift.text_lines import Place
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.scene.scene import Scene


@dataclass(frozen=True, kw_only=True)
class StudyFile:
    """What a study file says; its lift is read when it is asked for.

    Attributes
    ----------
    keep : mapping of str to Kept or StageTime
    until : mapping of str to float, or None
    exposure : Of largest values, s; None: the length of a run.
    accuracy : mapping of str to float, or None
        Largest error by quantity.
    """

    members: Members
    keep: Mapping[str, Kept | StageTime]
    until: Mapping[str, float] | None
    exposure: float | None
    accuracy: Mapping[str, Any] | None
    _over: Any
    _document: Document
    _folder: Path

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> StudyFile:
        """Read a file; runs no code, and does not read the lift.

        Raises
        ------
        FileFormatError
            With file, line, key and the nearest name.
        OSError
            If it cannot be read.
        """
        document = read_document(Path(path), STUDY)
        folder = Path(path).absolute().parent
        _require_tables(document)
        reader = _Reader(document, Checker(document, folder))
        over = reader.over()
        members, keep = reader.members(over), reader.keep()
        for name in (name for name in FROM_LIFTS if name in document.data):
            reader.checker.table((name,), TABLES[name].keys, document.data[name])
        return cls(
            members=members, keep=keep, until=reader.until(keep, members), exposure=reader.exposure(),
            accuracy=reader.accuracy(), _over=over, _document=document, _folder=folder,
        )  # fmt: skip

    @property
    def over(self) -> Any:
        """As `ensemble` takes it."""
        return self._over

    def lift(self) -> Lift:
        """The lift.

        Raises FileFormatError with the line of what is wrong in it.
        """
        return lift_of(*self._lift_document())

    def settings(self, lift: Lift) -> tuple[float, Literal["rest"] | None, Method, Outputs]:
        """End time (s), start, method, outputs: those of the study where it has its own, else the lift's."""
        data = self._document.data
        tables = {name: data[name] for name in FROM_LIFTS if name in data}
        document = replace(self._document, data={"format": LIFT.format, "version": VERSION, **tables})
        if "t_end_s" in tables.get("run", {}) and lift.stages:
            self._document.fail(
                ("run", "t_end_s"), "t_end_s is for lifts without stages, which tell their end; leave it out"
            )
        if lift.stages and self.exposure is not None:
            self._document.fail(
                ("statistics",),
                "exposure_s is for runs without stages: extremes are those of one lift; leave it out",
            )
        own = lift_of(document, self._folder)
        return (
            own.t_end if "t_end_s" in tables.get("run", {}) else lift.t_end,
            own.start or lift.start,
            self._method(own if "method" in tables else lift, own),
            own.outputs if "outputs" in tables else lift.outputs,
        )

    def _method(self, chosen: Lift, own: Lift) -> Method:
        """With [accuracy] it says nothing of what that chooses; what the lift says of it is left out."""
        if self.accuracy is None:
            return chosen.method
        try:
            refuse_what_is_chosen(own.method, {}, ())
        except SceneError as error:
            self._document.fail(("method",), str(error))
        return without_what_is_chosen(chosen.method)

    def require_accuracy(self, scene: Scene, *, staged: bool) -> None:
        """Raise FileFormatError for a quantity that the scene does not offer, or a limit that is none."""
        for name, limit in (self.accuracy or {}).items():
            try:
                model = None if staged else scene.compile()
                known = [] if name == EVENT_TIMES else quantities_of(scene, model, [name])
                limits_of([EVENT_TIMES, *known], {name: limit})
            except SceneError as error:
                self._document.fail(("accuracy", name), str(error))

    def fail_at(self, name: str, text: str) -> NoReturn:
        """Raise a FileFormatError about what varies."""
        table = "over" if "over" in self._document.data else "design"
        inside = ("ranges",) if table == "design" else ()
        path = (table, *inside, name)
        if path not in self._document.lines:
            path = (table, *inside, *name.split("."))
        self._document.fail(path, text)

    def _lift_document(self) -> tuple[Document, Path]:
        given = self._document.data["lift"]
        if isinstance(given, Mapping):
            lines = {place[1:]: line for place, line in self._document.lines.items() if place[0] == "lift"}
            lines.pop((), None)
            data = {"format": LIFT.format, "version": VERSION, **given}
            return Document(self._document.source, data, lines), self._folder
        if given in LIFTS:
            tables = Lift.shipped(given).tables
            return Document(given, {"format": LIFT.format, "version": VERSION, **tables}), self._folder
        path = Path(os.path.normpath(self._folder / given))
        if not path.is_file():
            self._document.fail(("lift",), f"lift is {shown(given)}: there is no file {path}")
        return read_document(path), path.parent


def _kept(table: Mapping[str, Any]) -> Kept | StageTime:
    """What a run leaves; ``channel = "stage[lift].end"`` is a time of a stage."""
    time = StageTime.of_text(table["channel"]) if table.keys() == {"channel"} else None
    return time or Kept(**table)


def _require_tables(document: Document) -> None:
    """Refuse tables that no study has, and a study without lift, keep or anything that varies."""
    document.require_version()
    known = (*TEXTS, *FROM_LIFTS)
    for name in document.data:
        if name not in (*known, "version"):
            document.fail((name,), f"{short(name)} is unknown in a study; {nearest(name, known)}")
    given = document.data.get("lift")
    if given is None:
        document.fail((), 'a study has a lift; add lift = "my_lift.toml" before its tables')
    if not (isinstance(given, str | Mapping) and given):
        document.fail(("lift",), f"lift is {shown(given)}; give the path of a lift file, or its tables")
    if ("over" in document.data) == ("design" in document.data):
        document.fail(("design",), "a study has either [over] or [design]; give one of them")


@dataclass(frozen=True)
class _Reader:
    """Reads the tables of a study."""

    document: Document
    checker: Checker

    def over(self) -> Any:
        """What varies, as `ensemble` takes it; ranges of values as they are."""
        if "over" in self.document.data:
            flat = self._flat(("over",), self.document.data["over"], RANGE)
            return {name: self._values(path, value) for name, path, value in flat}
        given = dict(self._table("design"))
        ranges = given.pop("ranges", None)
        if not isinstance(ranges, Mapping):
            self.document.fail(("design",), "[design] has no ranges; add [design.ranges]")
        found = {
            name: self._range(path, value)
            for name, path, value in self._flat(("design", "ranges"), ranges, ())
        }
        checked = keywords(DESIGN, self.checker.table(("design",), DESIGN, given))
        try:
            return LatinHypercube(ranges=found, **checked)
        except SceneError as error:
            self.document.fail(("design",), str(error))

    def members(self, over: Any) -> Members:
        """The members; of more than a million none is made."""
        try:
            return members_of(over)
        except SceneError as error:
            self.document.fail(("over",), str(error))

    def keep(self) -> dict[str, Kept | StageTime]:
        """What each run leaves, by name."""
        given = self.document.data.get("keep")
        if not isinstance(given, list) or not given:
            self.document.fail(
                ("keep",), f"keep is {shown(given)}; give [[keep]] for each of what runs leave"
            )
        found: dict[str, Kept | StageTime] = {}
        for place, one in enumerate(given):
            path = ("keep", place)
            table = plain(keywords(KEEP, self.checker.table(path, KEEP, one)))
            name = table.pop("name")
            if name in found:
                self.document.fail((*path, "name"), f"[[keep]] {place + 1}: name {name!r} is there twice")
            try:
                found[name] = _kept(table)
                checked_keep(found)
            except SceneError as error:
                self.document.fail(path, f"[[keep]] {place + 1}: {error}")
        return found

    def until(self, keep: Mapping[str, Kept | StageTime], members: Members) -> dict[str, float] | None:
        """Half widths by statistic."""
        if "until" not in self.document.data:
            return None
        found: dict[str, float] = {}
        for name, path, value in self._flat(("until",), self.document.data["until"], ()):
            found[name] = value
            try:
                targets_of({name: value}, keep)
            except SceneError as error:
                self.document.fail(path, str(error))
        if not found:
            self.document.fail(("until",), "[until] is empty; name a statistic, or leave it out")
        try:
            growth_of(members, None)
        except SceneError as error:
            self.document.fail(("until",), str(error))
        return found

    def accuracy(self) -> dict[str, Any] | None:
        """Largest error by quantity, as it is written."""
        if "accuracy" not in self.document.data:
            return None
        given = self._table("accuracy")
        if not given:
            self.document.fail(("accuracy",), "[accuracy] is empty; name a quantity, or leave it out")
        return dict(given)

    def exposure(self) -> float | None:
        """s."""
        if "statistics" not in self.document.data:
            return None
        table = self.checker.table(("statistics",), STATISTICS, self.document.data["statistics"])
        found = keywords(STATISTICS, table).get("exposure")
        if found is not None and not found > 0.0:
            self.document.fail(("statistics", "exposure_s"), f"exposure_s is {found:g}; give it above zero")
        return found

    def _table(self, name: str) -> Mapping[str, Any]:
        given = self.document.data[name]
        if not isinstance(given, Mapping):
            self.document.fail((name,), f"{name} is {shown(given)}; write [{name}]")
        return given

    def _flat(self, path: Place, given: Any, ends: Sequence[Key]) -> Iterator[tuple[str, Place, Any]]:
        """Values by dotted name, whether its parts are quoted together or not."""
        if not isinstance(given, Mapping):
            self.document.fail(path, f"{path[-1]} is {shown(given)}; give a table of names and values")
        for name, value in given.items():
            inside = (*path, name)
            if isinstance(value, Mapping) and not any(key.name in value for key in ends):
                for rest, place, one in self._flat(inside, value, ends):
                    yield f"{name}.{rest}", place, one
            else:
                yield name, inside, value

    def _values(self, path: Place, value: Any) -> Sequence[Any]:
        """The values of a parameter."""
        if isinstance(value, list):
            return value
        if not isinstance(value, Mapping):
            self.document.fail(path, f"{short(str(path[-1]))} is {shown(value)}; give a list of values")
        table = self.checker.table(path, RANGE, value)
        first, count = table["first"], table["count"]
        if count < 1:
            self.document.fail((*path, "count"), f"count is {count}; give one value or more")
        if "last" not in table:
            if first != int(first):
                self.document.fail(path, f"first is {first:g} without last; give both, or a whole number")
            return range(int(first), int(first) + count)
        if count > MOST_MEMBERS:
            return range(count)  # refused by its number, before values are made
        return [float(one) for one in np.linspace(first, table["last"], count)]

    def _range(self, path: Place, value: Any) -> tuple[float, float]:
        if not isinstance(value, list) or len(value) != 2:
            self.document.fail(path, f"{short(str(path[-1]))} is {shown(value)}; give [lowest, highest]")
        return value[0], value[1]
