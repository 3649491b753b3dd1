"""Notes of a scene as JSON data and back."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.node import Node

INFINITE = "$infinite"  # its value is the sign


def plain_data(what: str, value: Any) -> Any:
    """Notes as JSON data; infinities, for which JSON has no word, as objects."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, float) and math.isinf(value):
        return {INFINITE: int(math.copysign(1, value))}
    if isinstance(value, float) and math.isnan(value):
        raise SceneError(f"{what} is not a number; leave it out")
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, Mapping):
        return {str(key): plain_data(f"{what}[{key!r}]", item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return [plain_data(f"{what}[{i}]", item) for i, item in enumerate(value)]
    raise SceneError(f"{what} is a {type(value).__name__}; notes are numbers, texts, lists and mappings")


def plain_notes(scene: str, notes: Mapping[str, Any]) -> dict[str, Any]:
    """The notes of a scene as JSON data; raises SceneError for what is none."""
    try:
        return {key: plain_data(f"scene {scene!r}: notes[{key!r}]", value) for key, value in notes.items()}
    except RecursionError as error:
        raise SceneError(f"scene {scene!r}: its notes contain themselves; give plain data") from error


def notes_from_node(node: Node) -> dict[str, Any]:
    """What `plain_data` made of the notes, in the parsed document itself; raises FileFormatError."""
    if not isinstance(node.value, dict):
        node.fail("give an object")
    try:
        for key, value in node.value.items():
            node.value[key] = _restored(value)
    except RecursionError as error:
        raise FileFormatError(f"{node.path}: is nested too deeply") from error
    return node.value


def _restored(value: Any) -> Any:
    """The value with infinities in place of their objects; a copy would take as much memory again."""
    if isinstance(value, dict):
        if value.keys() == {INFINITE} and value[INFINITE] in (1, -1):
            return math.copysign(math.inf, value[INFINITE])
        for key, item in value.items():
            value[key] = _restored(item)
    elif isinstance(value, list):
        for i, item in enumerate(value):
            value[i] = _restored(item)
    return value
