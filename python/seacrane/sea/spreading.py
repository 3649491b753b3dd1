"""Directional spreading of wave energy about a mean direction, the same for all frequencies."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of

LARGEST_EXPONENT = 1e4


@dataclass(frozen=True, kw_only=True)
class Spreading:
    """Density of wave energy over the angle from the mean direction.

    Attributes
    ----------
    kind : str
        "cos-2s": cos^(2 s)(angle / 2) over the full circle (Longuet-Higgins, Cartwright and Smith 1963);
        "cos-n": cos^n(angle) within a right angle on either side.
    exponent : float
        s or n, above zero.

    Raises
    ------
    SceneError
        For an unknown kind or an exponent out of range.
    """

    kind: str
    exponent: float

    def __post_init__(self) -> None:
        if self.kind not in ("cos-2s", "cos-n"):
            raise SceneError.of("spreading: kind", f"is {self.kind!r}; give 'cos-2s' or 'cos-n'")
        value = number_of("spreading: exponent", self.exponent)
        if not 0.0 < value <= LARGEST_EXPONENT:
            raise SceneError.of(
                "spreading: exponent",
                f"is {value}; give one above 0 up to {LARGEST_EXPONENT:g}, "
                "or no spreading for long-crested waves",
            )
        object.__setattr__(self, "exponent", value)

    @property
    def _turns(self) -> tuple[float, float]:
        """Half of the exponent of the cosine, and its angle per angle."""
        return (self.exponent, 0.5) if self.kind == "cos-2s" else (0.5 * self.exponent, 1.0)

    def density(self, angle: ArrayLike) -> NDArray[np.float64]:
        """D(angle), 1/rad, integral one; angle from the mean direction, rad, any shape."""
        half, rate = self._turns
        turned = rate * np.angle(np.exp(1j * np.asarray(angle, dtype=float)))
        scale = rate * math.exp(math.lgamma(half + 1.0) - math.lgamma(half + 0.5)) / math.sqrt(math.pi)
        return np.asarray(scale * np.maximum(np.cos(turned), 0.0) ** (2.0 * half))

    def quantile(self, probability: ArrayLike) -> NDArray[np.float64]:
        """Angle (rad) below which this share of the energy travels; inverse of the integral of `density`.

        sin^2 of the (half) angle has the beta distribution with parameters 1/2 and half the exponent + 1/2.
        """
        from scipy.special import betaincinv

        half, rate = self._turns
        side = 2.0 * np.asarray(probability, dtype=float) - 1.0
        sine = np.sqrt(betaincinv(0.5, half + 0.5, np.abs(side)))
        return np.asarray(np.sign(side) * np.arcsin(sine) / rate)

    def quadrature(self, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Angles (count,) in rad and their shares of the energy, which integrate a function of the angle.

        Gauss and Gegenbauer, in the sine of the (half) angle: exact for "cos-2s" and a trigonometric
        polynomial up to the order ``count``, as an odd part gives nothing.
        """
        from scipy.special import roots_gegenbauer

        half, rate = self._turns
        sine, weights = roots_gegenbauer(count, half)
        return np.arcsin(sine) / rate, weights / weights.sum()

    @property
    def std(self) -> float:
        """Root mean square angle sqrt(2 (1 - E cos(angle))), rad: that of directional buoys."""
        if self.kind == "cos-2s":
            mean = self.exponent / (self.exponent + 1.0)
        else:
            # E cos = ratio of the normalisations of exponents n and n + 1.
            a, b, c = (math.lgamma(0.5 * self.exponent + more) for more in (1.0, 1.5, 0.5))
            mean = math.exp(2.0 * a - b - c)
        return math.sqrt(2.0 * (1.0 - mean))


def cos_2s(s: float) -> Spreading:
    """Spreading ~ cos^(2 s)(angle / 2); wind sea about 5 to 15, swell 25 and more."""
    return Spreading(kind="cos-2s", exponent=s)


def cos_n(n: float) -> Spreading:
    """Spreading ~ cos^n(angle) within 90 deg; wind sea 2 to 4 (DNV-RP-C205), swell above 6."""
    return Spreading(kind="cos-n", exponent=n)
