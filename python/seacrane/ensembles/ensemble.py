"""ensemble(): many runs of one lift over seeds, seas and parameters, on any executor."""

from __future__ import annotations

import contextlib
import math
import os
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

from seacrane.accuracy.choice import refuse_what_is_chosen
from seacrane.accuracy.expected import expected_error
from seacrane.ensembles.asked import checked_start, end_of, start_times_of
from seacrane.ensembles.chosen_accuracy import EnsembleAccuracy, checked, probed
from seacrane.ensembles.dataset import NOT_RUN, RESERVED, dataset_of
from seacrane.ensembles.filling import SIDE_BY_SIDE, Progress, lanes_for, remark, run_packs
from seacrane.ensembles.growing import GROWTH, Certain, Growth, Judge, grow, members_in
from seacrane.ensembles.job import Job
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import Members, Over, Value
from seacrane.ensembles.object_store import claimed_store, note, opened_store
from seacrane.ensembles.parts import KNOWN, Part, part_of
from seacrane.ensembles.price import Priced, goes_on
from seacrane.ensembles.store import Store, order_of, pack_size, packs_of, stored
from seacrane.ensembles.study import (
    START_TIME,
    Asked,
    Source,
    Stages,
    Start,
    Study,
    checked_keep,
    checked_stages_of,
    outputs_for,
)
from seacrane.ensembles.study_folder import identity_of, study_in
from seacrane.ensembles.targets import Certainty, targets_of, with_static_parts
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.run.channel_names import require_channels
from seacrane.run.method import Method, Shorthand, settled
from seacrane.run.outputs import Outputs
from seacrane.scene.scene import Scene
from seacrane.statistics.distribution import Distribution, distribution
from seacrane.warnings import FailedMembersWarning

if TYPE_CHECKING:
    import pandas
    import xarray
    from typing_extensions import Unpack

POOLED = ("seed", START_TIME)


@named
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Ensemble:
    """What the members of an ensemble kept.

    Attributes
    ----------
    dataset : xarray.Dataset
        A variable for everything kept, over the parameters of a grid or over `member`, NaN where a member
        failed or was not run; `failure`, `validity` and `kept_apart` are texts. The attribute `side_by_side`
        says how many were stepped side by side, and why others were not, with the price of it.
    failures : mapping of int to str
        Why members failed, by their number in order of the parameters, the last of a grid fastest.
    certainty : tuple of Certainty
        Of an ensemble with `until`: the statistics asked for, for every combination of parameters.
    accuracy : EnsembleAccuracy or None
        Of an ensemble with `accuracy`: the method that was chosen, and the errors that were found.
    """

    members: Members
    dataset: xarray.Dataset
    failures: Mapping[int, str] = field(default_factory=dict)
    certainty: tuple[Certainty, ...] = ()
    accuracy: EnsembleAccuracy | None = None

    def __repr__(self) -> str:
        shape = " x ".join(f"{size} {name}" for name, size in self.members.shape.items())
        return f"<Ensemble of {len(self.members)} members ({shape}), {len(self.failures)} failed>"

    def parameters(self, index: int) -> dict[str, Any]:
        """What a member has of what varies."""
        return self.members.values(index)

    def __str__(self) -> str:
        return f"{repr(self)[1:-1]}\n{self.to_dataframe()}"

    def to_dataframe(self) -> pandas.DataFrame:
        """What was kept as columns of a table, over the parameters; of kept curves over their axes too."""
        return self.dataset.drop_vars(("failure", "validity", "kept_apart"), errors="ignore").to_dataframe()

    def distribution(self, name: str, **chosen: Value) -> Distribution:
        """How what was kept is distributed over the seeds and, of lifts in stages, their start times.

        Parameters
        ----------
        name : str
            What was kept, one number of each member.
        **chosen
            The value of each other parameter, such as ``hs=1.5``, where there are others.

        Returns
        -------
        Distribution
            With intervals by resampling seeds: what begins at several times in one sea is dependent.

        Raises
        ------
        SceneError
            For something else than one number by seed and start time.

        Warns
        -----
        FewSeedsWarning
        """
        if name not in self.dataset:
            raise SceneError(
                f"distribution: nothing is kept as {name!r}; kept are {', '.join(map(str, self.dataset))}"
            )
        table = self.dataset[name]
        for dim, value in chosen.items():
            if dim not in table.dims or value not in table[dim]:
                raise SceneError(
                    f"distribution: {dim}={shown(value)} is not in it; it is over {dict(table.sizes)}"
                )
            table = table.sel({dim: value})
        table = table.squeeze([dim for dim in table.dims if dim not in POOLED and table.sizes[dim] == 1])
        others = [str(dim) for dim in table.dims if dim not in POOLED]
        if others or "seed" not in table.dims:
            missing = f"say which, as in {others[0]}=..." if others else "give several seeds in over"
            raise SceneError(f"distribution: {name!r} is over {', '.join(map(str, table.dims))}; {missing}")
        rows = table.transpose("seed", ...).to_numpy().reshape(table.sizes["seed"], -1)
        return distribution(rows, name=name, unit=str(table.attrs.get("units", "")))

    @classmethod
    def load(cls, folder: str | os.PathLike[str]) -> Ensemble:
        """What a store holds so far. Raises FileFormatError for a folder that is none, or damaged."""
        store = opened_store(folder)
        data = study_in(store.path)
        members, lanes = members_in(store, data), data.get("identity", {}).get("lanes", 1)
        return _ensemble(members, stored(store, members), lanes if isinstance(lanes, int) else 1)


