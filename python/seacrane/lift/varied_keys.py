"""Keys of a lift file as parameters: a lift is made anew with other values of them, and its scene built."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from seacrane.ensembles.members import Value
from seacrane.ensembles.other_sea import WORDS, with_sea
from seacrane.ensembles.study import with_values
from seacrane.lift.keys import Key
from seacrane.lift.lift import Lift
from seacrane.lift.tables import TABLES
from seacrane.scene.scene import Scene

OF_NO_SCENE = (
    "run",
    "method",
    "outputs",
    "stage",
    "study",
    "notes",
)  # tables that vary nothing that is built
SINGLE = ("number", "whole", "text", "flag", "curve")  # types of keys that hold one value, or may
MOST_HELD = 32  # scenes of a process

Tables = Mapping[str, Any]


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
    named = ((name, given) for name, given in tables.items() if name not in OF_NO_SCENE)
    return {
        path: place
        for name, given in named
        for path, place in _inside(name, (name,), TABLES[name].keys, given)
    }


def _inside(
    path: str, place: tuple[str | int, ...], keys: Iterable[Key], given: Any
) -> Iterator[tuple[str, KeyPlace]]:
    if isinstance(given, list):
        for number, one in enumerate(given):
            yield from _inside(f"{path}.{one.get('name', number + 1)}", (*place, number), keys, one)
        return
    for key in keys:
        for spelling in key.spellings:
            here, inside, value = f"{path}.{spelling}", (*place, spelling), given.get(spelling)
            if key.type in ("table", "tables"):
                yield from _inside(here, inside, key.keys, value) if value else ()
            elif key.type == "array":
                for number in range(len(value) if _of_numbers(value) else 0):
                    yield f"{here}.{number + 1}", KeyPlace((*inside, number))
            elif key.type in SINGLE and not isinstance(value, list | dict):
                yield here, KeyPlace(inside, tuple(one for one in key.spellings if one != spelling))


def _of_numbers(value: Any) -> bool:
    return isinstance(value, list) and not any(isinstance(one, list) for one in value)


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
    """Makes the scenes of a study whose lift varies in its keys; what is derived from a key follows it.

    Attributes
    ----------
    tables : Of the lift.
    places : mapping of str to KeyPlace
        Of its keys that vary.
    """

    tables: Tables
    places: Mapping[str, KeyPlace]

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
