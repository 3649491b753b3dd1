"""Prescribed coordinates and set-points: value, rate and acceleration as functions of time.

Records (all of them also accepted as a plain number, meaning a constant):

- ``{"kind": "constant", "value": v}``
- ``{"kind": "quintic", "start": a, "end": b, "t_start": t0, "t_end": t1}``  (rest to rest, held outside)
- ``{"kind": "cosine", "mean": m, "amplitude": a, "period": T, "phase": p}``  m + a cos(2 pi t / T + p)
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
Curve = Callable[[float], Triple]


@dataclass(frozen=True)
class ReferenceCurve:
    """A curve t -> (value, rate, acceleration) and the times at which the integrator must restart."""

    curve: Curve
    breaks: tuple[float, ...] = ()

    def __call__(self, t: float) -> Triple:
        return self.curve(t)


def constant(value: float) -> ReferenceCurve:
    """The same value for ever."""
    return ReferenceCurve(lambda t: (value, 0.0, 0.0))


def quintic(start: float, end: float, t_start: float, t_end: float) -> ReferenceCurve:
    """Rest-to-rest polynomial of degree five with zero acceleration at both ends."""
    duration, rise = t_end - t_start, end - start
    if not duration > 0.0:
        raise ValueError(f"quintic from t_start={t_start} to t_end={t_end}: t_end must be later")

    def curve(t: float) -> Triple:
        u = min(max((t - t_start) / duration, 0.0), 1.0)
        value = u**3 * (10.0 - 15.0 * u + 6.0 * u * u)
        rate = 30.0 * u * u * (1.0 - u) ** 2
        acceleration = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u)
        return start + rise * value, rise * rate / duration, rise * acceleration / duration**2

    return ReferenceCurve(curve, (t_start, t_end))


def cosine(mean: float, amplitude: float, period: float, phase: float = 0.0) -> ReferenceCurve:
    """Harmonic motion about a mean."""
    rate = 2.0 * math.pi / period

    def curve(t: float) -> Triple:
        c, s = math.cos(rate * t + phase), math.sin(rate * t + phase)
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


def sequence(switch: list[float], pieces: list[ReferenceCurve]) -> ReferenceCurve:
    """Piece k from time switch[k-1] (included) to switch[k]."""
    if len(pieces) != len(switch) + 1 or sorted(switch) != list(switch):
        raise ValueError(
            f"sequence with switch times {switch} needs them rising and one more piece than times"
        )
    breaks = sorted({*switch, *(b for piece in pieces for b in piece.breaks)})
    return ReferenceCurve(lambda t: pieces[bisect.bisect_right(switch, t)](t), tuple(breaks))


def from_record(record: Any) -> ReferenceCurve:
    """Build a curve from a number, a record as in the module's description, a curve, or a callable."""
    if isinstance(record, ReferenceCurve):
        return record
    if isinstance(record, (int, float)):
        return constant(float(record))
    if callable(record):
        return ReferenceCurve(record)
    fields = dict(record)
    kind = fields.pop("kind", None)
    if kind == "sequence":
        return sequence(list(fields["switch"]), [from_record(piece) for piece in fields["pieces"]])
    makers: dict[str, Callable[..., ReferenceCurve]] = {
        "constant": constant,
        "quintic": quintic,
        "cosine": cosine,
        "polynomials": polynomials,
    }
    if kind not in makers:
        raise ValueError(f"reference curve kind {kind!r} is unknown; use one of {[*makers, 'sequence']}")
    return makers[kind](**fields)
