"""A ship's six motions over time, from a measurement or from another program."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.curves import spline_curve
from seacrane.description.sum_of_cosines import ramp_of
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import rows_of, vector_of
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.plausible import AngleUnitWarning

Array = NDArray[np.float64]
FEWEST = 6
BETWEEN = 8  # places looked at between two samples
LARGEST_SWING, SMALLEST_SWING = 0.5, 0.01  # beyond the samples, of their range; and m or rad
LARGEST_ANGLE = 0.6  # rad: a ship that rolls or pitches beyond is rather one in degrees


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionHistory:
    """Six motions of a ship's reference point over time, as the channel `vessel_motion` records them.

    Parameters
    ----------
    time : array_like, shape (n,)
        s, increasing, from 0 or earlier on; at least 6.
    motion : array_like, shape (n, 6)
        Surge, sway, heave (m, from rest, along the ship's axes at rest) and roll, pitch, yaw (rad).

    Raises
    ------
    SceneError
        For another shape, too few samples, or times that do not increase or start later than 0.

    Warns
    -----
    AngleUnitWarning
        A roll or pitch beyond 0.6 rad (34 deg), which looks like degrees.
    """

    time: Any
    motion: Any

    def __post_init__(self) -> None:
        time = np.array(vector_of("motion history: time", self.time))
        motion = np.array(rows_of("motion history: motion", self.motion, 6))
        if time.size < FEWEST:
            raise SceneError(f"motion history: time has {time.size} samples; give at least {FEWEST}")
        if motion.shape[0] != time.size:
            raise SceneError(
                f"motion history: motion has {motion.shape[0]} rows and time {time.size}; give one row for "
                "each time"
            )
        if not (np.isfinite(time).all() and np.isfinite(motion).all()):
            raise SceneError("motion history: holds a value that is not finite; leave such samples out")
        if np.any(np.diff(time) <= 0.0):
            at = int(np.argmax(np.diff(time) <= 0.0))
            raise SceneError(
                f"motion history: time is {time[at + 1]:.6g} s after {time[at]:.6g} s; times must increase"
            )
        if time[0] > 0.0:
            raise SceneError(
                f"motion history: time starts at {time[0]:.6g} s, and runs start at 0; subtract "
                f"{time[0]:.6g} s from it"
            )
        for key, array in (("time", time), ("motion", motion)):
            array.setflags(write=False)
            object.__setattr__(self, key, array)
        self._warn_of_degrees()

    def _warn_of_degrees(self) -> None:
        largest = np.abs(self.motion[:, 3:5]).max(axis=0)
        worst = int(largest.argmax())
        if largest[worst] > LARGEST_ANGLE:
            warn_caller(
                f"motion history: {MOTIONS[3 + worst]} reaches {largest[worst]:.4g} rad, "
                f"{np.degrees(largest[worst]):.4g} deg; angles are radians: if these are degrees, give "
                "numpy.radians of roll, pitch and yaw",
                AngleUnitWarning,
            )

    def curves(self, ramp: float) -> tuple[_core.Curve, ...]:
        """Splines through the samples, of each motion; from rest over `ramp` (s) where it is not zero.

        Raises
        ------
        SceneError
            For samples so far apart that the spline swings out between them.
        """
        values = self.motion * ramp_of(self.time, ramp)[:, None]
        curves = tuple(spline_curve(times=self.time, values=column) for column in values.T)
        for name, curve, column in zip(MOTIONS, curves, values.T, strict=True):
            self._refuse_swings(name, curve, column)
        return curves

    def _refuse_swings(self, name: str, curve: _core.Curve, samples: Array) -> None:
        places = np.linspace(0.0, 1.0, BETWEEN, endpoint=False)
        fine = (self.time[:-1, None] + np.diff(self.time)[:, None] * places).ravel()
        values = curve.evaluate(fine)[:, 0]
        beyond = np.maximum(values - samples.max(), samples.min() - values)
        worst = int(beyond.argmax())
        if beyond[worst] > max(LARGEST_SWING * float(np.ptp(samples)), SMALLEST_SWING):
            raise SceneError(
                f"motion history: {name} would reach {values[worst]:.4g} at {fine[worst]:.6g} s, between "
                f"samples of {samples.min():.4g} to {samples.max():.4g}: they are too few there for a smooth "
                "curve; give at least eight in each period of the motion"
            )
