"""Cranes whose joints nothing holds: they fall under their own weight."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import LOAD_KINDS, named, springs_of
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import FreeCraneWarning

if TYPE_CHECKING:
    from seacrane.description.scene import Description

PASSIVE = ("limit", "friction", "soft stop")  # loads that name a joint and do not hold it where it is


def warn_of_free_cranes(scene: Description) -> None:
    """Joints of cranes that neither a driver nor a load acts on; not where C functions may hold them."""
    if scene.function_forces:
        return
    for roles in scene.roles.values():
        parts = {label: joint for label, joint in roles.cylinders.items() if joint in scene.joints}
        ropes = {label: rope.name for label, rope in roles.ropes.items()}
        parts |= {
            label: joint
            for label, (joint, _) in roles.luffs.items()
            if joint in scene.joints and ropes.get(label) not in scene.loads
        }
        if roles.slew is not None and roles.slew[0] in scene.joints:
            parts = {"slew drive": roles.slew[0]} | parts
        free = [f"{label} (joint {joint!r})" for label, joint in parts.items() if not _held(scene, joint)]
        if free:
            which = f"crane {roles.prefix!r}" if roles.prefix else "crane"
            warn_caller(
                f"{which}: nothing holds {', '.join(free)}: it falls, or turns as the ship rolls. Give "
                "add_crane(held=True), or each joint a driver (Scene.add_driver) or an actuator "
                "(Scene.add_actuator)",
                FreeCraneWarning,
            )


def _held(scene: Description, joint: str) -> bool:
    """By a driver, an actuator or another load on the joint, or a spring or hydraulic cylinder between its
    two bodies."""
    passive = tuple(LOAD_KINDS[kind] for kind in PASSIVE)
    ends = {scene.joints[joint].first, scene.joints[joint].second}
    springs = springs_of(scene.springs, scene.loads)
    return (
        any(driver.joint == joint for driver in scene.drivers.values())
        or any(joint in named(one, "joint") for one in scene.all_loads() if not isinstance(one, passive))
        or any({spring.first, spring.second} == ends for _, spring in springs)
        or any({one.first, one.second} == ends for one in hydraulic_cylinders(scene).values())
    )
