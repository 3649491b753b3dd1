"""Calls with a keyword that there is not, or without what they need: told as any other mistake."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Iterable, Mapping
from difflib import get_close_matches
from functools import wraps
from types import FunctionType
from typing import Any, TypeVar

from seacrane.errors import KeywordError, SceneError
from seacrane.inputs.shown import shown

Callee = TypeVar("Callee", bound=Callable[..., Any])
SETTINGS = "shorthand"  # what a call hands on, word by word
MODEL = "LinearModel"  # which some functions take in its place
# as what a function takes for its scene
SCENES = ("Scene", "Description", "Some", f"Scene | {MODEL}", f"Description | {MODEL}")
ALIKE = 0.6  # of two names, as difflib counts
KEYWORDS = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
BY_PLACE = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


def named(what: Callee, label: str = "", *, owners: int = 0) -> Callee:
    """The function, or the class, that raises KeywordError where arguments do not fit it, or its methods.

    `label`: what messages call it; `owners`: how many of a function's first arguments nobody writes.
    """
    if isinstance(what, type):
        made: Any = what
        made.__init__ = _named(made.__init__, what.__name__, 1)
        for name, member in list(vars(what).items()):
            if not name.startswith("_"):
                setattr(made, name, _of_class(member, name))
        return what
    return _named(what, label or what.__name__, owners)  # type: ignore[no-any-return]


def _of_class(member: Any, name: str) -> Any:
    """A method that tells the same; anything else as it is."""
    if isinstance(member, FunctionType):
        return _named(member, name, 1)
    if isinstance(member, staticmethod):
        return staticmethod(_named(member.__func__, name, 0))
    return classmethod(_named(member.__func__, name, 1)) if isinstance(member, classmethod) else member


def _named(function: Any, name: str, owners: int) -> Any:
    kind = str(getattr(function, "__annotations__", {}).get("scene"))
    first = list(inspect.signature(function).parameters)[owners : owners + 1] if kind in SCENES else []
    of_scene = first == ["scene"]

    @wraps(function)
    def called(*args: Any, **given: Any) -> Any:
        text: str | None
        if of_scene and (len(args) > owners or "scene" in given):
            _require_scene(name, given["scene"] if "scene" in given else args[owners], kind)
        known: tuple[str, ...] = ()
        try:
            return function(*args, **given)
        except KeywordError as error:
            unknown = [key for key in given if error.known and key not in error.known]
            own = [key for key in inspect.signature(function).parameters if key not in ("self", SETTINGS)]
            unknown = [key for key in unknown if key not in own]
            if not unknown:
                raise
            text, known = no_keyword(unknown[0], given[unknown[0]], [*own, *error.known]), error.known
        except TypeError:
            text = _misfit(inspect.signature(function), owners, args, given)
            if text is None:
                raise
        told = KeywordError(f"{name}: {text}")
        told.known = known
        raise told

    return called


def _require_scene(name: str, value: Any, kind: str) -> None:
    """Refuse what is no scene; a description is known by what it holds, since it stands above this module."""
    known = all(hasattr(value, key) for key in ("bodies", "joints", "loads"))
    if not known and not (MODEL in kind and type(value).__name__ == MODEL):
        fix = "call it, with ()" if callable(value) else "give a Scene, such as seacrane.cases.case2()"
        raise SceneError(f"{name}: scene is {shown(value)}; {fix}")


def _misfit(
    signature: inspect.Signature, owners: int, args: tuple[Any, ...], given: Mapping[str, Any]
) -> str | None:
    """Why a call does not fit a signature; None where it does."""
    try:
        signature.bind(*args, **given)
    except TypeError as error:
        known = list(signature.parameters.values())[owners:]
        keys = [one.name for one in known if one.kind in KEYWORDS]
        any_key = any(one.kind is inspect.Parameter.VAR_KEYWORD for one in known)
        unknown = [key for key in given if key not in signature.parameters]
        if unknown and not any_key:
            return no_keyword(unknown[0], given[unknown[0]], keys)
        places, taken = [one.name for one in known if one.kind in BY_PLACE], len(args) - owners
        if taken > len(places):
            others = ", ".join(key for key in keys if key not in places)
            return (
                f"{taken} values are given by their place, and it takes {len(places)} so "
                f"({', '.join(places) or 'none'}); name the others: {others}"
            )
        here = {*places[:taken], *given}
        missing = [one.name for one in known if one.default is one.empty and one.kind in KEYWORDS]
        missing = [key for key in missing if key not in here]
        if missing:
            return f"{' and '.join(missing)} missing; give {', '.join(f'{key}=...' for key in missing)}"
        return str(error)
    return None


def taken(what: str, kind: str, takes: Collection[str], **words: Any) -> dict[str, Any]:
    """The words that are given, not None; SceneError for one that things of this kind do not take."""
    given = {key: value for key, value in words.items() if value is not None}
    if strange := [key for key in given if key not in takes]:
        fix = f"a {kind} takes {', '.join(takes) or 'no number'}; leave it out"
        raise SceneError(f"{what}: {strange[0]} is given; {fix}")
    return given


def no_keyword(key: str, value: Any, known: Iterable[str]) -> str:
    """That there is no such keyword, and the nearest there is."""
    names = list(known)
    near = nearest(key, names)
    fix = f"did you mean {near!r}? It" if near else "it"
    takes = ", ".join(names) or "nothing"
    return f"there is no {key!r}, which is given as {shown(value)}; {fix} takes {takes}"


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The known name most like one, whatever its case; None where none is."""
    lower = {one.lower(): one for one in known}
    found = get_close_matches(name.lower(), lower, 1, ALIKE) or [
        one for one in lower if one.startswith(name.lower())
    ]
    return lower[found[0]] if found else None


def no_attribute(thing: object, name: str) -> AttributeError:
    """That an object has no such attribute, and the nearest that it has."""
    kind = type(thing)
    near = None if name.startswith("_") else nearest(name, [one for one in dir(kind) if one[0] != "_"])
    return AttributeError(
        f"{kind.__name__} has no attribute {name!r}" + (f"; did you mean {near!r}?" if near else "")
    )
