"""From the core's generic channels to the names that results carry."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError

if TYPE_CHECKING:
    from seacrane.description.scene import Scene

Array = NDArray[np.float64]
CYLINDERS = {"main": "main_cylinder", "knuckle": "knuckle_cylinder"}
SLEW = "A"
LINK = "link"
CRANE_CHANNELS = {
    "stroke": ("coordinate",),
    "stroke_rate": ("coordinate_rate",),
    "cylinder_force": ("actuator_force", "driver_force"),
    "slew_angle": ("coordinate",),
    "slew_torque": ("actuator_force", "driver_force"),
    "link_tension": ("tension",),
}


def core_channels(wanted: Sequence[str], known: Sequence[str]) -> set[str]:
    """The core's channels that the wanted ones are made of; raises SceneError for an unknown name."""
    made_of: set[str] = set()
    for name in wanted:
        sources = [source for source in CRANE_CHANNELS.get(name, (name,)) if source in known]
        if not sources:
            possible = [crane for crane, parts in CRANE_CHANNELS.items() if set(parts) & set(known)]
            raise SceneError(
                f"channel {name!r} is unknown to this scene; it offers: {', '.join([*known, *possible])}"
            )
        made_of.update(sources)
    return made_of


def _drive_load(scene: Scene, arrays: dict[str, Array], joint: str, coordinate: str) -> Array | None:
    """Load along a joint coordinate: what its actuators and its driver apply together."""
    actuators = [(actuator.joint, actuator.coordinate) for actuator in scene.actuators.values()]
    drivers = [(driver.joint, driver.coordinate) for driver in scene.drivers.values()]
    loads = [
        arrays[channel][:, i]
        for channel, places in (("actuator_force", actuators), ("driver_force", drivers))
        for i, place in enumerate(places)
        if place == (joint, coordinate) and channel in arrays
    ]
    return sum(loads[1:], loads[0].copy()) if loads else None


def _recorded(scene: Scene, joint: str) -> int | None:
    joints = [recorded for recorded, _ in scene.recorded.values()]
    return joints.index(joint) if joint in joints else None


def payload_of(scene: Scene) -> list[str]:
    """The bodies that hang on links or wires and carry no other by one."""
    hanging = [joint for joint in scene.joints.values() if joint.kind == "distance"]
    carrying = {joint.first for joint in hanging}
    return list(dict.fromkeys(joint.second for joint in hanging if joint.second not in carrying))


def named_channels(scene: Scene, arrays: dict[str, Array]) -> dict[str, Array]:
    """Adds stroke, stroke_rate, cylinder_force, slew_angle, slew_torque and link_tension of a crane."""
    out = dict(arrays)
    cylinders = [joint for joint in CYLINDERS.values() if joint in scene.joints]
    places = [_recorded(scene, joint) for joint in cylinders]
    columns = [place for place in places if place is not None]
    for name, channel in (("stroke", "coordinate"), ("stroke_rate", "coordinate_rate")):
        if cylinders and channel in arrays and len(columns) == len(cylinders):
            out[name] = arrays[channel][:, columns]
    loads = [_drive_load(scene, arrays, joint, "displacement") for joint in cylinders]
    if loads and all(load is not None for load in loads):
        out["cylinder_force"] = np.column_stack([load for load in loads if load is not None])
    slew = _recorded(scene, SLEW)
    if slew is not None and "coordinate" in arrays:
        out["slew_angle"] = np.unwrap(arrays["coordinate"][:, slew])
    torque = _drive_load(scene, arrays, SLEW, "angle") if SLEW in scene.joints else None
    if torque is not None:
        out["slew_torque"] = torque
    links = [name for name, joint in scene.joints.items() if joint.kind == "distance"]
    if LINK in links and "tension" in arrays:
        out["link_tension"] = arrays["tension"][:, links.index(LINK)]
    return {name: np.ascontiguousarray(values) for name, values in out.items()}
