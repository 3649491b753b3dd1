"""Keys of a lift file: a keyword of the API and its unit, such as mass_kg; from the tables of the engine.

The rule: a table is a call, a key is a keyword of that call with its unit as a suffix. Spaces of the unit are
"_", a stroke is "_per_": ``damping_N_s_per_m``. It may be any unit of the same dimension (``slew_deg``,
``mass_t``; inputs/units.py has the table). Where the unit depends on a joint's coordinate ("m or rad"), the
suffix says which one is meant.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from types import SimpleNamespace, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

import numpy as np

from seacrane._core import Curve
from seacrane.errors import SceneError
from seacrane.inputs.units import UNITS, others_of, spellings, suffix

MIXED = ", "  # between the units of an array of several: no suffix says them
EITHER = " or "  # between the units of a displacement and an angle
SECTIONS = ("Parameters", "Attributes")
TYPES = {str: "text", float: "number", int: "whole", bool: "flag", Literal: "text"}


@dataclass(frozen=True)
class Key:
    """A keyword of the API as a key of a file.

    `type`: text, texts, number, whole, flag, array, curve, file, table, tables or notes; or by dotted name
    names (texts), limits (numbers), ranges or values. `shapes` of an array: -1 is any length, () a number
    alone. `choices`: texts that it may be, or that stand for a number or a file. `bounds` are in the words of
    JSON Schema and in `unit`. `entry`: what messages call it, where they call it otherwise.
    """

    name: str
    type: str
    unit: str = ""
    text: str = ""
    required: bool = field(default=False, kw_only=True)
    shapes: tuple[tuple[int, ...], ...] = field(default=(), kw_only=True)
    choices: tuple[str, ...] = field(default=(), kw_only=True)
    bounds: Mapping[str, float] = field(default_factory=dict, kw_only=True)
    keys: tuple[Key, ...] = field(default=(), kw_only=True)
    entry: str = field(default="", kw_only=True)

    @property
    def units(self) -> tuple[str, ...]:
        """Units that a file may give it in; of several the first is a displacement's, then an angle's."""
        return tuple(unit for unit in self.spellings.values() if unit)

    @property
    def spellings(self) -> dict[str, str]:
        """Its unit by each way to write it in a file."""
        if not self.unit or MIXED in self.unit or self.name.endswith("_deg"):
            return {self.name: ""}
        return spellings(self.name, *self.unit.split(EITHER))

    def bounds_in(self, unit: str) -> dict[str, float]:
        """What its numbers must be in one of its units."""
        if unit.startswith("deg"):
            return {word: float(np.degrees(bound)) for word, bound in self.bounds.items()}
        return {word: bound / UNITS.get(unit, (1.0,))[0] for word, bound in self.bounds.items()}


UNIT_OF_SUFFIX = {suffix(unit): unit for unit in UNITS}


def require_unit(
    keys: Iterable[Key], values: Mapping[str, Any], own: str, what: str, otherwise: str = ""
) -> None:
    """Refuse values in another unit than its own, or one of several.

    `what` is meant; `otherwise`: the fix where no key is in it.
    """
    units = {each for unit in own.split(EITHER) for each in (unit, *others_of(unit))}
    for key in keys:
        right = [one for one, unit in key.spellings.items() if unit in units]
        for spelling, unit in key.spellings.items():
            if spelling in values and unit and spelling not in right:
                fix = f"give {' or '.join(right)}" if right else otherwise
                raise SceneError.of(spelling, f"is given, and {what} is in {own}; {fix}")


def keys_of(
    call: Any,
    *classes: type,
    more: Mapping[str, Mapping[str, Any]] | None = None,
    without: Collection[str] = (),
    only: Collection[str] | None = None,
    described: Any = None,
    entries: Mapping[str, str] | None = None,
) -> tuple[Key, ...]:
    """The keywords of a call as keys: types from its signature, texts from the docstring of `described`.

    FIELDS of `classes` of the core give type, shape, unit and text of the keywords of the same name, or of
    that in `entries`; `more` what neither knows, by keyword. A file holds `only` some, or is `without` some.
    """
    fields = {field.name: field for kind in classes for field in kind.FIELDS}  # type: ignore[attr-defined]
    other = entries or {}
    texts = parameter_texts(call if described is None else described)
    found = []
    for parameter in inspect.signature(call).parameters.values():
        name = parameter.name
        left_out = name == "scene" or name in without or (only is not None and name not in only)
        if left_out or parameter.kind is parameter.VAR_KEYWORD:
            continue
        known = _annotated(call, parameter.annotation) | _of_field(fields.get(other.get(name, name)))
        known["text"] = texts.get(name) or known.get("text", "")
        known |= (more or {}).get(name, {})
        required = {"required": parameter.default is parameter.empty}
        found.append(Key(name=name, entry=other.get(name, ""), **required | known))
    return tuple(found)


def field_keys(fields: Iterable[Any], *, without: Collection[str] = ()) -> tuple[Key, ...]:
    """FIELDS of a class of the core, or the parameters of a joint kind, as keys."""
    kept = (field for field in fields if field.name not in without)
    return tuple(Key(name=field.name, required=field.required, **_of_field(field)) for field in kept)


def _of_field(field: Any) -> dict[str, Any]:
    if field is None:
        return {}
    shapes = (tuple(field.shape),) if field.type == "array" else ()
    told = {name: getattr(field, name) for name in ("type", "unit", "text", "bounds")}
    return told | {"shapes": shapes}


def _annotated(call: Any, annotation: Any) -> dict[str, Any]:
    """Type and choices that an annotation tells; nothing for what it leaves open."""
    held = SimpleNamespace(__annotations__={"it": annotation})
    hint = get_type_hints(held, vars(sys.modules[call.__module__]))["it"]
    kinds = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    if Curve in kinds:
        return {"type": "curve"}
    first = get_origin(kinds[0]) or kinds[0]
    choices = tuple(text for kind in kinds if get_origin(kind) is Literal for text in get_args(kind))
    return {"type": TYPES[first], "choices": choices} if first in TYPES else {}


def parameter_texts(call: Any) -> dict[str, str]:
    """What a docstring says of each parameter or attribute, in one line."""
    texts: dict[str, str] = {}
    lines = (inspect.getdoc(call) or "").splitlines()
    names: list[str] = []
    inside = False
    for i, line in enumerate(lines):
        if line and i + 1 < len(lines) and re.fullmatch(r"-{4,}", lines[i + 1]):
            inside, names = line in SECTIONS, []
        elif inside and line and not line.startswith((" ", "-")):
            names = re.findall(r"\w+", line.partition(" : ")[0])
        elif names and line.strip():
            texts |= {name: f"{texts.get(name, '')} {line.strip()}".strip() for name in names}
    return texts
