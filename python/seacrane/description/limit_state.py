"""Where a joint coordinate is meant to stay, and what a recorded channel may reach."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from seacrane.inputs.read_only import ReadOnly


@dataclass(frozen=True, kw_only=True)
class Range:
    """Where a joint coordinate is meant to stay, m or rad, such as a cylinder's stroke."""

    name: str
    joint: str
    coordinate: str
    minimum: float
    maximum: float


@dataclass(frozen=True, kw_only=True)
class LimitState:
    """What a recorded channel may reach; it exerts no load.

    Attributes
    ----------
    maximum, minimum : In the unit of the channel; None where there is no such bound.
    names : Names along the channel's dimensions, such as ``{"cylinder": "main"}``; of a dimension that is not
        named, the worst counts.
    """

    name: str
    channel: str
    maximum: float | None = None
    minimum: float | None = None
    names: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", ReadOnly(self.names))
