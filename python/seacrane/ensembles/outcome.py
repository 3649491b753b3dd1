"""What came of one member: arrays with names of their dimensions, or why it failed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True, eq=False)
class Labelled:
    """What one member keeps under one name.

    Attributes
    ----------
    values : Numbers, float64.
    coords : mapping of str to ndarray
        Numbers or texts along those dimensions that have any.
    attributes : mapping of str to str
        Unit and description.
    """

    values: NDArray[np.float64]
    dims: tuple[str, ...] = ()
    coords: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)

    def lies_like(self, other: Labelled) -> bool:
        """Whether both have the same dimensions and the same values along them."""
        return (
            self.dims == other.dims
            and self.values.shape == other.values.shape
            and all(np.array_equal(self.coords[dim], other.coords[dim]) for dim in other.coords)
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a member kept, or why it failed.

    Attributes
    ----------
    kept : mapping of str to Labelled
        Empty where it failed.
    failure : Why it failed; empty where it did not.
    validity : What was out of range in its run, as of a result's stats.
    kept_apart : str
        Why it was stepped by itself where others were to be stepped beside it; empty where it was not.
    """

    index: int
    kept: Mapping[str, Labelled] = field(default_factory=dict)
    failure: str = ""
    validity: str = ""
    kept_apart: str = ""
