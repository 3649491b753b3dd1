"""A steady current over depth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import numbers_of
from seacrane.inputs.keywords import named

KEYS = ("depth", "speed", "direction_deg")


@named
@dataclass(frozen=True, kw_only=True, eq=False)
class Current:
    """Steady horizontal current over depth, the same at every place.

    Between two depths its components along x and y are linear; above the first and below the last it is that
    of the first and the last. One number in place of each list is a uniform current.

    Attributes
    ----------
    depth : ndarray, shape (n,)
        m below the still water, increasing; default: 0.
    speed : ndarray, shape (n,)
        m/s.
    direction_deg : ndarray, shape (n,)
        Where the water goes *to*, deg from +x towards +y, as for waves; one number for all depths.

    Raises
    ------
    SceneError
        For lists of different lengths, depths that do not increase, and values out of range.
    """

    depth: ArrayLike = 0.0
    speed: ArrayLike
    direction_deg: ArrayLike

    __repr__ = brief

    def __post_init__(self) -> None:
        size = np.atleast_1d(numbers_of("current: depth", self.depth)).size
        for key in KEYS:
            array = np.atleast_1d(numbers_of(f"current: {key}", getattr(self, key)))
            if array.shape not in ((size,), (1,)) or not np.all(np.isfinite(array)):
                raise SceneError.of(
                    f"current: {key}", f"is {array.tolist()}; give {size} finite numbers, one for each depth"
                )
            array = np.array(np.broadcast_to(array, (size,)))
            array.setflags(write=False)
            object.__setattr__(self, key, array)
        self.core()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Current):
            return NotImplemented
        return all(np.array_equal(getattr(self, key), getattr(other, key)) for key in KEYS)

    __hash__ = None  # type: ignore[assignment]  # arrays have none

    def core(self) -> _core.Current:
        """For the engine."""
        speed, angle = np.asarray(self.speed), np.radians(np.asarray(self.direction_deg))
        try:
            return _core.Current(depth=self.depth, x=speed * np.cos(angle), y=speed * np.sin(angle))
        except ValueError as error:
            raise SceneError(str(error)) from error

    def velocity(self, z: ArrayLike) -> Array:
        """Along x and y (..., 2), m/s, at heights z, m, upwards from the still water."""
        heights = numbers_of("current: z", z)
        rows: Array = self.core().velocity(heights.ravel())
        return rows.reshape(*heights.shape, 2)

    def mean(self, draught: float) -> tuple[float, float]:
        """Speed (m/s) and direction (deg) of the mean velocity from the surface to a draught (m)."""
        depth = np.asarray(self.depth, dtype=float)
        edges = np.unique(np.clip([0.0, *depth, draught], 0.0, draught))
        at = self.velocity(-edges)
        x, y = at[0] if edges.size == 1 else np.trapezoid(at, edges, axis=0) / draught
        return float(np.hypot(x, y)), float(np.degrees(np.arctan2(y, x)))
