"""The JSON text of a scene file, parsed in bounded memory; what is no such text is refused by name."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from typing import Any

from seacrane.errors import FileFormatError
from seacrane.inputs.json_text import json_of
from seacrane.inputs.looks_like import looks_like
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole

LARGEST_FILE = 32 * 2**20  # bytes


def read_scene_file(path: Path) -> bytes:
    """Its bytes; FileFormatError where it is too large, or plainly something else."""
    data = read_whole(path, LARGEST_FILE, "no scene file is")
    if not re.match(rb"\s*\{", data):
        raise FileFormatError(
            f"{path.name}: is {looks_like(path, data)}, no scene file, which is JSON as Scene.save writes it"
        )
    return data


def parsed(data: bytes, place: str) -> Any:
    """The document in the bytes of a scene file; raises FileFormatError with the line."""
    if len(data) > LARGEST_FILE:
        raise FileFormatError(f"{place}: has {len(data)} bytes, above {LARGEST_FILE}; no scene has")
    return json_of(data, place, object_pairs_hook=_unique, parse_constant=_no_constant)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    out = dict(pairs)
    if len(out) != len(pairs):
        counts = Counter(key for key, _ in pairs)
        twice = next(key for key, count in counts.items() if count > 1)
        raise ValueError(f"key {shown(twice)} occurs twice in one object; remove one")
    return out


def _no_constant(name: str) -> Any:
    raise ValueError(f"{name} is not a number; give a finite one")
