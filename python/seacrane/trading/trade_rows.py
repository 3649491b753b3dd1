"""The rows of a trade: one method, or one scene with less physics, against the reference."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.accuracy.quantities import Quantity, compare
from seacrane.analysis.drag_in_sea import drag_in_components
from seacrane.analysis.frequency_domain import response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.description.crane_parts import hooks, payloads
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.frames import heading_of, rotation_matrix
from seacrane.result.result import Result
from seacrane.run.method import Method
from seacrane.scene.scene import Scene
from seacrane.trading import simpler_scenes
from seacrane.trading.case import Case
from seacrane.trading.measured_case import channels_of, measured, timed, values_by
from seacrane.trading.methods import TIGHT
from seacrane.trading.reference import Reference, reference
from seacrane.trading.row import COMPLETED, REFUSED, Row
from seacrane.validity.after_run import require_finite

Array = NDArray[np.float64]
LONG = 0.3  # s of wall time from which on one run tells the cost


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


def tight_reference(case: Case, quantities: Mapping[str, Quantity]) -> Reference:
    """A tight run and its check, in another formulation and by another method; the first is the reference.

    Raises SceneError if fewer than two of them work: a reference without a second opinion is none.
    """

    def run(method: Method) -> Mapping[str, Array] | str:
        try:
            done = timed(case, method, channels_of(quantities))
            if done.stopped is not None:
                return str(done.stopped)
            return {
                name: quantity.values(require_finite(done.result())) for name, quantity in quantities.items()
            }
        except SeacraneError as error:
            return str(error)

    found = reference(run, TIGHT, enough=math.inf)
    if len(found.runs) < 2:
        raise SceneError(
            f"scene {case.scene.name!r}: only {len(found.runs)} of {len(TIGHT)} reference runs work, and one "
            f"cannot be checked: {'; '.join(found.refused.values())}"
        )
    return found


def measure(bench: Bench, row: Row, *, scene: Scene | None = None, limit_s: float | None = None) -> Row:
    """The row of a method, on the full scene or on one with less physics, filled in.

    `limit_s` is the processor time that it may take, s.
    """
    case = bench.case if scene is None else replace(bench.case, scene=scene)
    before = (0.0, 0.0)
    values = None
    try:
        if row.case["rung"] == simpler_scenes.WEIGHT:
            values = partial(_values_of_weight, bench.quantities, case.scene)
            case = replace(case, scene=simpler_scenes.payload_as_weight(case.scene))
        elif row.case["rung"] == simpler_scenes.PRESCRIBED:
            case, before = _prescribed(bench, case, row.method)
    except SeacraneError as error:
        return row.ended(REFUSED, error)
    done = measured(
        case, row.method, bench.quantities, bench.truth, row, values=values,
        repeats=bench.repeats, long_s=LONG, limit_s=limit_s,
    )  # fmt: skip
    return replace(done, wall_s=done.wall_s + before[0], cpu_s=done.cpu_s + before[1])


def measure_variant(bench: Bench, variant: simpler_scenes.Variant, row: Row) -> Row:
    """As `measure`, of a scene that has yet to be made; a fitted memory is named by its states."""
    try:
        scene = variant.build()
    except (SeacraneError, ValueError) as error:
        return row.ended(REFUSED, error)
    memory = simpler_scenes.full_memory_name(scene, variant.memory)
    return measure(bench, replace(row, case={**row.case, "memory": memory}), scene=scene)


def _prescribed(bench: Bench, case: Case, method: Method) -> tuple[Case, tuple[float, float]]:
    """The case with the vessel's motion of a locked crane prescribed; wall and CPU time of finding it, s."""
    alone = replace(case, scene=simpler_scenes.locked(case.scene))
    done = timed(alone, method, ["vessel_motion"], repeats=bench.repeats, long_s=LONG)
    if done.stopped is not None:
        raise SceneError(str(done.stopped))
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


def frequency_domain(bench: Bench, row: Row) -> Row:
    """The row of the linear model about the described pose, in its steady state under the same waves."""
    case, truth = bench.case, bench.truth.values
    begun, ticks = time.perf_counter(), time.thread_time()
    try:
        values = _linear_values(case, truth)
    except (SeacraneError, ValueError) as error:
        return row.ended(REFUSED, error)
    errors = {name: compare(truth[name], value) for name, value in values.items()}
    left_out = [name for name in bench.quantities if name not in errors]
    done = replace(
        row,
        stepped="linear",
        wall_s=time.perf_counter() - begun,
        cpu_s=time.thread_time() - ticks,
        simulated_s=case.t_end,
        errors=errors,
        uncertainty=bench.truth.uncertainty,
        motion=bench.truth.motion,
    )
    return done.ended(COMPLETED, f"has no {', '.join(left_out)}" if left_out else "")


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
