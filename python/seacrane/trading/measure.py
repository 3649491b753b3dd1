"""Run one setting or one rung, and measure its cost and its error."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.crane_parts import hooks, payloads
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.frames import heading_of, rotation_matrix
from seacrane.run.method import Method
from seacrane.run.simulation import simulate
from seacrane.trading import rungs
from seacrane.trading.quantities import Quantity, compare
from seacrane.trading.rows import NOT_DEFINED, Row
from seacrane.trading.settings_grid import TIGHT

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.analysis.linear_system import LinearModel
    from seacrane.result import Result
    from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
LONG = 0.3  # s of wall time from which on one run tells the cost
CHECKS = ("constraint_error_before_projection", "energy_balance", "absolute_work")


@dataclass(frozen=True, kw_only=True)
class Span:
    """What every run of a trade has in common."""

    t_end: float
    dt_out: float
    repeats: int
    quantities: Mapping[str, Quantity]

    def run(self, scene: Scene, setting: Method, *, repeats: int | None = None, **also: Any) -> Result:
        """The quickest of equal runs, recording what the quantities need."""
        wanted = {channel for quantity in self.quantities.values() for channel in quantity.channels}
        wanted |= {*CHECKS, *also.pop("channels", ())}
        channels = [name for name in wanted if name in _offered(scene)]
        best: Result | None = None
        for _ in range(self.repeats if repeats is None else repeats):
            result = simulate(
                scene, t_end=self.t_end, dt_out=self.dt_out, channels=channels, **setting.arguments()
            )
            if result.interrupted:
                raise KeyboardInterrupt
            if best is None or wall(result) < wall(best):
                best = result
            if wall(best) > LONG:
                break
        assert best is not None
        return best


def wall(result: Result) -> float:
    """Wall time of the loop, s."""
    return float(result.stats["wall_s"])


def _offered(scene: Scene) -> set[str]:
    from seacrane.run.channel_names import CRANE_CHANNELS

    known = set(scene.compile().channel_names(defaults_only=False))
    return known | {name for name, parts in CRANE_CHANNELS.items() if set(parts) & known}


@dataclass(frozen=True, kw_only=True)
class Reference:
    """The tight runs: values by quantity, their uncertainty, and the runs that did not work."""

    values: Mapping[str, Array]
    uncertainty: Mapping[str, float]
    runs: tuple[str, ...]
    refused: Mapping[str, str]


def reference(scene: Scene, span: Span) -> Reference:
    """Tight runs in two formulations and with two methods; the first is the reference.

    Raises
    ------
    SceneError
        If fewer than two of them work: a reference without a second opinion is none.
    """
    runs: dict[str, dict[str, Array]] = {}
    refused: dict[str, str] = {}
    for setting in TIGHT:
        try:
            result = span.run(scene, setting, repeats=1)
        except SeacraneError as error:
            refused[setting.name] = str(error)
            continue
        runs[setting.name] = {key: quantity.values(result) for key, quantity in span.quantities.items()}
    if len(runs) < 2:
        raise SceneError(
            f"scene {scene.name!r}: only {len(runs)} of {len(TIGHT)} reference runs work, and one cannot be "
            f"checked: {'; '.join(refused.values())}"
        )
    first, *others = runs.values()
    spread = {
        name: max(compare(first[name], run[name]).largest for run in others) for name in span.quantities
    }
    return Reference(values=first, uncertainty=spread, runs=tuple(runs), refused=refused)


def measure(scene: Scene, setting: Method, span: Span, truth: Mapping[str, Array], row: Row) -> Row:
    """The row of a numerical setting or of a scene with one thing changed, filled in."""
    from dataclasses import replace

    try:
        result, before = _run(scene, setting, span, row.rung)
        if not all(np.isfinite(values).all() for values in result.channels.values()):
            return replace(row, reason="the run ended with values that are not finite")
        values = {name: _values(quantity, result) for name, quantity in span.quantities.items()}
        if row.rung == rungs.WEIGHT:
            values |= _of_weight(scene, result)
    except SeacraneError as error:
        return replace(row, reason=" ".join(str(error).split()))
    errors = {name: compare(truth[name], v) for name, v in values.items() if v is not None and name in truth}
    left_out = [name for name in span.quantities if name not in errors]
    return replace(
        row,
        formulation=str(result.stats["formulation"]),
        wall_s=wall(result) + before,
        simulated_s=float(result.stats["simulated_s"]),
        evaluations=int(result.stats["evaluations"]),
        errors=errors,
        drift=_drift(result),
        energy=_energy(result),
        stable=True,
        reason=f"has no {', '.join(left_out)}" if left_out else "",
    )


def measure_variant(
    variant: rungs.Variant, setting: Method, span: Span, truth: Mapping[str, Array], row: Row
) -> Row:
    """As `measure`, of a scene that has yet to be made; a fitted memory is named by its states."""
    from dataclasses import replace

    try:
        scene = variant.build()
    except (SeacraneError, ValueError) as error:
        return replace(row, reason=" ".join(str(error).split()))
    return measure(
        scene, setting, span, truth, replace(row, memory=rungs.full_memory_name(scene, row.memory))
    )


def _run(scene: Scene, setting: Method, span: Span, rung: str) -> tuple[Result, float]:
    """The run, and the wall time of a run that it rests on (s)."""
    if rung == rungs.WEIGHT:
        return span.run(rungs.payload_as_weight(scene), setting), 0.0
    if rung != rungs.PRESCRIBED:
        return span.run(scene, setting), 0.0
    alone = span.run(rungs.locked(scene), setting, channels=("vessel_motion",))
    driven = rungs.with_prescribed_vessel(scene, alone.time, alone["vessel_motion"])
    return span.run(driven, setting), wall(alone)


def _values(quantity: Quantity, result: Result) -> Array | None:
    """None where the changed scene has no such quantity."""
    try:
        return quantity.values(result)
    except (KeyError, ValueError):
        return None


def _of_weight(scene: Scene, result: Result) -> dict[str, Array]:
    """Tension is the weight; each payload hangs plumb under its tip."""
    links = [scene.joints[link] for link in hooks(scene).values()]
    found = [_under_the_tip(scene, result, link) for link in links]
    out = {name: np.stack([one[name] for one in found], axis=1) for name in found[0]}
    if [link.second for link in links] != list(payloads(scene).values()):
        del out["payload_position"]
    return out


def _under_the_tip(scene: Scene, result: Result, link: _core.Joint) -> dict[str, Array]:
    """What `_of_weight` tells of one payload, each of shape (n, parts)."""
    payload, body = scene.bodies[link.second], scene.bodies[link.first]
    turn = rotation_matrix(result.select("quaternion", body=link.first))
    lever = np.asarray(link.first_frame.point) - np.asarray(body.center_of_mass)
    tip = result.select("position", body=link.first) + turn @ lever
    spin = np.cross(result.select("angular_velocity", body=link.first), turn @ lever)
    below = link.length + float(link.second_frame.point[2] - payload.center_of_mass[2])
    return {
        "hook_tension": np.full((len(tip), 1), payload.mass * scene.gravity),
        "tip_velocity": np.asarray(result.select("velocity", body=link.first) + spin),
        "payload_position": tip - np.array([0.0, 0.0, below]),
    }


def frequency_domain(scene: Scene, span: Span, truth: Mapping[str, Array], start: Array, row: Row) -> Row:
    """The row of the linear model about the described pose, in its steady state under the same waves.

    Parameters
    ----------
    start : ndarray, shape (payloads, 3)
        Positions of the payloads at rest, m.
    """
    import time
    from dataclasses import replace

    from seacrane.analysis.frequency_domain import response_summed
    from seacrane.analysis.linear_system import linear_model

    begun = time.perf_counter()
    try:
        hulls = {} if scene.waves is None else scene.waves.hulls
        linear = linear_model(scene, vessel=next(iter(hulls), None))
        times: Array = span.dt_out * np.arange(len(next(iter(truth.values()))), dtype=float)
        values: dict[str, Array] = {}
        if "roll" in truth:
            rolls = [_roll(linear, vessel.body, times) for vessel in scene.vessels.values()]
            values["roll"] = np.stack(rolls, axis=1)[:, :, None]
        if "payload_position" in truth:
            bodies = payloads(scene).values()
            moved = [response_summed(linear, body=body).at(times)[:, :3] for body in bodies]
            values["payload_position"] = start + np.stack(moved, axis=1)
    except (SeacraneError, ValueError) as error:
        return replace(row, reason=" ".join(str(error).split()))
    errors = {name: compare(truth[name], value) for name, value in values.items()}
    left_out = [name for name in span.quantities if name not in errors]
    return replace(
        row,
        wall_s=time.perf_counter() - begun,
        simulated_s=span.t_end,
        errors=errors,
        stable=True,
        reason=f"has no {', '.join(left_out)}" if left_out else "",
    )


def _roll(linear: LinearModel, body: str, times: Array) -> Array:
    """Of a vessel about its own axis, rad."""
    from seacrane.analysis.frequency_domain import response_summed

    heading = heading_of(linear.scene.bodies[body].quaternion)
    rotation = response_summed(linear, body=body).at(times)[:, 3:]
    return np.asarray(np.cos(heading) * rotation[:, 0] + np.sin(heading) * rotation[:, 1])


def _drift(result: Result) -> float:
    values = result.channels.get("constraint_error_before_projection")
    return NOT_DEFINED if values is None else float(np.max(values))


def _energy(result: Result) -> float:
    """Largest energy balance over the absolute work done by the end."""
    balance, work = result.channels.get("energy_balance"), result.channels.get("absolute_work")
    if balance is None or work is None or not work[-1] > 0.0:
        return NOT_DEFINED
    return float(np.max(np.abs(balance)) / work[-1])
