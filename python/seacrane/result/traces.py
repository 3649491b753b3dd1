"""Channels as single curves, with what they reached between outputs, in the units that people read."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import LARGEST, LEAST, unit_of
from seacrane.description.pick import Pick
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of
from seacrane.result.record import Extremes, Record

ROUNDING = 1e-9  # of the largest beside it: what is smaller is drawn by rounding alone
NO_MOTION = 1e-9  # m, deg, N and so on: nothing below it is meant
NO_ENERGY = 1e-6  # J
ANGLES = ("angle", "roll", "pitch", "yaw")  # coordinates that are angles
PREFIXES = ((1e6, "M"), (1e3, "k"))
LOADS = ("N", "N m", "J", "N or N m")
FEWEST_DIGITS = 1e4  # N: below it loads stay as they are


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
    pick, dims = Pick(channel=channel, names=names), result.dims[channel]
    every = (result.channels[channel], *result.extremes.get(channel, ()))
    by_unit: dict[str, list[Array]] = {}
    curves = []
    for several in zip(*(pick.curves(one, dims, result.coords) for one in every), strict=True):
        labels = (*names.values(), *(name for dim, name in several[0][0].items() if dim not in names))
        unit, own = _unit(result, channel, labels), [values for _, values in several]
        curves.append((labels, unit, own))
        by_unit.setdefault(unit, []).append(own[0])
    shown = {unit: shown_unit(unit, same) for unit, same in by_unit.items()}
    found: list[Trace] = []
    for labels, unit, own in curves:
        factor, told = shown[unit]
        values, *bounds = (np.asarray(factor * one) for one in own)
        reached = (bounds[0], bounds[1]) if bounds else None
        found.append(Trace(channel=channel, names=labels, unit=told, values=values, bounds=reached))
    return found


def _unit(result: Record, channel: str, names: tuple[str, ...]) -> str:
    """The unit of one curve; stops of angles push with moments, as the run noted its limits."""
    for bound in result.about.bounds if channel == "limit_force" else ():
        if names[-1] in (bound["name"], f"{bound['name']}.minimum", f"{bound['name']}.maximum"):
            return "N m" if bound["kind"] == "stop" and bound["coordinate"] in ANGLES else "N"
    return unit_of(channel, names)


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


def heavy_line_tension(result: Record, *, line: str) -> Array:
    """Tension at both ends of a line with mass, of `Scene.add_line`.

    Extrapolated from the two segments next to each end, whose tension is that of their middle.

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
