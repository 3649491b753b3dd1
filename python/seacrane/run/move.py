"""Commands of a stage: where a reference goes from where it is, and in what time."""

from __future__ import annotations

from dataclasses import dataclass

from seacrane._core import Curve
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of
from seacrane.inputs.keywords import named


@named
@dataclass(frozen=True, kw_only=True)
class Move:
    """A smooth way of a commanded value from where it is to another, held from there on.

    A quintic that takes over value, rate and acceleration as they are, and arrives at rest.

    Attributes
    ----------
    to : float, optional
        Where to, in the unit of what is commanded (m, rad, N, N m or m/s).
    by : float, optional
        How far from the present value, instead of `to`.
    over : float
        s.

    Raises
    ------
    SceneError
    """

    to: float | None = None
    by: float | None = None
    over: float

    def __post_init__(self) -> None:
        if (self.to is None) == (self.by is None):
            raise SceneError(f"move: to is {self.to} and by is {self.by}; give one of them")
        for name in ("to", "by", "over"):
            value = getattr(self, name)
            if value is None:
                continue
            number = finite_of(f"move: {name}", value)
            object.__setattr__(self, name, number)
        if not self.over > 0.0:
            raise SceneError(f"move: over is {self.over:g} s; give the positive time that it takes")

    def from_where_it_is(self, curve: Curve, time: float) -> Curve:
        """The curve until a time (s), and this move from there."""
        value, rate, acceleration = curve.evaluate([time])[0]
        end = self.to if self.to is not None else value + self.by
        start = [value, rate, 0.5 * acceleration, *_closing(end - value, rate, acceleration, self.over)]
        hold = [end, 0.0, 0.0, 0.0, 0.0, 0.0]
        move = Curve.pieces(starts=[time, time + self.over], coefficients=[start, hold])
        return curve.then(time=time, curve=move)


def _closing(way: float, rate: float, acceleration: float, over: float) -> list[float]:
    """Coefficients 3 to 5 of the quintic that arrives at rest."""
    left = way - rate * over - 0.5 * acceleration * over**2
    slope = -rate - acceleration * over
    return [
        (10.0 * left - 4.0 * slope * over - 0.5 * acceleration * over**2) / over**3,
        (-15.0 * left + 7.0 * slope * over + acceleration * over**2) / over**4,
        (6.0 * left - 3.0 * slope * over - 0.5 * acceleration * over**2) / over**5,
    ]
