"""Cells of a table of allowable Hs by peak period and direction: what is known of each, and how."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.ensembles.targets import WIDENED
from seacrane.operability.allowable_table import AllowableHs, breaking_height
from seacrane.operability.alpha import AlphaFactor
from seacrane.operability.asked import Asked
from seacrane.operability.linear_channels import LinearSeas
from seacrane.operability.time_domain import ByTime
from seacrane.plotting.table import Column, Table

Place = tuple[int, int]  # number of the peak period, and of the direction


class Cells:
    """Cells by peak period and direction, filled step by step; runs are wanted where nothing is known.

    Attributes
    ----------
    by_criterion, low, high : ndarray, shape (criteria, periods, directions)
        Allowable Hs, m, and its 95 % interval; NaN where a cell needed no runs.
    difference : ndarray, shape (criteria, periods, directions)
        Between run and linear model, over the allowance; NaN where it was not tested.
    again : ndarray, shape (criteria, periods, directions)
        Lowest Hs of the runs above the allowable one at which the criterion is kept again, m; or NaN.
    runs : (periods, directions) Seeds at each Hs.
    domain, reason : (periods, directions)
    energy_share : (periods,) Of the waves, within the database.
    """

    def __init__(self, asked: Asked) -> None:
        shape = (len(asked.tp), len(asked.direction_deg))
        all_of = (len(asked.criteria), *shape)
        self.asked = asked
        self.linear: LinearSeas | None = None
        self.by_criterion: Array = np.full(all_of, np.inf)
        self.low, self.high, self.difference, self.again = (np.full(all_of, np.nan) for _ in range(4))
        self.runs = np.zeros(shape, dtype=int)
        self.domain = np.full(shape, "time", dtype="U9")
        self.reason = np.full(shape, "asked for", dtype=object)
        self.energy_share: Array = np.full(shape[0], np.nan)

    @property
    def places(self) -> list[Place]:
        """All cells, directions fastest."""
        return [(i, j) for i in range(len(self.asked.tp)) for j in range(len(self.asked.direction_deg))]

    @property
    def wanted(self) -> list[Place]:
        """Cells of the time domain."""
        return [place for place in self.places if self.domain[place] == "time"]

    def words(self, place: Place) -> dict[str, Any]:
        """The words of the sea of a cell, without its height and seed."""
        return {"tp": self.asked.tp[place[0]], "direction_deg": self.asked.direction_deg[place[1]]}

    @property
    def allowable(self) -> Array:
        """Over all criteria, up to the largest Hs that was examined."""
        return np.asarray(np.minimum(self.by_criterion.min(axis=0), self.asked.hs[-1]))

    def refuse(self, reason: str) -> None:
        """Leave all cells to the time domain."""
        self.reason[:] = reason

    def take_difference(self, place: Place, found: Array | str) -> None:
        """What a probe of a cell brought: the largest of several counts."""
        if isinstance(found, str):
            self.domain[place], self.reason[place] = "time", f"a run failed: {found}"
            return
        here = self.difference[(slice(None), *place)]
        self.difference[(slice(None), *place)] = np.fmax(here, found)
        if self.reason[place].startswith("a run failed"):
            return
        worst = int(np.argmax(self.difference[(slice(None), *place)]))
        share = 100.0 * self.difference[worst, place[0], place[1]]
        name = self.asked.criteria[worst].name
        if share > 100.0 * self.asked.linear_within:
            self.domain[place] = "time"
            self.reason[place] = f"{name}: run and linear model differ by {share:.0f} % of the allowance"
        else:
            self.reason[place] = f"within {share:.1f} % of the allowance ({name})"

    def not_run(self, place: Place) -> None:
        """Nothing is known of a cell until its runs are there."""
        self.by_criterion[(slice(None), *place)] = np.nan

    def take_time(self, place: Place, found: Sequence[ByTime], seeds: int) -> None:
        """Fill a cell by its runs of so many seeds."""
        self.runs[place] = seeds
        for i, one in enumerate(found):
            at = (i, *place)
            self.by_criterion[at], self.low[at], self.high[at] = one.allowable, one.low, one.high
            self.again[at] = one.again
        failed = max((one.failed for one in found), default=0)
        unknown = [one.unknown for one in found if not np.isnan(one.unknown)]
        if unknown and (np.isnan(self.allowable[place]) or self.allowable[place] <= min(unknown)):
            self.reason[place] = f"{failed} runs failed: not known from Hs {min(unknown):g} m on"
        elif failed:
            self.reason[place] = f"{failed} runs failed, and the others count"

    def certain(self, place: Place, share: float, groups: Sequence[Sequence[int]]) -> bool:
        """Whether the half width of the 95 % interval is at most a share, for each group of criteria.

        What no criterion reaches at the largest Hs with certainty is known too.
        """
        for chosen in groups:
            each = (values[list(chosen), *place].min() for values in (self.by_criterion, self.low, self.high))
            found, low, high = (np.minimum(one, self.asked.hs[-1]) for one in each)
            if not WIDENED * (high - low) <= 2.0 * share * found:
                return False
        return True

    def table(
        self, scene: str, alpha: AlphaFactor, hours: float, failures: Mapping[int, str],
        chosen: Sequence[int] | None = None,
    ) -> AllowableHs:  # fmt: skip
        """The table of these cells, filled, by all criteria or chosen ones.

        Without a duration it is of lifts in stages.
        """
        asked = self.asked
        which = list(range(len(asked.criteria))) if chosen is None else list(chosen)
        criteria = tuple(asked.criteria[i] for i in which)
        names = [one.name for one in criteria]
        by_criterion, lows, highs, again, difference = (
            values[which] for values in (self.by_criterion, self.low, self.high, self.again, self.difference)
        )
        least = by_criterion.argmin(axis=0)
        bare = by_criterion.min(axis=0)
        found, capped = np.minimum(bare, asked.hs[-1]), bare > asked.hs[-1]
        governing = np.where(capped, "", np.array(names)[least])
        low, high = (np.minimum(values.min(axis=0), asked.hs[-1]) for values in (lows, highs))
        forecast = alpha.at(found, hours=hours) * found
        cell, period, told = ("tp", "direction_deg"), ("tp",), alpha.told(hours=hours)

        def column(name: str, values: Any, unit: str = "", long_name: str = "", over: Any = cell) -> Column:
            return Column(name=name, values=values, unit=unit, long_name=long_name, over=over)

        axes = [
            Column(name="criterion", values=names),
            Column(name="tp", values=asked.tp, unit="s", long_name="peak period"),
            Column(name="direction_deg", values=asked.direction_deg, unit="degrees",
                   long_name="direction of travel of the waves"),
        ]  # fmt: skip
        columns = [
            column("allowable_hs", found, "m", "allowable significant wave height"),
            column("low", low, "m", "lower end of its 95 % interval"),
            column("high", high, "m", "upper end of its 95 % interval"),
            column("forecast_hs", forecast, "m", f"allowable in a forecast: {told}"),
            column("capped", capped, "", "no criterion is reached at the largest Hs examined"),
            column("governing", governing.astype(str)),
            column("domain", self.domain),
            column("reason", self.reason.astype(str)),
            column("by_criterion", by_criterion, "m", over=None),
            column("again_hs", np.take_along_axis(again, least[None], axis=0)[0], "m",
                   "Hs of runs above the allowable one at which what governs is kept again"),
            column("runs", self.runs, "", "seeds of the runs at each Hs"),
            column("difference", difference, "1", "run against linear model, over the allowance", None),
            column("breaking_hs", [breaking_height(tp) for tp in asked.tp], "m",
                   "Hs above which waves of that period break (DNV-RP-C205)", period),
            column("wave_energy_share", self.energy_share, "1", over=period),
        ]  # fmt: skip
        attributes = {
            "scene": scene,
            "criteria": "; ".join(one.told(one_lift=asked.duration is None) for one in criteria),
            "alpha_factor": told,
            "operation_hours": hours,
            "hs_of_runs": list(asked.hs),
            "seeds": list(asked.seeds),
            **({} if asked.duration is None else {"duration": asked.duration}),
            "linear_within": asked.linear_within,
        }
        return AllowableHs(
            scene=scene, criteria=criteria, alpha=alpha, hours=hours, failures=dict(failures),
            dataset=Table(axes=axes, columns=columns, attributes=attributes).to_xarray(),
        )  # fmt: skip
