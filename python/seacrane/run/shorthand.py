"""The words by which a call names parts of a Method and of Outputs without making them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypedDict

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.run.method import Method, energy_limit_of, step_of, tolerance_of
from seacrane.run.outputs import Outputs


class Shorthand(TypedDict, total=False):
    """Each as the attribute of `Method` or `Outputs` that it stands for; None: not given."""

    integrator: str | None
    rtol: float | None
    dt: float | None
    formulation: str | None
    max_step: float | None
    spectral_radius: float | None
    energy_limit: float | None
    dt_out: float | None
    channels: Sequence[str] | None


def _as_it_is(_: str, value: Any) -> Any:
    return value


# The attribute that a word stands for, and its check, so that an error has the user's word for it.
METHOD_WORDS: dict[str, tuple[str, Callable[[str, Any], Any]]] = {
    "integrator": ("integrator", _as_it_is),
    "rtol": ("tolerance", tolerance_of),
    "dt": ("step", step_of),
    "formulation": ("formulation", _as_it_is),
    "max_step": ("max_step", step_of),
    "spectral_radius": ("spectral_radius", number_of),
    "energy_limit": ("energy_limit", energy_limit_of),
}
OUTPUT_WORDS: dict[str, tuple[str, Callable[[str, Any], Any]]] = {
    "dt_out": ("dt", number_of),
    "channels": ("channels", _as_it_is),
}


def settled(
    method: Method | None, outputs: Outputs | None, shorthand: Mapping[str, Any]
) -> tuple[Method, Outputs]:
    """The method and the outputs of a call: the objects given, or those that the shorthand makes.

    Raises
    ------
    SceneError
        For an object of another type, a value that makes no sense, or a word beside the object that it
        contradicts.
    TypeError
        For a word that is none.
    """
    unknown = [word for word in shorthand if word not in METHOD_WORDS and word not in OUTPUT_WORDS]
    if unknown:
        known = ", ".join([*METHOD_WORDS, *OUTPUT_WORDS])
        raise TypeError(f"unexpected keyword argument {unknown[0]!r}; settings are method, outputs, {known}")
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


def _settled(
    name: str,
    kind: Any,
    given: Any,
    words: Mapping[str, tuple[str, Callable[[str, Any], Any]]],
    shorthand: Mapping[str, Any],
) -> Any:
    if given is not None and not isinstance(given, kind):
        raise SceneError(f"{name} is {given!r}; give a seacrane.{kind.__name__}")
    made = _changed(kind() if given is None else given, words, shorthand)
    if given is not None and made != given:
        word = next(w for w in words if getattr(made, words[w][0]) != getattr(given, words[w][0]))
        attribute = words[word][0]
        raise SceneError(
            f"{word}={shorthand[word]!r} contradicts {name}, whose {attribute} is "
            f"{getattr(given, attribute)!r}: leave {word} out, or change {name}"
        )
    return made


def _changed(
    whole: Any, words: Mapping[str, tuple[str, Callable[[str, Any], Any]]], shorthand: Mapping[str, Any]
) -> Any:
    """The object with the attributes that the words given stand for."""
    values = {
        words[word][0]: words[word][1](word, value)
        for word, value in shorthand.items()
        if word in words and value is not None
    }
    return replace(whole, **values)
