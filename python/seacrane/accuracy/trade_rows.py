"""The rows of a trade: one method, or one scene with less physics, against the reference."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.accuracy import simpler_scenes
from seacrane.accuracy.case import Case, timed
from seacrane.accuracy.measured import Reference, measured, values_by, with_errors
from seacrane.accuracy.methods import LINES, PHYSICS
from seacrane.accuracy.quantities import Quantity
from seacrane.accuracy.row import REFUSED, Row
from seacrane.analysis.drag_in_sea import drag_in_components
from seacrane.analysis.frequency_domain import response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.description.crane_parts import hooks, payloads
from seacrane.errors import SeacraneError
from seacrane.inputs.frames import heading_of, rotation_matrix
from seacrane.result.result import Result
from seacrane.run.method import Method
from seacrane.scene.scene import Scene
from seacrane.validity.after_run import require_finite

Array = NDArray[np.float64]
Task = tuple[
    Row, simpler_scenes.Build | None
]  # a row to be filled in, and what makes its scene with less physics
LONG = 0.3  # s of wall time from which on one run tells the cost
LINEAR = Method(integrator="none")  # the frequency domain has no integrator


@dataclass(frozen=True, kw_only=True, eq=False)
class Bench:
    """What every row of a trade is measured with.

    Attributes
    ----------
    case : The full scene.
    quantities : mapping of str to Quantity
    repeats : Equal runs; the quickest counts.
    """

    case: Case
    quantities: Mapping[str, Quantity]
    truth: Reference
    repeats: int


def physics(bench: Bench, *, quick: bool) -> Iterator[Task]:
    """Each scene with less physics, all by the same method; rungs of lines by several."""
    for case, build in simpler_scenes.variants(bench.case.scene, quick=quick):
        for method in _of_rung(case["rung"], quick=quick):
            yield Row(case=case, method=method), build


def _of_rung(rung: str, *, quick: bool) -> Sequence[Method]:
    if rung == simpler_scenes.LINEAR:
        return (LINEAR,)
    if rung in simpler_scenes.LINE_RUNGS:
        return LINES[1::2] if quick else LINES
    return (Method(),) if quick else (PHYSICS,)


def measure(
    bench: Bench, row: Row, build: simpler_scenes.Build | None = None, limit_s: float | None = None
) -> Row:
    """The row filled in; a fitted memory is named by its states.

    Parameters
    ----------
    build : callable, optional
        Makes a scene with less physics; default: the full one.
    limit_s : Processor time that a run of the full scene may take, s.
    """
    case, before, values = bench.case, (0.0, 0.0), None
    try:
        if build is not None:
            limit_s, case = None, replace(case, scene=build())
            memory = simpler_scenes.full_memory_name(case.scene, str(row.case["memory"]))
            row = replace(row, case={**row.case, "memory": memory})
        if row.case["rung"] == simpler_scenes.LINEAR:
            return _frequency_domain(bench, row)
        if row.case["rung"] == simpler_scenes.WEIGHT:
            values = partial(_values_of_weight, bench.quantities, bench.case.scene)
        elif row.case["rung"] == simpler_scenes.PRESCRIBED:
            case, before = _prescribed(bench, case, row.method)
    except (SeacraneError, ValueError) as error:
        return row.ended(REFUSED, error)
    done = measured(
        case, row.method, bench.quantities, bench.truth, row, values=values,
        repeats=bench.repeats, long_s=LONG, limit_s=limit_s,
    )  # fmt: skip
    return replace(done, wall_s=done.wall_s + before[0], cpu_s=done.cpu_s + before[1])


def _prescribed(bench: Bench, case: Case, method: Method) -> tuple[Case, tuple[float, float]]:
    """The case with the vessel's motion of a locked crane prescribed; wall and CPU time of finding it, s."""
    alone = replace(case, scene=simpler_scenes.locked(case.scene))
    done = timed(alone, method, ["vessel_motion"], repeats=bench.repeats, long_s=LONG)
    result = require_finite(done.result())
    driven = simpler_scenes.with_prescribed_vessel(case.scene, result.time, result["vessel_motion"])
    return replace(case, scene=driven), (done.wall_s, done.cpu_s)


def _values_of_weight(
    quantities: Mapping[str, Quantity], scene: Scene, result: Result
) -> Mapping[str, Array]:
    """Tension is the weight; each payload hangs plumb under its tip."""
    links = [scene.joints[link] for link in hooks(scene).values()]
    found = [_under_the_tip(scene, result, link) for link in links]
    out = {name: np.stack([one[name] for one in found], axis=1) for name in found[0]}
    if [link.second for link in links] != list(payloads(scene).values()):
        del out["payload_position"]
    return {**values_by(quantities)(result), **out}


def _under_the_tip(scene: Scene, result: Result, link: _core.Joint) -> dict[str, Array]:
    """What `_values_of_weight` returns for one payload, each of shape (n, parts)."""
    payload, body = scene.bodies[link.second], scene.bodies[link.first]
    turn = rotation_matrix(result.select("quaternion", body=link.first))
    lever = np.asarray(link.first_frame.point) - np.asarray(body.center_of_mass)
    tip = result.select("position", body=link.first) + turn @ lever
    below = link.length + float(link.second_frame.point[2] - payload.center_of_mass[2])
    return {
        "hook_load": np.full((len(tip), 1), payload.mass * scene.gravity),
        "payload_position": tip - np.array([0.0, 0.0, below]),
    }


def _frequency_domain(bench: Bench, row: Row) -> Row:
    """The row of the linear model about the described pose, in its steady state under the same waves."""
    begun, ticks = time.perf_counter(), time.thread_time()
    values = _linear_values(bench.case, bench.truth.values)
    done = replace(
        row, stepped="linear", wall_s=time.perf_counter() - begun, cpu_s=time.thread_time() - ticks,
        simulated_s=bench.case.t_end, uncertainty=bench.truth.uncertainty,
    )  # fmt: skip
    return with_errors(done, values, bench.truth, bench.quantities)


def _linear_values(case: Case, truth: Mapping[str, Array]) -> dict[str, Array]:
    scene = case.scene
    hulls = {} if scene.waves is None else scene.waves.hulls
    linear = linear_model(scene, vessel=next(iter(hulls), None))
    if scene.waves is not None:
        linear = drag_in_components(linear, scene.waves)
    times: Array = case.dt_out * np.arange(len(next(iter(truth.values()))), dtype=float)
    values: dict[str, Array] = {}
    if "roll" in truth:
        rolls = [_roll(linear, vessel.body, times) for vessel in scene.vessels.values()]
        values["roll"] = np.stack(rolls, axis=1)[:, :, None]
    if "payload_position" in truth:
        start = truth["payload_position"][0]
        bodies = payloads(scene).values()
        moved = [response_summed(linear, body=body).at(times)[:, :3] for body in bodies]
        values["payload_position"] = start + np.stack(moved, axis=1)
    return values


def _roll(linear: LinearModel, body: str, times: Array) -> Array:
    """The roll of a vessel about its own axis, rad."""
    heading = heading_of(linear.scene.bodies[body].quaternion)
    rotation = response_summed(linear, body=body).at(times)[:, 3:]
    return np.asarray(np.cos(heading) * rotation[:, 0] + np.sin(heading) * rotation[:, 1])
