"""A design: few members spread evenly over the ranges of many parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown

MOST_POINTS = 10**6


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
        if self.count > MOST_POINTS:
            raise SceneError(f"design: count is {self.count}, more than {MOST_POINTS}; take fewer members")

    def columns(self) -> dict[str, tuple[float, ...]]:
        """The values of every parameter by member."""
        from scipy.stats import qmc

        sampler = qmc.LatinHypercube(len(self.ranges), seed=np.random.default_rng(self.seed))
        unit = sampler.random(int(self.count))
        return {
            name: tuple(float(low + (high - low) * share) for share in unit[:, place])
            for place, (name, (low, high)) in enumerate(self.ranges.items())
        }
