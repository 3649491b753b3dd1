"""Of which channels a run keeps least and largest values between outputs, and what follows from these."""

from __future__ import annotations

from collections.abc import Mapping, Set
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, DERIVED
from seacrane.result.extremes import Extremes
from seacrane.run.channel_names import named_channels

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
USUAL = (
    "vessel_motion", "actuator_force", "driver_force", "hydraulic_force", "tension", "line_tension",
    "end_tension", "section_tension", "gas_spring_tension", "contact_press", "limit_force",
)  # fmt: skip
# Derived channels that rise, or fall, with what they are made of.
MONOTONE = (
    "stroke", "stroke_rate", "cylinder_force", "cylinder_pressure", "slew_torque", "link_tension",
    "hook_load", "slack_margin", "utilisation", "wire_paid_out", "wire_spare",
)  # fmt: skip
POSES = ("position", "quaternion")  # with which the others are taken along


def wanted_extremes(scene: Description, recorded: Set[str], asked: tuple[str, ...] | None) -> set[str]:
    """Those of the core's recorded channels, for the channels that are asked for; None: the usual ones."""
    limited = tuple(state.channel for state in scene.limit_states.values())
    names = (*USUAL, *limited) if asked is None else asked
    made_of = {source for name in names if name in MONOTONE for source in DERIVED[name].made_of}
    wanted = {*names, *(made_of - {*POSES})}
    return {name for name in recorded & wanted if CHANNELS[name].has_extremes}


def derived_extremes(
    scene: Description,
    arrays: Mapping[str, Array],
    extremes: Extremes,
    wanted: Set[str] | Mapping[str, Array],
) -> dict[str, tuple[Array, Array]]:
    """Least and largest values of derived channels, from those of what they rise or fall with."""
    names = [
        name
        for name in MONOTONE
        if name in wanted and any(source in extremes for source in DERIVED[name].made_of)
    ]
    if not names:
        return {}
    known = {name: values for name, values in arrays.items() if name != "time"}
    ends = [
        named_channels(scene, known | {name: both[i] for name, both in extremes.items()}, names)
        for i in (0, 1)
    ]
    values = named_channels(scene, known, names)
    found = {}
    for name in names:
        every = [one[name] for one in (*ends, values) if name in one]
        if len(every) == 3:
            found[name] = (np.min(every, axis=0), np.max(every, axis=0))
    return found
