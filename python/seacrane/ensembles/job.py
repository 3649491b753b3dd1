"""The work of one pack, wherever it is done: each member described, run, and reduced to what is kept."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, lru_cache, partial
from typing import Any

from seacrane.ensembles.members import Value
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.study import Study
from seacrane.errors import SeacraneError
from seacrane.run.advance import drive
from seacrane.run.controller_calls import Calls
from seacrane.run.interrupts import Interrupts
from seacrane.run.lanes import advance_side_by_side
from seacrane.run.run import Run
from seacrane.version import __version__

Pack = tuple[tuple[int, Mapping[str, Value]], ...]


class WorkerVersionError(SeacraneError):
    """A worker has another version of seacrane than the process that asks for the ensemble."""


class Job:
    """A study to be run in packs; on its way to another process it is written once, and read there once."""

    def __init__(self, study: Study) -> None:
        self.study = study

    @cached_property
    def _data(self) -> bytes:
        return pickle.dumps(self.study, protocol=pickle.HIGHEST_PROTOCOL)

    def __reduce__(self) -> tuple[Any, ...]:
        return _read, (self._data,)

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
        if self.study.lanes == 1:
            return [self._outcome(index, partial(self._begun, values)) for index, values in pack]
        lanes = self.study.lanes
        beside: dict[int, list[tuple[int, Mapping[str, Value]]]] = {}
        for index, values in pack:
            beside.setdefault(index // lanes, []).append((index, values))
        return [outcome for members in beside.values() for outcome in self._together(members)]

    def _together(self, members: Sequence[tuple[int, Mapping[str, Value]]]) -> list[Outcome]:
        """Of members in lanes: each is then run to its end by itself, where that is left."""
        begun = {index: _tried(partial(self._begun, values)) for index, values in members}
        runs = [run for run in begun.values() if isinstance(run, Run)]
        if runs and not self._advanced(runs):
            begun = {index: _tried(partial(self._begun, values)) for index, values in members}
        return [self._outcome(index, partial(_given, begun[index])) for index, _ in members]

    def _advanced(self, runs: Sequence[Run]) -> bool:
        """Advance runs side by side; False where that failed, and left them nowhere."""
        with Interrupts() as interrupts:
            try:
                reached = advance_side_by_side(runs, self.study.lanes, lambda _: interrupts.take())
            except (MemoryError, SeacraneError, ValueError):
                return False
        interrupts.take()
        if not reached:
            raise KeyboardInterrupt
        return True

    def _begun(self, values: Mapping[str, Value]) -> Run:
        study = self.study
        return Run(study.scene(values), study.t_end, method=study.method, outputs=study.outputs)

    def _outcome(self, index: int, begun: Callable[[], Run]) -> Outcome:
        try:
            return self._ended(index, begun())
        except MemoryError:
            raise
        except Exception as error:
            return Outcome(index=index, failure=f"{type(error).__name__}: {error}")

    def _ended(self, index: int, run: Run) -> Outcome:
        with Interrupts() as interrupts:
            drive(run, Calls((), run.start.time), interrupts)
        interrupts.take()  # pressed as the run ended: the members after it are not to be run
        if run.interrupted:
            raise KeyboardInterrupt
        result = run.result()
        return Outcome(
            index=index, kept=self.study.kept_of(result), validity=str(result.stats.get("validity", ""))
        )


def _tried(begun: Callable[[], Run]) -> Run | Exception:
    try:
        return begun()
    except MemoryError:
        raise
    except Exception as error:
        return error


def _given(begun: Run | Exception) -> Run:
    """A run, or what kept it from being begun."""
    if isinstance(begun, Exception):
        raise begun
    return begun


@lru_cache(maxsize=4)
def _read(data: bytes) -> Job:
    return Job(pickle.loads(data))
