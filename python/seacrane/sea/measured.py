"""A measured record of the surface as waves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import finite_of, name_of, number_of, shaped_of, vector_of
from seacrane.inputs.plausible import direction_of
from seacrane.sea.spreading import Spreading

HIGHEST = 1e6  # m: no sea, and its squares do not overflow
UNIFORM = 1e-3  # largest departure of a time from the uniform grid, over the step


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredWaves:
    """Surface elevation measured at one point: a wave system whose waves reproduce the record there.

    The record, its mean removed and its ends tapered where asked, is taken apart by the discrete Fourier
    transform: one component per harmonic of its duration n dt between the two cuts. The waves repeat
    after that duration, and reproduce the band-passed record at its times to rounding.

    Attributes
    ----------
    time, elevation : ndarray, shape (n,)
        s, uniform to 0.1 % of the step; m, z up. At least 8 samples. Read-only copies.
    direction_deg : float
        Direction of travel, deg from +x towards +y: one point cannot tell it.
    spreading : Spreading, optional
        Each component then has a direction of its own; the record at the point stays the same.
    position : tuple of float
        x, y of the measuring point, m, inertial frame.
    minimum_omega, maximum_omega : float, optional
        Low and high cut, rad/s; default: all harmonics up to the Nyquist frequency.
    taper : float
        Share of the record, 0 to 1, over which a cosine window takes both ends to zero together (Tukey);
        0, the default, leaves the record as it is.

    Raises
    ------
    SceneError
        For arrays of other shapes, values that are not finite, steps that are not uniform, no motion, or cuts
        between which there is no harmonic.
    """

    time: Array
    elevation: Array
    direction_deg: float
    spreading: Spreading | None = None
    position: tuple[float, float] = (0.0, 0.0)
    minimum_omega: float | None = None
    maximum_omega: float | None = None
    taper: float = 0.0
    name: str = "measured"

    __repr__ = brief

    def __post_init__(self) -> None:
        name_of("measured waves", self.name)
        for field in ("time", "elevation"):
            values = np.array(vector_of(f"{self._object}: {field}", getattr(self, field)))
            bad = np.flatnonzero(~np.isfinite(values))
            if bad.size:
                raise SceneError(
                    f"{self._object}: {field}[{bad[0]}] is {values[bad[0]]}; give finite numbers: fill "
                    "gaps or cut the record there"
                )
            values.setflags(write=False)
            object.__setattr__(self, field, values)
        if self.time.size != self.elevation.size or self.time.size < 8:
            raise SceneError(
                f"{self._object}: {self.time.size} times and {self.elevation.size} elevations; give as many "
                "of both, 8 or more"
            )
        self._check_steps()
        if not 0.0 <= number_of(f"{self._object}: taper", self.taper) <= 1.0:
            raise SceneError.of(f"{self._object}: taper", f"is {self.taper}; give a share from 0 to 1")
        for value in shaped_of(f"{self._object}: position", self.position, (2,)):
            finite_of(f"{self._object}: position", value, "m")
        what = f"{self._object}: direction_deg"
        finite_of(what, direction_of(what, self.direction_deg))
        highest = float(np.abs(self.elevation).max())
        if highest > HIGHEST:
            raise SceneError(
                f"{self._object}: elevation reaches {highest:.4g} m, above {HIGHEST:g}; give metres"
            )
        if not np.ptp(self.elevation) > 0.0:
            raise SceneError.of(
                f"{self._object}: elevation", f"is {self.elevation[0]} throughout; leave the sea out"
            )
        if not self._kept.any():
            raise SceneError(
                f"{self._object}: no harmonic of {2.0 * np.pi / self.duration:.4g} rad/s lies between "
                f"minimum_omega {self.minimum_omega} and maximum_omega {self.maximum_omega}; widen the band"
            )

    @property
    def _object(self) -> str:
        return f"measured waves {self.name!r}"

    def _check_steps(self) -> None:
        step = self.step
        if not step > 0.0:
            raise SceneError(
                f"{self._object}: times run from {self.time[0]} to {self.time[-1]} s; let them rise"
            )
        off = np.abs(self.time - (self.time[0] + step * np.arange(self.time.size))) / step
        worst = int(np.argmax(off))
        if off[worst] > UNIFORM:
            raise SceneError.of(
                f"{self._object}: time[{worst}]",
                f"is {self.time[worst]:.6g} s, {off[worst]:.3g} steps off the "
                f"uniform grid of {step:.6g} s; resample the record with a uniform step",
            )

    @property
    def step(self) -> float:
        """Sampling interval, s."""
        return float((self.time[-1] - self.time[0]) / (self.time.size - 1))

    @property
    def duration(self) -> float:
        """n dt, s: after it the waves repeat."""
        return self.step * self.time.size

    @property
    def _harmonics(self) -> Array:
        return np.asarray(2.0 * np.pi / self.duration * np.arange(self.time.size // 2 + 1), dtype=float)

    @property
    def _kept(self) -> NDArray[np.bool_]:
        omega = self._harmonics
        kept = omega > 0.0
        if self.minimum_omega is not None:
            kept &= omega >= number_of(f"{self._object}: minimum_omega", self.minimum_omega)
        if self.maximum_omega is not None:
            kept &= omega <= number_of(f"{self._object}: maximum_omega", self.maximum_omega)
        return kept

    @property
    def count(self) -> int:
        """Number of components."""
        return int(np.count_nonzero(self._kept))

    def waves(self, *, direction: Array, depth: float) -> _core.WaveComponents:
        """Components with given directions of travel (rad), one for all or one for each."""
        from scipy.signal.windows import tukey

        kept, omega, n = self._kept, self._harmonics, self.time.size
        still = self.elevation - self.elevation.mean()
        transform = np.fft.rfft(still * tukey(n, self.taper) if self.taper else still)
        amplitude = np.abs(transform) * 2.0 / n
        if n % 2 == 0:
            amplitude[-1] *= 0.5  # the Nyquist harmonic has no conjugate partner
        plain = _core.WaveComponents(omega=omega[kept], amplitude=1.0, direction=direction, depth=depth)
        x, y = self.position
        along = x * np.cos(plain.direction) + y * np.sin(plain.direction)
        phase = np.angle(transform)[kept] - omega[kept] * self.time[0] + plain.wavenumber * along
        return _core.WaveComponents(
            omega=omega[kept], amplitude=amplitude[kept], phase=phase, direction=direction, depth=depth
        )
