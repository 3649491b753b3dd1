"""Loads that come back to the seat they left, and go through it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from seacrane.result.events import Event
from seacrane.warnings import ThroughSeatWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Finding = tuple[type[Warning], str]


def fallen_through(scene: Description, events: Sequence[Event]) -> list[Finding]:
    """Seats that what left them went through, each once."""
    found: list[Finding] = []
    for name in dict.fromkeys(event.name for event in events if event.kind == "through"):
        times = [event.time for event in events if event.kind == "through" and event.name == name]
        load = scene.joints[scene.loads[name].joint].second
        found.append(
            (
                ThroughSeatWarning,
                f"seat {name!r}: {load!r} had left it, and goes below its plane at t = {times[0]:.6g} s"
                f"{f' and {len(times) - 1} more time(s)' if len(times) > 1 else ''}: it would hit the deck "
                "there, and a seat that let go holds nothing, so that loads from then on are too small. Lift "
                "faster or at a better moment, or take the run as failed; see docs/events.md",
            )
        )
    return found
