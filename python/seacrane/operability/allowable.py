"""allowable_hs(): the largest Hs over peak period and direction that keeps every criterion."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from seacrane import _core
from seacrane.accuracy.choice import refuse_what_is_chosen
from seacrane.analysis.frequency_domain import response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.analysis.rest_state import equilibrium
from seacrane.description.given import given_drivers
from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.growing import Growth, Judge
from seacrane.ensembles.members import Members
from seacrane.ensembles.parts import Part
from seacrane.ensembles.price import Priced
from seacrane.ensembles.study import Stages, Start
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.alpha import AlphaFactor, alpha_of
from seacrane.operability.asked import Still, asked_of, still_of
from seacrane.operability.cells import Cells
from seacrane.operability.criterion import Criterion
from seacrane.operability.linear_channels import LinearSeas
from seacrane.operability.time_domain import allowable_of, differences, numbers_of, storms_in
from seacrane.run.method import Method, Shorthand, settled
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack

LINEAR_WITHIN = 0.1  # of the allowance
BATCH = 10  # seeds that are run together where `until` may end a cell
PROBES = 2  # seeds of each cell that are compared with the linear model
DT = 0.5  # s between outputs
HEIGHTS = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0)  # m
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
    until: float | None = None,
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
    until : float, optional
        Half width of the 95 % interval of the allowable Hs, as a share of it: seeds, which then have no gaps,
        are run in batches of ten until a cell is known so well; `seeds` are the most that there may be.
        Default: all of them.
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
    factor = alpha_of(alpha)
    period = positive_of("hours", hours)
    factor.at(1.0, hours=period)
    cells, failures = allowable_cells(
        scene, criteria=criteria, tp=tp, direction_deg=direction_deg, hs=hs, domain=domain,
        linear_within=linear_within, seeds=seeds, duration=duration, start_up=start_up, time=time,
        stages=stages, executor=executor, store=store, method=method, accuracy=accuracy, progress=progress,
        until=until, shorthand=shorthand,
    )  # fmt: skip
    return cells.table(scene.name, factor, period, failures)


def allowable_cells(
    scene: Scene, *, domain: str, time: float, executor: Executor | None, store: Any, method: Method | None,
    accuracy: Mapping[str, float] | None, progress: bool, until: float | None, shorthand: Mapping[str, Any],
    groups: Sequence[Sequence[int]] = (), part: Part | None = None, priced: Priced | None = None,
    **given: Any,
) -> tuple[Cells, dict[int, str]]:  # fmt: skip
    """The cells that `allowable_hs` makes a table of, and why members failed, by number.

    Arguments are its own, and as of `phase_sheet`; `groups`: criteria by number, of which a table each is
    made.
    """
    if "channels" in shorthand:
        raise SceneError("channels: runs record those of the criteria; leave channels out")
    if accuracy is not None:
        refuse_what_is_chosen(method, shorthand, ())
    how, recorded = settled(method, None, {"dt_out": DT, **shorthand})
    asked = asked_of(domain=domain, method=how, dt_out=recorded.dt_out, accuracy=accuracy, **given)
    still = still_of(scene, asked, number_of("time", time))
    cells, failures = Cells(asked), dict[int, str]()
    if asked.stages:
        cells.refuse("a lift in stages")
    elif domain != "time":
        _by_frequency(cells, still, strict=domain == "frequency", progress=progress)
    if domain == "auto" and not asked.stages and cells.linear is not None:
        if part is not None or priced is not None:
            raise SceneError(
                "domain is 'auto': what tests the linear model is in no part, and has no price; choose "
                "'frequency' or 'time'"
            )
        _test(cells, cells.linear, still, executor, progress)
    if cells.wanted:
        share = None if until is None else positive_of("until", until)
        every = groups or [range(len(asked.criteria))]
        failures = _by_time(cells, still, executor, store, progress, share, every, part, priced)
    return cells, failures


def _by_frequency(cells: Cells, still: Still, *, strict: bool, progress: bool) -> None:
    """Fill cells by the linear model; where there is none, note why."""
    from tqdm import tqdm

    asked = cells.asked
    try:
        linear = LinearSeas(still.scene, still.state, asked.criteria)
    except SceneError as error:
        if strict:
            raise
        cells.refuse(f"no linear model: {error}")
        return
    cells.linear = linear
    cells.energy_share = np.array([linear.energy_share(tp) for tp in asked.tp])
    directions = tqdm(asked.direction_deg, desc="linear model", delay=DELAY, disable=not progress)
    for j, direction in enumerate(directions):
        gains = linear.gains(direction)
        for i, tp in enumerate(asked.tp):
            allowable = linear.allowable(gains, tp)
            cells.by_criterion[:, i, j], cells.domain[i, j] = allowable, "frequency"
            at_rest = allowable.min() <= 0.0
            cells.reason[i, j] = "a bound is exceeded at rest" if at_rest else "not tested"


def _test(cells: Cells, linear: LinearSeas, still: Still, executor: Executor | None, progress: bool) -> None:
    """Compare the linear model with runs, and leave what it does not hold for to the time domain."""
    from tqdm import tqdm

    seeds = cells.asked.seeds[:PROBES]
    probes = [
        (place, cells.words(place) | {"hs": float(cells.allowable[place]), "seed": seed})
        for place in cells.places if cells.allowable[place] > 0.0 for seed in seeds
    ]  # fmt: skip
    found = differences(cells.asked, still, linear, [sea for _, sea in probes], executor)
    tested = tqdm(found, "test of the linear model", len(probes), delay=DELAY, disable=not progress)
    for (place, _), apart in zip(probes, tested, strict=True):
        cells.take_difference(place, apart)


def _by_time(
    cells: Cells, still: Still, executor: Executor | None, store: Any, progress: bool, until: float | None,
    groups: Sequence[Sequence[int]], part: Part | None, priced: Priced | None,
) -> dict[int, str]:  # fmt: skip
    """Fill the cells that are wanted by runs, those of a part alone; why members failed, by number."""
    if given_drivers(still.scene):  # on given ships and in stages from rest
        start: Start = partial(equilibrium, time=still.state.time)
    else:
        start = still.state if cells.asked.stages else steady_start(still.scene, still.state)
    judge = ByRuns(table=cells, still=still, share=until, groups=groups)
    storms = storms_in(
        cells.asked, still, judge, start, executor=executor, store=store, progress=progress, part=part,
        priced=priced,
    )  # fmt: skip
    return dict(storms.failures)


@dataclass(kw_only=True, eq=False)
class ByRuns(Judge):
    """Fills cells by their runs, and knows one where its Hs is known to a share of it, or all seeds are run.

    Attributes
    ----------
    groups : Criteria by number, of which each allows an Hs of its own.
    """

    table: Cells
    still: Still
    share: float | None
    groups: Sequence[Sequence[int]]

    def __post_init__(self) -> None:
        places = self.table.places
        self.cells = [places.index(one) for one in self.table.wanted]
        self.asked = {} if self.share is None else {"allowable_hs": self.share}
        for place in self.table.wanted:
            self.table.not_run(place)

    def growth(self, members: Members, pack: int | None, size: int) -> Growth:
        """By batches of ten seeds where a share is asked for."""
        seeds, heights = self.table.asked.seeds, len(self.table.asked.hs)
        batch = len(seeds) if self.share is None else min(BATCH, len(seeds))
        if batch < len(seeds) and [*seeds] != [*range(seeds[0], seeds[0] + len(seeds))]:
            raise SceneError(
                f"until: seeds is {shown(seeds)}, with gaps; give seeds one after another, as range(1, 21)"
            )
        others = {name: values for name, values in members.axes.items() if name != "seed"}
        return Growth(seeds=seeds, others=others, size=size, batch=batch, within=heights)

    def knows(self, growth: Growth, cell: int, outcomes: Sequence[Outcome]) -> bool:
        """As of `Judge`."""
        place, asked = self.table.places[cell], self.table.asked
        numbers = numbers_of(outcomes, asked)
        self.table.take_time(place, allowable_of(asked, self.still, numbers), numbers.shape[2])
        return self.share is None or self.table.certain(place, self.share, self.groups)


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
