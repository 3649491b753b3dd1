"""`GroupBody`: what one hull of a group is by itself."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.brief import brief
from seacrane.inputs.checked import require_unmasked

FloatArray = NDArray[np.float64]

SHAPES = {
    "position": (3,),
    "mass_matrix": (6, 6),
    "restoring": (6, 6),
    "linear_damping": (6, 6),
    "quadratic_damping": (6,),
}


@dataclass(frozen=True, kw_only=True, eq=False)
class GroupBody:
    """One hull of a `HydroGroup`; immutable, every array read-only.

    Attributes
    ----------
    name : its name in the group.
    position : (3,) m, its reference point from the group's origin, which is on the still waterline.
    heading : rad, of its x axis, from the group's x axis towards its y axis.
    mass_matrix, restoring, linear_damping : (6, 6), of this hull alone, about its reference point and in its
        own axes (x forward, y port, z up).
    quadratic_damping : (6,) coefficients of v |v| beside radiation.
    length, breadth, draught : m.
    """

    name: str
    position: FloatArray
    mass_matrix: FloatArray
    restoring: FloatArray
    length: float
    breadth: float
    draught: float
    heading: float = 0.0
    linear_damping: FloatArray = field(default_factory=lambda: np.zeros((6, 6)))
    quadratic_damping: FloatArray = field(default_factory=lambda: np.zeros(6))

    __repr__ = brief

    def __post_init__(self) -> None:
        if not self.name:
            raise ValueError("a body of a group has no name; give each hull one of its own")
        for name, shape in SHAPES.items():
            require_unmasked(f"body {self.name!r}: {name}", getattr(self, name))
            array = np.array(getattr(self, name), dtype=float)
            if array.shape != shape:
                raise ValueError(f"body {self.name!r}: {name} has shape {array.shape}; {shape} is needed")
            if not np.all(np.isfinite(array)):
                raise ValueError(f"body {self.name!r}: {name} is not finite; give finite numbers")
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        for name in ("length", "breadth", "draught"):
            if not 0.0 < float(getattr(self, name)) < np.inf:
                raise ValueError(f"body {self.name!r}: {name} is {getattr(self, name)}; give positive m")
        if not np.isfinite(self.heading):
            raise ValueError(f"body {self.name!r}: heading is {self.heading}; give a finite angle in rad")
        if np.any(np.linalg.eigvalsh(0.5 * (self.mass_matrix + self.mass_matrix.T)) <= 0.0):
            raise ValueError(
                f"body {self.name!r}: the mass matrix is not positive definite; check mass and inertia"
            )
