"""Packs run and kept as they come, with a bar of progress."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from typing import Any

from seacrane.ensembles.gather import gathered
from seacrane.ensembles.job import Job, Pack
from seacrane.ensembles.members import Members
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.store import Store
from seacrane.errors import SimulationError


def fill(
    store: Store,
    job: Job,
    packs: Iterator[tuple[int, Pack]],
    executor: Executor | None,
    *,
    done: Callable[[int], None],
    check: Callable[[Outcome], None],
) -> None:
    """Run packs by their number and keep what comes back.

    Parameters
    ----------
    done : callable
        Told how many members each pack had.
    check : callable
        Given every outcome once its pack is kept; may raise.
    """
    with contextlib.closing(gathered(job, packs, executor)) as coming:
        for number, outcomes in coming:
            store.keep(number, outcomes)
            done(len(outcomes))
            for outcome in outcomes:
                check(outcome)


def any_outcome(_: Outcome) -> None:
    """Whatever came of a member."""


def require_success(members: Members) -> Callable[[Outcome], None]:
    """A check that raises SimulationError for a member that failed."""

    def check(outcome: Outcome) -> None:
        if outcome.failure:
            told = ", ".join(f"{name}={value!r}" for name, value in members.values(outcome.index).items())
            raise SimulationError(f"ensemble: member {outcome.index} ({told}) failed: {outcome.failure}")

    return check


class Progress:
    """A bar with the time left, where one is wanted; else nothing that looks like it."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar

    def add(self, count: int) -> None:
        """So many members more are done."""
        if self._bar is not None:
            self._bar.update(count)

    def left(self, count: int) -> None:
        """So many members are still expected."""
        if self._bar is not None:
            self._bar.total = self._bar.n + count
            self._bar.refresh()


@contextlib.contextmanager
def progress_bar(total: int, done: int, wanted: bool) -> Iterator[Progress]:
    """A bar over so many members, some of which are done."""
    if not wanted:
        yield Progress(None)
        return
    from tqdm.auto import tqdm

    with tqdm(total=total, initial=done, unit="member", desc="ensemble") as bar:
        yield Progress(bar)
