"""Every public keyword and every key of lift files has the spelling of docs/conventions.md."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import seacrane
from seacrane.lift.inner_keys import RANGE
from seacrane.lift.keys import Key
from seacrane.lift.tables import TABLES


@pytest.fixture(scope="module")
def refused(repository: Path) -> dict[str, list[str]]:
    """Replaced spellings with the places where they stay; an asterisk stands for the rest."""
    text = (repository / "docs" / "conventions.md").read_text(encoding="utf-8")
    table = text.split("## Words", 1)[1].split("\n## ", 1)[0]
    rows = [line.split("|") for line in table.splitlines() if line.startswith("| `")]
    return {old: re.findall(r"`([^`]+)`", row[4]) for row in rows for old in re.findall(r"`([^`]+)`", row[3])}


def replaced(place: str, word: str, refused: dict[str, list[str]]) -> bool:
    rows = [stays for old, stays in refused.items() if fnmatchcase(word, old)]
    return any(not any(fnmatchcase(place, at) for at in stays) for stays in rows)


def keywords_of(name: str, call: Any) -> Iterator[tuple[str, str]]:
    try:
        parameters = inspect.signature(call).parameters
    except (TypeError, ValueError):  # of the core, whose keywords are those of Scene
        return
    yield from ((f"{name}({one}=)", one) for one in parameters)


def public(module: ModuleType, prefix: str = "") -> Iterator[tuple[str, str]]:
    """Keywords of what a module shows, of its modules, and of the methods of its classes."""
    for name in (name for name in dir(module) if not name.startswith("_")):
        one = getattr(module, name)
        if isinstance(one, ModuleType):
            if one.__name__.startswith("seacrane.") and not prefix:
                yield from public(one, f"{name}.")
        elif not str(getattr(one, "__module__", "")).startswith("seacrane") or not callable(one):
            continue
        elif not (isinstance(one, type) and issubclass(one, BaseException)):
            yield from keywords_of(prefix + name, one)
            for method in vars(one) if isinstance(one, type) else ():
                if not method.startswith("_"):
                    yield from keywords_of(f"{prefix}{name}.{method}", getattr(one, method))


def keys_in(path: str, keys: Iterable[Key]) -> Iterator[tuple[str, str]]:
    for key in keys:
        yield f"[{path}] {key.name}", key.name
        yield from keys_in(f"{path}.{key.name}", key.keys)


def words() -> list[tuple[str, str]]:
    tables = {table.name: table.keys for table in TABLES.values()}
    files = [word for name, keys in {**tables, "over": RANGE}.items() for word in keys_in(name, keys)]
    return [*public(seacrane), *files]


def test_no_public_keyword_or_key_has_a_spelling_that_the_table_replaces(
    refused: dict[str, list[str]],
) -> None:
    """A place of the last column that no longer holds its word is taken out of the table."""
    found = words()
    seen = {"Scene.add_line(length=)", "simulate(t_end=)", "[stage.until] minimum", "[study.keep] names"}
    assert seen <= {place for place, _ in found} and len(found) > 1000
    assert {"where", "above", "max_*", "heading", "rho"} <= set(refused)
    assert replaced("motion_rao(heading=)", "heading", refused)
    assert not replaced("hydro.HydroData(heading=)", "heading", refused)
    assert not [place for place, word in found if replaced(place, word, refused)]
    held = [(place, old) for place, word in found for old in refused if fnmatchcase(word, old)]
    for at in {at for stays in refused.values() for at in stays}:
        assert any(fnmatchcase(place, at) and at in refused[old] for place, old in held), at
