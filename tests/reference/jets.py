"""Truncated Taylor arithmetic: a value with its first and second derivative by one variable."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Jet:
    """f, f', f'' of a function of one variable."""

    f: float
    d: float = 0.0
    dd: float = 0.0

    @staticmethod
    def of(value: Jet | float) -> Jet:
        return value if isinstance(value, Jet) else Jet(float(value))

    def __add__(self, other: Jet | float) -> Jet:
        o = Jet.of(other)
        return Jet(self.f + o.f, self.d + o.d, self.dd + o.dd)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.f, -self.d, -self.dd)

    def __sub__(self, other: Jet | float) -> Jet:
        return self + (-Jet.of(other))

    def __rsub__(self, other: Jet | float) -> Jet:
        return Jet.of(other) - self

    def __mul__(self, other: Jet | float) -> Jet:
        o = Jet.of(other)
        return Jet(
            self.f * o.f, self.d * o.f + self.f * o.d, self.dd * o.f + 2.0 * self.d * o.d + self.f * o.dd
        )

    __rmul__ = __mul__

    def chain(self, value: float, slope: float, curvature: float) -> Jet:
        """g(self) from g, g', g'' at self.f."""
        return Jet(value, slope * self.d, slope * self.dd + curvature * self.d**2)

    def reciprocal(self) -> Jet:
        return self.chain(1.0 / self.f, -1.0 / self.f**2, 2.0 / self.f**3)

    def __truediv__(self, other: Jet | float) -> Jet:
        return self * Jet.of(other).reciprocal()

    def sqrt(self) -> Jet:
        root = math.sqrt(self.f)
        return self.chain(root, 0.5 / root, -0.25 / (self.f * root))

    def sin(self) -> Jet:
        return self.chain(math.sin(self.f), math.cos(self.f), -math.sin(self.f))

    def cos(self) -> Jet:
        return self.chain(math.cos(self.f), -math.sin(self.f), -math.cos(self.f))
