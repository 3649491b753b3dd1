"""The JSON Schema of lift files, from the same tables as the reader; editors complete and check with it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from importlib.resources import files
from pathlib import Path
from typing import Any

from seacrane.lift.document import FORMAT, VERSION
from seacrane.lift.inner_keys import CURVES, FROM, RANGE
from seacrane.lift.keys import Key
from seacrane.lift.tables import TABLES, Table

Json = dict[str, Any]
DRAFT = "http://json-schema.org/draft-07/schema#"
VALUES: Json = {"type": "array", "minItems": 1, "items": {"type": ["number", "string", "boolean"]}}


def schema_path() -> Path:
    """Where the schema is in the installed package."""
    return Path(str(files("seacrane") / "data" / "lift.schema.json"))


def schema_text() -> str:
    """The schema as JSON text."""
    return json.dumps(schema(), indent=1) + "\n"


def schema() -> Json:
    """The schema (draft 7) of a lift file as plain data."""
    return {
        "$schema": DRAFT,
        "title": "A lift for seacrane",
        "type": "object",
        "properties": {
            "format": {"const": FORMAT, "description": "What the file is."},
            "version": {"const": VERSION},
            **{table.name: _table(table) for table in TABLES.values()},
        },
        "required": ["format", "version"],
        "additionalProperties": False,
        "definitions": {
            **{table.name: object_of(table.keys) for table in TABLES.values()},
            "curve": _curve([kind for kind in CURVES if kind != "gust"]),
            "curve_of_speed": _curve(list(CURVES)),
            "names": _named("names", {"type": "string"}),
            "limits": _named("limits", {"type": "number", "exclusiveMinimum": 0}),
            "ranges": _named("ranges", _array((2,), {"type": "number"})),
            "values": _named("values", {"anyOf": [VALUES, object_of(RANGE)]}),
        },
    }


def _table(table: Table) -> Json:
    one = {"$ref": f"#/definitions/{table.name}"}
    if not table.several:
        return {"description": table.text, "allOf": [one]}
    return {"description": table.text, "anyOf": [one, {"type": "array", "minItems": 1, "items": one}]}


def object_of(keys: Iterable[Key]) -> Json:
    """A table: every spelling of every key, one spelling of each that is required, and no two of one."""
    keys = tuple(keys)
    if any(key.type == "notes" for key in keys):
        return {"type": "object"}
    rules = [rule for key in keys for rule in _rules(key)]
    return {
        "type": "object",
        "properties": {
            spelling: _described(key, unit) for key in keys for spelling, unit in key.spellings.items()
        },
        "required": [next(iter(key.spellings)) for key in keys if key.required and len(key.spellings) == 1],
        "additionalProperties": False,
        **({"allOf": rules} if rules else {}),
    }


def _rules(key: Key) -> list[Json]:
    spellings = list(key.spellings)
    if len(spellings) == 1:
        return []
    if key.required:
        return [{"oneOf": [{"required": [one]} for one in spellings]}]
    given = [{"required": [one]} for one in spellings]
    return [{"oneOf": [*given, {"not": {"anyOf": given}}]}]


def _described(key: Key, unit: str) -> Json:
    mixed = f" ({key.unit})" if key.unit and not key.units and not key.name.endswith("_deg") else ""
    text = f"{key.text}{f' [{unit}]' if unit else mixed}".strip()
    return ({"description": text} if text else {}) | _kind(key, {"type": "number", **key.bounds_in(unit)})


def _kind(key: Key, number: Json) -> Json:
    match key.type:
        case "text":
            return {"type": "string", **({"enum": list(key.choices)} if key.choices else {})}
        case "number":
            words = [{"enum": list(key.choices)}] if key.choices else []
            return {"anyOf": [number, *words]} if words else number
        case "whole":
            return number | {"type": "integer"}
        case "flag":
            return {"type": "boolean"}
        case "array":
            arrays = [_array(shape, number) for shape in key.shapes]
            return arrays[0] if len(arrays) == 1 else {"anyOf": arrays}
        case "texts":
            return {"type": "array", "items": {"type": "string"}}
        case "file":
            return {"type": "string", "minLength": 1}
        case "names" | "limits" | "ranges" | "values":
            return {"allOf": [{"$ref": f"#/definitions/{key.type}"}]}
        case "table":
            return object_of(key.keys)
        case "tables":
            return {"type": "array", "items": object_of(key.keys)}
        case "curve":
            name = "curve_of_speed" if key.unit == "m/s" else "curve"
            return {"allOf": [{"$ref": f"#/definitions/{name}"}]}
    raise TypeError(f"no lift file holds a {key.type}")


def _named(kind: str, one: Json) -> Json:
    """Values by name, whose parts may be tables in tables."""
    inside = {"anyOf": [one, {"$ref": f"#/definitions/{kind}"}]}
    return {"type": "object", "minProperties": 1, "additionalProperties": inside}


def _array(shape: tuple[int, ...], number: Json) -> Json:
    if not shape:
        return number
    items = number if len(shape) == 1 else _array(shape[1:], number)
    length = {} if shape[0] == -1 else {"minItems": shape[0], "maxItems": shape[0]}
    return {"type": "array", "items": items, **length}


def _curve(kinds: list[str]) -> Json:
    first, later = ([_piece(kind, *more) for kind in kinds] for more in ((), (FROM,)))
    return {
        "description": "A number, a piece, or pieces of which each takes over from the one before.",
        "anyOf": [
            {"type": "number"},
            {"anyOf": first},
            {
                "type": "array",
                "minItems": 1,
                "items": [{"anyOf": first}],
                "additionalItems": {"anyOf": later},
            },
        ],
    }


def _piece(kind: str, *more: Key) -> Json:
    piece = object_of((*more, *CURVES[kind]))
    piece["properties"] = {"kind": {"const": kind}, **piece["properties"]}
    piece["required"] = ["kind", *piece["required"]]
    return piece
