"""Areas of hydraulic cylinders, and the pressure that a force takes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.errors import SceneError
from seacrane.inputs.checked import shaped_of
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]
Areas = tuple[float, float]  # full side and rod side, m2


def areas_of(what: str, given: Any) -> Areas:
    """Full side and rod side of a piston, m2; SceneError for what is no cylinder."""
    full, ring = (float(value) for value in shaped_of(f"{what}: areas", given, (2,)))
    if not (np.isfinite(full) and 0.0 < ring <= full):
        raise SceneError(
            f"{what}: areas are {full:g} and {ring:g} m2; give the full side and then the rod side, which is "
            "above zero and not larger"
        )
    return full, ring


def areas_by_label(what: str, given: Any, cylinders: Mapping[str, str]) -> dict[str, Areas]:
    """Areas by the labels of cylinders."""
    if not isinstance(given, Mapping):
        raise SceneError(f"{what}: areas are {shown(given)}; give {{label: (full side, rod side)}}, m2")
    for label in given:
        if label not in cylinders:
            raise SceneError(
                f"{what}: areas are given of cylinder {label!r}; the cylinders are "
                f"{', '.join(map(repr, cylinders)) or 'none'}"
            )
    return {label: areas_of(f"{what}: cylinder {label!r}", pair) for label, pair in given.items()}


def pressure(force: ArrayLike, areas: Areas) -> Array:
    """Pressure (Pa) over the other chamber's, of the chamber that carries a force (N; positive pushes).

    Positive: on the full side. Negative: on the rod side. The other chamber counts as relieved.
    """
    loads = np.asarray(force, dtype=float)
    return np.asarray(np.where(loads >= 0.0, loads / areas[0], loads / areas[1]))
