"""What came of one member."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from seacrane.ensembles.labelled import Labelled


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a member kept, or why it failed.

    Attributes
    ----------
    kept : mapping of str to Labelled
        Empty where it failed.
    failure : Why it failed; empty where it did not.
    validity : What was out of range in its run, as of a result's stats.
    kept_apart : str
        Why it was stepped by itself where others were to be stepped beside it; empty where it was not.
    """

    index: int
    kept: Mapping[str, Labelled] = field(default_factory=dict)
    failure: str = ""
    validity: str = ""
    kept_apart: str = ""
