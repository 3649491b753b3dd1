"""Names along the dimensions of a result's channels."""

from __future__ import annotations

from typing import TypedDict

from seacrane import _core
from seacrane.description.scene import Scene
from seacrane.run.channel_names import CYLINDERS


class CoordinateNames(TypedDict):
    """Arguments of `Result.from_arrays`."""

    bodies: list[str]
    joints: list[str]
    cylinders: list[str]
    coordinates: list[str]
    actuators: list[str]
    drivers: list[str]
    links: list[str]
    limits: list[str]
    vessels: list[str]


def coordinate_names(scene: Scene, model: _core.Model) -> CoordinateNames:
    """Names of a scene's elements, in the order of the arrays."""
    return {
        "bodies": list(scene.bodies),
        "joints": list(scene.joints),
        "cylinders": [role for role, joint in CYLINDERS.items() if joint in scene.joints],
        "coordinates": list(scene.recorded),
        "actuators": list(scene.actuators),
        "drivers": list(scene.drivers),
        "links": [name for name, joint in scene.joints.items() if joint.kind == "distance"],
        "limits": [name for name, _ in model.limits],
        "vessels": list(scene.vessels),
    }
