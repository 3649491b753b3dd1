"""availability(): the share of the time in which a lift may go ahead, by a scatter diagram of sea states."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, numbers_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.alpha import ascending
from seacrane.operability.hindcast import WaveHindcast
from seacrane.plotting.table import Answer, Column, Table
from seacrane.sea.records.scatter import read_scatter

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ScatterDiagram:
    """Counts or probabilities of sea states, by ranges of Hs and Tp, and of directions where they are known.

    Attributes
    ----------
    hs, tp : array_like, shape (n + 1,), (k + 1,)
        Bounds of the ranges, ascending, m and s.
    counts : array_like, shape (n, k) or (n, k, d)
        None negative, not all zero; their sum is all of the time.
    direction_deg : array_like, shape (d,), optional
        Middle of each range of directions of travel, as of `allowable_hs`, degrees.
    source : str
        Where it is from.

    Raises
    ------
    SceneError
        For ranges or counts that make no sense, or do not fit.
    """

    hs: Any
    tp: Any
    counts: Any
    direction_deg: Any = None
    source: str = ""

    def __post_init__(self) -> None:
        hs, tp = (_bounds(name, getattr(self, name)) for name in ("hs", "tp"))
        shape: tuple[int, ...] = (hs.size - 1, tp.size - 1)
        if self.direction_deg is not None:
            directions = numbers_of("scatter diagram: direction_deg", self.direction_deg)
            if directions.ndim != 1 or not np.all(np.isfinite(directions)):
                raise SceneError(f"scatter diagram: direction_deg is {directions}; give one row of numbers")
            object.__setattr__(self, "direction_deg", directions)
            shape = (*shape, directions.size)
        counts = numbers_of("scatter diagram: counts", self.counts)
        if counts.shape != shape:
            raise SceneError(
                f"scatter diagram: counts have shape {counts.shape}, and the ranges are {shape}; give the "
                "bounds of the ranges, one more than ranges"
            )
        if not np.all(np.isfinite(counts)) or np.any(counts < 0.0):
            place = np.argwhere(~(counts >= 0.0) | ~np.isfinite(counts))[0]
            raise SceneError(
                f"scatter diagram: counts{place.tolist()} is {counts[tuple(place)]}; give zero or more"
            )
        if not counts.sum() > 0.0:
            raise SceneError("scatter diagram: all counts are zero; give how often sea states occur")
        for name, value in (("hs", hs), ("tp", tp), ("counts", counts)):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "source", text_of("scatter diagram: source", self.source or "not told"))

    @property
    def probability(self) -> Array:
        """Share of the time, of the shape of `counts`."""
        return np.asarray(self.counts / self.counts.sum())

    def __repr__(self) -> str:
        shape = " x ".join(map(str, self.counts.shape))
        return f"<ScatterDiagram: {shape} ranges, {self.counts.sum():g} sea states>"

    @classmethod
    def load(
        cls, path: str | os.PathLike[str], *, rows: Literal["hs", "tp"] | None = None,
        units: Mapping[str, str] | None = None, classes: Literal["lower", "middle", "upper"] | None = None,
    ) -> ScatterDiagram:  # fmt: skip
        """Read a scatter table: a text file of classes of Hs in one direction and of Tp in the other.

        Classes are limits such as "0.5-1.0", which meet; sums beside them are left out. Cells are counts or
        percent, and end with a comma, a semicolon or a tab; with one of the latter numbers may have a decimal
        comma.

        Parameters
        ----------
        path : path
        rows : "hs" or "tp", optional
            Whose classes stand in the first column; default: as the corner says, such as "Hs [m] \\ Tp [s]".
        units : mapping of str to str, optional
            Of "hs" and "tp", where the table does not say them.
        classes : "lower", "middle" or "upper", optional
            What one number for each class is, where the table has no limits.

        Raises
        ------
        FileFormatError
            For what is no such table, or does not say what is asked for here; with the line.
        SceneError
            As for arrays.
        """
        file = Path(path)
        return cls(**read_scatter(file, rows=rows, units=units, classes=classes), source=file.name)

    @classmethod
    def of(
        cls, hindcast: WaveHindcast, *, hs: Any, tp: Any, direction_deg: Any = None, heading_deg: float = 0.0
    ) -> ScatterDiagram:
        """Count the sea states of a hindcast.

        Parameters
        ----------
        hs, tp : array_like
            Bounds of the ranges; a value at a bound belongs to the upper range, at the last one to the last.
        direction_deg : array_like, optional
            Directions of travel, to the nearest of which a sea state belongs.
        heading_deg : float
            Compass heading of the vessel's bow.

        Raises
        ------
        SceneError
            Where sea states lie outside the ranges, or directions are not known.
        """
        known = hindcast.known
        bounds = {"hs": _bounds("hs", hs), "tp": _bounds("tp", tp)}
        places = []
        for name, edges in bounds.items():
            values = getattr(hindcast, name)[known]
            if values.size and not (edges[0] <= values.min() and values.max() <= edges[-1]):
                raise SceneError(
                    f"scatter diagram: {name} of the hindcast is {values.min():g} to {values.max():g}, its "
                    f"ranges are {edges[0]:g} to {edges[-1]:g}; give ranges that hold all"
                )
            places.append(np.clip(np.searchsorted(edges, values, side="right") - 1, 0, edges.size - 2))
        shape = [edges.size - 1 for edges in bounds.values()]
        if direction_deg is not None:
            middles = np.atleast_1d(numbers_of("scatter diagram: direction_deg", direction_deg))
            travel = hindcast.travel_deg(heading_deg)[known]
            if not np.all(np.isfinite(travel)):
                raise SceneError("scatter diagram: not all directions of the hindcast are known")
            apart = np.abs((travel[:, None] - middles + 180.0) % 360.0 - 180.0)
            places.append(apart.argmin(axis=1))
            shape.append(middles.size)
        counts = np.zeros(shape)
        np.add.at(counts, tuple(places), 1.0)
        return cls(**bounds, counts=counts, direction_deg=direction_deg, source=hindcast.source)


def _bounds(name: str, given: Any) -> Array:
    values = np.array(ascending(f"scatter diagram: {name}", given, fewest=2))
    if values[0] < 0.0:
        raise SceneError(f"scatter diagram: {name} begins with {values[0]:g}; give zero or more")
    return values


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Availability(Answer):
    """Share of the time in which the lift may go ahead. Made by `availability`; prints as a table.

    Attributes
    ----------
    percent : float
        Of all the time.
    outside_percent : float
        Of all the time, in sea states beyond the table of allowable Hs: they count as not allowed.
    dataset : xarray.Dataset
        Over the ranges, by their middles `hs` (m), `tp` (s) and `direction_deg` where there are any:
        `probability`, and `allowed`, the share of each range below the allowable Hs.
    alpha_factor : str
        Whether the limit is the forecast's, and by which factor.
    source : str
        Of the scatter diagram.
    """

    percent: float
    outside_percent: float
    dataset: xarray.Dataset
    alpha_factor: str
    source: str

    def __repr__(self) -> str:
        return f"<Availability: {self.percent:.1f} %>"

    def _shown(self) -> Table:
        title = (
            f"Availability {self.percent:.1f} % of the time by {self.source}; {self.alpha_factor}; "
            f"{self.outside_percent:.1f} % beyond the table, counted as not allowed"
        )
        weight = self.dataset["probability"]
        others = [dim for dim in weight.dims if dim != "tp"]
        there = weight.sum(others).to_numpy()
        met = there > 0.0
        allowed = (weight * self.dataset["allowed"]).sum(others).to_numpy()[met] / there[met]
        return Table(
            axes=[Column(head="Tp", values=self.dataset["tp"].to_numpy()[met], unit="s", form="g")],
            columns=[
                Column(head="of the time", values=100.0 * there[met], unit="%", form=".1f"),
                Column(head="allowed", values=100.0 * allowed, unit="%", form=".1f"),
            ],
            title=title, data=self.dataset,
        )  # fmt: skip


@named
def availability(allowable: AllowableHs, scatter: ScatterDiagram, *, forecast: bool = True) -> Availability:
    """Find the share of the time in which the lift may go ahead.

    Parameters
    ----------
    scatter : ScatterDiagram
        Within a range sea states are spread evenly over Hs, and have its middle period and direction. Without
        directions the worst of the table counts.
    forecast : bool
        Default: the limit is `forecast_hs`, alpha included. False: `allowable_hs`.

    Raises
    ------
    SceneError
        For something else.
    """
    import xarray

    if not isinstance(allowable, AllowableHs):
        raise SceneError(f"allowable is {shown(allowable)}; give what allowable_hs() returns")
    if not isinstance(scatter, ScatterDiagram):
        raise SceneError(f"scatter is {shown(scatter)}; give a ScatterDiagram")
    with_alpha = flag_of("forecast", forecast)
    middles = {
        name: 0.5 * (edges[1:] + edges[:-1]) for name, edges in (("hs", scatter.hs), ("tp", scatter.tp))
    }
    dims: tuple[str, ...] = ("hs", "tp")
    coords: dict[str, Any] = dict(middles)
    if scatter.direction_deg is None:
        limit = allowable.at(middles["tp"], forecast=with_alpha)
    else:
        limit = allowable.at(middles["tp"][:, None], scatter.direction_deg, forecast=with_alpha)
        dims, coords = (*dims, "direction_deg"), coords | {"direction_deg": scatter.direction_deg}
    shape = (-1,) + (1,) * limit.ndim
    low, high = scatter.hs[:-1].reshape(shape), scatter.hs[1:].reshape(shape)
    allowed = np.clip((np.nan_to_num(limit) - low) / (high - low), 0.0, 1.0)  # none of limits that are NaN
    weight = scatter.probability
    outside = np.broadcast_to(np.isnan(limit), weight.shape)
    return Availability(
        percent=float(100.0 * np.sum(weight * allowed)),
        outside_percent=float(100.0 * weight[outside].sum()),
        dataset=xarray.Dataset({"probability": (dims, weight), "allowed": (dims, allowed)}, coords),
        alpha_factor=allowable.alpha.told(hours=allowable.hours) if with_alpha else "without an alpha factor",
        source=scatter.source,
    )
