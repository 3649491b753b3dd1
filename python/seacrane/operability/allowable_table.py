"""AllowableHs: the table of allowable wave heights, what governs each cell and how it was found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.description import STANDARD_GRAVITY
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of
from seacrane.inputs.described import described
from seacrane.inputs.shown import shown
from seacrane.operability.alpha import AlphaFactor
from seacrane.operability.criterion import Criterion
from seacrane.plotting.panel import COLOURS, new_figure
from seacrane.plotting.table import Answer, Column, Table
from seacrane.sea.spectra import steepness_limit

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

MARK = {"frequency": "f", "time": "t"}
LARGEST_GAP = 90.0  # degrees between two directions that are taken as neighbours
ROUNDING = 1e-9  # degrees
DARK = 0.6  # of the colour scale, above which figures on it are black
STYLES = ("-", "--", ":", "-.")


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
        database. `again_hs` (m) is the lowest Hs of runs above `allowable_hs` at which what governs is kept
        again, or NaN: such a limit is not monotone in Hs. `runs` counts the seeds at each Hs.
    failures : mapping of int to str
        Why runs failed, by their number: seeds, periods, directions, Hs fastest, of all cells.
    """

    scene: str
    criteria: tuple[Criterion, ...]
    alpha: AlphaFactor
    hours: float
    dataset: xarray.Dataset
    failures: Mapping[int, str] = field(default_factory=dict)

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
        tp, directions = (self.dataset[name].to_numpy() for name in ("tp", "direction_deg"))
        heights, domain = (self.dataset[name].to_numpy() for name in ("allowable_hs", "domain"))
        return Table(
            axes=[Column(head="Tp", values=tp, unit="s", form="g")],
            columns=[
                Column(head=f"{one:g} deg", values=heights[:, j],
                       read=("", [self._cell(heights, i, j) + MARK[domain[i, j]] for i in range(tp.size)]))
                for j, one in enumerate(directions)
            ],
            title=f"{self.scene}: allowable Hs [m] over peak period and direction of travel of the waves",
            remarks=self._words(), data=self.dataset,
        )  # fmt: skip

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
        again = int(np.isfinite(self.dataset["again_hs"].to_numpy()).sum())
        if again:
            lines.append(
                f"{again} cells are not monotone in Hs: kept again at again_hs; the first limit counts"
            )
        if self.failures:
            lines.append(f"{len(self.failures)} runs failed, see failures and reason; failed: not known")
        return lines

    def _cell(self, values: Array, i: int, j: int) -> str:
        """A value of the table, then the letter of what governs it."""
        if np.isnan(values[i, j]):
            return "failed "
        governs = str(self.dataset["governing"].to_numpy()[i, j])
        if not governs:
            return f">{values[i, j]:.2f} "
        return f"{values[i, j]:.2f} {letters()[[one.name for one in self.criteria].index(governs)]}"


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

    These ascend (k,) over less than a circle, degrees; values (k, ...) are one for each of them and each of
    `asked` (...), of which 370 is 10. NaN in gaps of more than a right angle.
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


def plot_allowable_hs(table: AllowableHs, *, kind: str = "map", forecast: bool = False) -> Figure:
    """Draw allowable Hs over peak period and direction of travel.

    Parameters
    ----------
    kind : str
        "map" (default): colours and numbers, with the letter of what governs; in a frame where runs told it.
        "rosette": Hs over the direction, a curve for each period, drawn where the waves come from with the
        bow upwards.
    forecast : bool
        With the alpha factor; default without.

    Raises
    ------
    SceneError
        For something else.
    """
    if not isinstance(table, AllowableHs):
        raise SceneError(f"table is {described(table)}; give what allowable_hs() returns")
    if kind not in ("map", "rosette"):
        raise SceneError(f"kind is {shown(kind)}; choose 'map' or 'rosette'")
    with_alpha = flag_of("forecast", forecast)
    figure = new_figure(figsize=(7.2, 5.4), layout="constrained")
    name = "forecast_hs" if with_alpha else "allowable_hs"
    (_map if kind == "map" else _rosette)(figure, table, table.dataset[name].to_numpy())
    what = "allowable Hs in a forecast" if with_alpha else "allowable Hs"
    figure.suptitle(f"{table.scene}: {what}", fontsize=11)
    told, notes = table.alpha.told(hours=table.hours), table.told_criteria()
    if kind == "map":
        notes.append("in a frame: by runs, else by the linear model; >: no criterion is reached")
    notes.append(told if with_alpha else f"{told}: not in these numbers")
    figure.supxlabel("\n".join(notes), fontsize=7, ha="left", x=0.02)
    return figure


def _map(figure: Figure, table: AllowableHs, values: Any) -> None:
    from matplotlib.patches import Rectangle

    axes = figure.subplots()
    image = axes.imshow(values, cmap="viridis", origin="lower", aspect="auto", vmin=0.0)
    figure.colorbar(image, ax=axes, label="Hs [m]")
    data = table.dataset
    tp, directions = (data[name].to_numpy() for name in ("tp", "direction_deg"))
    axes.set_xticks(range(directions.size), [f"{one:g}" for one in directions])
    axes.set_yticks(range(tp.size), [f"{one:g}" for one in tp])
    axes.set(xlabel="direction of travel of the waves [deg], 180: head waves", ylabel="peak period [s]")
    top = max(float(np.max(values, initial=0.0, where=np.isfinite(values))), 1e-9)
    for i in range(tp.size):
        for j in range(directions.size):
            text = table._cell(values, i, j).rstrip()
            colour = "black" if values[i, j] / top > DARK else "white"
            axes.text(j, i, text, ha="center", va="center", fontsize=8, color=colour)
            if data["domain"].to_numpy()[i, j] == "time":
                look: dict[str, Any] = {"fill": False, "edgecolor": COLOURS[1], "linewidth": 1.6}
                axes.add_patch(Rectangle((j - 0.47, i - 0.46), 0.94, 0.92, **look))


def _rosette(figure: Figure, table: AllowableHs, values: Any) -> None:
    axes: Any = figure.add_subplot(projection="polar")
    axes.set_theta_zero_location("S")  # head waves come from the top, where the bow points
    directions = table.dataset["direction_deg"].to_numpy()
    closed = directions[0] + 360.0 - directions[-1] <= 90.0
    angles = np.radians(np.append(directions, directions[0] + 360.0) if closed else directions)
    for k, (tp, row) in enumerate(zip(table.dataset["tp"].to_numpy(), values, strict=True)):
        curve = np.append(row, row[0]) if closed else row
        style = STYLES[k // len(COLOURS) % len(STYLES)]
        axes.plot(
            angles, curve, style, marker="o", markersize=3, color=COLOURS[k % len(COLOURS)], label=f"{tp:g} s"
        )
    axes.set_rlim(0.0, None)
    axes.set_rlabel_position(22.5)
    axes.grid(alpha=0.4)
    figure.legend(title="peak period", loc="outside right upper", fontsize=8, title_fontsize=8)
