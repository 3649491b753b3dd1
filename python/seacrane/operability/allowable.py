"""allowable_hs(): the largest Hs over peak period and direction that keeps every criterion."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.accuracy.choice import refuse_what_is_chosen
from seacrane.analysis.frequency_domain import response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.analysis.rest_state import equilibrium, held
from seacrane.description.given import given_drivers, in_calm_water, led_by
from seacrane.ensembles.other_sea import require_same_sea
from seacrane.ensembles.stage_values import Stages, checked_stages_of
from seacrane.ensembles.study import Start
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of, number_of, numbers_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.alpha import AlphaFactor, alpha_of
from seacrane.operability.cells import Cells
from seacrane.operability.criterion import FEWEST_SEEDS, Criterion
from seacrane.operability.linear_channels import LinearSeas
from seacrane.operability.time_domain import Cell, Storms, differences
from seacrane.result import Result
from seacrane.run.advance import finished
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.shorthand import Shorthand, settled
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

if TYPE_CHECKING:
    from typing_extensions import Unpack

Array = NDArray[np.float64]
LINEAR_WITHIN = 0.1  # of the allowance
PROBES = 2  # seeds of each cell that are compared with the linear model
DT = 0.5  # s between outputs
HEIGHTS = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0)  # m
FEWEST_PERIODS = 10.0  # that a record holds
DURATION, START_UP = 1800.0, 300.0  # s
DELAY = 2.0  # s before a progress bar shows
LARGEST_TURN = 0.2  # rad, of a body: what the linear model says of more is no state to start from


@named
def allowable_hs(
    scene: Scene,
    *,
    criteria: Sequence[Criterion],
    tp: Any,
    direction_deg: Any,
    hs: Any = HEIGHTS,
    domain: Literal["auto", "frequency", "time"] = "auto",
    linear_within: float = LINEAR_WITHIN,
    seeds: Sequence[int] = tuple(range(1, 11)),
    duration: float | None = None,
    start_up: float | None = None,
    time: float = 0.0,
    stages: Stages = (),
    alpha: AlphaFactor | float = 1.0,
    hours: float = 12.0,
    executor: Executor | None = None,
    store: str | os.PathLike[str] | None = None,
    method: Method | None = None,
    accuracy: Mapping[str, float] | None = None,
    progress: bool = False,
    **shorthand: Unpack[Shorthand],
) -> AllowableHs:
    """Find the largest Hs over peak period and direction of the waves that keeps every criterion.

    The scene has its references held, and lies in seas of its own spectrum and spreading. Its linear
    model answers first. Where `domain` is "auto", runs in the same waves and from the same state tell in each
    cell whether that is enough; where it is not, runs of all seeds at each `hs` answer.

    Parameters
    ----------
    scene : Scene
        With a sea of one wave system, whose height, period and direction are replaced.
    tp : array_like
        Peak periods, s, ascending.
    direction_deg : array_like
        Directions in which the waves travel, as of `Scene.add_sea`: 0 along x, 180 against it. Ascending.
    hs : array_like
        m, ascending: of the runs, and the last one the largest that is examined in either domain.
    domain : str
        "auto" (default), "frequency": the linear model is not tested, or "time".
    linear_within : float
        "auto" takes the linear model where what its statistic of the record and that of the run differ by is
        at most this share of the allowance, the distance from the value at rest to the bound; for every
        criterion and both probes, at the Hs that it finds, or at the last `hs` if that is lower.
    seeds : sequence of int
        Of runs, at least 3. The first two are the probes.
    duration, start_up : float, optional
        Of each run: evaluated, and left out before, s; default 1800 and 300. Runs begin in the linear steady
        state, where there is a linear model, and at rest elsewhere. Maxima of shorter runs than the exposure
        time are carried to it by Gumbel's distribution.
    time : float
        At which the references are held, s.
    stages : sequence of Stage, or callable
        The lift is run in these stages from rest, as by `ensemble`, in runs alone: `domain` is "time". A
        criterion's largest value is that of one lift, or of one of its stages; what it reaches in the same
        lift in calm water is its value at rest.
    alpha : AlphaFactor
        For the uncertainty of forecasts; default 1. It does not change `allowable_hs`: `forecast_hs` is both
        together.
    hours : float
        Planned period of the operation, for alpha, h.
    executor, store
        Of the runs, as of `ensemble`; the probes take the executor too. With a store, runs that were killed
        are resumed.
    method : Method, optional
        Of the runs.
    accuracy : mapping of str to float, optional
        As of `ensemble`: integrator and tolerance of the runs of all seeds, and of a lift in calm water, are
        chosen by it.
    progress : bool
        Show progress of what takes more than two seconds.
    **shorthand
        Parts of the method, and `dt_out` (s), as of `simulate`; default 0.5.

    Raises
    ------
    SceneError
        For values that make no sense, a channel or a sea that the scene does not have, a scene with no rest
        state, or with domain="frequency" one without a linear model; for what lifts in stages do not take:
        a duration, an exposure time, "significant", motion=True, domain="frequency".
    KeyboardInterrupt
        On Ctrl-C; runs that came back before are in the store.
    """
    asked = _Asked.of(
        criteria, tp, direction_deg, hs, seeds, duration, start_up, linear_within, domain, stages, accuracy
    )
    factor = alpha_of(alpha)
    period = positive_of("hours", hours)
    factor.at(1.0, hours=period)
    if "channels" in shorthand:
        raise SceneError("channels: runs record those of the criteria; leave channels out")
    if accuracy is not None:
        refuse_what_is_chosen(method, shorthand, ())
    how, recorded = settled(method, None, {"dt_out": DT, **shorthand})
    outputs = Outputs(
        dt_out=recorded.dt_out, channels=tuple(dict.fromkeys(one.channel for one in asked.criteria))
    )
    still = _Still.of(scene, asked, number_of("time", time), how, outputs)
    study = _Study(asked=asked, still=still, method=how, outputs=outputs)
    cells = Cells.of(asked.criteria, asked.tp, asked.directions, largest=asked.hs[-1])
    failures: dict[int, str] = {}
    if asked.stages:
        cells.refuse("a lift in stages")
    elif domain != "time":
        study.by_frequency(cells, strict=domain == "frequency", progress=progress)
    if domain == "auto" and not asked.stages and cells.linear is not None:
        study.test(cells, executor, progress)
    if cells.wanted:
        failures = study.by_time(cells, executor, store, progress)
    return AllowableHs.of(
        scene.name, cells, factor, period, hs=asked.hs, seeds=asked.seeds, duration=asked.duration,
        linear_within=asked.linear_within, failures=failures,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class _Asked:
    """What was asked, checked."""

    criteria: tuple[Criterion, ...]
    tp: tuple[float, ...]
    directions: tuple[float, ...]
    hs: tuple[float, ...]
    seeds: tuple[int, ...]
    duration: float | None
    start_up: float
    linear_within: float
    stages: Stages
    accuracy: Mapping[str, float] | None

    @classmethod
    def of(
        cls, criteria: Any, tp: Any, directions: Any, hs: Any, seeds: Any, duration: Any, start_up: Any,
        linear_within: Any, domain: Any, stages: Any, accuracy: Any,
    ) -> _Asked:  # fmt: skip
        if domain not in ("auto", "frequency", "time"):
            raise SceneError(f"domain is {shown(domain)}; choose 'auto', 'frequency' or 'time'")
        in_stages, listed = checked_stages_of("allowable_hs", stages), _criteria(criteria)
        _require_fit(listed, in_stages, {"duration": duration, "start_up": start_up}, domain)
        usual = 0.0 if in_stages else START_UP
        begin = not_negative_of("start_up", usual if start_up is None else start_up, "s")
        within = _ascending("direction_deg", directions)
        if within[-1] - within[0] >= 360.0:
            raise SceneError(
                f"direction_deg goes from {within[0]:g} to {within[-1]:g}; name each direction of the circle "
                "once"
            )
        periods = _ascending("tp", tp, above_zero=True)
        span = None if in_stages else positive_of("duration", DURATION if duration is None else duration)
        if span is not None and span < FEWEST_PERIODS * periods[-1]:
            raise SceneError(
                f"duration is {span:g} s; give at least {FEWEST_PERIODS:g} of the longest peak period, "
                f"{FEWEST_PERIODS * periods[-1]:g} s"
            )
        return cls(
            criteria=listed,
            tp=periods,
            directions=within,
            hs=_ascending("hs", hs, above_zero=True),
            seeds=_seeds(seeds),
            duration=span,
            start_up=begin,
            linear_within=positive_of("linear_within", linear_within),
            stages=in_stages,
            accuracy=accuracy,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class _Still:
    """The scene with its references held, its sea, its state at rest and the criteria's values there."""

    scene: Scene
    state: Any
    rest: Array

    @classmethod
    def of(cls, scene: Any, asked: _Asked, time: float, method: Method, outputs: Outputs) -> _Still:
        if not isinstance(scene, Scene):
            raise SceneError(f"scene is {shown(scene)}; give a Scene")
        if scene.waves is None:
            raise SceneError(
                f"scene {scene.name!r} has no sea; add one of any height, whose height, period and direction "
                "are then replaced"
            )
        require_same_sea(scene, ("hs", "tp", "direction_deg"))
        scene = _lasting(scene, asked, time)
        calm = in_calm_water(scene)
        state = equilibrium(calm, time=time)
        if asked.stages:
            stages = asked.stages(calm) if callable(asked.stages) else asked.stages
            result = simulate(
                calm, stages, start=state, method=method, outputs=outputs, accuracy=asked.accuracy
            )
            return cls(scene=scene, state=state, rest=_extremes(result, asked.criteria))
        calm = held(calm, time=time)
        result = finished(Run(calm, state.time, start=state, method=method, outputs=outputs))
        rest = np.array([result.curve(one.channel, **one.names)[0] for one in asked.criteria])
        moving = {name: scene.drivers[name].curve for name in given_drivers(scene)}
        moved = led_by(calm, moving).copy(waves=scene.waves)
        return cls(scene=moved, state=state, rest=rest)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Study:
    """The three steps: linear model, its test, runs."""

    asked: _Asked
    still: _Still
    method: Method
    outputs: Outputs

    def by_frequency(self, cells: Cells, *, strict: bool, progress: bool) -> None:
        """Fill cells by the linear model; where there is none, note why."""
        from tqdm import tqdm

        try:
            linear = LinearSeas(self.still.scene, self.still.state, self.asked.criteria)
        except SceneError as error:
            if strict:
                raise
            cells.refuse(f"no linear model: {error}")
            return
        cells.linear = linear
        cells.energy_share = np.array([linear.energy_share(tp) for tp in self.asked.tp])
        directions = tqdm(self.asked.directions, desc="linear model", delay=DELAY, disable=not progress)
        for j, direction in enumerate(directions):
            gains = linear.gains(direction)
            for i, tp in enumerate(self.asked.tp):
                cells.take_linear(i, j, linear.allowable(gains, tp))

    def test(self, cells: Cells, executor: Executor | None, progress: bool) -> None:
        """Compare the linear model with runs, and leave what it does not hold for to the time domain."""
        from tqdm import tqdm

        assert cells.linear is not None and self.asked.duration is not None
        places = [place for place in cells.places if cells.allowable[place] > 0.0]
        seas = [
            {"hs": float(cells.allowable[i, j]), "tp": tp, "direction_deg": direction, "seed": seed}
            for i, j in places
            for tp, direction in [(self.asked.tp[i], self.asked.directions[j])]
            for seed in self.asked.seeds[:PROBES]
        ]
        of_places = [place for place in places for _ in self.asked.seeds[:PROBES]]
        found = differences(
            self.still.scene, cells.linear, self.asked.criteria, seas, start=self.still.state.time,
            duration=self.asked.duration, method=self.method, outputs=self.outputs, executor=executor,
        )  # fmt: skip
        tested = tqdm(found, "test of the linear model", len(seas), delay=DELAY, disable=not progress)
        for place, apart in zip(of_places, tested, strict=True):
            cells.take_difference(place, apart, self.asked.linear_within)

    def by_time(self, cells: Cells, executor: Executor | None, store: Any, progress: bool) -> dict[int, str]:
        """Fill the cells that are wanted by runs; why members failed, by number."""
        storms = Storms(
            scene=self.still.scene, begin=self.still.state.time,
            start=self._start(),
            start_up=self.asked.start_up, duration=self.asked.duration, hs=self.asked.hs,
            seeds=self.asked.seeds, criteria=self.asked.criteria, rest=self.still.rest, method=self.method,
            outputs=self.outputs, stages=self.asked.stages, accuracy=self.asked.accuracy,
        )  # fmt: skip
        places = cells.wanted
        of_cells: list[Cell] = [(self.asked.tp[i], self.asked.directions[j]) for i, j in places]
        found = storms.run(of_cells, executor=executor, store=store, progress=progress)
        for place, by_time in zip(places, storms.allowable(found, of_cells), strict=True):
            cells.take_time(place, by_time)
        return dict(found.failures)

    def _start(self) -> Start:
        """Where runs begin: in the linear steady state; on given ships and in stages at rest."""
        still = self.still
        if given_drivers(still.scene):
            return partial(equilibrium, time=still.state.time)
        return still.state if self.asked.stages else steady_start(still.scene, still.state)


