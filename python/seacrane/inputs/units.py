"""Units that a text or a key of a file may have, what each is in SI, of which dimension, and its suffix."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from math import inf, isfinite, pi
from types import MappingProxyType
from typing import Any

import numpy as np

Dimension = tuple[Fraction, Fraction, Fraction, Fraction]
BASE = ("kg", "m", "s", "rad")


def _dimension(*exponents: int) -> Dimension:
    return tuple(map(Fraction, exponents))  # type: ignore[return-value]


PURE, ANGLE = _dimension(0, 0, 0, 0), _dimension(0, 0, 0, 1)
G = 9.80665  # m/s2, standard: of a tonne-force
_OF_DIMENSION: dict[tuple[int, ...], dict[str, float | Fraction]] = {  # kg, m, s, rad: in SI, its own first
    (0, 0, 0, 0): {"1": 1.0}, (0, 0, 0, 1): {"rad": 1.0, "deg": pi / 180.0},
    (0, 0, -1, 1): {"rad/s": 1.0, "deg/s": pi / 180.0, "rpm": pi / 30.0},
    (0, 0, -2, 1): {"rad/s2": 1.0, "deg/s2": pi / 180.0},
    (0, 1, 0, 0): {"m": 1.0, "mm": 1e-3}, (0, 2, 0, 0): {"m2": 1.0, "cm2": 1e-4, "mm2": 1e-6},
    (0, 1, -1, 0): {"m/s": 1.0, "m/min": Fraction(1, 60), "kn": Fraction(1852, 3600)},
    (0, 1, -2, 0): {"m/s2": 1.0},
    (0, 3, 0, 0): {"m3": 1.0, "l": 1e-3}, (0, 3, -1, 0): {"m3/s": 1.0, "l/min": Fraction(1, 60_000)},
    (0, 0, 1, 0): {"s": 1.0, "min": 60.0, "h": 3600.0}, (1, 0, 0, 0): {"kg": 1.0, "t": 1e3},
    (1, -1, 0, 0): {"kg/m": 1.0, "t/m": 1e3}, (1, -3, 0, 0): {"kg/m3": 1.0, "t/m3": 1e3},
    (1, 1, 0, 0): {"kg m": 1.0, "t m": 1e3}, (1, 2, 0, 0): {"kg m2": 1.0, "t m2": 1e3},
    (1, 1, -2, 0): {"N": 1.0, "kN": 1e3, "MN": 1e6, "tf": 1e3 * G}, (1, 1, -1, 0): {"N s": 1.0},
    (1, 2, -2, 0): {"N m": 1.0, "J": 1.0, "kN m": 1e3, "MN m": 1e6, "tf m": 1e3 * G},
    (1, 0, -2, 0): {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "N/mm": 1e3, "tf/m": 1e3 * G},
    (1, 0, -1, 0): {"N s/m": 1.0, "kN s/m": 1e3},
    (1, 2, -2, -1): {"N m/rad": 1.0, "kN m/rad": 1e3, "N m/deg": 180.0 / pi, "kN m/deg": 180e3 / pi},
    (1, 2, -1, -1): {"N m s/rad": 1.0, "kN m s/rad": 1e3}, (1, 2, -3, 0): {"W": 1.0, "kW": 1e3},
    (1, -1, -2, 0): {"Pa": 1.0, "N/m2": 1.0, "kPa": 1e3, "bar": 1e5, "MPa": 1e6, "kN/m2": 1e3},
    (-1, 4, 1, 0): {"m3/s/Pa": 1.0, "l/min/bar": Fraction(1, 6 * 10**9)},
}  # fmt: skip
UNITS: Mapping[str, tuple[float, Dimension]] = MappingProxyType(
    {unit: (float(si), _dimension(*of)) for of, units in _OF_DIMENSION.items() for unit, si in units.items()}
)
_EXACT = {  # of a minute and an hour no decimals are exact
    unit: si if isinstance(si, Fraction) else Fraction(repr(si))
    for units in _OF_DIMENSION.values() for unit, si in units.items()
}  # fmt: skip


@cache
def others_of(unit: str) -> tuple[str, ...]:
    """The units of another size and the same dimension, in which a person may give what is in this one."""
    if unit not in UNITS:
        return ()
    size, dimension = UNITS[unit]
    return tuple(one for one, (factor, of) in UNITS.items() if of == dimension and factor != size)


def in_si(value: float, unit: str) -> float:
    """A number of a unit in SI, rounded once from its decimals: 6 m/min are 0.1 m/s to the last bit."""
    factor = UNITS[unit][0]
    if factor == 1.0 or value == 0.0 or not isfinite(value):
        return value
    try:
        return float(Fraction(repr(float(value))) * _EXACT[unit])
    except OverflowError:
        return inf if value > 0.0 else -inf


def suffix(unit: str) -> str:
    """A unit as the end of a key."""
    return re.sub(r"^_", "", unit.removeprefix("1").replace("/", "_per_").replace(" ", "_"))


def spellings(key: str, *units: str) -> dict[str, str]:
    """The unit by each way to write a key that is in one of ``units``, or in another of its dimension."""
    every = (one for unit in units for one in (unit, *others_of(unit)))
    return {f"{key}_{suffix(one)}".rstrip("_"): one for one in every}


def into_si(unit: str) -> Callable[[Any], Any]:
    """From a file's unit to that of the API, of a number or of numbers in tuples."""
    if unit.startswith("deg"):
        return np.radians

    def converted(value: Any) -> Any:
        return tuple(map(converted, value)) if isinstance(value, tuple) else in_si(value, unit)

    return converted if unit in UNITS and UNITS[unit][0] != 1.0 else lambda value: value


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
