"""Of which channels a run keeps least and largest values between outputs, and what follows from these."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Set

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, DERIVED
from seacrane.description.description import Description
from seacrane.description.places import POSE
from seacrane.result.record import Extremes
from seacrane.run.channel_names import sources_of, with_sources
from seacrane.run.derived import named_channels

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


def _limited(scene: Description) -> tuple[str, ...]:
    return tuple(state.channel for state in scene.limit_states.values())


def wanted_extremes(scene: Description, recorded: Set[str], asked: tuple[str, ...] | None) -> set[str]:
    """Those of the core's recorded channels, for the channels that are asked for; None: the usual ones."""
    names = (*USUAL, *_limited(scene)) if asked is None else asked
    made_of = {source for name in names if name in MONOTONE for source in sources_of(name)}
    wanted = {*names, *made_of.difference(POSE)}
    return {name for name in recorded & wanted if CHANNELS[name].has_extremes}


def followed(scene: Description, recorded: Set[str], asked: tuple[str, ...] | None) -> dict[str, set[str]]:
    """Derived channels that are made anew at every step: of what recorded channels."""
    names = _limited(scene) if asked is None else asked
    found = {}
    for name in names:
        if name not in DERIVED or name in MONOTONE or DERIVED[name].turns:
            continue
        made_of = {source for part in with_sources(scene, [name]) for source in sources_of(part)}
        found[name] = made_of & recorded
    return found


def followed_extremes(
    trail: Mapping[str, Array],
    outputs: Mapping[str, Array],
    made_of: Mapping[str, set[str]],
    named: Callable[[Mapping[str, Array], set[str]], Mapping[str, Array]],
) -> dict[str, tuple[Array, Array]]:
    """Least and largest values of derived channels, from what the core kept of every step (`trail`).

    `named` makes channels of those of the core; `made_of` is that of `followed`.
    """
    names = {
        name for name, sources in made_of.items() if name in outputs and sources and sources <= trail.keys()
    }
    if not names:
        return {}
    at = np.searchsorted(outputs["time"], trail["time"])
    seen = at < len(outputs["time"])
    found = {}
    for name, values in named(trail, names).items():
        if name in names:
            least, largest = outputs[name].copy(), outputs[name].copy()
            np.fmin.at(least, at[seen], values[seen])
            np.fmax.at(largest, at[seen], values[seen])
            found[name] = least, largest
    return found


def derived_extremes(
    scene: Description,
    arrays: Mapping[str, Array],
    extremes: Extremes,
    wanted: Set[str] | Mapping[str, Array],
) -> dict[str, tuple[Array, Array]]:
    """Least and largest values of derived channels, from those of what they rise or fall with."""
    names = [one for one in MONOTONE if one in wanted and any(part in extremes for part in sources_of(one))]
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
