"""`DriftCoefficients`: mean second-order wave loads of regular waves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.brief import brief

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class DriftCoefficients:
    """Mean second-order load per squared wave amplitude; axes, headings and point as in `HydroDatabase`.

    The mean load of a wave of amplitude a is ``coefficient a^2``. With Newman's approximation (1974, Second
    Order Slowly Varying Forces on Vessels in Irregular Waves) it also gives the slow loads of several waves.

    Attributes
    ----------
    heading : (m,) direction waves travel to, rad, increasing, within [0, 2 pi).
    omega : (n,) wave frequency (not encounter frequency), rad/s, increasing, positive.
    coefficient : (m, n, 6) N/m2 and N m/m2; motions the source does not give are zero.

    Raises
    ------
    ValueError : a wrong shape, a value that is not finite, headings or frequencies that do not rise.
    """

    heading: FloatArray
    omega: FloatArray
    coefficient: FloatArray

    __repr__ = brief

    def __post_init__(self) -> None:
        m, n = np.size(self.heading), np.size(self.omega)
        for name, shape in (("heading", (m,)), ("omega", (n,)), ("coefficient", (m, n, 6))):
            array = np.array(getattr(self, name), dtype=float)
            if array.shape != shape or array.size == 0:
                raise ValueError(f"drift coefficients: {name} has shape {array.shape}; {shape} is needed")
            if not np.all(np.isfinite(array)):
                where = [int(i) for i in np.argwhere(~np.isfinite(array))[0]]
                raise ValueError(f"drift coefficients: {name}{where} is not finite; give finite numbers")
            array.setflags(write=False)
            object.__setattr__(self, name, array)
        if np.any(np.diff(self.omega) <= 0.0) or self.omega[0] <= 0.0:
            raise ValueError("drift coefficients: omega must be positive and rise; sort it, drop duplicates")
        turn = 2.0 * np.pi
        if np.any(np.diff(self.heading) <= 0.0) or self.heading[0] < -1e-12 or self.heading[-1] >= turn:
            raise ValueError("drift coefficients: heading must rise within [0, 2 pi); sort it, wrap angles")
