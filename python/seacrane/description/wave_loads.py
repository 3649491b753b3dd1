"""The loads of a sea on its vessels, as the core takes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.wave_selection import without_negligible
from seacrane.description.wave_series import drift_table, wave_table
from seacrane.description.waves import HullLoads, Waves
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of

EVALUATIONS = ("table", "exact", "fft")


def compiled_waves(waves: Waves, *, prune: bool = True) -> list[_core.WaveLoads]:
    """The loads for the compiled core; raises SceneError for shapes or values that make no sense.

    `prune` leaves out the components that are negligible.
    """
    bodies = [text_of("waves: body", body) for body in waves.hulls]
    try:
        sea = without_negligible(waves) if prune else waves
    except (TypeError, ValueError) as error:
        raise SceneError(f"waves on {', '.join(map(repr, bodies))}: {error}") from error
    return [_loads_on(sea, body) for body in bodies]


def _loads_on(waves: Waves, body: str) -> _core.WaveLoads:
    hull = waves.hulls[body]
    try:
        loads = _mean(waves, hull) if hull.force_by_heading is None else _positioned(waves, hull)
    except (TypeError, ValueError) as error:
        raise SceneError(f"waves on {body!r}: {error}") from error
    return _core.WaveLoads(name=f"waves on {body}", body=body, **loads)


def _positioned(waves: Waves, hull: HullLoads) -> dict[str, Any]:
    force, drift = hull.force_by_heading, hull.drift_by_heading
    if force is None or (hull.drift is not None and drift is None):
        raise ValueError("drift at the actual position needs drift_by_heading")
    if waves.evaluation == "fft":
        raise ValueError("loads at the actual or slow position have no table; choose evaluation='exact'")
    slow: dict[str, Any] = {}
    if drift is not None:
        slow = {"drift_headings": np.asarray(drift.heading).tolist(), "drift": drift.values}
    positioned = _core.PositionedWaveLoad(
        waves.components(),
        headings=np.asarray(force.heading).tolist(),
        transfer=force.values,
        cutoff=hull.cutoff,
        **slow,
    )
    return {"positioned": positioned}


def _mean(waves: Waves, hull: HullLoads) -> dict[str, Any]:
    if waves.evaluation not in EVALUATIONS:
        raise ValueError(f"evaluation is {waves.evaluation!r}; choose {', '.join(EVALUATIONS)}")
    sea, position = waves.components(), hull.position
    loads: dict[str, Any] = {
        "exact": _core.ExactWaveLoad(sea, transfer=hull.transfer, position=position, elevation_point=position)
    }
    if hull.drift is not None:
        loads["drift"] = _core.DriftLoad(sea, coefficient=hull.drift, position=position)
    if waves.evaluation == "exact":
        return loads
    bound = waves.relative_bound
    if waves.evaluation == "fft":
        loads["table"] = wave_table(waves, hull, loads["exact"])
        if hull.drift is not None:
            loads["drift_table"] = drift_table(waves, hull, loads["drift"])
        return loads
    loads["table"] = _core.WaveTable(loads["exact"], relative_bound=bound)
    if hull.drift is not None:
        loads["drift_table"] = _core.DriftTable(loads["drift"], relative_bound=bound)
    return loads
