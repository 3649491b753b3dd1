"""What lifts in the same stages share that differ in their seas alone."""

from __future__ import annotations

from dataclasses import dataclass, field

from seacrane import _core
from seacrane.run.run import Run

MOST_RUNS = 64
Key = tuple[str, float, frozenset[str]]  # a stage, when it began (s), what was absent


@dataclass
class AlikeStages:
    """Found by the first of them, and used by the others; threads may share it.

    Attributes
    ----------
    model : Of the scene before the first stage.
    channels : Names that are known, by what is absent.
    runs : Of stages, at their start.
    """

    model: _core.Model | None = None
    channels: dict[frozenset[str], set[str]] = field(default_factory=dict)
    runs: dict[Key, Run] = field(default_factory=dict)

    @property
    def has_room(self) -> bool:
        """Whether it takes one more: behind an event, a stage begins at its own time in every sea."""
        return len(self.runs) < MOST_RUNS
