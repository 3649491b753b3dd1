"""Packs run and kept as they come, with a bar of progress."""

from __future__ import annotations

import contextlib
import re
from collections import Counter
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from importlib import import_module
from itertools import islice

from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.job import Job, Pack
from seacrane.ensembles.members import Members
from seacrane.ensembles.other_sea import WORDS
from seacrane.ensembles.store import Store, kept_packs
from seacrane.errors import SceneError, SimulationError, WorkerVersionError
from seacrane.run.lanes import lanes_of
from seacrane.version import __version__

PACKAGE = __name__.partition(".")[0]
AT_ONCE = 256  # packs on their way: what came back and is not yet kept takes memory
Gathered = tuple[int, list[Outcome]]
SIDE_BY_SIDE = "side_by_side"  # attribute of a dataset
PARTLY = re.compile(r"from t = \S+ s on: |in part: ")
MOST_REASONS = 3
PRICE = "by itself a loop takes about twice its time in lanes"
WAITING = "lifts with start_time go on from one run"


def run_packs(
    store: Store, job: Job, members: Members, packs: Mapping[int, Sequence[int]], executor: Executor | None,
    bar: Progress, *, raises: bool, measured: list[Outcome] | None = None,
) -> None:  # fmt: skip
    """Run and keep those packs, by number and members, that are not in the store.

    Raises SimulationError for the first member that failed, now or before, where it `raises`. Outcomes are
    added to `measured`, whose processor time no store has.
    """
    there = kept_packs(store, packs)
    bar.skip(sum(len(packs[number]) for number in there))
    if raises:
        for number in sorted(there):
            _require_success(store[number], members)
    left = ((number, indices) for number, indices in packs.items() if number not in there)
    coming = ((number, tuple((index, members.values(index)) for index in own)) for number, own in left)
    with contextlib.closing(gathered(job, coming, executor)) as found:
        for number, outcomes in found:
            store[number] = outcomes
            bar.add(outcomes)
            if measured is not None:
                measured += outcomes
            if raises:
                _require_success(outcomes, members)


def _require_success(outcomes: Iterable[Outcome], members: Members) -> None:
    for outcome in outcomes:
        if outcome.failure:
            told = ", ".join(f"{name}={value!r}" for name, value in members.values(outcome.index).items())
            raise SimulationError(f"ensemble: member {outcome.index} ({told}) failed: {outcome.failure}")


class Progress:
    """A bar over members with the time left, and how they are stepped; hidden where none is wanted."""

    def __init__(self, total: int, wanted: bool, lanes: int) -> None:
        kind = import_module("tqdm.auto" if wanted else "tqdm")  # a notebook's bar may warn of its widgets
        self.bar = kind.tqdm(total=total, unit="member", desc="ensemble", disable=not wanted)
        self._lanes, self._told = lanes, Counter[str]()

    def skip(self, count: int) -> None:
        """So many members were done before, which tells nothing of the time left."""
        self.bar.update(count)
        self.bar.initial = self.bar.n

    def add(self, outcomes: Sequence[Outcome]) -> None:
        """Members more are done: in how many lanes, or why by themselves, the bar says of all until now."""
        if self.bar.disable:
            return
        self._told.update(one.kept_apart for one in outcomes)
        self.bar.set_postfix_str(remark(self._lanes, self._told), refresh=False)
        self.bar.update(len(outcomes))

    def left(self, count: int) -> None:
        """So many members are still expected."""
        self.bar.total = self.bar.n + count
        self.bar.refresh()


def gathered(
    job: Job, packs: Iterator[tuple[int, Pack]], executor: Executor | None
) -> Generator[Gathered, None, None]:
    """The outcomes of packs by their number, as they come.

    Raises SimulationError after all others, where workers were lost with their packs.
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


def lanes_for(lanes: int | None, pack: int | None, members: Members, *, starts: Sequence[float]) -> int:
    """The lanes of an ensemble, of which those that begin at several times of one run have none.

    Raises SceneError for lanes that there are not.
    """
    asked = lanes_of(lanes)
    if starts and lanes not in (None, 1):
        raise SceneError(f"lanes is {lanes}, and lifts with start_time are run one by one; leave lanes out")
    if starts:
        return 1
    if lanes is not None:
        return asked
    of_one_lift = any(name in WORDS for name in members.axes)
    return asked if of_one_lift and not (isinstance(pack, int) and pack % asked) else 1


def remark(lanes: int, told: Mapping[str, int], *, starts: bool = False) -> str:
    """One line on how members are stepped, by how many were kept apart for each reason, and the price of it.

    `starts`: whether they begin at several times of one run.
    """
    if lanes == 1:
        alone = f"{sum(told.values())} one by one"
        return f"{alone}: {WAITING}; {PRICE}" if starts else alone
    reasons = Counter[str]()
    for why, several in told.items():
        reasons[PARTLY.sub("in part, ", why)] += several
    words = [f"{reasons.pop('', 0)} in {lanes} lanes"]
    words += [f"{several} by themselves: {why}" for why, several in reasons.most_common(MOST_REASONS)]
    words += ["..."] * (len(reasons) > MOST_REASONS) + [PRICE] * bool(reasons)
    return "; ".join(words)
