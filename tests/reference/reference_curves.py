"""Set-points: value and rate in time, from records (or a number, a constant):

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

Pair = tuple[float, float]


@dataclass(frozen=True)
class ReferenceCurve:
    """A curve t -> (value, rate) and the times at which the integrator must restart."""

    curve: Callable[[float], Pair]
    breaks: tuple[float, ...] = ()

    def __call__(self, t: float) -> Pair:
        return self.curve(t)


def quintic(start: float, end: float, t_start: float, t_end: float) -> ReferenceCurve:
    duration, rise = t_end - t_start, end - start

    def curve(t: float) -> Pair:
        u = min(max((t - t_start) / duration, 0.0), 1.0)
        value = u**3 * (10.0 - 15.0 * u + 6.0 * u * u)
        rate = 30.0 * u * u * (1.0 - u) ** 2
        return start + rise * value, rise * rate / duration

    return ReferenceCurve(curve, (t_start, t_end))


def cosine(mean: float, amplitude: float, period: float) -> ReferenceCurve:
    rate = 2.0 * math.pi / period

    def curve(t: float) -> Pair:
        return mean + amplitude * math.cos(rate * t), -amplitude * rate * math.sin(rate * t)

    return ReferenceCurve(curve)


def polynomials(starts: list[float], coefficients: list[list[float]]) -> ReferenceCurve:
    def curve(t: float) -> Pair:
        if t < starts[0]:
            return coefficients[0][0], 0.0
        i = bisect.bisect_right(starts, t) - 1
        s, value, rate = t - starts[i], 0.0, 0.0
        for c in reversed(coefficients[i]):
            rate = rate * s + value
            value = value * s + c
        return value, rate

    return ReferenceCurve(curve)


def sequence(switch: list[float], pieces: list[Any]) -> ReferenceCurve:
    curves = [from_record(piece) for piece in pieces]
    breaks = sorted({*switch, *(b for curve in curves for b in curve.breaks)})
    return ReferenceCurve(lambda t: curves[bisect.bisect_right(switch, t)](t), tuple(breaks))


def from_record(record: Any) -> ReferenceCurve:
    if isinstance(record, int | float):
        return ReferenceCurve(lambda t: (float(record), 0.0))
    fields = dict(record)
    makers = {"quintic": quintic, "cosine": cosine, "polynomials": polynomials, "sequence": sequence}
    return makers[fields.pop("kind")](**fields)
