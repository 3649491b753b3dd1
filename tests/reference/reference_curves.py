"""Prescribed coordinates and set-points: value, rate and acceleration as functions of time.

Records (or a plain number, a constant):

- ``{"kind": "quintic", "start": a, "end": b, "t_start": t0, "t_end": t1}``  (rest to rest, held outside)
- ``{"kind": "cosine", "mean": m, "amplitude": a, "period": T}``  m + a cos(2 pi t / T)
- ``{"kind": "polynomials", "starts": [t0, ...], "coefficients": [[c0, ..., c5], ...]}``  of t - start, each
  piece from its start on; the first value is held before
- ``{"kind": "sequence", "switch": [t1, ...], "pieces": [curve, curve, ...]}``  piece k holds from switch k-1
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class ReferenceCurve:
    """A curve t -> (value, rate, acceleration) and the times at which the integrator must restart."""

    curve: Callable[[float], Triple]
    breaks: tuple[float, ...] = ()

    def __call__(self, t: float) -> Triple:
        return self.curve(t)


def quintic(start: float, end: float, t_start: float, t_end: float) -> ReferenceCurve:
    """Rest-to-rest polynomial of degree five with zero acceleration at both ends."""
    duration, rise = t_end - t_start, end - start

    def curve(t: float) -> Triple:
        u = min(max((t - t_start) / duration, 0.0), 1.0)
        value = u**3 * (10.0 - 15.0 * u + 6.0 * u * u)
        rate = 30.0 * u * u * (1.0 - u) ** 2
        acceleration = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u)
        return start + rise * value, rise * rate / duration, rise * acceleration / duration**2

    return ReferenceCurve(curve, (t_start, t_end))


def cosine(mean: float, amplitude: float, period: float) -> ReferenceCurve:
    rate = 2.0 * math.pi / period

    def curve(t: float) -> Triple:
        c, s = math.cos(rate * t), math.sin(rate * t)
        return mean + amplitude * c, -amplitude * rate * s, -amplitude * rate * rate * c

    return ReferenceCurve(curve)


def polynomials(starts: list[float], coefficients: list[list[float]]) -> ReferenceCurve:
    """Pieces of polynomials that join smoothly."""

    def curve(t: float) -> Triple:
        if t < starts[0]:
            return coefficients[0][0], 0.0, 0.0
        i = bisect.bisect_right(starts, t) - 1
        s, value, rate, half = t - starts[i], 0.0, 0.0, 0.0
        for c in reversed(coefficients[i]):
            half = half * s + rate
            rate = rate * s + value
            value = value * s + c
        return value, rate, 2.0 * half

    return ReferenceCurve(curve)


def sequence(switch: list[float], pieces: list[Any]) -> ReferenceCurve:
    """Piece k from time switch[k-1] (included) to switch[k]."""
    curves = [from_record(piece) for piece in pieces]
    breaks = sorted({*switch, *(b for curve in curves for b in curve.breaks)})
    return ReferenceCurve(lambda t: curves[bisect.bisect_right(switch, t)](t), tuple(breaks))


def from_record(record: Any) -> ReferenceCurve:
    """From a number, or a record as in the module's description."""
    if isinstance(record, int | float):
        return ReferenceCurve(lambda t: (float(record), 0.0, 0.0))
    fields = dict(record)
    makers: dict[str, Callable[..., ReferenceCurve]] = {
        "quintic": quintic, "cosine": cosine, "polynomials": polynomials, "sequence": sequence,
    }  # fmt: skip
    return makers[fields.pop("kind")](**fields)
