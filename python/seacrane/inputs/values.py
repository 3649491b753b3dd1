"""Values that stand for several entries of an element of the core, which checks their numbers."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from inspect import cleandoc, signature
from typing import Any, TypeVar, dataclass_transform

from seacrane.errors import SceneError
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown

T = TypeVar("T")
Call = TypeVar("Call", bound=Callable[..., Any])
_ENTRIES: dict[type, Mapping[str, str]] = {}


@dataclass_transform(frozen_default=True, kw_only_default=True)
def value(element: Any, prefix: str = "", *keys: str, **entries: str) -> Callable[[type[T]], type[T]]:
    """A class as a frozen value of keywords; its docstring lists them, with the units and words of FIELDS.

    Parameters
    ----------
    element : Of the core.
    prefix, *keys : Begins the names that the element has for these fields; for all without keys.
    **entries : Other names of the element, by field.
    """

    def made(kind: type[T]) -> type[T]:
        named(dataclass(frozen=True, kw_only=True)(kind))
        own = [one.name for one in fields(kind)]  # type: ignore[arg-type]
        begun = {key: f"{prefix}_{key}" for key in (keys or own) if prefix}
        _ENTRIES[kind] = {key: key for key in own} | begun | entries
        told = {field.name: f"{field.unit or 1}\n    {field.text}" for field in element.FIELDS}
        rows = [f"{key} : {told[name]}" for key, name in _ENTRIES[kind].items() if name in told]
        kind.__doc__ = "\n".join((cleandoc(kind.__doc__ or ""), "", "Attributes", "----------", *rows))
        return kind

    return made


def told_by(*elements: Any) -> Callable[[Call], Call]:
    """A call whose docstring tells the keywords that it leaves out as FIELDS of elements of the core do."""

    def told(call: Call) -> Call:
        text = cleandoc(call.__doc__ or "")
        head, mark, rest = text.partition("\nParameters\n----------\n")
        keywords = signature(call).parameters
        missing = [
            f"{field.name} : {field.unit or field.type}" + f"\n    {field.text}" * bool(field.text)
            for field in {one.name: one for kind in elements for one in kind.FIELDS}.values()
            if field.text
            and field.name in keywords
            and not re.search(rf"^(\w+, )*{field.name}\b", rest, re.MULTILINE)
        ]
        said, end, after = rest.partition("\n\n")
        call.__doc__ = head + mark + "\n".join([said, *missing]) + end + after
        return call

    return told


def made_of(what: str, word: str, kind: type[T], given: T | Mapping[str, Any]) -> T:
    """A value of a kind, or its keywords as one. SceneError for what is neither."""
    if isinstance(given, kind):
        return given
    if not isinstance(given, Mapping):
        raise SceneError(f"{what}: {word} is {shown(given)}; give {word}={kind.__name__}(...)")
    return kind(**given)


def listed_of(what: str, kind: type[T], given: Any, *, by: str = "name") -> tuple[T, ...]:
    """At least one value of a kind, no two of one name, or a SceneError."""
    listed = [given] if isinstance(given, kind) else list(given) if isinstance(given, Sequence) else []
    if not listed or not all(isinstance(one, kind) for one in listed):
        raise SceneError(f"{what} is {shown(given)}; give a list of {kind.__name__}")
    names = [getattr(one, by) for one in listed]
    for name in names:
        if names.count(name) > 1:
            raise SceneError(f"{what}: {name!r} is there twice; give each a {by} of its own")
    return tuple(listed)


def entries_of(word: str, kind: type) -> dict[str, str]:
    """Entries of the element by the fields of a value, for a keyword; those of a rod side end so."""
    end = "_rod" if word.startswith("rod_") else ""
    return {key: entry + end for key, entry in _ENTRIES[kind].items()}


def flat(what: str, given: Mapping[str, Any], kinds: Mapping[str, type]) -> dict[str, Any]:
    """Keywords as entries, without those that are None. SceneError for what is no value of its kind."""
    found: dict[str, Any] = {}
    for word, one in given.items():
        if word in kinds and one is not None:
            made, entries = made_of(what, word, kinds[word], one), entries_of(word, kinds[word])
            found |= {entry: getattr(made, key) for key, entry in entries.items()}
        else:
            found[word] = one
    return {entry: one for entry, one in found.items() if one is not None}
