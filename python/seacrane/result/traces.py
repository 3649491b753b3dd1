"""Channels as single curves, with what they reached between outputs, in the units that people read."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, LARGEST, LEAST, unit_of
from seacrane.description.pick import Pick, column_name
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of
from seacrane.plotting.table import Column, Table
from seacrane.result.about import About, Stat
from seacrane.result.events import Event

Array = NDArray[np.float64]
ROUNDING = 1e-9  # of the largest beside it: what is smaller is drawn by rounding alone
NO_MOTION = 1e-9  # m, deg, N and so on: nothing below it is meant
NO_ENERGY = 1e-6  # J
ANGLES = ("angle", "roll", "pitch", "yaw")  # coordinates that are angles
PREFIXES = ((1e6, "M"), (1e3, "k"))
LOADS = ("N", "N m", "J", "N or N m")
FEWEST_DIGITS = 1e4  # N: below it loads stay as they are
Extremes = Mapping[str, tuple[Array, Array]]  # least and largest values by channel


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Record(ABC):
    """What curves are read from: the part of a `Result` that was recorded."""

    time: Array
    channels: Mapping[str, Array]
    coords: Mapping[str, tuple[str, ...]]
    stats: Mapping[str, Stat]
    interrupted: bool = False
    events: tuple[Event, ...] = ()
    about: About = field(default_factory=About)
    extremes: Extremes = field(default_factory=dict)
    dims: Mapping[str, tuple[str, ...]] = field(init=False)

    @abstractmethod
    def select(self, channel: str | Pick, /, **names: str) -> Array:
        """A channel at named coordinates; KeyError or ValueError for what is not there."""


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
        bounds = (least, largest) if channel in result.extremes else None
        found.append(Trace(channel=channel, names=named, unit=shown, values=values, bounds=bounds))
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


def curves_of(result: Record, picks: Sequence[Pick], part: slice) -> Table:
    """A column for each curve of each selector, by the times of a part."""
    found: dict[str, Column] = {}
    for pick in picks:
        dims = result.dims[pick.channel]
        for names, curve in pick.curves(result.channels[pick.channel], dims, result.coords):
            name = column_name(pick.channel, list(names.values()))
            unit = unit_of(pick.channel, names.values())
            found[name] = Column(name=name, values=curve[part], unit=unit)
    return Table(axes=[Column(name="time", values=result.time[part], unit="s")], columns=list(found.values()))


def as_arrays(extremes: Extremes) -> dict[str, Array]:
    """As arrays with names of their own, which files hold beside the channels."""
    return {
        name + ending: array
        for name, both in extremes.items()
        for ending, array in zip((LEAST, LARGEST), both, strict=True)
    }


def parted(arrays: Mapping[str, Array]) -> tuple[dict[str, Array], dict[str, tuple[Array, Array]]]:
    """Channels, and their least and largest values, of `as_arrays` beside channels."""
    extremes = {name: (arrays[name + LEAST], arrays[name + LARGEST])
                for name in arrays if name + LEAST in arrays and name + LARGEST in arrays}  # fmt: skip
    own = as_arrays(extremes)
    return {name: array for name, array in arrays.items() if name not in own}, extremes


def inside(result: Record, part: slice, values: Array, bound: Array) -> Array:
    """Least or largest values (n,) of a part of the outputs, whose values are `values`.

    What was before the first output of the part counts if the part begins at the output before it: at the
    start of a stage.
    """
    out = bound[part]
    if not len(out) or part.start == 0:
        return out
    before = float(result.time[part.start - 1])
    if any(span.start == before for span in result.about.stages):
        return out
    return np.concatenate([values[part][:1], out[1:]])


def heavy_line_tension(result: Record, *, line: str) -> Array:
    """Tension at both ends of a line with mass, of `Scene.add_line`.

    Extrapolated from the two segments next to each end, whose tension is that of their middle.

    Parameters
    ----------
    result : Result
        With the channel `line_tension`.
    line : str
        Its name.

    Returns
    -------
    ndarray, shape (n, 2)
        N, at the first end and at the last, over the outputs.

    Raises
    ------
    SceneError
        For a line that is not in the result, or a result without that channel.
    """
    name = name_of("heavy line", line)
    if "line_tension" not in result.channels:
        raise SceneError(
            f"heavy line {name!r}: the result has no channel 'line_tension'; leave it in channels"
        )
    every = result.coords["line"]
    own = [i for i, one in enumerate(every) if re.fullmatch(re.escape(name) + r"\.\d+", one)]
    if not own:
        raise SceneError(f"heavy line {name!r}: is not in the result, which has the lines {', '.join(every)}")
    tension = result.channels["line_tension"].reshape(result.time.size, len(every))[:, own]
    if len(own) == 1:
        return np.repeat(tension, 2, axis=1)
    near, far = tension[:, [0, -1]], tension[:, [1, -2]]
    return np.asarray(1.5 * near - 0.5 * far)
