"""Packs sent to an executor, a bounded number at a time, and what comes back."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from itertools import islice

from seacrane.ensembles.job import Job, Pack
from seacrane.ensembles.outcome import Outcome
from seacrane.errors import SimulationError, WorkerVersionError
from seacrane.version import __version__

PACKAGE = __name__.partition(".")[0]
AT_ONCE = 256  # packs on their way: what came back and is not yet kept takes memory

Gathered = tuple[int, list[Outcome]]


def gathered(
    job: Job, packs: Iterator[tuple[int, Pack]], executor: Executor | None
) -> Generator[Gathered, None, None]:
    """The outcomes of packs by their number, as they come.

    Raises
    ------
    SimulationError
        After all others, where workers were lost with their packs.
    """
    if executor is None:
        for number, pack in packs:
            yield number, job.run(pack, __version__)
        return
    lost: dict[int, BaseException] = {}
    on_way: dict[Future[list[Outcome]], int] = {}
    try:
        while _fill(on_way, job, packs, executor, lost) or on_way:
            for future in wait(on_way, return_when=FIRST_COMPLETED).done:
                yield from _taken(future, on_way.pop(future), lost)
    except KeyboardInterrupt:
        for future, number in on_way.items():
            if not future.cancel() and future.done():
                yield from _taken(future, number, lost)
        raise
    finally:
        for future in on_way:
            future.cancel()
    if lost:
        number, error = min(lost.items(), key=lambda item: item[0])
        raise SimulationError(
            f"ensemble: pack {number} was lost with its worker ({type(error).__name__}: {error}). Members "
            "that came back are in the store, if one was given: call again with the same store and a new "
            "executor to run the others"
        ) from error


def _fill(
    on_way: dict[Future[list[Outcome]], int],
    job: Job,
    packs: Iterator[tuple[int, Pack]],
    executor: Executor,
    lost: dict[int, BaseException],
) -> bool:
    """Send as many packs as may be on their way; whether any was sent."""
    if any(isinstance(error, BrokenExecutor) for error in lost.values()):
        return False
    sent = False
    for number, pack in islice(packs, AT_ONCE - len(on_way)):
        try:
            on_way[executor.submit(job.run, pack, __version__)] = number
        except BrokenExecutor as error:
            lost[number] = error
            break
        sent = True
    return sent


def _taken(future: Future[list[Outcome]], number: int, lost: dict[int, BaseException]) -> Iterator[Gathered]:
    """What a pack brought; what lost it is noted."""
    try:
        outcomes = future.result()
    except WorkerVersionError:
        raise
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != PACKAGE:
            lost[number] = error
            return
        raise WorkerVersionError(
            f"a worker has no {PACKAGE} ({error}), and the ensemble is of {__version__}; install it there"
        ) from error
    except Exception as error:
        lost[number] = error
    else:
        yield number, outcomes
