"""Cranes whose joints nothing holds: they fall under their own weight."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seacrane.description.holding import free_drives
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import FreeCraneWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description


def warn_of_free_cranes(scene: Description) -> None:
    """Joints of cranes that neither a driver nor a load acts on; not where C functions may hold them."""
    for roles in scene.roles.values():
        free = [f"{label} (joint {joint!r})" for label, joint, _ in free_drives(scene, roles)]
        if free and not roles.held:
            which = f"crane {roles.prefix!r}" if roles.prefix else "crane"
            warn_caller(
                f"{which}: nothing holds {', '.join(free)}: it falls, or turns as the ship rolls. Leave out "
                "held=False of add_crane, or give each joint a driver (Scene.add_driver) or an actuator "
                "(Scene.add_actuator)",
                FreeCraneWarning,
            )