def _lasting(scene: Scene, asked: _Asked, begin: float) -> Scene:
    """The scene with the motion of ships by RAOs described to the end of the runs, each in its own sea."""
    end = begin + asked.start_up + (asked.duration or 0.0)
    stages = asked.stages(scene) if callable(asked.stages) else asked.stages
    end += sum(one.duration or one.maximum_duration or 0.0 for one in stages)
    out = scene.copy()
    for name, known in scene.provenance.items():
        if known.motion == "raos" and known.duration is not None and known.duration < end:
            out.provenance[name] = replace(known, duration=end)
    return out


def _extremes(calm: Result, criteria: Sequence[Criterion]) -> Array:
    """What each criterion reaches in a lift in calm water, given ships at rest."""
    found = []
    for one in criteria:
        least, largest = calm.reached(one.channel, part=calm.part(stage=one.stage or None), **one.names)
        found.append(largest.max() if one.minimum is None else least.min())
    return np.array(found)


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


def _criteria(given: Any) -> tuple[Criterion, ...]:
    listed = [given] if isinstance(given, Criterion) else list(given) if isinstance(given, Sequence) else []
    if not listed or not all(isinstance(one, Criterion) for one in listed):
        raise SceneError(f"criteria is {shown(given)}; give a list of Criterion")
    names = [one.name for one in listed]
    for name in names:
        if names.count(name) > 1:
            raise SceneError(f"criteria: {name!r} is there twice; give each a name of its own")
    return tuple(listed)


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


