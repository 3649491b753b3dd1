"""Hydraulic cylinders whose oil boiled in a run: a void opened, and held nothing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.warnings import BoilingOilWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description
    from seacrane.result.events import Event

Channels = Mapping[str, NDArray[np.float64]]
Finding = tuple[type[Warning], str]
SIDES = {"vapour": "full", "vapour_rod": "rod"}  # by what its event is called
VOIDS = "hydraulic_void"


def boiled(scene: Description, events: Sequence[Event], channels: Channels) -> Iterator[Finding]:
    """Every chamber that reached its vapour pressure, and how large the void grew where that was recorded."""
    cylinders = hydraulic_cylinders(scene)
    for number, (name, one) in enumerate(cylinders.items()):
        for chamber, (bound, side) in enumerate(SIDES.items()):
            times = [event.time for event in events if event.name == f"{name}.{bound}"]
            if not times:
                continue
            often = f", and {len(times) - 1} time(s) more" if len(times) > 1 else ""
            size = ""
            if VOIDS in channels:
                size = f", of up to {1e3 * channels[VOIDS][:, number, chamber].max():.3g} l"
            yield (
                BoilingOilWarning,
                f"hydraulic cylinder {name!r}: the oil of its {side} side boils at t = {times[0]:.6g} s"
                f"{often}: a void opens{size}, at the vapour pressure of {one.vapour_pressure:.4g} Pa, and "
                "holds no load. Give makeup_flow or a higher tank_pressure, or move slower; refuse_void=True "
                "ends a run here",
            )
