"""What is described as plain data and back, by its fields and their types; notes as they are.

A dataclass, and an element of the core, is an object of its fields; a mapping an object, a sequence a list,
numbers that are complex an object of two lists. Infinities, for which JSON has no word, are objects too.
"""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.node import Node

INFINITE = "$infinite"  # its value is the sign
COMPLEX = ("real", "imaginary")
DERIVED = {"derived": True}  # metadata of a field that follows from the others, and is in no file


def plain_data(what: str, value: Any) -> Any:
    """A value as JSON data; SceneError for what is none, which names its place."""
    if isinstance(value, (np.generic, np.ndarray)):
        return _plain_array(what, value)
    if isinstance(value, float) and math.isinf(value):
        return {INFINITE: int(math.copysign(1, value))}
    if isinstance(value, float) and math.isnan(value):
        raise SceneError(f"{what} is not a number; leave it out")
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, os.PathLike):
        return plain_data(what, os.fspath(value))
    if isinstance(value, Mapping):
        return {str(key): plain_data(f"{what}[{key!r}]", item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray)):
        return [plain_data(f"{what}[{i}]", item) for i, item in enumerate(value)]
    if is_dataclass(value) and not isinstance(value, type):
        plain = {}
        for key, kind in field_types(type(value)).items():
            own = getattr(value, key)
            if type(own) is int and float in (kind, *get_args(kind)):
                own = float(own)  # so that equal descriptions are equal data
            plain[key] = plain_data(f"{what}.{key}", own)
        return plain
    if hasattr(value, "FIELDS"):
        return {field.name: _plain_entry(getattr(value, field.name)) for field in value.FIELDS}
    raise SceneError(f"{what} is a {type(value).__name__}; notes are numbers, texts, lists and mappings")


def _plain_array(what: str, value: NDArray[Any] | np.generic) -> Any:
    if np.iscomplexobj(value):
        return {
            part: _plain_array(what, numbers)
            for part, numbers in zip(COMPLEX, (value.real, value.imag), strict=True)
        }
    listed = value.tolist()
    return listed if value.dtype.kind in "iuf" and np.isfinite(value).all() else plain_data(what, listed)


def _plain_entry(value: Any) -> Any:
    """An entry of an element of the core, whose numbers the core has checked or will."""
    if isinstance(value, (str, bool, float)):
        return value
    if isinstance(value, _core.Curve):
        return value.to_pieces()
    if isinstance(value, _core.Frame):
        return plain_data("frame", value)
    if isinstance(value, _core.RetardationFunctions):
        return {"step": value.step, "kernel": value.kernel.tolist()}
    if isinstance(value, list) and value and isinstance(value[0], _core.StateSpaceBlock):
        return [_block(block) for block in value]
    return np.asarray(value).tolist()


@cache
def field_types(kind: type) -> dict[str, Any]:
    """The fields of a dataclass that a file holds, and their types."""
    types = get_type_hints(kind)
    return {one.name: types[one.name] for one in fields(kind) if not one.metadata.get("derived")}


def arguments(kind: type, node: Node) -> dict[str, Any]:
    """The fields of a dataclass or of an element of the core from its object; raises FileFormatError."""
    if is_dataclass(kind):
        types = field_types(kind)
        node.expect([*types])
        return {name: value_of(node.at(name), one) for name, one in types.items()}
    entries = {field.name: field for field in kind.FIELDS}  # type: ignore[attr-defined]
    node.expect([*entries])
    return {name: _entry(node.at(name), field) for name, field in entries.items()}


