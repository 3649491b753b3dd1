"""Run the study of a lift into its folder, or go on with it; keys of the lift may be what varies.

A lift is made anew with other values of its keys, so that what is derived from a key follows.
"""

from __future__ import annotations

import copy
import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from seacrane.ensembles.ensemble import Ensemble, ensemble
from seacrane.ensembles.members import Value
from seacrane.ensembles.merging import merge_parts
from seacrane.ensembles.object_store import folder_of
from seacrane.ensembles.other_sea import WORDS, require_same_sea, with_sea
from seacrane.ensembles.price import Priced
from seacrane.ensembles.study import Source, require_paths, stage_paths, with_values
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import is_draft
from seacrane.lift.answer_keys import ANSWERS
from seacrane.lift.keys import Key
from seacrane.lift.lift import Lift, Study
from seacrane.lift.tables import ASIDE, TABLES
from seacrane.scene.scene import Scene

FILE, MEMBERS = "study.toml", "members"
SINGLE = ("number", "whole", "text", "flag", "curve")  # types of keys that hold one value, or may
MOST_HELD = 32  # scenes of a process

Tables = Mapping[str, Any]


def run_study(
    path: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    member_limit: float | None = None,
    part: str | None = None,
    priced: Priced | None = None,
    progress: bool = False,
) -> Ensemble:
    """Run the study of a lift file into a folder; what is there is not run again.

    Of a `part`, such as "3/40", its members alone; `merge_study` makes one folder of those of all parts.
    `member_limit` (s) and `priced`, which is told the price and says whether to go on, are as of `ensemble`.

    Raises
    ------
    FileFormatError
        With the line, for what is wrong in the file or the lift that it names.
    SceneError
        If there is no [study], or the folder is that of another study, or of something else.
    SimulationError, WorkerVersionError, OSError
        As of `ensemble`; what came back before is kept.
    """
    lift = Lift.load(path)
    if lift.study is None:
        raise SceneError(f"{Path(path).name} has no [study]; `seacrane run` runs it once")
    source = _source(lift, lift.study)
    target = made_folder(folder, FILE, [MEMBERS])
    if not (target / FILE).exists():
        lift.save(target / FILE)
    done = ensemble(
        source, over=lift.study.over, keep=lift.study.keep, until=lift.study.until, accuracy=lift.accuracy,
        stages=lift.stages, start=lift.start, t_end=None if lift.stages else lift.t_end, method=lift.method,
        outputs=lift.outputs, executor=executor, store=target / MEMBERS, member_limit=member_limit,
        part=part, priced=priced,
        progress=progress,
    )  # fmt: skip
    lift.save(target / FILE)
    return done


def merge_study(parts: Sequence[str | os.PathLike[str]], folder: str | os.PathLike[str]) -> Ensemble:
    """Make one folder of those of all parts of a study: that of one run, to the bit.

    Raises
    ------
    SceneError, FileFormatError, OSError
        As `merge_parts`, and for a folder that is none of a part, or holds something else than a study.
    """
    for one in map(Path, parts):
        if not (one / FILE).is_file():
            raise SceneError(f"merge: {one} is no folder of a study; give those of seacrane study --part")
    target = made_folder(folder, FILE, [MEMBERS])
    done = merge_parts([Path(one) / MEMBERS for one in parts], target / MEMBERS)
    Lift.load(Path(parts[0]) / FILE).save(target / FILE)
    return done


def made_folder(folder: str | os.PathLike[str], file: str, others: Sequence[str]) -> Path:
    """The folder of a study or sheet, by the file in it, made if absent; SceneError where it is none."""
    target = folder_of("out", folder)
    if target.exists() and not target.is_dir():
        raise SceneError(f"{target} is a file; give the name of a folder")
    target.mkdir(parents=True, exist_ok=True)
    there = (one for one in target.iterdir() if one.name not in others and not is_draft(one))
    if not (target / file).exists() and any(there):
        raise SceneError(f"{target} holds something else than a {Path(file).stem}; give another folder")
    return target


