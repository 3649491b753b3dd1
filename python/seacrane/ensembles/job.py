"""The work of one pack, wherever it is done: each member described, run, and reduced to what is kept."""

from __future__ import annotations

import math
import pickle
from collections import OrderedDict, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cached_property, lru_cache
from itertools import pairwise
from threading import Lock
from time import thread_time
from typing import Any, ParamSpec, TypeVar

from seacrane import _core
from seacrane.analysis.after_run import Finding, require_finite
from seacrane.description.given import given_vessels
from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.members import Value
from seacrane.ensembles.other_sea import OtherSeeds
from seacrane.ensembles.study import START_TIME, Study, Values
from seacrane.errors import MemberLimitError, SceneError, SeacraneError, WorkerVersionError
from seacrane.one_thread import one_thread
from seacrane.result.record import Record
from seacrane.run.advance import ended
from seacrane.run.carry import AlikeStages
from seacrane.run.interrupts import Interrupts
from seacrane.run.lanes import LiftsInLanes, advance_side_by_side, note_apart
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.plan import first_scene
from seacrane.run.run import Run
from seacrane.run.stage import Stage
from seacrane.run.staged_run import StagedRun
from seacrane.scene.scene import Scene
from seacrane.version import __version__

TOGETHER = 4  # members of a pack whose runs are in memory at a time
Some = TypeVar("Some")
P = ParamSpec("P")
Pack = tuple[tuple[int, Mapping[str, Value]], ...]
Runs = list[Run | StagedRun | str]  # or why there is none
MOST_HELD = 32  # of each: scenes that differ in more than their sea, runs that wait for a lift


class Clock(Interrupts):
    """Takes Ctrl-C, and ends by a MemberLimitError what takes more processor time than a limit."""

    def __init__(self) -> None:
        super().__init__()
        self._limit = self._end = math.inf

    @contextmanager
    def limited(self, limit: float) -> Iterator[None]:
        """Within the block processor time has a limit, s."""
        self._limit, self._end = limit, thread_time() + limit if limit < math.inf else math.inf
        try:
            yield
        finally:
            self._end = math.inf

    def take(self) -> None:
        """Do what Ctrl-C stands for, or end what takes too long."""
        super().take()
        if self._end < math.inf and thread_time() > self._end:
            raise MemberLimitError(
                f"it took more than {self._limit:g} s of processor time; give a larger member_limit"
            )


def stepped(run: Run | StagedRun, clock: Clock, limit: float = math.inf) -> Run | StagedRun:
    """The run at its end; KeyboardInterrupt where Ctrl-C stopped it, MemberLimitError beyond a limit, s."""
    with clock.limited(limit):
        if isinstance(run, StagedRun):
            for _ in run.runs(clock):
                pass
        else:
            ended(run, (), clock)
    if run.interrupted:
        raise KeyboardInterrupt
    return run


class Carried:
    """The states of a scene that waits for its lift, at the times at which one may begin.

    It lands on each of them on its way to a later one, so that every state is the same to the bit whichever
    were asked for before. Threads may share it.
    Its times ascend, s; without a start it is assembled. By the method of the lift, and nothing is recorded.
    """

    def __init__(
        self,
        scene: Scene,
        stages: Sequence[Stage],
        *,
        start: _core.State | None,
        times: Sequence[float],
        method: Method,
        outputs: Outputs,
    ) -> None:
        self._scene = first_scene(scene, stages)
        self._model = self._scene.compile()
        self._state = _core.initial_state(self._model) if start is None else start
        self._left = list(times)
        if self._left[0] < self._state.time:
            raise SceneError(
                f"{START_TIME} is {self._left[0]:g} s, and the run that waits for it begins at "
                f"{self._state.time:g} s; give later ones"
            )
        self._method, self._outputs = method, replace(outputs, channels=())
        self._reached: dict[float, tuple[_core.State, tuple[Finding, ...]]] = {}
        self._found: list[Finding] = []
        self._lock = Lock()

    def at(self, time: float) -> tuple[_core.State, tuple[Finding, ...]]:
        """The state at one of the times, and what was out of range until then, as a load through a deck."""
        with self._lock:
            while time not in self._reached:
                self._state = self._next(self._left[0])
                self._reached[self._left.pop(0)] = self._state, tuple(self._found)
            return self._reached[time]

    def _next(self, time: float) -> _core.State:
        if time == self._state.time:
            return self._state
        run = Run(
            self._scene, time, start=self._state, method=self._method, outputs=self._outputs,
            model=self._model,
        )  # fmt: skip
        with Clock() as clock:
            ended_run = stepped(run, clock)
        clock.take()
        assert isinstance(ended_run, Run)
        known = {kind for kind, _ in self._found}
        self._found += [one for one in ended_run.judged_result()[1] if one[0] not in known]
        return ended_run.state


