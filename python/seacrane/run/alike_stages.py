"""What lifts in the same stages share that differ in their seas alone."""

from __future__ import annotations

from dataclasses import dataclass, field

from seacrane import _core
from seacrane.run.run import Run

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
