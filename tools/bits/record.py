"""Runs a case by each of its methods, and keeps of each channel a digest and a few numbers."""

from __future__ import annotations

import hashlib
import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bits.case import CASES, Case, Settings
from seacrane import Result, Scene, ensemble, simulate
from seacrane.description.channels import CHANNELS, DERIVED
from seacrane.description.description import all_loads
from seacrane.description.loads import kind_of
from seacrane.run.channel_names import core_channels, missing_names

Record = dict[str, Any]
COSTLY = {"slack_margin", "utilisation"}  # look for a state at rest, or need a crane's table
# Fractional parts of multiples: nothing but products and remainders, which every machine rounds alike.
WEIGHTS = (0.6180339887498949, 0.41421356237309515)


@dataclass(frozen=True)
class Values:
    """One channel of a run."""

    unit: str
    dims: tuple[str, ...]
    array: NDArray[np.float64]


def recorded(name: str) -> Record:
    """What a case gives; of the runs by their methods."""
    import bits.scenes  # noqa: F401  fills the list

    case = CASES[name]
    with warnings.catch_warnings(action="ignore"):
        scene = case.build()
        kinds = sorted({kind_of(load) for load in all_loads(scene)})
        return {"loads": kinds, "runs": {label(method): _run(case, method) for method in case.methods}}


def label(method: Settings) -> str:
    lanes = f", {method['lanes']} lanes" if "lanes" in method else ""
    return f"{method['integrator']}, {method['formulation']}{lanes}"


def _run(case: Case, method: Settings) -> Record:
    values, axes = _members(case, method) if case.over else _channels(_result(case, method))
    channels = {name: kept(values[name]) for name in sorted(values)}
    return {"settings": case.settings(method), "axes": axes, "channels": channels}


def _result(case: Case, method: Settings) -> Result:
    scene = case.build()
    told: dict[str, Any] = {**method, "dt_out": case.dt_out, "start": case.start}
    if case.stages is not None:
        return simulate(scene, case.stages(), controllers=case.controllers, **told)
    return simulate(scene, case.t_end, controllers=case.controllers, channels=offered(scene), **told)


def offered(scene: Scene) -> list[str]:
    """All channels of a scene but those that cost more than the run."""
    known = scene.compile().channel_names(defaults_only=False)
    derived = [name for name in DERIVED if name not in COSTLY and set(DERIVED[name].made_of) & set(known)]
    without = missing_names(scene, derived)
    names = [*known, *(name for name in derived if name not in without)]
    return [name for name in names if core_channels(scene, [name], known)]


def _channels(result: Result) -> tuple[dict[str, Values], dict[str, list[str]]]:
    """Channels, times of outputs and of events, and the names along axes."""
    values = {
        name: Values(CHANNELS[name].unit, tuple(result.dims[name]), np.asarray(array))
        for name, array in result.items()
    }
    values["time"] = Values("s", ("time",), np.asarray(result.time))
    values["event_time"] = Values("s", ("event",), np.array([event.time for event in result.events]))
    return values, {dim: list(names) for dim, names in result.coords.items()}


def _members(case: Case, method: Settings) -> tuple[dict[str, Values], dict[str, list[str]]]:
    """What an ensemble keeps, and its parameters."""
    told: dict[str, Any] = {**method, "dt_out": case.dt_out}
    told |= {"t_end": case.t_end} if case.stages is None else {"stages": case.stages()}
    table = ensemble(
        case.build(), over=case.over or {}, keep=case.keep or {}, on_error="raise", **told
    ).dataset
    kept_here = {name: table[name] for name in case.keep or {}}
    values = {
        name: Values(str(one.attrs.get("units", "")), tuple(map(str, one.dims)), one.to_numpy().astype(float))
        for name, one in kept_here.items()
    }
    dims = {str(dim) for one in kept_here.values() for dim in one.dims}
    return values, {
        dim: [str(x) for x in table[dim].to_numpy()] for dim in sorted(dims) if dim in table.coords
    }


def kept(values: Values) -> Record:
    """Digest, ends, extremes and two weighted sums of one channel; numbers as hexadecimal floats."""
    flat = np.ascontiguousarray(values.array, dtype="<f8").ravel()
    flat = np.where(np.isnan(flat), np.nan, flat)  # one pattern of bits for all that is no number
    out: Record = {"unit": values.unit, "dims": list(values.dims), "shape": list(values.array.shape)}
    out["sha256"] = hashlib.sha256(flat.astype("<f8").tobytes()).hexdigest()
    finite = flat[np.isfinite(flat)]
    if finite.size < flat.size:
        out["not_finite"] = int(flat.size - finite.size)
    numbers: Mapping[str, float] = {}
    if flat.size:
        ends = (finite.min(), finite.max()) if finite.size else (math.nan, math.nan)
        numbers = {"first": flat[0], "last": flat[-1], "least": ends[0], "largest": ends[1]}
    sums = [_weighted(flat, step) for step in WEIGHTS]
    return out | {key: float(x).hex() for key, x in numbers.items()} | {"sums": [x.hex() for x in sums]}


def _weighted(flat: NDArray[np.float64], step: float) -> float:
    """The sum, rounded once, of what is finite times the fractional parts of multiples of a step."""
    weights = (np.arange(1, flat.size + 1) * step) % 1.0
    return math.fsum((weights * np.where(np.isfinite(flat), flat, 0.0)).tolist())
