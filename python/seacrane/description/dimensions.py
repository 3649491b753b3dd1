"""Physical dimensions as exponents of kg, m, s and rad, and the units that texts may give them in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import pi
from types import MappingProxyType

Dimension = tuple[Fraction, Fraction, Fraction, Fraction]
BASE = ("kg", "m", "s", "rad")


def _dimension(*exponents: int) -> Dimension:
    kg, m, s, rad = (Fraction(one) for one in exponents)
    return kg, m, s, rad


PURE, ANGLE = _dimension(0, 0, 0, 0), _dimension(0, 0, 0, 1)

UNITS: Mapping[str, tuple[float, Dimension]] = MappingProxyType(
    {  # factor to SI, and dimension; of units of one dimension the SI one comes first
        "1": (1.0, PURE),
        "rad": (1.0, ANGLE),
        "deg": (pi / 180.0, ANGLE),
        "rad/s": (1.0, _dimension(0, 0, -1, 1)),
        "deg/s": (pi / 180.0, _dimension(0, 0, -1, 1)),
        "rad/s2": (1.0, _dimension(0, 0, -2, 1)),
        "m": (1.0, _dimension(0, 1, 0, 0)),
        "mm": (1e-3, _dimension(0, 1, 0, 0)),
        "m2": (1.0, _dimension(0, 2, 0, 0)),
        "m3": (1.0, _dimension(0, 3, 0, 0)),
        "m/s": (1.0, _dimension(0, 1, -1, 0)),
        "m/s2": (1.0, _dimension(0, 1, -2, 0)),
        "m3/s": (1.0, _dimension(0, 3, -1, 0)),
        "s": (1.0, _dimension(0, 0, 1, 0)),
        "kg": (1.0, _dimension(1, 0, 0, 0)),
        "t": (1e3, _dimension(1, 0, 0, 0)),
        "N": (1.0, _dimension(1, 1, -2, 0)),
        "kN": (1e3, _dimension(1, 1, -2, 0)),
        "N s": (1.0, _dimension(1, 1, -1, 0)),
        "N m": (1.0, _dimension(1, 2, -2, 0)),
        "J": (1.0, _dimension(1, 2, -2, 0)),
        "kN m": (1e3, _dimension(1, 2, -2, 0)),
        "N/m": (1.0, _dimension(1, 0, -2, 0)),
        "W": (1.0, _dimension(1, 2, -3, 0)),
        "Pa": (1.0, _dimension(1, -1, -2, 0)),
        "bar": (1e5, _dimension(1, -1, -2, 0)),
    }
)


def product(dimensions: Sequence[Dimension]) -> Dimension:
    """The dimension of quantities multiplied with each other."""
    kg, m, s, rad = (sum(exponents, Fraction(0)) for exponents in zip(*dimensions, strict=True))
    return kg, m, s, rad


def power(dimension: Dimension, exponent: Fraction) -> Dimension:
    """The dimension of a quantity to a power."""
    kg, m, s, rad = (one * exponent for one in dimension)
    return kg, m, s, rad


def unit_text(dimension: Dimension) -> str:
    """The SI unit, such as "m/s", or "kg m^2" where it has no name here."""
    for text, (factor, known) in UNITS.items():
        if known == dimension and factor == 1.0:
            return text
    parts = zip(BASE, dimension, strict=True)
    return " ".join(base if exponent == 1 else f"{base}^{exponent}" for base, exponent in parts if exponent)
