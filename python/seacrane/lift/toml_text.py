"""The tables of a lift as TOML text, as a person would lay them out."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from seacrane.errors import SceneError
from seacrane.lift.document import FORMAT, VERSION

WIDTH = 100  # characters of a line of keys; longer tables get a heading


def toml_text(tables: Mapping[str, Any]) -> str:
    """Format, version, then the tables.

    Raises SceneError for a value that TOML has no word for.
    """
    lines = [f'format = "{FORMAT}"', f"version = {VERSION}"]
    for name, given in tables.items():
        lines += _sections(name, given)
    return "\n".join(lines) + "\n"


def _sections(heading: str, given: Any) -> Iterator[str]:
    """A table, or each of a list of tables, under its heading."""
    if isinstance(given, list):
        for one in given:
            yield from _section(f"[[{heading}]]", heading, one)
    else:
        yield from _section(f"[{heading}]", heading, given)


def _section(title: str, heading: str, table: Mapping[str, Any]) -> Iterator[str]:
    yield from ("", title)
    below = {}
    for key, value in table.items():
        line = f"{_key(key)} = {toml_value(value)}"
        rows = [f"    {toml_value(one)}," for one in value] if _is_tables(value) else []
        if len(line) <= WIDTH or not (rows or isinstance(value, Mapping)):
            yield line
        elif rows and max(map(len, rows)) <= WIDTH:
            yield from (f"{_key(key)} = [", *rows, "]")
        else:
            below[key] = value
    for key, value in below.items():
        yield from _sections(f"{heading}.{_key(key)}", value)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(one, Mapping) for one in value)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else _text(name)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_value(value: Any) -> str:
    """A value as TOML writes it; raises SceneError where it has no word."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return _text(value)
        case int() | float():
            return repr(value)
        case list():
            return f"[{', '.join(map(toml_value, value))}]"
        case Mapping():
            pairs = ", ".join(f"{_key(key)} = {toml_value(one)}" for key, one in value.items())
            return f"{{ {pairs} }}" if pairs else "{}"
    raise SceneError(f"lift: TOML has no word for {value!r}; leave it out")
