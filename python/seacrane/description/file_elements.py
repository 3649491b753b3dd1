"""Elements in a scene file: an object with the FIELDS of the core's class, made and read by them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.loads import LOAD_KINDS, kind_of
from seacrane.errors import FileFormatError
from seacrane.inputs.node import Node


def element_to_data(element: Any) -> dict[str, Any]:
    """An element's entries as plain data."""
    return {field.name: _plain(getattr(element, field.name)) for field in type(element).FIELDS}


def element_from_node(kind: type, node: Node, keys: Mapping[str, str] | None = None) -> dict[str, Any]:
    """The arguments of an element from what `element_to_data` wrote.

    `keys`: entries of the file that are named otherwise than the arguments. Raises FileFormatError.
    """
    spelt = keys or {}
    fields = {spelt.get(field.name, field.name): field for field in kind.FIELDS}  # type: ignore[attr-defined]
    node.expect([*fields])
    return {field.name: _value(node.at(key), field) for key, field in fields.items()}


def load_to_data(element: Any) -> dict[str, Any]:
    """A described load as plain data."""
    kind, data = kind_of(element), element_to_data(element)
    if "kind" in data:  # a limit's own
        data[kind] = data.pop("kind")
    return {"kind": kind, **data}


def load_from_node(node: Node) -> Any:
    """What `load_to_data` wrote; raises FileFormatError."""
    name = node.at("kind").text()
    if name not in LOAD_KINDS:
        node.at("kind").fail(f"give one of {', '.join(LOAD_KINDS)}")
    rest = Node({key: value for key, value in node.value.items() if key != "kind"}, node.path)
    arguments = element_from_node(LOAD_KINDS[name], rest, {"kind": name})
    with node.scene_errors():
        return LOAD_KINDS[name](**arguments)


def _plain(value: Any) -> Any:
    if isinstance(value, (str, bool, float)):
        return value
    if isinstance(value, _core.Curve):
        return value.to_pieces()
    if isinstance(value, _core.Frame):
        return element_to_data(value)
    if isinstance(value, _core.RetardationFunctions):
        return {"step": value.step, "kernel": value.kernel.tolist()}
    if isinstance(value, list) and value and isinstance(value[0], _core.StateSpaceBlock):
        return [_block(block) for block in value]
    return np.asarray(value).tolist()


def _value(node: Node, field: _core.Field) -> Any:
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
            return _core.Frame(**element_from_node(_core.Frame, node))
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
    return _core.StateSpaceBlock(
        inputs=inputs,
        outputs=outputs,
        a=node.at("a").array((states, states)),
        b=node.at("b").array((states, len(inputs))),
        c=node.at("c").array((len(outputs), states)),
        d=node.at("d").array((len(outputs), len(inputs))),
        state_scale=node.at("state_scale").array((-1,)),
    )