def _ascending(name: str, given: Any, *, above_zero: bool = False) -> tuple[float, ...]:
    values = np.atleast_1d(numbers_of(name, given))
    if values.ndim != 1 or not values.size or not np.all(np.isfinite(values)) or np.any(np.diff(values) <= 0):
        raise SceneError(f"{name} is {shown(given)}; give ascending finite numbers")
    if above_zero and values[0] <= 0.0:
        raise SceneError(f"{name} begins with {values[0]:g}; give numbers above zero")
    return tuple(values.tolist())


@dataclass(frozen=True, kw_only=True, eq=False)
class SteadyStart:
    """The steady response of a linear model to the waves of a scene, at the time of its state at rest."""

    model: LinearModel

    def __call__(self, scene: Scene) -> _core.State:
        """Where a run of this scene begins; scaled down where a body would turn by more than 0.2 rad."""
        model = self.model
        found = response_summed(model, body=model.bodies[0], waves=scene.waves)
        x = found.state_at(model.state.time)
        turns = (model.basis @ x[: model.degrees_of_freedom]).reshape(-1, 2, 3)[:, 1]
        return model.full_state(x * min(1.0, LARGEST_TURN / max(float(np.abs(turns).max()), 1e-300)))


def steady_start(scene: Scene, rest: _core.State) -> Start:
    """A `SteadyStart`, or the state at rest of a scene whose linear model has no such state."""
    assert scene.waves is not None
    try:
        model = linear_model(scene, state=rest, vessel=next(iter(scene.waves.hulls)))
        PartsInWaves(model)
    except SceneError:
        return rest
    return rest if model.memories else SteadyStart(model=model)
