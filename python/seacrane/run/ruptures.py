"""Hoses that burst in a run, as events."""

from __future__ import annotations

from seacrane.description.description import Description
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.result.events import Event


def ruptures(scene: Description, start: float, now: float) -> list[Event]:
    """Those from a start (s) to before now: a run that goes on from there tells of what bursts then."""
    return [
        Event(time=cylinder.rupture_time, name=f"{name}.rupture", kind="limit")
        for name, cylinder in hydraulic_cylinders(scene).items()
        if cylinder.rupture_area > 0.0 and start <= cylinder.rupture_time < now
    ]
