"""Mutations of small valid files, by their structure: numbers, lines and values, and seldom plain bytes."""

from __future__ import annotations

import json
import random
import re
from typing import Any

NUMBERS = (
    "nan", "inf", "-inf", "NaN", "1e999", "-1e999", "1e308", "-1e308", "1e200", "1e155", "1e30", "1e-30",
    "1e-200", "1e-308", "5e-324", "0", "-0.0", "0.0", "-1", "1", "2", "3", "6", "7", "1.5", "999999999",
    "1000000000", "2147483648", "-2147483649", "4294967297", "9223372036854775808", "1e18", "1D5", "0x10",
    "1_000", "+1", ".", "-", "1e", "--1", "1,5", "9" * 320, "9" * 5000, "1" + "0" * 400 + ".5", "Infinity",
)  # fmt: skip
WORDS = (
    "", " ", "\t", "\x00", "\ufeff", "é", "\ud7ff", "\u2028", "\x85", "\x1c", "~", "null", "true", "false",
    "[]", "{}", "[", "]", "{", "}", '"', "'", ":", ",", "#", "*a", "&a", "!!python/object/apply:os.system",
    "<<", "|", ">", "-", "---", "%", "=", "[[a]]", "[a.b]", "1979-05-27", "\\u0000", "solid", "endsolid",
    "facet",
)  # fmt: skip
LARGEST = 20000  # bytes of a case
DEEP = 3000
TOKEN = re.compile(rb"[^\s,\[\]{}:=]+")
VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 2, 6, 7, 10**6, 10**9, 2**31, 2**63, 10**320, -(10**320), 0.0, -0.0, 1.5,
    1e-320, 1e-200, 1e155, 1e200, 1.7e308, -1e308, "", " ", "nan", "inf", "-inf", "\x00", "\ud800", "é",
    "x" * 300, "a\nb", [], [[]], {}, [None], ["nan"], [1e308, -1e308], {"": None}, {"$infinite": 1},
)  # fmt: skip


def mutate_text(data: bytes, rng: random.Random) -> bytes:
    """Numbers, words and lines replaced, lost, doubled or exchanged."""
    for _ in range(rng.choice((1, 1, 1, 2, 3, 5))):
        data = rng.choices((_token, _line, _bytes), (6, 3, 1))[0](data, rng)
    return data[:LARGEST]


def mutate_json(data: bytes, rng: random.Random) -> bytes:
    """Values of a JSON document replaced, lost, doubled, exchanged or nested."""
    if rng.random() < 0.1:
        return mutate_text(data, rng)
    try:
        document = json.loads(data)
    except (ValueError, RecursionError):
        return mutate_text(data, rng)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 5))):
        document = _value(document, rng)
    try:
        return json.dumps(document).encode()[: 4 * LARGEST]
    except (RecursionError, ValueError):
        return data


def _token(data: bytes, rng: random.Random) -> bytes:
    found = list(TOKEN.finditer(data))
    if not found:
        return data + rng.choice(NUMBERS).encode()
    match = rng.choice(found)
    choice = rng.random()
    if choice < 0.5:
        new = rng.choice(NUMBERS).encode()
    elif choice < 0.65:
        new = rng.choice(WORDS).encode("utf-8")
    elif choice < 0.85:
        new = rng.choice(found).group()
    else:
        digits = bytearray(match.group())
        digits[rng.randrange(len(digits))] = rng.choice(b"0123456789.-+eEnai")
        new = bytes(digits)
    return data[: match.start()] + new + data[match.end() :]


def _line(data: bytes, rng: random.Random) -> bytes:
    lines = data.splitlines(keepends=True) or [b""]
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    operation = rng.randrange(6)
    if operation == 0:
        del lines[i : i + rng.choice((1, 1, 2, 6))]
    elif operation == 1:
        lines.insert(j, lines[i])
    elif operation == 2:
        lines[i], lines[j] = lines[j], lines[i]
    elif operation == 3:
        del lines[i:]
    elif operation == 4:
        lines[i] = (rng.choice(WORDS) + " " + rng.choice(NUMBERS)).encode("utf-8") + b"\n"
    else:
        opening = rng.choice((b"[", b"{", b"- ", b"a: ", b'{"a":', b"a=[", b"a.", b" "))
        lines.insert(i, opening * rng.choice((5, 50, DEEP)) + b"\n")
    return b"".join(lines)


def _bytes(data: bytes, rng: random.Random) -> bytes:
    start = rng.randrange(len(data) + 1)
    end = min(len(data), start + rng.choice((0, 1, 2, 8, 64)))
    new = bytes(rng.randrange(256) for _ in range(rng.choice((0, 1, 2, 4, 8))))
    return data[:start] + new + data[end:]


def _value(document: Any, rng: random.Random) -> Any:
    """One place of the document changed, found by walking down at random."""
    path: list[tuple[Any, Any]] = []
    node = document
    while isinstance(node, dict | list) and node and (not path or rng.random() < 0.85):
        key = rng.choice(list(node)) if isinstance(node, dict) else rng.randrange(len(node))
        path.append((node, key))
        node = node[key]
    if not path:
        return rng.choice(VALUES)
    parent, key = path[-1]
    operation = rng.random()
    if operation < 0.6:
        parent[key] = rng.choice(VALUES)
    elif operation < 0.75:
        del parent[key]
    elif operation < 0.85 and isinstance(parent, list):
        parent.insert(key, rng.choice(parent))
    elif operation < 0.93:
        parent[key] = rng.choice(list(parent.values()) if isinstance(parent, dict) else parent)
    elif isinstance(parent, dict):
        parent[rng.choice((*WORDS, str(key) + "x", *map(str, parent)))] = parent.pop(key)
    else:
        for _ in range(rng.choice((1, 3, 60, 400))):
            parent[key] = [parent[key]]
    return document
