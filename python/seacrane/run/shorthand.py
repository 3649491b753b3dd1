"""The words by which a call names parts of a Method and of Outputs without making them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypedDict

from seacrane.errors import KeywordError, SceneError
from seacrane.inputs.keywords import no_keyword
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs


class Shorthand(TypedDict, total=False):
    """Each as the attribute of `Method` or `Outputs` that it stands for; None: not given."""

    integrator: str | None
    rtol: float | None
    dt: float | None
    formulation: str | None
    maximum_step: float | None
    spectral_radius: float | None
    energy_limit: float | None
    dt_out: float | None
    channels: Sequence[str] | None


METHOD_WORDS = tuple(Method.__dataclass_fields__)
OUTPUT_WORDS = tuple(Outputs.__dataclass_fields__)


def settled(
    method: Method | None, outputs: Outputs | None, shorthand: Mapping[str, Any]
) -> tuple[Method, Outputs]:
    """The method and the outputs of a call: the objects given, or those that the shorthand makes.

    Raises
    ------
    SceneError
        For an object of another type, a value that makes no sense, or a word beside the object that it
        contradicts.
    KeywordError
        For a word that is none.
    """
    for word in shorthand:
        if word not in METHOD_WORDS and word not in OUTPUT_WORDS:
            known = ["method", "outputs", *METHOD_WORDS, *OUTPUT_WORDS]
            error = KeywordError(f"settings: {no_keyword(word, shorthand[word], known)}")
            error.known = (*METHOD_WORDS, *OUTPUT_WORDS)
            raise error
    return (
        _settled("method", Method, method, METHOD_WORDS, shorthand),
        _settled("outputs", Outputs, outputs, OUTPUT_WORDS, shorthand),
    )


def overridden(
    method: Method | None, outputs: Outputs | None, shorthand: Mapping[str, Any]
) -> tuple[Method, Outputs]:
    """The objects, or defaults, with what the shorthand says in their place; raises SceneError."""
    return (
        _changed(Method() if method is None else method, METHOD_WORDS, shorthand),
        _changed(Outputs() if outputs is None else outputs, OUTPUT_WORDS, shorthand),
    )


def _settled(name: str, kind: Any, given: Any, words: Iterable[str], shorthand: Mapping[str, Any]) -> Any:
    if given is not None and not isinstance(given, kind):
        raise SceneError(f"{name} is {given!r}; give a seacrane.{kind.__name__}")
    made = _changed(kind() if given is None else given, words, shorthand)
    if given is not None and made != given:
        word = next(word for word in words if getattr(made, word) != getattr(given, word))
        raise SceneError(
            f"{word}={shorthand[word]!r} contradicts {name}, whose {word} is {getattr(given, word)!r}: "
            f"leave {word} out, or change {name}"
        )
    return made


def _changed(whole: Any, words: Iterable[str], shorthand: Mapping[str, Any]) -> Any:
    """The object with the attributes that the words given stand for."""
    values = {word: shorthand[word] for word in words if shorthand.get(word) is not None}
    return replace(whole, **values)
