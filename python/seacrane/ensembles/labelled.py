"""An array with names of its dimensions and the values along them, as members return it."""

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
