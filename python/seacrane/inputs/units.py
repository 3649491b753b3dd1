"""Units that a text may have, with what each is in SI and of which dimension."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import pi
from types import MappingProxyType

Dimension = tuple[Fraction, Fraction, Fraction, Fraction]
BASE = ("kg", "m", "s", "rad")


def _dimension(*exponents: int) -> Dimension:
    return tuple(map(Fraction, exponents))  # type: ignore[return-value]


PURE, ANGLE = _dimension(0, 0, 0, 0), _dimension(0, 0, 0, 1)
_OF_DIMENSION: dict[tuple[int, ...], dict[str, float]] = {  # kg, m, s, rad: units, the SI one first, in SI
    (0, 0, 0, 0): {"1": 1.0}, (0, 0, 0, 1): {"rad": 1.0, "deg": pi / 180.0},
    (0, 0, -1, 1): {"rad/s": 1.0, "deg/s": pi / 180.0}, (0, 0, -2, 1): {"rad/s2": 1.0},
    (0, 1, 0, 0): {"m": 1.0, "mm": 1e-3}, (0, 2, 0, 0): {"m2": 1.0}, (0, 3, 0, 0): {"m3": 1.0},
    (0, 1, -1, 0): {"m/s": 1.0}, (0, 1, -2, 0): {"m/s2": 1.0}, (0, 3, -1, 0): {"m3/s": 1.0},
    (0, 0, 1, 0): {"s": 1.0}, (1, 0, 0, 0): {"kg": 1.0, "t": 1e3}, (1, 1, -2, 0): {"N": 1.0, "kN": 1e3},
    (1, 1, -1, 0): {"N s": 1.0}, (1, 2, -2, 0): {"N m": 1.0, "J": 1.0, "kN m": 1e3},
    (1, 0, -2, 0): {"N/m": 1.0}, (1, 2, -3, 0): {"W": 1.0}, (1, -1, -2, 0): {"Pa": 1.0, "bar": 1e5},
}  # fmt: skip
UNITS: Mapping[str, tuple[float, Dimension]] = MappingProxyType(
    {unit: (si, _dimension(*of)) for of, units in _OF_DIMENSION.items() for unit, si in units.items()}
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
