"""Utilisation of the limit states of a scene by what a run recorded."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import unit_of
from seacrane.description.limit_state import LimitState
from seacrane.description.pick import Pick
from seacrane.errors import FileFormatError
from seacrane.plotting.table import Rows, Table, Verdict, read_as
from seacrane.result.record import Record


@dataclass(frozen=True, kw_only=True)
class Utilised:
    """How far one limit state was used.

    Attributes
    ----------
    curve : Which of the channel's curves is the worst, by its names; empty where there is one only.
    unit : Of the limit and of what was reached, SI; the table prints kN, kN m, deg, bar.
    limit : The bound that is nearest to being reached.
    reached : Worst value; NaN where the channel was not recorded.
    at : When, s; NaN likewise.
    utilisation : float
        1 at the limit: reached over limit, or limit over reached where the limit is one from below (or, of
        negative values, from above); infinite where such a value has changed its sign. NaN where the channel
        was not recorded.
    """

    name: str
    channel: str
    curve: str
    unit: str
    limit: float
    reached: float
    at: float
    utilisation: float

    @property
    def kept(self) -> bool | None:
        """Whether the limit was kept; None where nothing recorded tells it."""
        return None if math.isnan(self.utilisation) else self.utilisation <= 1.0


@dataclass(frozen=True, repr=False)
class Utilisation(Rows[Utilised]):
    """Every limit state of a scene, in the order in which they were added; prints as a table."""

    @property
    def largest(self) -> float:
        """The largest of all that are known; NaN where none is."""
        known = [state.utilisation for state in self.rows if not math.isnan(state.utilisation)]
        return max(known, default=math.nan)

    def __repr__(self) -> str:
        return f"<Utilisation of {len(self)} limit states: {self.largest:.3g} at most>"

    def _shown(self) -> Table:
        read = [read_as(one.unit) for one in self]
        limits = [factor * one.limit for (factor, _), one in zip(read, self, strict=True)]
        reached = [factor * one.reached for (factor, _), one in zip(read, self, strict=True)]
        told = ["not recorded" if math.isnan(value) else value for value in reached]
        names = [f"{one.name} ({one.curve})" if one.curve else one.name for one in self]
        return Table(
            axes=[self.names("limit_state", head="limit state", read=("", names))],
            columns=[
                self.column("channel", printed=False), self.column("curve", printed=False),
                self.column("limit", read=("", limits)), self.column("reached", read=("", told)),
                self.column("unit", read=("", [unit for _, unit in read])), self.column("at", unit="s"),
                self.column("utilisation", read=("", [_verdict(one) for one in self])),
            ],
            title="Utilisation of limit states, 1 at the limit" if self.rows else "no limit states",
        )  # fmt: skip


def _verdict(one: Utilised) -> Verdict:
    words = {None: "-", True: f"{one.utilisation:.2f}", False: f"{one.utilisation:.2f} exceeded"}
    return Verdict(words[one.kept], one.kept)


def utilisation_of(result: Record) -> Utilisation:
    """Utilisation of the limit states that a run noted; FileFormatError for notes that no run writes."""
    try:
        return Utilisation(tuple(_utilised(state, result) for state in result.about.limit_states))
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        raise FileFormatError(f"the result's limit states are none that a run writes: {error}") from error


def _utilised(state: LimitState, result: Record) -> Utilised:
    channel, where = state.channel, state.names
    known = (("maximum", state.maximum), ("minimum", state.minimum))
    bounds = [(key, float(value)) for key, value in known if value is not None]
    used, at, reached, bound, names = math.nan, math.nan, math.nan, bounds[0][1], list[str]()
    if channel in result.channels:
        least, largest = result.extremes.get(channel, (result.channels[channel],) * 2)
        pick, dims = Pick(channel=channel, names=where), result.dims[channel]
        found = [
            (*_worst(values, kind, bound), bound, [name for dim, name in names.items() if dim not in where])
            for kind, bound in bounds
            for names, values in pick.curves(largest if kind == "maximum" else least, dims, result.coords)
        ]
        used, when, reached, bound, names = max(found, key=lambda one: -1.0 if math.isnan(one[0]) else one[0])
        at = float(result.time[when])
    return Utilised(
        name=state.name, channel=channel, curve=" ".join(names), limit=bound, reached=reached,
        unit=unit_of(channel, (*where.values(), *names)), at=at, utilisation=used,
    )  # fmt: skip


def _worst(values: Array, kind: str, bound: float) -> tuple[float, int, float]:
    """Utilisation, output and value where a curve is nearest to a bound, or farthest beyond."""
    if not np.isfinite(values).any():
        return math.nan, 0, math.nan
    at = int(np.nanargmax(values) if kind == "maximum" else np.nanargmin(values))
    reached = float(values[at])
    if (kind == "maximum") == (bound > 0.0):  # a size that is not to grow beyond it
        return max(reached / bound, 0.0), at, reached
    return bound / reached if reached * bound > 0.0 else math.inf, at, reached
