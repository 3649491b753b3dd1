"""When the stages of a lift began and ended, and what ended them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class StageSpan:
    """A stage as it was run.

    Attributes
    ----------
    name : str
    start, end : float
        s.
    ended_by : str
        The condition in words, "duration", or "" where something stopped it.
    """

    name: str
    start: float
    end: float
    ended_by: str


def spans_as_text(spans: Sequence[StageSpan]) -> str:
    """As `Result.stats` and files hold them."""
    return json.dumps([asdict(span) for span in spans])


def spans_of(stats: Mapping[str, Any]) -> tuple[StageSpan, ...]:
    """The stages that a result's stats tell of; none: it was one run."""
    return tuple(StageSpan(**span) for span in json.loads(str(stats.get("stages", "[]"))))
