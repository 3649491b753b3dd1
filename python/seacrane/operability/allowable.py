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
from seacrane.arrays import Array
from seacrane.description.given import given_drivers
from seacrane.ensembles.study import Stages, Start
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.operability.allowable_table import AllowableHs, breaking_height
from seacrane.operability.alpha import AlphaFactor, alpha_of
from seacrane.operability.asked import Asked, Still, asked_of, still_of
from seacrane.operability.criterion import Criterion
from seacrane.operability.linear_channels import LinearSeas
from seacrane.operability.time_domain import ByTime, allowable_in, differences, storms_in
from seacrane.plotting.table import Column, Table
from seacrane.run.method import Method, Shorthand, settled
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack

Place = tuple[int, int]  # number of the peak period, and of the direction
LINEAR_WITHIN = 0.1  # of the allowance
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
    factor = alpha_of(alpha)
    period = positive_of("hours", hours)
    factor.at(1.0, hours=period)
    if "channels" in shorthand:
        raise SceneError("channels: runs record those of the criteria; leave channels out")
    if accuracy is not None:
        refuse_what_is_chosen(method, shorthand, ())
    how, recorded = settled(method, None, {"dt_out": DT, **shorthand})
    asked = asked_of(
        criteria, tp, direction_deg, hs, domain=domain, stages=stages, duration=duration, start_up=start_up,
        seeds=seeds, linear_within=linear_within, method=how, dt_out=recorded.dt_out, accuracy=accuracy,
    )  # fmt: skip
    still = still_of(scene, asked, number_of("time", time))
    cells, failures = Cells(asked), dict[int, str]()
    if asked.stages:
        cells.refuse("a lift in stages")
    elif domain != "time":
        _by_frequency(cells, still, strict=domain == "frequency", progress=progress)
    if domain == "auto" and not asked.stages and cells.linear is not None:
        _test(cells, cells.linear, still, executor, progress)
    if cells.wanted:
        failures = _by_time(cells, still, executor, store, progress)
    return cells.table(scene.name, factor, period, failures)


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
    cells: Cells, still: Still, executor: Executor | None, store: Any, progress: bool
) -> dict[int, str]:
    """Fill the cells that are wanted by runs; why members failed, by number."""
    places = cells.wanted
    seas = [cells.words(place) for place in places]
    if given_drivers(still.scene):  # on given ships and in stages from rest
        start: Start = partial(equilibrium, time=still.state.time)
    else:
        start = still.state if cells.asked.stages else steady_start(still.scene, still.state)
    storms = storms_in(cells.asked, still, seas, start, executor=executor, store=store, progress=progress)
    for place, by_time in zip(places, allowable_in(cells.asked, still, storms, len(places)), strict=True):
        cells.take_time(place, by_time)
    return dict(storms.failures)


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


