"""Channels as single curves, each with its names and in the unit that people read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, unit_of
from seacrane.description.pick import Pick
from seacrane.result.about import About
from seacrane.result.events import Event
from seacrane.result.extremes import Extremes

Array = NDArray[np.float64]
ROUNDING = 1e-9  # of the largest beside it: what is smaller is drawn by rounding alone
NO_MOTION = 1e-9  # m, deg, N and so on: nothing below it is meant
NO_ENERGY = 1e-6  # J
ANGLES = ("angle", "roll", "pitch", "yaw")  # coordinates that are angles
PREFIXES = ((1e6, "M"), (1e3, "k"))
LOADS = ("N", "N m", "J", "N or N m")
FEWEST_DIGITS = 1e4  # N: below it loads stay as they are


class Record(Protocol):
    """What curves are read from: a `Result`."""

    @property
    def time(self) -> Array: ...
    @property
    def channels(self) -> Mapping[str, Array]: ...
    @property
    def coords(self) -> Mapping[str, tuple[str, ...]]: ...
    @property
    def dims(self) -> Mapping[str, tuple[str, ...]]: ...
    @property
    def events(self) -> tuple[Event, ...]: ...
    @property
    def about(self) -> About: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def stats(self) -> Mapping[str, Any]: ...
    @property
    def extremes(self) -> Extremes: ...

    def select(self, channel: str | Pick, /, **names: str) -> Array: ...


class Bounded:
    """What a curve reached between its outputs, where the run kept that."""

    values: Array
    bounds: tuple[Array, Array] | None

    @property
    def least(self) -> Array:
        """Least values since the output before, (n,)."""
        return self.values if self.bounds is None else self.bounds[0]

    @property
    def largest(self) -> Array:
        """Largest values since the output before, (n,)."""
        return self.values if self.bounds is None else self.bounds[1]


@dataclass(frozen=True, kw_only=True, eq=False)
class Trace(Bounded):
    """One curve of a channel.

    Attributes
    ----------
    names : Along the channel's dimensions but time.
    unit : Of the values: degrees for radians, kN for newtons where they are large.
    values : (n,)
    bounds : Least and largest values since the output before, (n,) each; None: the run keeps none.
    """

    channel: str
    names: tuple[str, ...]
    unit: str
    values: Array
    bounds: tuple[Array, Array] | None = None

    @property
    def label(self) -> str:
        """Names along its dimensions; empty for a channel that has none."""
        return " ".join(self.names)

    @property
    def title(self) -> str:
        """Channel and names, as a table shows them."""
        return " ".join([self.channel.replace("_", " "), *self.names])


def traces(result: Record, channel: str, **names: str) -> list[Trace]:
    """The curves of a channel, or those of them that names pick.

    Parameters
    ----------
    **names : str
        As of `Result.select`, such as ``body="payload"``.

    Raises KeyError or ValueError as `Result.select`.
    """
    result.select(channel, **names)  # which refuses what is not there
    pick, array = Pick(channel=channel, names=names), result.channels[channel]
    has_bounds = channel in result.extremes
    every = (array, *result.extremes.get(channel, (array, array)))
    curves = [
        (
            (*names.values(), *(name for dim, name in named.items() if dim not in names)),
            (values, least, largest),
        )
        for (named, values), (_, least), (_, largest) in zip(
            *(pick.curves(one, result.dims[channel], result.coords) for one in every), strict=True
        )
    ]
    units = [_unit(result, channel, named) for named, _ in curves]
    found: list[Trace] = []
    for (named, own), unit in zip(curves, units, strict=True):
        same = [values for (_, (values, _, _)), one in zip(curves, units, strict=True) if one == unit]
        factor, shown = shown_unit(unit, same)
        values, least, largest = (np.asarray(factor * one) for one in own)
        found.append(
            Trace(
                channel=channel,
                names=named,
                unit=shown,
                values=values,
                bounds=(least, largest) if has_bounds else None,
            )
        )
    return found


def _unit(result: Record, channel: str, names: tuple[str, ...]) -> str:
    """The unit of one curve."""
    if channel == "limit_force":
        return _unit_of_limit(result, names[-1])
    return unit_of(channel, names)


def _unit_of_limit(result: Record, name: str) -> str:
    """As the run noted its limits; stops of angles push with moments."""
    for bound in result.about.bounds:
        if name in (bound["name"], f"{bound['name']}.minimum", f"{bound['name']}.maximum"):
            return "N m" if bound["kind"] == "stop" and bound["coordinate"] in ANGLES else "N"
    return CHANNELS["limit_force"].unit


def shown_unit(unit: str, curves: Iterable[Array]) -> tuple[float, str]:
    """Factor and unit that people read curves of an SI unit in."""
    if unit in ("rad", "rad/s", "rad/s2"):
        return float(np.degrees(1.0)), unit.replace("rad", "deg")
    if unit not in LOADS:
        return 1.0, unit
    largest = max((float(np.nanmax(np.abs(curve), initial=0.0)) for curve in curves), default=0.0)
    scales = [(scale, prefix) for scale, prefix in PREFIXES if largest >= 10.0 * scale]
    if not scales or largest < FEWEST_DIGITS:
        return 1.0, unit
    scale, prefix = scales[0]
    return 1.0 / scale, " or ".join(f"{prefix}{one}" for one in unit.split(" or "))


def beyond_rounding(found: Iterable[Trace]) -> list[Trace]:
    """The curves that are not zero up to rounding, beside the largest of the same unit."""
    every = list(found)
    largest: dict[str, float] = {}
    for one in every:
        largest[one.unit] = max(largest.get(one.unit, 0.0), _size(one))
    least = {unit: NO_ENERGY if unit == "J" else NO_MOTION for unit in largest}
    return [one for one in every if _size(one) > max(ROUNDING * largest[one.unit], least[one.unit])]


def _size(one: Trace) -> float:
    return max(float(np.nanmax(np.abs(bound), initial=0.0)) for bound in (one.least, one.largest))
