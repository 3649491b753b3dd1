"""What a result is made of: what it holds of its scene and settings, and its arrays and counters, checked."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.limit_state import LimitState
from seacrane.inputs.checked import is_finite
from seacrane.inputs.file_version import FILE_VERSION, require_file_version

SETTINGS, ABOUT = "settings", "about"  # attributes of files and datasets: JSON
VERSION = "file_version"
Array = NDArray[np.float64]
Stat = str | int | float
ALWAYS_STATED = (
    "seacrane_version", "scene", "formulation", "integrator", "simulated_s", "wall_s", "evaluations", "steps",
    "rejected_steps", "states", "coordinates", "constraints", "degrees_of_freedom", "compiled_coordinates",
    "compiled_constraints",
)  # fmt: skip
SUMS = (
    "simulated_s", "wall_s", "steps", "rejected_steps", "evaluations", "jacobians", "newton_iterations",
    "projections", "restarts", "dense_solves", "events",
)  # fmt: skip


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
    if not np.isfinite(time).all() or np.any(np.diff(time) <= 0):
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
        if isinstance(value, np.generic):
            value = value.item()
        if isinstance(value, bool):
            value = int(value)
        if not isinstance(value, (str, int, float)):
            raise ValueError(f"stat {name!r} is a {type(value).__name__}; give a string or a number")
        if isinstance(value, float) and math.isnan(value):
            raise ValueError(f"stat {name!r} is not a number; leave out what is not defined")
        plain[name] = value
    return plain


def added_stats(before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
    """Stats of two pieces of a run as of one: counters are added, and what either was warned of is told."""
    out = dict(now)
    out |= {key: before.get(key, 0) + now.get(key, 0) for key in SUMS if key in before or key in now}
    for key in ("described", "validity"):
        lines = [line for stats in (before, now) for line in str(stats.get(key, "")).splitlines()]
        if lines:
            out[key] = "\n".join(dict.fromkeys(lines))
    return out