class Cells:
    """Cells by peak period and direction, filled step by step; runs are wanted where nothing is known.

    Attributes
    ----------
    by_criterion, low, high : ndarray, shape (criteria, periods, directions)
        Allowable Hs, m, and its 95 % interval; NaN where a cell needed no runs.
    difference : ndarray, shape (criteria, periods, directions)
        Between run and linear model, over the allowance; NaN where it was not tested.
    domain, reason : (periods, directions)
    energy_share : (periods,) Of the waves, within the database.
    """

    def __init__(self, asked: Asked) -> None:
        shape = (len(asked.tp), len(asked.direction_deg))
        all_of = (len(asked.criteria), *shape)
        self.asked = asked
        self.linear: LinearSeas | None = None
        self.by_criterion: Array = np.full(all_of, np.inf)
        self.low, self.high, self.difference = (np.full(all_of, np.nan) for _ in range(3))
        self.domain = np.full(shape, "time", dtype="U9")
        self.reason = np.full(shape, "asked for", dtype=object)
        self.energy_share: Array = np.full(shape[0], np.nan)

    @property
    def places(self) -> list[Place]:
        """All cells, directions fastest."""
        return [(i, j) for i in range(len(self.asked.tp)) for j in range(len(self.asked.direction_deg))]

    @property
    def wanted(self) -> list[Place]:
        """Cells of the time domain."""
        return [place for place in self.places if self.domain[place] == "time"]

    def words(self, place: Place) -> dict[str, Any]:
        """The words of the sea of a cell, without its height and seed."""
        return {"tp": self.asked.tp[place[0]], "direction_deg": self.asked.direction_deg[place[1]]}

    @property
    def allowable(self) -> Array:
        """Over all criteria, up to the largest Hs that was examined."""
        return np.asarray(np.minimum(self.by_criterion.min(axis=0), self.asked.hs[-1]))

    def refuse(self, reason: str) -> None:
        """Leave all cells to the time domain."""
        self.reason[:] = reason

    def take_difference(self, place: Place, found: Array | str) -> None:
        """What a probe of a cell brought: the largest of several counts."""
        if isinstance(found, str):
            self.domain[place], self.reason[place] = "time", f"a run failed: {found}"
            return
        here = self.difference[(slice(None), *place)]
        self.difference[(slice(None), *place)] = np.fmax(here, found)
        if self.reason[place].startswith("a run failed"):
            return
        worst = int(np.argmax(self.difference[(slice(None), *place)]))
        share = 100.0 * self.difference[worst, place[0], place[1]]
        name = self.asked.criteria[worst].name
        if share > 100.0 * self.asked.linear_within:
            self.domain[place] = "time"
            self.reason[place] = f"{name}: run and linear model differ by {share:.0f} % of the allowance"
        else:
            self.reason[place] = f"within {share:.1f} % of the allowance ({name})"

    def take_time(self, place: Place, found: Sequence[ByTime]) -> None:
        """Fill a cell by its runs."""
        for i, one in enumerate(found):
            at = (i, *place)
            self.by_criterion[at], self.low[at], self.high[at] = one.allowable, one.low, one.high
        failed = max((one.failed for one in found), default=0)
        unknown = [one.unknown for one in found if not np.isnan(one.unknown)]
        if unknown and (np.isnan(self.allowable[place]) or self.allowable[place] <= min(unknown)):
            self.reason[place] = f"{failed} runs failed: not known from Hs {min(unknown):g} m on"
        elif failed:
            self.reason[place] = f"{failed} runs failed, and the others count"

    def table(self, scene: str, alpha: AlphaFactor, hours: float, failures: Mapping[int, str]) -> AllowableHs:
        """The table of these cells, filled; without a duration it is of lifts in stages."""
        asked = self.asked
        names = [one.name for one in asked.criteria]
        found, capped = self.allowable, self.by_criterion.min(axis=0) > asked.hs[-1]
        governing = np.where(capped, "", np.array(names)[self.by_criterion.argmin(axis=0)])
        low, high = (np.minimum(values.min(axis=0), asked.hs[-1]) for values in (self.low, self.high))
        forecast = alpha.at(found, hours=hours) * found
        cell, period, told = ("tp", "direction_deg"), ("tp",), alpha.told(hours=hours)

        def column(name: str, values: Any, unit: str = "", long_name: str = "", over: Any = cell) -> Column:
            return Column(name=name, values=values, unit=unit, long_name=long_name, over=over)

        axes = [
            Column(name="criterion", values=names),
            Column(name="tp", values=asked.tp, unit="s", long_name="peak period"),
            Column(name="direction_deg", values=asked.direction_deg, unit="degrees",
                   long_name="direction of travel of the waves"),
        ]  # fmt: skip
        columns = [
            column("allowable_hs", found, "m", "allowable significant wave height"),
            column("low", low, "m", "lower end of its 95 % interval"),
            column("high", high, "m", "upper end of its 95 % interval"),
            column("forecast_hs", forecast, "m", f"allowable in a forecast: {told}"),
            column("capped", capped, "", "no criterion is reached at the largest Hs examined"),
            column("governing", governing.astype(str)),
            column("domain", self.domain),
            column("reason", self.reason.astype(str)),
            column("by_criterion", self.by_criterion, "m", over=None),
            column("difference", self.difference, "1", "run against linear model, over the allowance", None),
            column("breaking_hs", [breaking_height(tp) for tp in asked.tp], "m",
                   "Hs above which waves of that period break (DNV-RP-C205)", period),
            column("wave_energy_share", self.energy_share, "1", over=period),
        ]  # fmt: skip
        attributes = {
            "scene": scene,
            "criteria": "; ".join(one.told(one_lift=asked.duration is None) for one in asked.criteria),
            "alpha_factor": told,
            "operation_hours": hours,
            "hs_of_runs": list(asked.hs),
            "seeds": list(asked.seeds),
            **({} if asked.duration is None else {"duration": asked.duration}),
            "linear_within": asked.linear_within,
        }
        return AllowableHs(
            scene=scene, criteria=asked.criteria, alpha=alpha, hours=hours, failures=dict(failures),
            dataset=Table(axes=axes, columns=columns, attributes=attributes).to_xarray(),
        )  # fmt: skip
