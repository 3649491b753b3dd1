"""The six motions of a ship from the file of a motion sensor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import texts_of
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.shown import listed
from seacrane.series.measured_series import MeasuredSeries
from seacrane.series.series_file import heading_of

Array = NDArray[np.float64]
COMPASS = ("heading", "hdg")


def recorded_motion(
    path: str | PathLike[str],
    *,
    zero: Sequence[str],
    negated: Sequence[str],
    columns: Mapping[str, str] | None,
    reading: Mapping[str, Any],
) -> tuple[Array, Array, str]:
    """Times (n,) from 0 on, motions (n, 6), and what was done in words, as `MotionHistory.load` tells it."""
    still, turned = _motions("zero", zero), _motions("negated", negated)
    if columns is not None and not isinstance(columns, Mapping):
        raise SceneError("columns is no mapping; give the names in the file by those of the motions")
    unknown = sorted(set(columns or {}) - {*MOTIONS, "time"})
    if unknown:
        raise SceneError(f"columns names {listed(unknown)}; give names for time and for {', '.join(MOTIONS)}")
    usual = {name: ("yaw", *COMPASS) if name == "yaw" else name for name in MOTIONS if name not in still}
    series = MeasuredSeries.load(path, columns={**usual, **(columns or {})}, **reading)
    _require_units(path, series)
    motion = np.zeros((series.time.size, 6))
    told = [series.told]
    for name, values in series.columns.items():
        column = MOTIONS.index(name)
        motion[:, column] = values
        if name == "yaw" and set(COMPASS) & set(heading_of(0, series.headers[name]).name.split()):
            motion[:, column] = values.mean() - values
            mean = np.degrees(values.mean()) % 360.0
            told.append(f"yaw against the compass heading, from its mean of {mean:.1f} deg")
    motion[:, [MOTIONS.index(name) for name in turned]] *= -1.0
    told += [f"{', '.join(turned)} with the other sign"] * bool(turned)
    told += [f"{', '.join(still)} zero"] * bool(still)
    return series.time - series.time[0], motion, "; ".join(told)


def _motions(what: str, names: Sequence[str]) -> list[str]:
    found = texts_of(what, names)
    unknown = [one for one in found if one not in MOTIONS]
    if unknown:
        raise SceneError(f"{what} holds {listed(unknown)}; give some of {', '.join(MOTIONS)}")
    return found


def _require_units(path: str | PathLike[str], series: MeasuredSeries) -> None:
    for name, unit in series.units.items():
        due = "m" if MOTIONS.index(name) < 3 else "rad"
        if unit != due:
            raise FileFormatError(
                f"{fspath(path)}: column {series.headers[name]!r} is in {unit}, and {name} in {due} or a "
                f"unit of its kind; give the right column or unit: columns={{{name!r}: ...}}, "
                f"units={{{name!r}: ...}}"
            )
