"""What a result holds of its scene and its settings beside numbers and words."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

from seacrane.description.limit_state import LimitState
from seacrane.inputs.file_version import FILE_VERSION, require_file_version

SETTINGS, ABOUT = "settings", "about"  # attributes of files and datasets: JSON
VERSION = "file_version"


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
