"""Where a joint coordinate is meant to stay."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Range:
    """Where a joint coordinate is meant to stay, m or rad, such as a cylinder's stroke."""

    name: str
    joint: str
    coordinate: str
    minimum: float
    maximum: float