class Job:
    """A study to be run in packs; on its way to another process it is written once, and read there once."""

    def __init__(self, study: Study) -> None:
        self.study = study
        self._prepared = Prepared(study)

    @cached_property
    def _data(self) -> bytes:
        return pickle.dumps(self.study, protocol=pickle.HIGHEST_PROTOCOL)

    def __reduce__(self) -> tuple[Any, ...]:
        return _read, (self._data,)

    @one_thread
    def run(self, pack: Pack, version: str) -> list[Outcome]:
        """The outcomes of a pack, in its order.

        Raises
        ------
        WorkerVersionError
            Where the version here is not the one asked for.
        KeyboardInterrupt
            Where Ctrl-C stopped a run.
        """
        if version != __version__:
            raise WorkerVersionError(
                f"a worker has seacrane {__version__}, and the ensemble is of {version}; install the same"
            )
        count = TOGETHER if self.study.lanes == 1 else self.study.lanes
        groups = [pack[first : first + count] for first in range(0, len(pack), count)]
        with Clock() as clock:
            outcomes = [outcome for members in groups for outcome in self._together(members, clock)]
        clock.take()
        return outcomes

    def _together(self, members: Pack, clock: Clock) -> list[Outcome]:
        """Prepared, then stepped, then ended: what each of them needs is then in the processor's caches."""
        times = [thread_time()]
        runs = self._begun(members, times, clock)
        if self.study.lanes > 1:
            runs = self._beside(members, runs, clock)
        runs = [
            run if isinstance(run, str) else _tried(clock, stepped, run, clock, self.study.member_limit)
            for run in runs
        ]
        outcomes = [self._outcome(index, run, clock) for (index, _), run in zip(members, runs, strict=True)]
        share = (thread_time() - times[-1]) / len(members)
        return [
            replace(one, begun_s=there - before, stepped_s=share)
            for one, (before, there) in zip(outcomes, pairwise(times), strict=True)
        ]

    def _begun(self, members: Pack, times: list[float], clock: Clock) -> Runs:
        """The runs at their starts; at what processor time each was there is added to the times, s."""
        runs = []
        for _, values in members:
            runs.append(_tried(clock, self._prepared.run, values))
            times.append(thread_time())
        return runs

    def _beside(self, members: Pack, begun: Runs, clock: Clock) -> Runs:
        """The runs as far as they go side by side; where that fails altogether, begun anew."""
        runs = list(begun)
        try:
            with clock.limited(self.study.member_limit * len(members)):
                reached = self._advance(runs, clock)
        except (MemoryError, SeacraneError, ValueError) as error:
            reached, runs = True, self._begun(members, [], clock)
            why = f"stepping it beside others failed: {type(error).__name__}: {error}"
            note_apart([run for run in runs if isinstance(run, Run)], why)
        clock.take()
        if not reached:
            raise KeyboardInterrupt
        return runs

    def _advance(self, runs: Runs, interrupts: Interrupts) -> bool:
        lanes = self.study.lanes
        if not self.study.stages:
            plain = [run for run in runs if isinstance(run, Run)]
            return advance_side_by_side(plain, lanes, lambda _: interrupts.take())

        def stepped_in_lanes(place: int, lift: StagedRun) -> Iterator[Run]:
            try:
                yield from lift.runs(interrupts)
            except (MemoryError, MemberLimitError):
                raise
            except Exception as error:
                runs[place] = _told(error)

        lifts = [
            stepped_in_lanes(place, lift) for place, lift in enumerate(runs) if isinstance(lift, StagedRun)
        ]
        return LiftsInLanes(lifts, lanes, lambda _: interrupts.take()).advance()

    def _outcome(self, index: int, run: Run | StagedRun | str, clock: Clock) -> Outcome:
        """The outcome of a run at its end, or of why there is none."""
        made = run if isinstance(run, str) else _tried(clock, self._ended, index, run)
        return Outcome(index=index, failure=made) if isinstance(made, str) else made

    def _ended(self, index: int, run: Run | StagedRun) -> Outcome:
        made = run.record() if isinstance(run, Run) and self.study.keeps_curves else run.result()
        result: Record = require_finite(made)
        validity, apart = (str(result.stats.get(name, "")) for name in ("validity", "kept_apart"))
        return Outcome(index=index, kept=self.study.kept_of(result), validity=validity, kept_apart=apart)


