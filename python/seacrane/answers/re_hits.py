"""Re-hits: contact again after all feet were free by a margin, and how probable that is over seeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.plotting.table import Answer, Column, Table
from seacrane.result import Result
from seacrane.statistics.estimate import CONFIDENCE, Estimate

if TYPE_CHECKING:
    import xarray

CHANNELS = ("contact_least_gap", "contact_press")
NUMBERS = ("free", "hit", "speed", "press")


@named
@dataclass(frozen=True, kw_only=True)
class ReHit:
    """What an ensemble keeps of re-hits of a contact: ``keep={"hit": ReHit(contact="feet", margin=0.5)}``.

    Attributes
    ----------
    contact : str
    margin : float
        m, by which all its points are to be free before a hit counts as one.
    """

    contact: str
    margin: float

    def __post_init__(self) -> None:
        name_of("re-hit: contact", self.contact)
        positive_of("re-hit: margin", self.margin, "m")

    def __call__(self, result: Result) -> Array:
        """Whether it came free, whether it was hit again (0 or 1), fastest speed (m/s), largest press (N).

        The gap is that of the outputs; touches are events of the run. Raises SceneError for a result without
        the channels "contact_least_gap" and "contact_press".
        """
        for channel in CHANNELS:
            if channel not in result:
                raise SceneError(f're-hit: the result has no channel "{channel}"; record it')
        gap = result.curve("contact_least_gap", contact=self.contact)
        free = np.flatnonzero(gap >= self.margin)
        if not free.size:
            return np.zeros(len(NUMBERS))
        since = float(result.time[free[0]])

        def own(point: str) -> bool:  # not one of "feet.aft"
            return point.rpartition(".")[0] == self.contact

        hits = [
            one.speed for one in result.events
            if one.kind == "contact" and own(one.name) and one.time > since
        ]  # fmt: skip
        if not hits:
            return np.array([1.0, 0.0, 0.0, 0.0])
        points = [name for name in result.coords["contact_point"] if own(name)]
        part = slice(int(free[0]) + 1, None)
        press = [result.reached("contact_press", part=part, contact_point=name)[1].max() for name in points]
        return np.array([1.0, 1.0, max(hits), max(press)])


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ReHitProbability(Answer):
    """How probable a re-hit is. Made by `re_hit_probability`; prints as a table.

    Attributes
    ----------
    dataset : xarray.Dataset
        Over all parameters but the seed: `runs` that came free, `hits` of them, `probability` with `low` and
        `high` of its 95 % interval (Clopper and Pearson), `never_free` and `failed` runs, which do not count,
        the fastest `speed` (m/s) and the largest `press` (N) of a hit.
    """

    dataset: xarray.Dataset

    def __repr__(self) -> str:
        return (
            f"<ReHitProbability: {int(self.dataset['hits'].sum())} hits in {int(self.dataset['runs'].sum())}>"
        )

    def _shown(self) -> Table:
        data = self.dataset
        axes = [Column(name=str(dim), values=data[dim].to_numpy()) for dim in data["hits"].dims]
        columns = [
            Column(name=str(name), values=one.to_numpy(), unit=one.attrs.get("units", ""), form=".3g")
            for name, one in data.items()
        ]
        return Table(axes=axes, columns=columns, title="Re-hits after all points were free", data=data)


def share_of(hits: int, runs: int) -> Estimate:
    """A probability by so many hits in runs, with its exact interval (Clopper and Pearson)."""
    from scipy.stats import binomtest

    if not runs:
        return Estimate(value=float("nan"), low=0.0, high=1.0)
    ends = binomtest(hits, runs).proportion_ci(confidence_level=CONFIDENCE, method="exact")
    return Estimate(value=hits / runs, low=float(ends.low), high=float(ends.high))


@named
def re_hit_probability(kept: xarray.DataArray) -> ReHitProbability:
    """Find how probable a re-hit is over the seeds of an ensemble.

    Parameters
    ----------
    kept : xarray.DataArray
        What a `ReHit` kept: ``done.dataset["hit"]``, with a dimension "seed", or of members.

    Raises
    ------
    SceneError
        For something else.
    """
    import xarray

    over = next((dim for dim in ("seed", "member") if dim in getattr(kept, "dims", ())), None)
    if not isinstance(kept, xarray.DataArray) or over is None or kept.shape[-1] != len(NUMBERS):
        raise SceneError(f"re-hits of {shown(kept)}; give what a ReHit kept, dataset['hit'] of an ensemble")
    values = kept.transpose(..., over, kept.dims[-1])
    free, hit, speed, press = (values.isel({kept.dims[-1]: i}, drop=True) for i in range(len(NUMBERS)))
    runs, hits = ((one == 1.0).sum(over) for one in (free, hit))
    shares = [
        share_of(int(k), int(n)) for k, n in zip(hits.to_numpy().flat, runs.to_numpy().flat, strict=True)
    ]
    data = {"runs": runs, "hits": hits}
    for name in ("value", "low", "high"):
        found = np.array([getattr(one, name) for one in shares]).reshape(runs.shape)
        data["probability" if name == "value" else name] = runs.copy(data=found)
    data |= {"never_free": (free == 0.0).sum(over), "failed": free.isnull().sum(over)}
    data["speed"], data["press"] = speed.max(over), press.max(over)
    made = xarray.Dataset(data)
    made["speed"].attrs["units"], made["press"].attrs["units"] = "m/s", "N"
    return ReHitProbability(dataset=made)
