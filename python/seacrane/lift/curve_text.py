"""Curves as a lift file writes them: a number, a piece, or pieces that take over from each other."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from seacrane._core import Curve
from seacrane.description.curves import spline_curve
from seacrane.errors import SceneError
from seacrane.lift.keys import into_si
from seacrane.lift.tables import CURVES
from seacrane.scene.wind_current import gust_curve

Scale = Callable[[Any], Any]
LONGEST_GUST = 1e7  # s times components: fourteen hours of the usual 200


def curve_from(given: Any, unit: str) -> float | Curve:
    """A curve in SI from what a file holds; a number stays one.

    Parameters
    ----------
    given : float, mapping, or tuple of mapping
        Checked.
    unit : Of its values.

    Raises SceneError for a curve that makes no sense.
    """
    scale = into_si(unit)
    if isinstance(given, float):
        return float(scale(given))
    first, *others = (given,) if isinstance(given, Mapping) else given
    curve = _piece(first, scale)
    for piece in others:
        curve = curve.then(time=piece["from_s"], curve=_piece(piece, scale))
    return curve


def _piece(piece: Mapping[str, Any], scale: Scale) -> Curve:
    arguments: dict[str, Any] = {}
    for key in CURVES[piece["kind"]]:
        for spelling, unit in key.spellings.items():
            if spelling in piece:
                own = into_si(unit) if unit else scale
                arguments[key.name] = own(piece[spelling])
    return _MAKE[piece["kind"]](**arguments)


def _harmonic(*, amplitude: float, period: float, **others: float) -> Curve:
    if not period > 0.0:
        raise SceneError(f"curve: period_s is {period:g}; give a period above zero")
    return Curve.harmonic(amplitude=amplitude, omega=2.0 * np.pi / period, **others)


def _spline(*, times: Any, values: Any) -> Curve:
    try:
        return spline_curve(times=times, values=values)
    except np.linalg.LinAlgError as error:
        raise SceneError(f"curve: no spline leads through its samples ({error}); space them out") from error


def _gust(*, duration: float, count: int = 200, **others: Any) -> Curve:
    if duration * count > LONGEST_GUST:
        raise SceneError(
            f"curve: duration_s is {duration:g} with count {count}; their product may be {LONGEST_GUST:g} s"
        )
    return gust_curve(duration=duration, count=count, **others)


_MAKE: Mapping[str, Callable[..., Curve]] = {
    "constant": Curve.constant,
    "quintic": Curve.quintic,
    "harmonic": _harmonic,
    "spline": _spline,
    "gust": _gust,
    "table": Curve.table,
}