@named
def ensemble(
    source: Source,
    *,
    over: Over,
    keep: Asked,
    t_end: float | None = None,
    stages: Stages = (),
    method: Method | None = None,
    outputs: Outputs | None = None,
    start: Start | Literal["rest"] = None,
    executor: Executor | None = None,
    store: str | os.PathLike[str] | None = None,
    until: Mapping[str, float] | Judge | None = None,
    accuracy: Mapping[str, float] | None = None,
    on_error: Literal["record", "raise"] = "record",
    pack: int | None = None,
    lanes: int | None = None,
    member_limit: float | None = None,
    part: tuple[int, int] | str | None = None,
    priced: Priced | None = None,
    progress: bool = False,
    **shorthand: Unpack[Shorthand],
) -> Ensemble:
    """Run a lift for many seeds, seas or parameters, and keep of each run what is asked for.

    The results are the same to the bit whatever the executor, its workers, the packs and their order, and
    whether the ensemble was killed and resumed; and within the tolerance whatever the processor and `lanes`.

    Parameters
    ----------
    source : Scene or callable
        A scene of which parts vary, or ``function(**parameters)`` that returns one. For executors of other
        processes the function stands at the top level of a module.
    over : mapping, list of mappings, or LatinHypercube
        Values by name. A mapping is a grid of all combinations; a list has one mapping for each member. Of a
        scene, names are paths such as "bodies.payload.mass", or words of its sea: "seed", "hs", "tp",
        "direction_deg" and "gamma". Up to a million members.
    keep : mapping
        By name: a `Kept` or its short text, such as "hook_load.max", or a function of a `Result` that returns
        numbers.
    t_end : float, optional
        End time, s; default 100. Stages tell it themselves.
    stages : sequence of Stage, or callable
        The members are lifts in these stages, as `simulate` runs them, or in those that a function
        of the scene tells. Their numbers vary by paths such as "stages.lift.duration",
        "stages.lift.commands.hoist.rate" or, of a `Move`, "stages.lift.commands.slew.to". What is kept may
        be of one stage, "hook_load[stage=lift].max", and its time, "stage[lift].end" ("start", "duration").
        A member whose stage is not over in its maximum duration fails, by its name.
        In a grid, "start_time" (s) is when the lift begins. One run carries the waiting scene through its
        sea, from each start time to the next. A member begins in the state that this run has reached at its
        start time. Such members run one by one, not in lanes.
    method, outputs : Method, Outputs, optional
        As of `simulate`. Without channels in `outputs`, runs record only what is kept.
    start : State, "rest" or callable, optional
        Where every member begins, the word for its state at rest, or a function of its scene that tells it;
        default: the assembled start of its scene.
    executor : concurrent.futures.Executor, optional
        Threads, processes, or ``client.get_executor()`` of dask.distributed; default: one member after
        another, here.
    store : path, optional
        A folder for results as they come, in NetCDF, or a URL of an object store that fsspec knows. A call
        with the same study goes on where the last one ended.
    until : mapping of str to float, optional
        Half widths of 95 % intervals as shares of the dynamic part, such as ``{"hook_load.mpm": 0.02}``:
        "mpm", "mean" or "p90" of a maximum or minimum that is kept, "mean" of anything else. Seeds are added
        in whole batches of 20 until every combination of the other parameters is known so narrowly; those in
        `over`, one after another, are the most that there may be. The dynamic part is what differs from the
        mean of the channel, which is kept too, as "<name>_mean". The record is the exposure time.
    accuracy : mapping of str to float, optional
        Largest error by quantity, as of `simulate`: integrator and tolerance are chosen by a few members as
        probes, for all, and checked on others at random. Leave integrator, rtol and dt out.
    on_error : str
        "record": a member that fails is recorded, the others go on. "raise": the first failure ends it.
    pack : int, optional
        Members that are run, kept and lost together, a multiple of `lanes`; default: so many that there are
        at most 250 packs, but no more than 64; with `until` two seeds, or as many as there are lanes.
    lanes : int, optional
        Members that are stepped side by side, as far as they are of one lift; see docs/ensembles.md: 4, 8
        (AVX-512), or 1 for each by itself. Default: 4 where a word of the sea varies, the processor has AVX2
        and `pack` is a multiple of it. What cannot be stepped so is run by itself; `kept_apart` of the
        dataset, and of a result's stats, says why.
    member_limit : float, optional
        Processor time that a member may take once it is described, s: one beyond it fails, others go on. What
        is beyond it side by side is run anew, each by itself. A store belongs to one limit.
    part : (int, int) or str, optional
        Run one part of so many alone, (3, 40) or "3/40". It has whole packs, or with `until` all seeds of
        whole combinations, so that `merge_parts` makes of the stores of all parts what one run writes, to
        the bit.
    priced : callable, optional
        Is told the `Price` of all members that are missing, once a few packs of them are run, and says
        whether to go on. If not, the few are kept. Where none is left to be measured, it is told None.
    progress : bool
        Show a progress bar with the time left.
    **shorthand
        Parts of `method` and `outputs` by name, as of `simulate`.

    Raises
    ------
    SceneError
        For a parameter that the scene does not have, too many members, a part that there is not, or a store
        of another study.
    SimulationError
        With ``on_error="raise"``, or where a worker died; what came back before is in the store.
    WorkerVersionError
        Where a worker has another version of seacrane.
    OSError
        If the store cannot be written; the packs before it are in it.

    Warns
    -----
    FailedMembersWarning
        Where members failed.
    FailedSeedsWarning
        Where seeds of an ensemble with `until` failed.
    FewSeedsWarning
        Where `over` allows fewer seeds than `until` takes.
    LostMembersWarning
        Where members of the store are lost or damaged; they are run again.
    AccuracyNotHeldWarning
        Where a member that was checked has a larger error than `accuracy` allows.
    """
    if not isinstance(source, Scene) and not callable(source):
        raise SceneError(f"ensemble of {shown(source)}; give a Scene, or a function that returns one")
    if on_error not in ("record", "raise"):
        raise SceneError(f"on_error is {shown(on_error)}; choose 'record' or 'raise'")
    if executor is not None and not isinstance(executor, Executor):
        raise SceneError(f"executor is {shown(executor)}; give a concurrent.futures.Executor")
    how, recorded = settled(method, outputs, shorthand)
    wanted, in_stages = checked_keep(keep), checked_stages_of("ensemble", stages)
    starts, members = start_times_of(over, in_stages)
    judge: Judge | None = None
    if isinstance(until, Judge):
        judge = until
    elif until is not None:
        targets = targets_of(until, wanted)
        judge, wanted = Certain(targets=targets, asked=dict(until)), with_static_parts(wanted, targets)
    own = None if part is None else part_of(part)
    study = Study(
        source=source.copy() if isinstance(source, Scene) else source,
        t_end=math.inf if starts else end_of(t_end, in_stages),
        stages=in_stages,
        start_times=starts,
        method=how,
        outputs=outputs_for(wanted, recorded),
        keep=wanted,
        start=checked_start(start),
        lanes=lanes_for(lanes, pack, members, starts=starts),
        member_limit=math.inf if member_limit is None else positive_of("member_limit", member_limit, "s"),
    )
    for what in wanted.values():
        if isinstance(what, Kept):
            what.require_times(study.t_end, recorded.dt_out)
    if isinstance(source, Scene):
        require_channels(source, study.outputs.channels or ())
    for name in members.axes:
        if name in wanted or name in RESERVED:
            raise SceneError(f"over: the name {name!r} is taken by what is kept; rename one of them")
    study.require_names(list(members.axes))
    size = pack_size(pack, len(members), study.lanes, together=len(starts))
    raises = on_error == "raise"
    probes = {}
    if accuracy is not None:
        refuse_what_is_chosen(method, shorthand, ())
        probes = probed(study, members, accuracy, executor)
        tightest = min((probe.method for probe in probes.values()), key=expected_error)
        study = replace(study, method=tightest)
    job = Job(study)
    if judge is not None:
        beside = study.lanes if study.lanes > 1 else None
        growth = judge.growth(members, beside if pack is None else size, size)
        every = range(growth.cells) if own is None else own.numbers(growth.cells, "cells")
        cells = [cell for cell in every if judge.cells is None or cell in judge.cells]
        first, packs = growth.members(1), growth.packs_of_cells(0, cells)
        with _store(store, study, first, growth.size, growth=growth, part=own) as kept:
            further = goes_on(
                priced, kept, job, first, packs, executor, raises=raises, batches=growth.batches
            )
            if not further:
                there = growth.members(max(growth.batches_in(kept), 1))
                return _ensemble(there, stored(kept, there), study.lanes)
            if own is not None:
                note(kept, KNOWN, None)
            members, outcomes = grow(
                growth, job, kept, executor, judge, cells, raises=raises, progress=progress
            )
            if own is not None:
                told = {"until": judge.asked, "seeds": len(growth.seeds), "packs": len([*kept])}
                note(kept, KNOWN, told)
        done = _ensemble(members, dataset_of(members, outcomes), study.lanes)
        if isinstance(judge, Certain):
            done = replace(done, certainty=judge.told(growth))
        else:
            _warn_of_failures(done)
    else:
        with _store(store, study, members, size, part=own) as kept:
            packs = packs_of(order_of(study, members), size)
            packs = packs if own is None else {number: packs[number] for number in own.numbers(len(packs))}
            progressed = Progress(sum(map(len, packs.values())), progress, study.lanes)
            further = goes_on(priced, kept, job, members, packs, executor, raises=raises)
            if further:
                with progressed.bar:
                    run_packs(kept, job, members, packs, executor, progressed, raises=raises)
            done = _ensemble(members, stored(kept, members), study.lanes)
        _warn_of_failures(done)
        if not further:
            return done
    if accuracy is None:
        return done
    ran = [int(place) for place in (done.dataset.failure.to_numpy().ravel() == "").nonzero()[0]]
    return replace(done, accuracy=checked(study, done.members, accuracy, probes, ran, executor))


