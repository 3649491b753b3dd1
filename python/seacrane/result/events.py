"""What wires, end stops, seats and stages did during a run, as read-only values and as arrays of a file."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

KINDS = ("contact", "rebound", "release", "slip", "stick", "through", "stage", "connection", "limit")
PREFIX = "event_"
NUMBERS: Mapping[str, tuple[str, str]] = {
    "time": ("s", "when it happened"),
    "speed": ("m/s or rad/s", "rate of approach just before; 0 for a release"),
    "impulse": ("N s or N m s", "along the coordinate, positive as the limit can act"),
    "energy_lost": ("J", "mechanical energy lost in the impact"),
}
TEXTS = ("name", "kind")


@dataclass(frozen=True, kw_only=True)
class Event:
    """A limit or a connection that began or ceased to hold, or a stage that began.

    Attributes
    ----------
    time : float
        s.
    name : str
        The limit's, the connection's or the stage's; ".minimum" or ".maximum" is added where a stop has both,
        the number of the point, such as ".1", to a contact.
    kind : str
        "contact": holds from now on (a wire is taut, a point touches); "rebound": was hit and left at once;
        "release": holds no more (a wire is slack, a seat or a point is lifted off, a stage released a
        connection); "slip", "stick": a point slides from now on, or friction holds it; "through": what has
        left a seat went below its plane again, unhindered; "stage": a stage
        began; "connection": a stage connected an element; "limit": a winch, a compensator, a gas spring
        or a hydraulic cylinder reached one of its bounds, which the name ends with, such as ".stroke", or its
        hose burst (".rupture").
    speed : float
        Rate of approach just before, m/s or rad/s; 0 for a release, a stage or a limit.
    impulse : float
        N s or N m s, as the limit can act: tension of a wire, push of a stop; 0 of stages, connections,
        limits of that kind, and contacts, whose force lasts: `seacrane.answers.contact_hits` adds it up.
    energy_lost : float
        Mechanical energy lost in the impact, or with what a stage connected or released, J.
    """

    time: float
    name: str
    kind: str
    speed: float = 0.0
    impulse: float = 0.0
    energy_lost: float = 0.0


def checked_events(events: Sequence[Event]) -> tuple[Event, ...]:
    """The events as a tuple; ValueError for times that decrease or numbers that are not finite."""
    out = tuple(events)
    for before, event in itertools.pairwise(out):
        if event.time < before.time:
            raise ValueError(f"event {event.name!r} at {event.time} s comes after one at {before.time} s")
    for event in out:
        if not np.isfinite([getattr(event, key) for key in NUMBERS]).all():
            raise ValueError(f"event {event.name!r} at {event.time} s holds a number that is not finite")
        if event.kind not in KINDS:
            raise ValueError(
                f"event {event.name!r} is of kind {event.kind!r}; choose from {', '.join(KINDS)}"
            )
    return out


def event_arrays(events: Sequence[Event]) -> dict[str, np.ndarray[Any, Any]]:
    """Arrays by the names that files have: numbers, then names and kinds."""
    out = {PREFIX + key: np.array([getattr(e, key) for e in events], dtype=np.float64) for key in NUMBERS}
    return out | {PREFIX + key: np.array([getattr(e, key) for e in events], dtype=object) for key in TEXTS}


def events_from_arrays(arrays: Mapping[str, Any]) -> tuple[Event, ...]:
    """What `event_arrays` made; KeyError where one is missing."""
    numbers = {key: np.asarray(arrays[PREFIX + key], dtype=np.float64) for key in NUMBERS}
    texts = {key: [str(text) for text in arrays[PREFIX + key]] for key in TEXTS}
    return tuple(
        Event(name=name, kind=kind, **{key: float(values[i]) for key, values in numbers.items()})
        for i, (name, kind) in enumerate(zip(texts["name"], texts["kind"], strict=True))
    )
