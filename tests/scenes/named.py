"""Scenes that tests of several rooms begin with, as small as they can be.

============ ==========================================================================
`pendulum`   a bob on a pin about y through the origin, let go level
`on_joint`   a body on a joint of the ground: a cart on a rail, a table on a pin
`on_wire`    a load at rest on a wire below the origin
============ ==========================================================================
"""

from __future__ import annotations

from typing import Any

from seacrane import Scene


def pendulum(*, mass: float = 1.0, arm: float = 1.0, inertia: float = 0.1, **settings: Any) -> Scene:
    """Body "bob" on joint "pin"; settings are those of the scene."""
    scene, pin = Scene(**{"name": "pendulum"} | settings), {"point": (0, 0, 0), "axis": (0, 1, 0)}
    scene.add_body("bob", mass=mass, inertia=[inertia] * 3, position=(arm, 0.0, 0.0))
    scene.add_joint("pin", kind="revolute", first="ground", second="bob", **pin)
    return scene


def on_joint(body: str, *, mass: float = 1.0, inertia: float = 1.0, kind: str = "prismatic",
             axis: Any = (1, 0, 0), joint: str = "rail", gravity: float | None = None,
             **state: Any) -> Scene:  # fmt: skip
    """A body at the origin, whose coordinate is recorded; its state by keyword."""
    scene = Scene(name=body) if gravity is None else Scene(name=body, gravity=gravity)
    scene.add_body(body, mass=mass, inertia=[inertia] * 3, **state)
    scene.add_joint(joint, kind=kind, first="ground", second=body, axis=axis)
    scene.add_channel(joint=joint)
    return scene


def on_wire(*, mass: float = 2e4, depth: float = 10.0, **line: Any) -> Scene:
    """Body "load" on line "hoist", which bears its weight at the start unless told otherwise."""
    scene = Scene(name="hoist")
    scene.add_body("load", mass=mass, inertia=[mass] * 3, position=(0.0, 0.0, -depth))
    given = {"EA": 5e7, "tension_at_start": mass * scene.gravity} | line
    scene.add_line("hoist", "ground", "load", **given)
    return scene
