"""Scenes with one element changed: elements are immutable, and a changed one takes the place of the old."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Scene, _core

BODY = ("name", "mass", "inertia", "center_of_mass", "position", "quaternion", "velocity", "angular_velocity",
        "gravity")  # fmt: skip
VESSEL = ("name", "body", "added_mass", "linear_damping", "quadratic_damping", "restoring",
          "mooring_stiffness", "mooring_damping", "memory", "kinematics")  # fmt: skip
BLOCK = ("inputs", "outputs", "a", "b", "c", "d", "state_scale")
ACTUATOR = ("name", "joint", "coordinate", "stiffness", "damping", "feed_forward", "reference")


def _changed(kind: Any, names: tuple[str, ...], element: Any, changes: dict[str, Any]) -> Any:
    return kind(**{name: changes.get(name, getattr(element, name)) for name in names})


def change_body(scene: Scene, name: str, **changes: Any) -> None:
    """Replace a body by one with other properties."""
    scene.bodies[name] = _changed(_core.Body, BODY, scene.bodies[name], changes)


def scale_body(scene: Scene, name: str, factor: float) -> None:
    """Multiply mass and inertia."""
    body = scene.bodies[name]
    change_body(scene, name, mass=body.mass * factor, inertia=np.asarray(body.inertia) * factor)


def change_vessel(scene: Scene, name: str, **changes: Any) -> None:
    """Replace a vessel's hydrodynamics by others."""
    scene.vessels[name] = _changed(_core.VesselHydrodynamics, VESSEL, scene.vessels[name], changes)


def change_actuator(scene: Scene, name: str, **changes: Any) -> None:
    """Replace an actuator by another."""
    scene.actuators[name] = _changed(_core.Actuator, ACTUATOR, scene.actuators[name], changes)


def scaled_memory(scene: Scene, name: str, factor: float) -> list[_core.StateSpaceBlock]:
    """The memory blocks of a vessel with their loads multiplied."""
    blocks = scene.vessels[name].memory
    assert isinstance(blocks, list)
    return [
        _changed(_core.StateSpaceBlock, BLOCK, block, {"c": factor * block.c, "d": factor * block.d})
        for block in blocks
    ]
