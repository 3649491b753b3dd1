"""The members of an ensemble: the values that each of them has of what varies."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, text_of
from seacrane.inputs.shown import shown

MOST_MEMBERS = 10**6
Value = bool | int | float | str


@dataclass(frozen=True, kw_only=True)
class LatinHypercube:
    """Members of which each parameter has one value in every one of `count` equal parts of its range.

    Attributes
    ----------
    ranges : mapping of str to (float, float)
        Smallest and largest value of each parameter.
    count : int
        Members.
    seed : int
        Of the design; the same seed gives the same members.

    Raises
    ------
    SceneError
        For a range that is none, or a count or seed that is no whole number.
    """

    ranges: Mapping[str, tuple[float, float]]
    count: int
    seed: int = 1

    def __post_init__(self) -> None:
        if not isinstance(self.ranges, Mapping) or not self.ranges:
            raise SceneError(f"design: ranges is {shown(self.ranges)}; give (lowest, highest) by name")
        for name, limits in self.ranges.items():
            if not isinstance(limits, tuple | list) or len(limits) != 2:
                raise SceneError(f"design: range of {name} is {shown(limits)}; give (lowest, highest)")
            low, high = (number_of(f"design: range of {name}", limit) for limit in limits)
            if not (np.isfinite([low, high]).all() and low < high):
                raise SceneError(f"design: range of {name} is ({low}, {high}); give the smaller value first")
        for what, value, least in (("count", self.count, 1), ("seed", self.seed, 0)):
            if not isinstance(value, int | np.integer) or isinstance(value, bool) or value < least:
                raise SceneError(f"design: {what} is {shown(value)}; give a whole number from {least} on")
        if self.count > MOST_MEMBERS:
            raise SceneError(f"design: count is {self.count}, more than {MOST_MEMBERS}; take fewer members")

    def columns(self) -> dict[str, tuple[float, ...]]:
        """The values of every parameter by member."""
        from scipy.stats import qmc

        sampler = qmc.LatinHypercube(len(self.ranges), seed=np.random.default_rng(self.seed))
        unit = sampler.random(int(self.count))
        return {
            name: tuple(float(low + (high - low) * share) for share in unit[:, place])
            for place, (name, (low, high)) in enumerate(self.ranges.items())
        }


Over = Mapping[str, Iterable[Value]] | Sequence[Mapping[str, Value]] | LatinHypercube


@dataclass(frozen=True, kw_only=True)
class Members:
    """The values of every member, made as they are asked for."""

    axes: Mapping[str, tuple[Value, ...]]  # by parameter: of a grid along its axis, of a list by member
    grid: bool  # whether all combinations are run, those of the last parameter next to each other

    def __len__(self) -> int:
        lengths = [len(values) for values in self.axes.values()]
        return math.prod(lengths) if self.grid else lengths[0]

    @property
    def shape(self) -> dict[str, int]:
        """Dimensions of the ensemble and their lengths."""
        if self.grid:
            return {name: len(values) for name, values in self.axes.items()}
        return {"member": len(self)}

    def values(self, index: int) -> dict[str, Value]:
        """What a member has, by parameter."""
        if not self.grid:
            return {name: values[index] for name, values in self.axes.items()}
        places = np.unravel_index(index, tuple(self.shape.values()))
        return {
            name: values[int(place)] for (name, values), place in zip(self.axes.items(), places, strict=True)
        }


def members_of(over: Over) -> Members:
    """The members that `over` asks for.

    Raises SceneError for what is no grid, list or design, values that are no numbers or texts, values given
    twice on an axis, rows of different names, or more than a million members.
    """
    if isinstance(over, LatinHypercube):
        return Members(axes=over.columns(), grid=False)
    if isinstance(over, Mapping):
        return _grid(over)
    if isinstance(over, (str, bytes)) or not isinstance(over, Sequence):
        raise SceneError(
            f"over is {shown(over)}; give names with their values, a list of mappings, or a LatinHypercube"
        )
    return _rows(over)


def _grid(over: Mapping[str, Iterable[Value]]) -> Members:
    if not over:
        raise SceneError("over is empty; name at least one parameter and its values")
    sizes = {text_of("over", name): _size(name, values) for name, values in over.items()}
    count = math.prod(sizes.values())
    if count > MOST_MEMBERS:
        told = " x ".join(f"{size} {name}" for name, size in sizes.items())
        raise SceneError(
            f"over: {told} are {count} members, more than {MOST_MEMBERS}; take fewer values, or a "
            "LatinHypercube of the same ranges"
        )
    axes = {name: tuple(_plain(name, value) for value in values) for name, values in over.items()}
    for name, values in axes.items():
        if len(set(values)) < len(values):
            twice = next(value for value in values if values.count(value) > 1)
            raise SceneError(f"over: {name} has {twice!r} twice; give each value once")
    return Members(axes=axes, grid=True)


def _size(name: str, values: Any) -> int:
    if isinstance(values, (str, bytes)) or not hasattr(values, "__len__"):
        raise SceneError(f"over: {name} is {shown(values)}; give a list of values")
    if not len(values):
        raise SceneError(f"over: {name} has no values; give at least one")
    return len(values)


def _rows(rows: Sequence[Mapping[str, Value]]) -> Members:
    if not rows:
        raise SceneError("over is empty; give at least one member")
    if len(rows) > MOST_MEMBERS:
        raise SceneError(f"over: {len(rows)} members are more than {MOST_MEMBERS}; split the list")
    for place, row in enumerate(rows):
        if not isinstance(row, Mapping) or not row:
            raise SceneError(f"over[{place}] is {shown(row)}; give a mapping of names to values")
        if row.keys() != rows[0].keys():
            raise SceneError(
                f"over[{place}] has {', '.join(map(str, row))}, over[0] has {', '.join(map(str, rows[0]))}; "
                "name the same parameters in all"
            )
    names = [text_of("over", name) for name in rows[0]]
    axes = {name: tuple(_plain(name, row[name]) for row in rows) for name in names}
    return Members(axes=axes, grid=False)


def _plain(name: str, value: Any) -> Value:
    plain = value.item() if isinstance(value, np.generic) else value
    if not isinstance(plain, bool | int | float | str) or plain != plain:
        raise SceneError(
            f"over: {name} has {shown(value)}; give numbers or texts, and make other objects of them in a "
            "function"
        )
    return plain