def value_of(node: Node, kind: Any) -> Any:
    """A value of a type; FileFormatError, with its place, where it is none."""
    inner = get_args(kind)
    if get_origin(kind) in (Union, UnionType) and NoneType in inner and len(inner) == 2:
        return (
            None if node.value is None else value_of(node, next(one for one in inner if one is not NoneType))
        )
    reader = {str: Node.text, bool: Node.flag, int: _whole, float: _number}.get(kind)
    if reader is not None:
        return reader(node)
    if get_origin(kind) is tuple:
        items = [*node.items()]
        if inner[-1] is Ellipsis:
            return tuple(value_of(one, inner[0]) for one in items)
        if len(items) != len(inner):
            raise FileFormatError(f"{node.path}: has {len(items)} entries; give {len(inner)}")
        return tuple(value_of(one, each) for one, each in zip(items, inner, strict=True))
    if get_origin(kind) is Mapping:
        if not isinstance(node.value, dict):
            node.fail("give an object")
        return {key: value_of(node.at(key), inner[1]) for key in node.value}
    if isinstance(kind, type) and is_dataclass(kind):
        given = arguments(kind, node)
        with node.scene_errors():
            return kind(**given)
    return _restored_at(node) if kind is Any else _array(node)


def _whole(node: Node) -> int:
    if type(node.value) is not int:
        node.fail("give a whole number")
    return int(node.value)


def _number(node: Node) -> float:
    value = _restored(node.value) if isinstance(node.value, dict) else node.value
    return value if isinstance(value, float) and math.isinf(value) else node.number()


def _array(node: Node) -> NDArray[Any]:
    if isinstance(node.value, dict):
        node.expect(COMPLEX)
        real, imaginary = (_array(node.at(part)) for part in COMPLEX)
        if real.shape != imaginary.shape:
            raise FileFormatError(f"{node.path}: real has shape {real.shape}, imaginary {imaginary.shape}")
        out = np.empty(real.shape, dtype=complex)  # without arithmetic, which would lose the sign of a zero
        out.real, out.imag = real, imaginary
        return out
    depth, inner = 1, node.values()
    while inner and isinstance(inner[0], list):
        depth, inner = depth + 1, inner[0]
    return node.array((-1,) * depth)


def _entry(node: Node, field: _core.Field) -> Any:
    match field.type:
        case "text":
            return node.text()
        case "texts":
            return [item.text() for item in node.items()]
        case "number":
            return node.number()
        case "flag":
            return node.flag()
        case "array":
            return node.array(field.shape)
        case "curve":
            return node.curve()
        case "frame":
            return _core.Frame(**arguments(_core.Frame, node))
        case "object":
            return _memory_back(node)
    raise FileFormatError(f"{node.path}: a file holds no {field.type}; add it in a script")


def _block(block: _core.StateSpaceBlock) -> dict[str, Any]:
    matrices = {key: getattr(block, key).tolist() for key in ("a", "b", "c", "d", "state_scale")}
    return {"inputs": list(block.inputs), "outputs": list(block.outputs), **matrices}


def _memory_back(node: Node) -> list[_core.StateSpaceBlock] | _core.RetardationFunctions:
    if not isinstance(node.value, dict):
        return [_block_back(block) for block in node.items()]
    node.expect(("step", "kernel"))
    step, kernel = node.at("step").number(), node.at("kernel").array((-1, 6, 6))
    return _core.RetardationFunctions(step=step, kernel=kernel)


def _block_back(node: Node) -> _core.StateSpaceBlock:
    node.expect(("inputs", "outputs", "a", "b", "c", "d", "state_scale"))
    inputs = [item.whole() for item in node.at("inputs").items()]
    outputs = [item.whole() for item in node.at("outputs").items()]
    states = len(node.at("a").values())
    shapes = {
        "a": (states, states), "b": (states, len(inputs)), "c": (len(outputs), states),
        "d": (len(outputs), len(inputs)), "state_scale": (-1,),
    }  # fmt: skip
    matrices: dict[str, Any] = {key: node.at(key).array(shape) for key, shape in shapes.items()}
    return _core.StateSpaceBlock(inputs=inputs, outputs=outputs, **matrices)


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
    for key in node.value:
        node.value[key] = _restored_at(node.at(key))
    return node.value


def _restored_at(node: Node) -> Any:
    try:
        return _restored(node.value)
    except RecursionError as error:
        raise FileFormatError(f"{node.path}: is nested too deeply") from error


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
