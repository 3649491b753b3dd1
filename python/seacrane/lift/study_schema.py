"""The JSON Schema of study files, from the keys that the reader uses."""

from __future__ import annotations

import json
from typing import Any

from seacrane.lift.document import MOST_PARTS, VERSION
from seacrane.lift.schema import DRAFT, object_of, schema
from seacrane.lift.study_keys import DESIGN, FROM_LIFTS, KEEP, RANGE, STATISTICS, STUDY, TEXTS

Json = dict[str, Any]
VALUE: Json = {"type": ["number", "string", "boolean"]}
SHARE: Json = {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1}
LIMITS: Json = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}


def study_schema_text() -> str:
    """The schema as JSON text."""
    return json.dumps(study_schema(), indent=1) + "\n"


def study_schema() -> Json:
    """The schema (draft 7) of a study file as plain data."""
    lift = schema()
    design = object_of(DESIGN)
    design["properties"]["ranges"] = _named("limits")
    design["required"] = [*design["required"], "ranges"]
    tables: dict[str, Json] = {
        "format": {"const": STUDY.format},
        "lift": {"anyOf": [{"type": "string", "minLength": 1}, {"type": "object", "minProperties": 1}]},
        "over": _named("values"),
        "design": design,
        "keep": {"type": "array", "minItems": 1, "items": object_of(KEEP)},
        "accuracy": _named("error"),
        "until": _named("share"),
        "statistics": object_of(STATISTICS),
    }
    return {
        "$schema": DRAFT,
        "title": "A study for seacrane",
        "type": "object",
        "properties": {
            "version": {"const": VERSION},
            **{name: {"description": TEXTS[name], **table} for name, table in tables.items()},
            **{name: lift["properties"][name] for name in FROM_LIFTS},
        },
        "required": ["format", "version", "lift", "keep"],
        "oneOf": [{"required": ["over"]}, {"required": ["design"]}],
        "additionalProperties": False,
        "definitions": {
            **{name: lift["definitions"][name] for name in FROM_LIFTS},
            "values": {"anyOf": [{"type": "array", "minItems": 1, "items": VALUE}, object_of(RANGE)]},
            "limits": LIMITS,
            "error": {"type": "number", "exclusiveMinimum": 0},
            "share": SHARE,
        },
    }


def _named(kind: str) -> Json:
    """Values by name, whose parts may be tables in tables."""
    one = {"$ref": f"#/definitions/{kind}"}
    inside: Json = {"type": "object", "minProperties": 1, "additionalProperties": one}
    for _ in range(MOST_PARTS - 2):
        inside = {
            "type": "object", "minProperties": 1, "additionalProperties": {"anyOf": [one, inside]},
        }  # fmt: skip
    return inside
