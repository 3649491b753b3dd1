"""availability(): the share of the time in which a lift may go ahead, by a scatter diagram."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.scatter import ScatterDiagram
from seacrane.plotting.table import Answer, Column, Table

if TYPE_CHECKING:
    import xarray

Array = NDArray[np.float64]


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
    allowed = _share_below(scatter.hs, limit)
    weight = scatter.probability
    outside = np.broadcast_to(np.isnan(limit), weight.shape)
    return Availability(
        percent=float(100.0 * np.sum(weight * allowed)),
        outside_percent=float(100.0 * weight[outside].sum()),
        dataset=xarray.Dataset({"probability": (dims, weight), "allowed": (dims, allowed)}, coords),
        alpha_factor=allowable.alpha.told(hours=allowable.hours) if with_alpha else "without an alpha factor",
        source=scatter.source,
    )


def _share_below(edges: Array, limit: Array) -> Array:
    """Share of each range of Hs below the limits (...), shape (n, ...); none of limits that are NaN."""
    shape = (-1,) + (1,) * limit.ndim
    low, high = edges[:-1].reshape(shape), edges[1:].reshape(shape)
    return np.asarray(np.clip((np.nan_to_num(limit) - low) / (high - low), 0.0, 1.0))
