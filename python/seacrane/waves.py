"""A sea and the force transfer of a vessel in it, as a scene keeps them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.checked import text_of
from seacrane.errors import SceneError

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Waves:
    """A sea and the force transfer of a vessel in it, as plain arrays.

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
        Bound on the table's interpolation error over the sum of component magnitudes; 0 sums exactly.
    depth : float
        Water depth, m, for the wavenumbers.
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
    information: Mapping[str, Any] = field(default_factory=dict)

    def compile(self) -> _core.WaveLoads:
        """The loads for the compiled core; raises SceneError for shapes or values that make no sense."""
        try:
            waves = _core.WaveComponents(
                omega=self.omega,
                amplitude=self.amplitude,
                phase=self.phase,
                direction=self.direction,
                depth=self.depth,
            )
            exact = _core.ExactWaveLoad(
                waves=waves, transfer=self.transfer, position=self.position, elevation_point=self.position
            )
            table = None
            if self.relative_bound:
                table = _core.WaveTable(load=exact, relative_bound=self.relative_bound)
        except (TypeError, ValueError) as error:
            raise SceneError(f"waves on {self.body!r}: {error}") from error
        return _core.WaveLoads(name="waves", body=text_of("waves: body", self.body), exact=exact, table=table)
