"""What the [sheet] of a lift says: phases, criteria and seas, and what it is held against."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from seacrane.errors import SceneError
from seacrane.lift.build import refused_at
from seacrane.lift.calls import keywords, require_unit_of_channel
from seacrane.lift.check_keys import Entry, plain
from seacrane.lift.sheet_keys import ALPHA, CRITERION, FORECAST, HINDCAST, PHASE, SCATTER, SHEET
from seacrane.operability.alpha import AlphaFactor
from seacrane.operability.criterion import Criterion
from seacrane.operability.phase import Phase

BESIDE = ("phase", "criterion", "alpha", "cases", "forecast", "hindcast", "scatter", "seeds")


@dataclass(frozen=True, kw_only=True)
class Sheet:
    """What a [sheet] says.

    Attributes
    ----------
    phases, criteria, given : As `phase_sheet` takes them, but the scenes of phases.
    lifts : Of phases that have a lift of their own, its path by their name.
    cases : Values of load cases by key of the lift.
    forecast, hindcast, scatter : A file of sea states, and how it is looked at; empty: none.
    """

    phases: tuple[Phase, ...]
    criteria: tuple[Criterion, ...]
    given: Mapping[str, Any]
    lifts: Mapping[str, str] = field(default_factory=dict)
    cases: Mapping[str, Any] = field(default_factory=dict)
    forecast: Mapping[str, Any] = field(default_factory=dict)
    hindcast: Mapping[str, Any] = field(default_factory=dict)
    scatter: Mapping[str, Any] = field(default_factory=dict)
    entry: Entry = field(repr=False, compare=False)


def sheet_of(entry: Entry) -> Sheet:
    """The sheet of its table; FileFormatError with the line of what is wrong in it."""
    values = entry.values
    given = keywords([key for key in SHEET if key.name not in BESIDE], values)
    phases, criteria = [], []
    lifts: dict[str, str] = {}
    for place, table in enumerate(values["phase"]):
        with refused_at(entry, "phase", place):
            own = keywords(PHASE, table)
            path = own.pop("lift", None)
            if path is not None and own.get("passage"):
                raise SceneError("lift is of stationary phases; a passage has the stages of this lift")
            phases.append(Phase(**own))
            lifts |= {} if path is None else {phases[-1].name: path}
    for place, table in enumerate(values["criterion"]):
        with refused_at(entry, "criterion", place):
            one = Criterion(**keywords(CRITERION, plain(table)))
            require_unit_of_channel(CRITERION, table, one.channel, one.names)
            criteria.append(one)
    if "alpha" in values:
        with refused_at(entry, "alpha"):
            given["alpha"] = AlphaFactor(**keywords(ALPHA, values["alpha"]))
    if "seeds" in values:
        given["seeds"] = range(1, 1 + values["seeds"])
    return Sheet(
        phases=tuple(phases), criteria=tuple(criteria), given=given, lifts=lifts,
        cases=values.get("cases", {}), entry=entry,
        forecast=keywords(FORECAST, values.get("forecast", {})),
        hindcast=keywords(HINDCAST, values.get("hindcast", {})),
        scatter=keywords(SCATTER, values.get("scatter", {})),
    )  # fmt: skip
