"""What is known of each cell of a table of allowable Hs while it is made."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.operability.asked import Asked
from seacrane.operability.linear_channels import LinearSeas
from seacrane.operability.time_domain import ByTime

Array = NDArray[np.float64]
Place = tuple[int, int]  # number of the peak period, and of the direction


class Cells:
    """Cells by peak period and direction, filled step by step; runs are wanted where nothing is known.

    Attributes
    ----------
    by_criterion, low, high : ndarray, shape (criteria, periods, directions)
        Allowable Hs, m, and its 95 % interval; NaN where a cell needed no runs.
    difference : ndarray, shape (criteria, periods, directions)
        Between run and linear model, over the allowance; NaN where it was not tested.
    domain, reason : (periods, directions)
    energy_share : (periods,) Of the waves, within the database.
    """

    def __init__(self, asked: Asked) -> None:
        shape = (len(asked.tp), len(asked.direction_deg))
        all_of = (len(asked.criteria), *shape)
        self.asked = asked
        self.linear: LinearSeas | None = None
        self.by_criterion: Array = np.full(all_of, np.inf)
        self.low, self.high, self.difference = (np.full(all_of, np.nan) for _ in range(3))
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

    def take_linear(self, period: int, direction: int, allowable: Array) -> None:
        """Fill a cell by its linear model."""
        self.by_criterion[:, period, direction] = allowable
        self.domain[period, direction] = "frequency"
        at_rest = allowable.min() <= 0.0
        self.reason[period, direction] = "a bound is exceeded at rest" if at_rest else "not tested"

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

    def take_time(self, place: Place, found: Sequence[ByTime]) -> None:
        """Fill a cell by its runs."""
        for i, one in enumerate(found):
            at = (i, *place)
            self.by_criterion[at], self.low[at], self.high[at] = one.allowable, one.low, one.high
        failed = max((one.failed for one in found), default=0)
        unknown = [one.unknown for one in found if not np.isnan(one.unknown)]
        if unknown and (np.isnan(self.allowable[place]) or self.allowable[place] <= min(unknown)):
            self.reason[place] = f"{failed} runs failed: not known from Hs {min(unknown):g} m on"
        elif failed:
            self.reason[place] = f"{failed} runs failed, and the others count"
