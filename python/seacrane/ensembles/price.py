"""The price of an ensemble before it is run: a few of its packs are run first, and are kept."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np

from seacrane.ensembles.dataset import Outcome
from seacrane.ensembles.filling import Progress, run_packs
from seacrane.ensembles.job import Job
from seacrane.ensembles.members import Members
from seacrane.ensembles.store import Store, bytes_in

FEWEST, MOST, SHARE = 2, 8, 5  # packs that are run first: at most the fifth of all
HOUR = 3600.0  # s
SUMMED = ("members", "measured", "core_hours", "bytes")  # of prices together
Priced = Callable[["Price | None"], bool]


@dataclass(frozen=True, kw_only=True)
class Price:
    """What members cost that were not there yet, by a few of them.

    Attributes
    ----------
    members : int
        Whose price it is: all that were missing; with `until` all that there may be.
    measured : int
        How many of these were run for it. They are kept.
    core_hours : float
        Processor time of all, h.
    bytes : int
        What all keep: files of a store, or arrays in memory.
    at_most : bool
        Whether `until` may do with fewer.
    """

    members: int
    measured: int
    core_hours: float
    bytes: int
    at_most: bool = False

    def __str__(self) -> str:
        most = "at most " if self.at_most else ""
        return (
            f"price: {most}{self.core_hours:.2g} core hours and {self.bytes / 1e6:.2g} MB for {self.members} "
            f"members, by the {self.measured} of them that are done"
        )


def sum_of(prices: Sequence[Price]) -> Price | None:
    """Of several together; None of none."""
    if not prices:
        return None
    total = {name: sum(getattr(one, name) for one in prices) for name in SUMMED}
    return Price(**total, at_most=any(one.at_most for one in prices))


def goes_on(
    priced: Priced | None, store: Store, job: Job, members: Members,
    packs: Mapping[int, Sequence[int]], executor: Executor | None, *, raises: bool, batches: int = 1,
) -> bool:  # fmt: skip
    """Run a few of the packs that are left, evenly spread, tell what all cost, and ask whether to go on.

    There is no price where none is left. `batches`: how many times as many packs may come.
    """
    if priced is None:
        return True
    there = {*store}
    left = [number for number in packs if number not in there]
    if not left:
        return priced(None)
    count = min(len(left), max(FEWEST, min(MOST, len(left) // SHARE)))
    few = [left[(2 * place + 1) * len(left) // (2 * count)] for place in range(count)]
    measured: list[Outcome] = []
    bar = Progress(0, False, job.study.lanes)
    chosen = {number: packs[number] for number in few}
    run_packs(store, job, members, chosen, executor, bar, raises=raises, measured=measured)
    # Of lifts alike but in their seas the first one in a process is compiled: the median leaves that out.
    usual = np.mean if job.study.start_times else np.median
    each = usual([one.begun_s for one in measured]) + np.mean([one.stepped_s for one in measured])
    every = sum(len(packs[number]) for number in left) + (batches - 1) * sum(map(len, packs.values()))
    kept = len(left) + (batches - 1) * len(packs)
    price = Price(
        members=every,
        measured=len(measured),
        core_hours=float(each) * every / HOUR,
        bytes=round(np.mean([bytes_in(store, number) for number in few]) * kept),
        at_most=batches > 1,
    )
    return priced(price)
