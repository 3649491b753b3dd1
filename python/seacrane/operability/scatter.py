"""ScatterDiagram: how often which sea states occur."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of, text_of
from seacrane.operability.hindcast import WaveHindcast

Array = NDArray[np.float64]


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
    values = numbers_of(f"scatter diagram: {name}", given)
    if (
        values.ndim != 1
        or values.size < 2
        or not np.all(np.isfinite(values))
        or np.any(np.diff(values) <= 0.0)
    ):
        raise SceneError(f"scatter diagram: {name} is {values.tolist()}; give ascending bounds of ranges")
    if values[0] < 0.0:
        raise SceneError(f"scatter diagram: {name} begins with {values[0]:g}; give zero or more")
    return values
