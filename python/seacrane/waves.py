"""A sea and its loads on a vessel, as a scene keeps them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.checked import text_of
from seacrane.errors import SceneError

Array = NDArray[np.float64]
EVALUATIONS = ("table", "exact", "fft")


class RepeatingSeaWarning(UserWarning):
    """A run is longer than its sea: after one period it meets the same waves, and extremes learn nothing."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ByHeading:
    """Loads of every wave component over its heading relative to the vessel.

    Attributes
    ----------
    heading : ndarray, shape (m,)
        rad, increasing within one turn, at most 45 deg apart.
    values : ndarray, shape (m, n, 6), complex or real
        Force per amplitude (N/m, N m/m), or mean drift per squared amplitude (N/m2, N m/m2), at the
        frequencies of the n components.
    """

    heading: Array
    values: NDArray[Any]


@dataclass(frozen=True, kw_only=True)
class Waves:
    """A sea and its loads on a vessel, as plain arrays.

    Attributes
    ----------
    body : str
        The vessel's body.
    omega, amplitude, phase, direction : ndarray, shape (n,)
        rad/s, m, rad, rad (travelling to, from +x towards +y).
    transfer : ndarray, shape (n, 6), complex
        Force RAO at each component, N/m and N m/m about the body origin in the vessel's axes, exp(+i w t).
    position : tuple of float
        Mean position (x, y), m, where the phase is taken.
    relative_bound : float
        Bound on a table's interpolation error over the sum of component magnitudes; 0 sums exactly.
    depth : float
        Water depth, m, for the wavenumbers.
    evaluation : str
        "table": knots made as a run reaches them. "fft": knots of a whole period made beforehand by FFT, for
        long records of many components; frequencies must be multiples of one step. "exact": the sum in every
        evaluation.
    force_by_heading : ByHeading, optional
        Force RAOs over the heading. With them loads are those at the vessel's position and heading of the
        moment, summed exactly; `transfer` then only serves the linear model.
    drift : ndarray, shape (n, 6), optional
        Mean drift load per squared amplitude at each component, N/m2 and N m/m2: adds Newman's slow drift.
    drift_by_heading : ByHeading, optional
        The same over the heading, for loads at the actual position.
    negligible : float
        Components whose magnitudes sum to no more than this share of all, in every load and the elevation,
        are left out when the scene is compiled, 0 to 0.1; 0 leaves out those that add nothing.
    information : mapping
        What is reported of the sea (seed, realised Hs, repeat period).
    """

    body: str
    omega: Array
    amplitude: Array
    phase: Array
    direction: Array
    transfer: NDArray[np.complex128]
    position: tuple[float, float] = (0.0, 0.0)
    relative_bound: float = 1e-9
    depth: float = float("inf")
    evaluation: str = "table"
    force_by_heading: ByHeading | None = None
    drift: Array | None = None
    drift_by_heading: ByHeading | None = None
    negligible: float = 1e-9
    information: Mapping[str, Any] = field(default_factory=dict)

    def compile(self, *, prune: bool = True) -> _core.WaveLoads:
        """The loads for the compiled core; raises SceneError for shapes or values that make no sense.

        `prune` leaves out the components that are negligible.
        """
        from seacrane.wave_selection import without_negligible

        try:
            sea = without_negligible(self) if prune else self
            loads = sea._positioned() if sea.force_by_heading is not None else sea._mean()
        except (TypeError, ValueError) as error:
            raise SceneError(f"waves on {self.body!r}: {error}") from error
        return _core.WaveLoads(name="waves", body=text_of("waves: body", self.body), **loads)

    def components(self) -> _core.WaveComponents:
        """The sea alone."""
        return _core.WaveComponents(
            omega=self.omega,
            amplitude=self.amplitude,
            phase=self.phase,
            direction=self.direction,
            depth=self.depth,
        )

    def warn_of_repeats(self, duration: float) -> None:
        """Warn with RepeatingSeaWarning if a series made by FFT is shorter than a run (s)."""
        if self.evaluation != "fft":
            return
        from seacrane.wave_series import grid_of

        period = 2.0 * np.pi / grid_of(np.asarray(self.omega, dtype=float))[0]
        if duration > period:
            warnings.warn(
                f"waves on {self.body!r}: repeat after {period:.6g} s, the run takes {duration:.6g} s: what "
                "comes later adds nothing to extremes or statistics; put more components into the same band",
                RepeatingSeaWarning,
                stacklevel=4,
            )

    def _positioned(self) -> dict[str, Any]:
        force, drift = self.force_by_heading, self.drift_by_heading
        if force is None or (self.drift is not None and drift is None):
            raise ValueError("drift at the actual position needs drift_by_heading")
        if self.evaluation == "fft":
            raise ValueError("loads at the actual position have no table; choose evaluation='exact'")
        slow: dict[str, Any] = {}
        if drift is not None:
            slow = {"drift_headings": np.asarray(drift.heading).tolist(), "drift": drift.values}
        positioned = _core.PositionedWaveLoad(
            self.components(), headings=np.asarray(force.heading).tolist(), transfer=force.values, **slow
        )
        return {"positioned": positioned}

    def _mean(self) -> dict[str, Any]:
        if self.evaluation not in EVALUATIONS:
            raise ValueError(f"evaluation is {self.evaluation!r}; choose {', '.join(EVALUATIONS)}")
        waves = self.components()
        loads: dict[str, Any] = {
            "exact": _core.ExactWaveLoad(
                waves, transfer=self.transfer, position=self.position, elevation_point=self.position
            )
        }
        if self.drift is not None:
            loads["drift"] = _core.DriftLoad(waves, coefficient=self.drift, position=self.position)
        if self.evaluation == "exact" or not self.relative_bound:
            return loads
        from seacrane.wave_series import drift_table, wave_table

        bound = self.relative_bound
        if self.evaluation == "fft":
            loads["table"] = wave_table(self, loads["exact"])
            if self.drift is not None:
                loads["drift_table"] = drift_table(self, loads["drift"])
            return loads
        loads["table"] = _core.WaveTable(loads["exact"], relative_bound=bound)
        if self.drift is not None:
            loads["drift_table"] = _core.DriftTable(loads["drift"], relative_bound=bound)
        return loads