def _warn_of_failures(done: Ensemble) -> None:
    if not done.failures:
        return
    failed, every = len(done.failures), len(done.members)
    member, why = next(iter(done.failures.items()))
    told = (
        f"all {every} members failed, and nothing is kept"
        if failed == every
        else f"{failed} of {every} members failed, and what is kept leaves them out"
    )
    warn_caller(
        f"ensemble: {told}; the first, member {member}, by {why}. `failures` has all of them; try what is "
        'kept on one result of simulate, or give on_error="raise"',
        FailedMembersWarning,
    )


def _ensemble(members: Members, dataset: xarray.Dataset, lanes: int) -> Ensemble:
    told = dataset.failure.to_numpy().ravel()
    failures = {index: str(text) for index, text in enumerate(told) if text and text != NOT_RUN}
    apart = dataset.kept_apart.to_numpy().ravel()[told == ""]
    dataset.attrs[SIDE_BY_SIDE] = remark(lanes, Counter(map(str, apart)), starts=START_TIME in members.axes)
    return Ensemble(members=members, dataset=dataset, failures=failures)


@contextlib.contextmanager
def _store(
    path: str | os.PathLike[str] | None, study: Study, members: Members, size: int, *,
    growth: Growth | None = None, part: Part | None = None,
) -> Iterator[Store]:  # fmt: skip
    """Of an ensemble that grows half widths and the most seeds do not tell it from another."""
    if path is None:
        yield {}
        return
    grows = {} if growth is None else {"growth": {name: getattr(growth, name) for name in GROWTH}}
    identity = identity_of(study, members, size) | grows | ({} if part is None else part.identity())
    data = {"identity": identity, "grid": members.grid, "axes": dict(members.axes)}
    with claimed_store(path, data | grows) as kept:
        yield kept
