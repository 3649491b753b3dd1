"""The one table of loads that are the same in Python, in a scene file and in the core.

A new kind of load is its C++ file with an entry in `loads/registry.hpp`, a binding, and an entry here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.files.node import Node


@dataclass(frozen=True, kw_only=True)
class LoadKind:
    """A class of the core and the kinds of its arguments; all have a name."""

    type: type
    texts: tuple[str, ...] = ("body",)
    numbers: tuple[str, ...] = ()
    curves: tuple[str, ...] = ()
    arrays: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    @property
    def keys(self) -> tuple[str, ...]:
        """All entries of an element in a scene file."""
        return ("kind", "name", *self.texts, *self.numbers, *self.curves, *self.arrays)


LOAD_KINDS = {
    "flow force": LoadKind(
        type=_core.FlowForce,
        numbers=("density", "direction", "frontal_area", "lateral_area", "length"),
        curves=("speed",),
        arrays={"point": (3,), "angles": (-1,), "coefficients": (-1, 3)},
    ),
    "limit": LoadKind(
        type=_core.Limit,
        texts=("limit", "joint", "coordinate"),
        numbers=("minimum", "maximum", "restitution", "sticking_speed"),
    ),
    "friction": LoadKind(type=_core.Friction, texts=("joint", "coordinate"), numbers=("load", "speed")),
    "soft stop": LoadKind(
        type=_core.SoftStop,
        texts=("joint", "coordinate"),
        numbers=("minimum", "maximum", "stiffness", "damping"),
    ),
}
RENAMED = {"limit": "kind"}  # entries of a scene file by the arguments of the class


def kind_of(element: Any) -> str:
    """The kind of a described load; raises SceneError for anything else."""
    for name, kind in LOAD_KINDS.items():
        if isinstance(element, kind.type):
            return name
    known = ", ".join(kind.type.__name__ for kind in LOAD_KINDS.values())
    raise SceneError(f"load {element!r} is of no known kind; give one of {known}")


def load_to_data(element: Any) -> dict[str, Any]:
    """A described load as plain data."""
    name = kind_of(element)
    kind = LOAD_KINDS[name]
    out: dict[str, Any] = {"kind": name, "name": element.name}
    out |= {key: getattr(element, RENAMED.get(key, key)) for key in kind.texts}
    out |= {key: getattr(element, key) for key in kind.numbers}
    out |= {key: getattr(element, key).to_pieces() for key in kind.curves}
    return out | {key: np.asarray(getattr(element, key)).tolist() for key in kind.arrays}


def load_from_node(node: Node) -> Any:
    """What `load_to_data` wrote; raises FileFormatError."""
    name = node.at("kind").text()
    if name not in LOAD_KINDS:
        node.at("kind").fail(f"give one of {', '.join(LOAD_KINDS)}")
    kind = LOAD_KINDS[name]
    node.expect(kind.keys)
    arguments: dict[str, Any] = {RENAMED.get(key, key): node.at(key).text() for key in ("name", *kind.texts)}
    arguments |= {key: node.at(key).number() for key in kind.numbers}
    arguments |= {key: node.at(key).curve() for key in kind.curves}
    arguments |= {key: node.at(key).array(shape) for key, shape in kind.arrays.items()}
    with node.scene_errors():
        return kind.type(**arguments)
