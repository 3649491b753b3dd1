"""The choices that are tried. A new one is a function of a scene, and an entry here."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from seacrane.needs.choice import Choice
from seacrane.needs.drives import (
    held_crane,
    held_oil,
    more_pendulum_damping,
    no_air_drag,
    no_contact,
    no_pendulum_damping,
    no_wind,
    welded_contact,
)
from seacrane.needs.lines import elastic, fewer_segments, quasi_static, rigid, stiff_slings
from seacrane.needs.sea import (
    coarse_table,
    fewer_waves,
    less_memory,
    more_drift,
    more_memory,
    no_coupling,
    no_drift,
)
from seacrane.needs.water_parts import no_strips, no_waves_on_parts, scatter, waves_on_parts
from seacrane.scene.scene import Scene

Tried = Callable[[Scene], Iterator[Choice]]
SIMPLER: tuple[Tried, ...] = (
    stiff_slings,
    quasi_static,
    rigid,
    fewer_segments,
    fewer_waves,
    coarse_table,
    less_memory,
    no_coupling,
    no_drift,
    no_air_drag,
    no_wind,
    no_pendulum_damping,
    no_strips,
    no_waves_on_parts,
    held_oil,
    held_crane,
    welded_contact,
    no_contact,
)
MISSING: tuple[Tried, ...] = (
    more_memory,
    more_drift,
    elastic,
    more_pendulum_damping,
    waves_on_parts,
    scatter,
)


def choices_of(scene: Scene) -> list[Choice]:
    """What may be made simpler in a scene."""
    return [choice for tried in SIMPLER for choice in tried(scene)]


def missing_from(scene: Scene) -> list[Choice]:
    """What a scene leaves out, or knows badly."""
    return [choice for tried in MISSING for choice in tried(scene)]