def _tried(clock: Clock, work: Callable[P, Some], *given: P.args, **named: P.kwargs) -> Some | str:
    """What it returns, or in words why it failed; Ctrl-C that was pressed meanwhile is taken then."""
    made: Some | str
    try:
        made = work(*given, **named)
    except MemoryError:
        raise
    except Exception as error:
        made = _told(error)
    clock.take()
    return made


def _told(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"


@lru_cache(maxsize=4)
def _read(data: bytes) -> Job:
    return Job(pickle.loads(data))


class Prepared:
    """Makes the runs of a study; threads may share it.

    The run of a member is, to the bit, that of its scene by itself.
    """

    def __init__(self, study: Study) -> None:
        self._study = study
        self._held: defaultdict[str, OrderedDict[str, Any]] = defaultdict(OrderedDict)
        self._lock = Lock()

    def run(self, values: Values) -> Run | StagedRun:
        """Run of the member with these values, at its start. Raises what describing or compiling raises."""
        study = self._study
        source = study.source
        sea, others = study.parts(values)
        if study.stages:
            scene, stages, start, before = self.lift(values)
            same = isinstance(source, Scene) and not callable(study.stages) and not given_vessels(scene)
            return StagedRun(
                scene, stages, start=start, before=before, method=study.method, outputs=study.outputs,
                peaks=study.peaks, alike=self._kept("stages alike", others, AlikeStages) if same else None,
            )  # fmt: skip
        if not sea or study.start is not None or not isinstance(source, Scene) or given_vessels(source):
            return self._begun(study.scene(values))
        # The run of the scene's own sea, from which those of other seas are made, is not stepped.
        first: Run = self._kept("first", others, lambda: self._begun(study.scene(others)))
        words = {name: value for name, value in sea.items() if name != "seed"}
        seeds: OtherSeeds = self._kept("seeds", {**others, **words}, lambda: OtherSeeds(first.scene, words))
        return first.in_sea(seeds.sea(sea.get("seed")))

    def lift(self, values: Values) -> tuple[Scene, list[Stage], _core.State | None, Sequence[Finding]]:
        """The scene and stages of a member, where it begins, and what was out of range until then."""
        study = self._study
        scene = study.scene(values)
        stages = study.stages_of(scene, values)
        start = study.start_of(scene)
        if START_TIME not in values:
            return scene, stages, start, ()
        same = {name: value for name, value in values.items() if name != START_TIME}
        carried: Carried = self._kept(
            "carried", same,
            lambda: Carried(
                scene, stages, start=start, times=study.start_times, method=study.method,
                outputs=study.outputs,
            ),
        )  # fmt: skip
        return scene, stages, *carried.at(float(values[START_TIME]))

    def _begun(self, scene: Scene) -> Run:
        study = self._study
        return Run(
            scene, study.t_end, start=study.start_of(scene), method=study.method, outputs=study.outputs,
            peaks=study.peaks,
        )  # fmt: skip

    def _kept(self, kind: str, values: Values, make: Callable[[], Any]) -> Any:
        """What is held of these values, made where it is not; of too many the one of longest ago goes."""
        key = repr(list(values.items()))
        with self._lock:
            held = self._held[kind]
            if key not in held:
                held[key] = make()
            held.move_to_end(key)
            if len(held) > MOST_HELD:
                held.popitem(last=False)
            return held[key]