def _source(lift: Lift, study: Study) -> Source:
    """The scene of the lift, or what makes scenes where keys of the lift vary."""
    scene = lift.scene()
    tables = {name: table for name, table in lift.tables.items() if name not in ("study", "sheet", *ANSWERS)}
    axes = study.members.axes
    keys, of_stages = keys_in(tables), stage_paths(lift.stages)
    for name, values in axes.items():
        try:
            require_paths(scene, [name], WORDS, [*keys, *of_stages])
            for value in (values[0], values[-1]) if name in keys else ():
                Lift(with_keys(tables, keys, {name: value}))
        except (FileFormatError, SceneError) as error:
            study.fail_at(name, str(error))
    varied: dict[str, KeyPlace] = {name: keys[name] for name in axes if name in keys}
    for name, first in in_two_units(varied):
        study.fail_at(name, f"over: {name} is {first} in another unit; leave one of them out")
    if not varied:
        return scene
    words = [name for name in axes if name in WORDS]
    if words:
        try:
            require_same_sea(scene, words)
        except SceneError as error:
            study.fail_at(words[0], str(error))
    return LiftScenes(tables, varied)


@dataclass(frozen=True)
class KeyPlace:
    """Where a key stands in the tables of a lift, and its other spellings, beside which it may not stand."""

    place: tuple[str | int, ...]
    others: tuple[str, ...] = ()


def keys_in(tables: Tables) -> dict[str, KeyPlace]:
    """By path, such as "crane.payload.mass_kg": every key of the tables there that holds one value.

    Tables of which there are several are told apart by their names, or else by their number from 1 on; so
    are the parts of arrays, as in "crane.foot_m.2".
    """
    named = [(name, given) for name, given in tables.items() if name not in (*ASIDE, "notes")]
    inside = (_inside(name, (name,), TABLES[name].keys, given) for name, given in named)
    return {path: place for places in inside for path, place in places}


def _inside(
    path: str, place: tuple[str | int, ...], keys: Iterable[Key], given: Any
) -> Iterator[tuple[str, KeyPlace]]:
    if isinstance(given, list):
        for number, one in enumerate(given):
            yield from _inside(f"{path}.{one.get('name', number + 1)}", (*place, number), keys, one)
        return
    for key in keys:
        whole = any(isinstance(given.get(spelling), list | dict) for spelling in key.spellings)
        for spelling in key.spellings:
            here, inside, value = f"{path}.{spelling}", (*place, spelling), given.get(spelling)
            if key.type in ("table", "tables"):
                yield from _inside(here, inside, key.keys, value) if value else ()
            elif key.type == "array" and isinstance(value, list):
                for number, part in enumerate(value):
                    if not isinstance(part, list):
                        yield f"{here}.{number + 1}", KeyPlace((*inside, number))
            elif key.type in SINGLE and not whole:
                yield here, KeyPlace(inside, tuple(one for one in key.spellings if one != spelling))


def in_two_units(varied: Mapping[str, KeyPlace]) -> Iterator[tuple[str, str]]:
    """Paths that vary a key which an earlier one varies in another unit, with that one."""
    once: dict[Any, str] = {}
    for name, one in varied.items():
        first = once.setdefault((one.place[:-1], frozenset((one.place[-1], *one.others))), name)
        if first != name:
            yield name, first


def with_keys(tables: Tables, places: Mapping[str, KeyPlace], values: Mapping[str, Value]) -> Tables:
    """A copy of the tables with values of keys by path."""
    out = copy.deepcopy(dict(tables))
    for path, value in values.items():
        *outer, last = places[path].place
        node: Any = out
        for part in outer:
            node = node[part]
        for other in places[path].others:
            node.pop(other, None)
        node[last] = value
    return out


@dataclass(frozen=True)
class LiftScenes:
    """Makes the scenes of a study whose lift varies in its keys; what is derived from a key follows it."""

    tables: Tables  # of the lift
    places: Mapping[str, KeyPlace]  # of its keys that vary

    def __call__(self, **values: Value) -> Scene:
        """With values of keys, then of paths into the scene, then of words of its sea."""
        keys = {name: value for name, value in values.items() if name in self.places}
        sea = {name: value for name, value in values.items() if name in WORDS}
        paths = {name: value for name, value in values.items() if name not in keys and name not in sea}
        scene = _built(json.dumps(with_keys(self.tables, self.places, keys)))
        made = with_values(scene, paths)
        return with_sea(made, sea) if sea else made


@lru_cache(maxsize=MOST_HELD)
def _built(tables: str) -> Scene:
    return Lift(json.loads(tables)).scene()
