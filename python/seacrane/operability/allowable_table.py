"""AllowableHs: the table of allowable wave heights, what governs each cell and how it was found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import STANDARD_GRAVITY
from seacrane.operability.alpha import AlphaFactor
from seacrane.operability.cells import Cells
from seacrane.operability.criterion import Criterion
from seacrane.plotting.answer import Answer, Table
from seacrane.sea.spectra import steepness_limit

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]
MARK = {"frequency": "f", "time": "t"}
LARGEST_GAP = 90.0  # degrees between two directions that are taken as neighbours
ROUNDING = 1e-9  # degrees


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class AllowableHs(Answer):
    """Allowable significant wave heights. Made by `allowable_hs`; prints as a table.

    Attributes
    ----------
    scene : str
        Its name.
    hours : float
        Planned period of the operation, h.
    dataset : xarray.Dataset
        Over `tp` (s) and `direction_deg`: `allowable_hs` (m), NaN where runs failed at the lowest Hs, with
        `low` and `high` of its 95 % interval, and
        `forecast_hs`, which is alpha times `allowable_hs`; `capped`, where no criterion is reached at the
        largest Hs that was examined and `allowable_hs` is that Hs; `governing`, the criterion that is reached
        first; `domain`, "frequency" or "time", and `reason`. `by_criterion` and `difference` (of run and
        linear model, over the allowance) have the dimension `criterion` too. `breaking_hs` is the
        height above which waves of a period break, and `wave_energy_share` what of them lies within the
        database.
    failures : mapping of int to str
        Why runs failed, by their number: periods, directions, Hs, seeds fastest, of the cells by runs.
    """

    scene: str
    criteria: tuple[Criterion, ...]
    alpha: AlphaFactor
    hours: float
    dataset: xarray.Dataset
    failures: Mapping[int, str] = field(default_factory=dict)

    @classmethod
    def of(
        cls,
        scene: str,
        cells: Cells,
        alpha: AlphaFactor,
        hours: float,
        *,
        hs: Sequence[float],
        seeds: Sequence[int],
        duration: float | None,
        linear_within: float,
        failures: Mapping[int, str],
    ) -> AllowableHs:
        """The table of filled cells; without a duration it is of lifts in stages."""
        import xarray

        names = [one.name for one in cells.criteria]
        found, capped = cells.allowable, cells.by_criterion.min(axis=0) > cells.largest
        governing = np.where(capped, "", np.array(names)[cells.by_criterion.argmin(axis=0)])
        low, high = (np.minimum(values.min(axis=0), cells.largest) for values in (cells.low, cells.high))
        two, three = ("tp", "direction_deg"), ("criterion", "tp", "direction_deg")
        metres = {"units": "m"}
        dataset = xarray.Dataset(
            {
                "allowable_hs": (two, found, metres | {"long_name": "allowable significant wave height"}),
                "low": (two, low, metres | {"long_name": "lower end of its 95 % interval"}),
                "high": (two, high, metres | {"long_name": "upper end of its 95 % interval"}),
                "forecast_hs": (
                    two,
                    alpha.at(found, hours=hours) * found,
                    metres | {"long_name": f"allowable in a forecast: {alpha.told(hours=hours)}"},
                ),
                "capped": (two, capped, {"long_name": "no criterion is reached at the largest Hs examined"}),
                "governing": (two, governing.astype(str)),
                "domain": (two, cells.domain.copy()),
                "reason": (two, cells.reason.astype(str)),
                "by_criterion": (three, cells.by_criterion.copy(), metres),
                "difference": (
                    three,
                    cells.difference.copy(),
                    {"units": "1", "long_name": "run against linear model, over the allowance"},
                ),
                "breaking_hs": (
                    "tp",
                    np.array([breaking_height(tp) for tp in cells.tp]),
                    metres | {"long_name": "Hs above which waves of that period break (DNV-RP-C205)"},
                ),
                "wave_energy_share": ("tp", cells.energy_share.copy(), {"units": "1"}),
            },
            {
                "criterion": names,
                "tp": ("tp", np.array(cells.tp), {"units": "s", "long_name": "peak period"}),
                "direction_deg": (
                    "direction_deg",
                    np.array(cells.directions),
                    {"units": "degrees", "long_name": "direction of travel of the waves"},
                ),
            },
            {
                "scene": scene,
                "criteria": "; ".join(one.told(one_lift=duration is None) for one in cells.criteria),
                "alpha_factor": alpha.told(hours=hours),
                "operation_hours": hours,
                "hs_of_runs": list(hs),
                "seeds": list(seeds),
                **({} if duration is None else {"duration": duration}),
                "linear_within": linear_within,
            },
        )
        return cls(
            scene=scene, criteria=cells.criteria, alpha=alpha, hours=hours, dataset=dataset,
            failures=dict(failures),
        )  # fmt: skip

    def at(self, tp: Any, direction_deg: Any = None, *, forecast: bool = False) -> Array:
        """Allowable Hs (m) at peak periods (s) and directions of travel (degrees), linear in between.

        Parameters
        ----------
        tp, direction_deg : array_like, broadcast against each other
            Without directions the worst one of the table counts.
        forecast : bool
            With the alpha factor.

        Returns
        -------
        ndarray
            NaN where the table does not reach.
        """
        values = self.dataset["forecast_hs" if forecast else "allowable_hs"].to_numpy()
        periods = self.dataset["tp"].to_numpy()
        if direction_deg is None:
            return _along(periods, values.min(axis=1), np.asarray(tp, dtype=float))
        asked, turned = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (tp, direction_deg)))
        return over_circle(
            self.dataset["direction_deg"].to_numpy(),
            np.stack([_along(periods, column, asked) for column in values.T]),
            turned,
        )

    def __repr__(self) -> str:
        shape = " x ".join(f"{size} {name}" for name, size in self.dataset["allowable_hs"].sizes.items())
        return f"<AllowableHs of {self.scene!r}: {shape}>"

    def _shown(self) -> Table:
        head, rows = self._cells()
        title = f"{self.scene}: allowable Hs [m] over peak period and direction of travel of the waves"
        return Table(head=head, rows=rows, right=range(len(head)), title=title, remarks=self._words())

    def told_criteria(self) -> list[str]:
        """The criteria in words, each after its letter."""
        one_lift = "duration" not in self.dataset.attrs
        return [
            f"{letter}: {one.told(one_lift=one_lift)}"
            for letter, one in zip(letters(), self.criteria, strict=False)
        ]

    def _words(self) -> list[str]:
        """What the table rests on: criteria, domains, alpha factor."""
        counts = {name: int((self.dataset["domain"] == name).sum()) for name in MARK}
        lines = self.told_criteria()
        lines.append(
            f"f: by the linear model ({counts['frequency']} cells), t: by runs ({counts['time']} cells); "
            ">: reached by no criterion"
        )
        lines.append(f"{self.alpha.told(hours=self.hours)}: not in the table, in forecast_hs")
        if self.failures:
            lines.append(f"{len(self.failures)} runs failed, see failures and reason; failed: not known")
        return lines

    def _cells(self) -> tuple[list[str], list[list[str]]]:
        directions = self.dataset["direction_deg"].to_numpy()
        head = ["Tp [s]", *(f"{one:g} deg" for one in directions)]
        rows = [
            [f"{tp:g}", *(self._cell(i, j) for j in range(directions.size))]
            for i, tp in enumerate(self.dataset["tp"].to_numpy())
        ]
        return head, rows

    def _cell(self, i: int, j: int) -> str:
        cell = self.dataset.isel(tp=i, direction_deg=j)
        value, mark = float(cell["allowable_hs"]), MARK[str(cell["domain"].item())]
        if np.isnan(value):
            return f"failed {mark}"
        if cell["capped"].item():
            return f">{value:.2f} {mark}"
        names = [one.name for one in self.criteria]
        return f"{value:.2f} {letters()[names.index(str(cell['governing'].item()))]}{mark}"


def breaking_height(tp: float) -> float:
    """Hs (m) at the steepness 2 pi Hs / (g Tp^2) above which waves break."""
    return steepness_limit(tp) * STANDARD_GRAVITY * tp**2 / (2.0 * np.pi)


def letters() -> list[str]:
    """By which criteria are told in tables: A to Z, then A0 and so on."""
    return [chr(ord("A") + i) for i in range(26)] + [f"A{i}" for i in range(1000)]


def _along(periods: Array, values: Array, asked: Array) -> Array:
    return np.asarray(np.interp(asked, periods, values, left=np.nan, right=np.nan))


def over_circle(directions: Array, values: Array, asked: Array) -> Array:
    """Values at directions, linear between neighbours.

    Parameters
    ----------
    directions : (k,) Ascending, over less than a circle, degrees.
    values : (k, ...) One for each direction and each of `asked`.
    asked : (...) Degrees; 370 is 10.

    Returns
    -------
    ndarray, shape (...)
        NaN in gaps of more than a right angle.
    """
    first = directions[0]
    turned = first + (asked - first) % 360.0
    turned = np.where(turned > first + 360.0 - ROUNDING, first, turned)
    closed = np.append(directions, first + 360.0)
    below = np.clip(np.searchsorted(closed, turned, side="right") - 1, 0, directions.size - 1)
    width = closed[below + 1] - closed[below]
    share = (turned - closed[below]) / width
    lower, upper = (
        np.take_along_axis(values, (places % directions.size)[None], axis=0)[0]
        for places in (below, below + 1)
    )
    mixed = np.where(share <= ROUNDING, lower, (1.0 - share) * lower + share * upper)
    return np.asarray(np.where((width <= LARGEST_GAP + ROUNDING) | (share <= ROUNDING), mixed, np.nan))
