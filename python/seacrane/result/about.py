"""What a result is made of beside its channels: scene, settings, counters and events, checked."""

from __future__ import annotations

import itertools
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.limit_state import LimitState
from seacrane.errors import SeacraneError
from seacrane.inputs.checked import is_finite
from seacrane.inputs.file_version import FILE_VERSION, require_file_version
from seacrane.scene.file import LARGEST_FILE, described, scene_from_bytes
from seacrane.scene.scene import Scene

SETTINGS, ABOUT = "settings", "about"  # attributes of files and datasets: JSON
VERSION = "file_version"
Stat = str | int | float
PLAIN = (str, int, float)
ALWAYS_STATED = (
    "seacrane_version", "scene", "formulation", "integrator", "simulated_s", "wall_s", "evaluations", "steps",
    "rejected_steps", "states", "coordinates", "constraints", "degrees_of_freedom", "compiled_coordinates",
    "compiled_constraints",
)  # fmt: skip
SUMS = (
    "simulated_s", "wall_s", "steps", "rejected_steps", "evaluations", "jacobians", "newton_iterations",
    "projections", "restarts", "dense_solves", "events",
)  # fmt: skip
NOT_KEPT = "scene_not_kept"  # among the stats of a result: what of the scene its file does not hold, and why
EVENT_KINDS = ("contact", "rebound", "release", "slip", "stick", "through", "stage", "connection", "limit")
PREFIX = "event_"
NUMBERS: Mapping[str, tuple[str, str]] = {
    "time": ("s", "when it happened"),
    "speed": ("m/s or rad/s", "rate of approach just before; 0 for a release"),
    "impulse": ("N s or N m s", "along the coordinate, positive as the limit can act"),
    "energy_lost": ("J", "mechanical energy lost in the impact"),
}
TEXTS = ("name", "kind")


@dataclass(frozen=True, kw_only=True)
class StageSpan:
    """A stage as it was run.

    Attributes
    ----------
    start, end : s.
    ended_by : The condition in words, "duration", or "" where something stopped it.
    """

    name: str
    start: float
    end: float
    ended_by: str


@dataclass(frozen=True, kw_only=True)
class About:
    """What a run notes of its scene and its settings; all of it is plain data.

    Attributes
    ----------
    settings : mapping
        By the words of `simulate`, with what is known of vessels and sea.
    stages : tuple of StageSpan
        Empty: it was one run.
    cranes : sequence of mapping
        Roles of each crane, as a scene file holds them.
    outline, bounds
        As `outline_of` and `bounds_of` make them.
    hung : sequence of mapping
        What hangs, as `hung_notes` tells it.
    hanging_weight : mapping
        Weight on each rod, wire or line, N, and on how many of its falls, by the name in the channels over
        `suspension`.
    """

    settings: Mapping[str, Any] = field(default_factory=dict)
    stages: tuple[StageSpan, ...] = ()
    limit_states: tuple[LimitState, ...] = ()
    cranes: Sequence[Mapping[str, Any]] = ()
    outline: Mapping[str, Any] = field(default_factory=dict)
    bounds: Sequence[Mapping[str, Any]] = ()
    hung: Sequence[Mapping[str, Any]] = ()
    hanging_weight: Mapping[str, Sequence[float]] = field(default_factory=dict)

    def to_attributes(self) -> dict[str, str]:
        """As files hold it; ValueError or TypeError for what no file can hold."""
        rest = {name: value for name, value in vars(self).items() if name != SETTINGS}
        return {VERSION: FILE_VERSION, SETTINGS: _json(self.settings), ABOUT: _json(rest)}


def _json(value: Mapping[str, Any]) -> str:
    return json.dumps(dict(value), default=vars, sort_keys=True, allow_nan=False)


NAMES = tuple(one.name for one in fields(About))


def parted(place: object, attributes: Mapping[str, Any]) -> tuple[dict[str, Any], About]:
    """The stats among a file's attributes, and the rest; ValueError for a rest that no run writes.

    Raises FileFormatError for a file of another version.
    """
    require_file_version(place, attributes.get(VERSION))
    stats = {name: value for name, value in attributes.items() if name not in (VERSION, SETTINGS, ABOUT)}
    try:
        return stats, _made({**json.loads(attributes[ABOUT]), SETTINGS: json.loads(attributes[SETTINGS])})
    except (LookupError, TypeError, ValueError, AttributeError, RecursionError) as error:
        raise ValueError(f"its notes are none that a run writes: {error}") from error


def _made(data: Mapping[str, Any]) -> About:
    given = {name: data[name] for name in NAMES}
    for name, value in given.items():
        kind = dict if isinstance(getattr(About(), name), dict) else list
        if not isinstance(value, kind):
            raise TypeError(f"{name} is a {type(value).__name__}")
        given[name] = value if kind is dict else tuple(value)
    stages = tuple(StageSpan(**one) for one in given.pop("stages"))
    limit_states = tuple(LimitState(**one) for one in given.pop("limit_states"))
    return About(**given, stages=stages, limit_states=limit_states)


