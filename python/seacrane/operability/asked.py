"""What is asked of a table of allowable Hs, checked, and the scene at rest that it is asked of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.rest_state import equilibrium, held
from seacrane.arrays import Array
from seacrane.description.given import given_drivers, in_calm_water, led_by
from seacrane.ensembles.other_sea import require_same_sea
from seacrane.ensembles.study import Stages, checked_stages_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, positive_of
from seacrane.inputs.shown import shown
from seacrane.inputs.values import listed_of
from seacrane.operability.alpha import ascending
from seacrane.operability.criterion import FEWEST_SEEDS, Criterion
from seacrane.run.advance import finished
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

FEWEST_PERIODS = 10.0  # that a record holds
DURATION, START_UP = 1800.0, 300.0  # s


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What `allowable_hs` was asked, under its names; `duration` is None of lifts in stages."""

    criteria: tuple[Criterion, ...]
    tp: tuple[float, ...]
    direction_deg: tuple[float, ...]
    hs: tuple[float, ...]
    seeds: tuple[int, ...]
    duration: float | None
    start_up: float
    linear_within: float
    stages: Stages
    method: Method
    outputs: Outputs
    accuracy: Mapping[str, float] | None


def asked_of(
    criteria: Any, tp: Any, direction_deg: Any, hs: Any, *, domain: str, stages: Any, duration: Any,
    start_up: Any, seeds: Any, linear_within: Any, method: Method, dt_out: float,
    accuracy: Mapping[str, float] | None,
) -> Asked:  # fmt: skip
    """It, or a SceneError for what makes no sense or does not go together."""
    if domain not in ("auto", "frequency", "time"):
        raise SceneError(f"domain is {shown(domain)}; choose 'auto', 'frequency' or 'time'")
    in_stages, listed = checked_stages_of("allowable_hs", stages), listed_of("criteria", Criterion, criteria)
    _require_fit(listed, in_stages, {"duration": duration, "start_up": start_up}, domain)
    usual = 0.0 if in_stages else START_UP
    begin = not_negative_of("start_up", usual if start_up is None else start_up, "s")
    within = ascending("direction_deg", direction_deg, fewest=1)
    if within[-1] - within[0] >= 360.0:
        raise SceneError(
            f"direction_deg goes from {within[0]:g} to {within[-1]:g}; name each direction of the circle once"
        )
    periods = ascending("tp", tp, fewest=1, above_zero=True)
    span = None if in_stages else positive_of("duration", DURATION if duration is None else duration)
    if span is not None and span < FEWEST_PERIODS * periods[-1]:
        raise SceneError(
            f"duration is {span:g} s; give at least {FEWEST_PERIODS:g} of the longest peak period, "
            f"{FEWEST_PERIODS * periods[-1]:g} s"
        )
    return Asked(
        criteria=listed, tp=periods, direction_deg=within,
        hs=ascending("hs", hs, fewest=1, above_zero=True), seeds=_seeds(seeds), duration=span, start_up=begin,
        linear_within=positive_of("linear_within", linear_within), stages=in_stages, method=method,
        outputs=Outputs(dt_out=dt_out, channels=tuple(dict.fromkeys(one.channel for one in listed))),
        accuracy=accuracy,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Still:
    """The scene with its references held, its sea, its state at rest and the criteria's values there."""

    scene: Scene
    state: _core.State
    rest: Array


def still_of(scene: Any, asked: Asked, time: float) -> Still:
    """The scene at rest; SceneError for what is none, or has no sea or no such state."""
    if not isinstance(scene, Scene):
        raise SceneError(f"scene is {shown(scene)}; give a Scene")
    if scene.waves is None:
        raise SceneError(
            f"scene {scene.name!r} has no sea; add one of any height, whose height, period and direction are "
            "then replaced"
        )
    require_same_sea(scene, ("hs", "tp", "direction_deg"))
    scene = _lasting(scene, asked, time)
    calm = in_calm_water(scene)
    state = equilibrium(calm, time=time)
    how: dict[str, Any] = {"start": state, "method": asked.method, "outputs": asked.outputs}
    if asked.stages:
        stages = asked.stages(calm) if callable(asked.stages) else asked.stages
        result = simulate(calm, stages, accuracy=asked.accuracy, **how)
        rest = []
        for one in asked.criteria:
            result.curve(one.channel, **one.names)  # refuses several curves before all seas are run
            part = result.part(stage=one.stage or None)
            least, largest = result.reached(one.channel, part=part, **one.names)
            rest.append(largest.max() if one.minimum is None else least.min())
        return Still(scene=scene, state=state, rest=np.array(rest))
    calm = held(calm, time=time)
    result = finished(Run(calm, state.time, **how))
    begun = np.array([result.curve(one.channel, **one.names)[0] for one in asked.criteria])
    moving = {name: scene.drivers[name].curve for name in given_drivers(scene)}
    return Still(scene=led_by(calm, moving).copy(waves=scene.waves), state=state, rest=begun)


def _lasting(scene: Scene, asked: Asked, begin: float) -> Scene:
    """The scene with the motion of ships by RAOs described to the end of the runs, each in its own sea."""
    end = begin + asked.start_up + (asked.duration or 0.0)
    stages = asked.stages(scene) if callable(asked.stages) else asked.stages
    end += sum(one.duration or one.maximum_duration or 0.0 for one in stages)
    out = scene.copy()
    for name, known in scene.provenance.items():
        if known.motion == "raos" and known.duration is not None and known.duration < end:
            out.provenance[name] = replace(known, duration=end)
    return out


def _require_fit(criteria: Sequence[Criterion], stages: Stages, spans: dict[str, Any], domain: Any) -> None:
    """Raise SceneError for what a lift with or without stages does not take."""
    of_stages = {one.stage for one in criteria if one.stage}
    if not stages:
        if of_stages:
            raise SceneError(
                f"criteria: stage {min(of_stages)!r} is asked for, and the lift has none; give stages"
            )
        return
    if not callable(stages):
        missing = sorted(of_stages - {one.name for one in stages})
        if missing:
            known = ", ".join(one.name for one in stages)
            raise SceneError(f"criteria: there is no stage {missing[0]!r}; the lift has {known}")
    given = [name for name, value in spans.items() if value is not None]
    if given:
        raise SceneError(f"{given[0]}: stages tell how long a lift takes; leave {given[0]} out")
    if domain == "frequency":
        raise SceneError("domain is 'frequency': a lift in stages has no linear model; leave domain out")
    for one in criteria:
        if one.exposure is not None:
            raise SceneError(
                f"criterion {one.name!r}: a lift in stages is its own exposure time; leave it out"
            )
        if one.statistic == "significant" or one.motion:
            what = (
                "motion=True is a distance from rest" if one.motion else "'significant' is of a long record"
            )
            raise SceneError(f"criterion {one.name!r}: {what}, which a lift in stages does not have")


def _seeds(given: Any) -> tuple[int, ...]:
    listed = list(given) if isinstance(given, Sequence) and not isinstance(given, (str, bytes)) else []
    whole = all(
        isinstance(one, int | np.integer) and not isinstance(one, bool) and one >= 0 for one in listed
    )
    if len(listed) < FEWEST_SEEDS or not whole or len(set(listed)) < len(listed):
        raise SceneError(
            f"seeds is {shown(given)}; give at least {FEWEST_SEEDS} different whole numbers from 0 on"
        )
    return tuple(int(one) for one in listed)
