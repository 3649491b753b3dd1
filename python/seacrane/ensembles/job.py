"""The work of one pack, wherever it is done: each member described, run, and reduced to what is kept."""

from __future__ import annotations

import pickle
from collections.abc import Mapping
from functools import cached_property, lru_cache
from typing import Any

from seacrane.ensembles.members import Value
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.prepared import Prepared
from seacrane.ensembles.study import Study
from seacrane.errors import SeacraneError
from seacrane.run.advance import drive
from seacrane.run.controller_calls import Calls
from seacrane.run.interrupts import Interrupts
from seacrane.version import __version__

Pack = tuple[tuple[int, Mapping[str, Value]], ...]


class WorkerVersionError(SeacraneError):
    """A worker has another version of seacrane than the process that asks for the ensemble."""


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
        return [self._outcome(index, values) for index, values in pack]

    def _outcome(self, index: int, values: Mapping[str, Value]) -> Outcome:
        try:
            return self._run(index, values)
        except MemoryError:
            raise
        except Exception as error:
            return Outcome(index=index, failure=f"{type(error).__name__}: {error}")

    def _run(self, index: int, values: Mapping[str, Value]) -> Outcome:
        run = self._prepared.run(values)
        with Interrupts() as interrupts:
            drive(run, Calls((), run.start.time), interrupts)
        interrupts.take()  # pressed as the run ended: the members after it are not to be run
        if run.interrupted:
            raise KeyboardInterrupt
        result = run.result()
        return Outcome(
            index=index, kept=self.study.kept_of(result), validity=str(result.stats.get("validity", ""))
        )


@lru_cache(maxsize=4)
def _read(data: bytes) -> Job:
    return Job(pickle.loads(data))