def checked_array(name: str, values: Any, shape: tuple[int, ...], gaps: bool) -> Array:
    """The values as a read-only float64 array of the stated shape; `gaps`: some may be no numbers."""
    array = np.asarray(values, dtype=np.float64)
    if array.shape != shape:
        raise ValueError(f"channel {name!r} has shape {array.shape}; its dimensions ask for {shape}")
    if not gaps and not is_finite(array):
        first = int(np.argwhere(~np.isfinite(array.reshape(len(array), -1)).all(axis=1))[0, 0])
        raise ValueError(
            f"channel {name!r} is not finite at output {first} of a finished run; "
            "leave out a channel that is not defined for the scene"
        )
    array.setflags(write=False)
    return array


def checked_time(values: Any) -> Array:
    time = np.asarray(values, dtype=np.float64)
    if time.ndim != 1 or not time.size:
        raise ValueError(f"time has shape {time.shape}; a result needs a vector of at least one output time")
    if not (is_finite(time) and (time[1:] > time[:-1]).all()):
        raise ValueError("time must be finite and strictly increasing")
    time.setflags(write=False)
    return time


def checked_names(dim: str, names: Sequence[str]) -> tuple[str, ...]:
    names = tuple(str(name) for name in names)
    if len(set(names)) != len(names):
        twice = sorted(name for name, count in Counter(names).items() if count > 1)
        raise ValueError(f"{dim} names must differ; given more than once: {', '.join(twice)}")
    return names


def checked_stats(stats: Mapping[str, Any]) -> dict[str, Stat]:
    """Plain strings, integers and floats, none missing that every result states; what is None is left out."""
    plain = plain_stats(stats)
    missing = [name for name in ALWAYS_STATED if name not in plain]
    if missing:
        raise ValueError(f"stats lack {', '.join(missing)}; every result states them")
    return plain


def plain_stats(stats: Mapping[str, Any]) -> dict[str, Stat]:
    """Plain strings, integers and floats; what is None is left out."""
    plain: dict[str, Stat] = {}
    for name, value in stats.items():
        if name in NAMES:
            raise ValueError(f"stats hold numbers and words; give {name!r} in about=About({name}=...)")
        if value is None:
            continue
        if type(value) not in PLAIN:
            value = _plain(name, value)
        if value != value:
            raise ValueError(f"stat {name!r} is not a number; leave out what is not defined")
        plain[name] = value
    return plain


def _plain(name: str, value: Any) -> Stat:
    value = value.item() if isinstance(value, np.generic) else value
    if not isinstance(value, PLAIN):
        raise ValueError(f"stat {name!r} is a {type(value).__name__}; give a string or a number")
    return int(value) if isinstance(value, bool) else value


def added_stats(before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
    """Stats of two pieces of a run as of one: counters are added, and what either was warned of is told."""
    out = dict(now)
    out |= {key: before.get(key, 0) + now.get(key, 0) for key in SUMS if key in before or key in now}
    for key in ("described", "validity"):
        lines = [line for stats in (before, now) for line in str(stats.get(key, "")).splitlines()]
        if lines:
            out[key] = "\n".join(dict.fromkeys(lines))
    return out


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
        if event.kind not in EVENT_KINDS:
            raise ValueError(
                f"event {event.name!r} is of kind {event.kind!r}; choose from {', '.join(EVENT_KINDS)}"
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


class KeptScene:
    """A scene of the process that ran it, or the text that `written` made, found at a place."""

    def __init__(self, scene: Scene | None, text: bytes = b"", place: str = "") -> None:
        self._live, self._text, self._place = scene, text, place

    @property
    def scene(self) -> Scene:
        """The scene, always the same one; FileFormatError where the text is none."""
        if self._live is None:
            self._live = scene_from_bytes(self._text, self._place, Scene())
        return self._live

    def written(self) -> tuple[bytes, str]:
        """The text of a scene file, and in words what it lacks; empty where nothing, or all, is lost."""
        if self._live is None:
            return self._text, ""
        functions = ", ".join(f"function force {name!r}" for name in self._live.function_forces)
        lacks = f"{functions}: a file holds data only" if functions else ""
        try:
            data = described(self._live.copy(notes={}, function_forces={}))
            text = json.dumps(data, allow_nan=False, separators=(",", ":")).encode("ascii")
        except (SeacraneError, ValueError) as error:
            return b"", f"the scene: {error}"
        if len(text) > LARGEST_FILE:
            return b"", f"the scene: takes {len(text)} bytes, above {LARGEST_FILE}"
        return text, lacks
