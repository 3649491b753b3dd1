"""The [study] of a lift: what varies in it, what each run leaves, and when it is enough."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from seacrane.ensembles.growing import growth_of
from seacrane.ensembles.kept import Kept, StageTime
from seacrane.ensembles.members import MOST_MEMBERS, LatinHypercube, Members, members_of
from seacrane.ensembles.study import checked_keep
from seacrane.ensembles.targets import targets_of
from seacrane.errors import SceneError
from seacrane.lift.build import refused_at
from seacrane.lift.calls import Keywords, keywords
from seacrane.lift.check_keys import Entry, plain
from seacrane.lift.inner_keys import STUDY


@dataclass(frozen=True, kw_only=True)
class Study:
    """What a [study] says.

    Attributes
    ----------
    over : As `ensemble` takes it.
    keep : mapping of str to Kept or StageTime
    until : mapping of str to float, or None
    exposure : Of largest values, s; None: the length of a run.
    """

    over: Any
    members: Members
    keep: Mapping[str, Kept | StageTime]
    until: Mapping[str, float] | None
    exposure: float | None
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
    over = _over(entry, given)
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


def _over(entry: Entry, given: Keywords) -> Any:
    """What varies, as `ensemble` takes it; ranges of values as they are."""
    if "over" in given:
        return {name: _values(entry, name, one) for name, one in given["over"].items()}
    with refused_at(entry, "design"):
        return LatinHypercube(**given["design"])


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
