"""An ensemble that grows by batches of seeds until its statistics are known narrowly enough.

Members, packs and batches are numbered before anything runs, and whether a batch is run depends on the
results of those before it alone: so the ensemble is the same whatever runs it, and whether it was resumed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from seacrane.ensembles.dataset import RESERVED, Outcome
from seacrane.ensembles.filling import Progress, run_packs
from seacrane.ensembles.job import Job
from seacrane.ensembles.members import MOST_MEMBERS, Members, Value
from seacrane.ensembles.store import Folder, Store
from seacrane.ensembles.targets import Certainty, Target, certainty_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.run.interrupts import interrupts_kept
from seacrane.warnings import FailedSeedsWarning, FewSeedsWarning

BATCH = 20  # seeds: fewer would be judged too often, by intervals that scatter too much
IN_A_PACK = 2  # as a rule, so that one combination of parameters still fills several cores


@dataclass(frozen=True, kw_only=True)
class Growth:
    """Members by seed and by combination of the other parameters, which is called a cell."""

    first: int  # seed
    batches: int  # how many there may be
    others: Mapping[str, tuple[Value, ...]]  # of the other parameters: all combinations are run
    size: int  # seeds in a pack

    @property
    def cells(self) -> int:
        """Number of combinations."""
        return math.prod(len(values) for values in self.others.values())

    def members(self, batches: int) -> Members:
        """The members of so many batches."""
        seeds = tuple(range(self.first, self.first + batches * BATCH))
        return Members(axes={"seed": seeds, **self.others}, grid=True)

    def batches_in(self, packs: Iterable[int]) -> int:
        """How many batches packs of these numbers belong to."""
        return max((pack // (self._chunks * self.cells) + 1 for pack in packs), default=0)

    @property
    def _chunks(self) -> int:
        return math.ceil(BATCH / self.size)

    def packs(self, batch: int, cell: int) -> dict[int, range]:
        """Numbers of the members of each pack of a batch of a cell, by the number of the pack."""
        first, end = (batch * self.cells + cell) * self._chunks, (batch + 1) * BATCH * self.cells
        starts = range(batch * BATCH * self.cells + cell, end, self.size * self.cells)
        return {
            first + chunk: range(start, min(start + self.size * self.cells, end), self.cells)
            for chunk, start in enumerate(starts)
        }

    def first_packs(self) -> dict[int, Sequence[int]]:
        """Those of the first batch, of all cells."""
        return {number: own for cell in range(self.cells) for number, own in self.packs(0, cell).items()}

    def parameters(self, cell: int) -> dict[str, Value]:
        """What the members of a cell share."""
        values = self.members(1).values(cell)
        return {name: value for name, value in values.items() if name != "seed"}


def growth_of(members: Members, pack: int | None) -> Growth:
    """How an ensemble of these members grows; its seeds are those that there may be.

    Raises SceneError for members that are no grid over at least 20 seeds one after another.
    """
    seeds = members.axes.get("seed", ())
    if not members.grid or not seeds:
        raise SceneError(
            "until adds seeds, and over has none; give those that may be run, as in "
            "over={'seed': range(1, 1001)}, beside a grid of other parameters"
        )
    if not all(isinstance(seed, int) and seed == int(seeds[0]) + place for place, seed in enumerate(seeds)):
        raise SceneError("until: seed has gaps; give seeds one after another, such as range(1, 1001)")
    if len(seeds) < BATCH:
        raise SceneError(
            f"until: seed has {len(seeds)} values and a batch takes {BATCH}; give as many as may be run"
        )
    others = {name: values for name, values in members.axes.items() if name != "seed"}
    size = min(IN_A_PACK if pack is None else pack, BATCH)
    return Growth(first=int(seeds[0]), batches=len(seeds) // BATCH, others=others, size=size)


def grow(
    growth: Growth,
    job: Job,
    store: Store,
    executor: Executor | None,
    targets: tuple[Target, ...],
    *,
    raises: bool,
    progress: bool,
) -> tuple[Members, list[Outcome], tuple[Certainty, ...]]:
    """Add batches of seeds to every cell until its targets are reached, or there are no more.

    Members of the seeds that were needed, their outcomes, and what they tell. Warns with FailedSeedsWarning
    where seeds failed, with FewSeedsWarning where the most seeds did not do.
    """
    members = growth.members(growth.batches)
    cells: dict[int, list[Outcome]] = {cell: [] for cell in range(growth.cells)}
    known: dict[int, list[Certainty]] = {}
    going, batch, most = list(cells), 0, BATCH * growth.cells
    progressed = Progress(most, progress, job.study.lanes)
    with progressed.bar:
        while going and batch < growth.batches:
            packs = {n: own for cell in going for n, own in growth.packs(batch, cell).items()}
            run_packs(store, job, members, packs, executor, progressed, raises=raises)
            for cell in going:
                with interrupts_kept():
                    cells[cell] += [one for number in growth.packs(batch, cell) for one in store[number]]
                    known[cell] = [
                        certainty_of(target, cells[cell], growth.parameters(cell)) for target in targets
                    ]
            batch += 1
            going = [cell for cell in going if not all(one.reached or one.futile for one in known[cell])]
            progressed.left(_expected(growth, batch, [known[cell] for cell in going]))
    certainty = tuple(one for cell in sorted(known) for one in known[cell])
    _warn_of_failed(certainty, [cells[cell] for cell in sorted(known) for _ in targets])
    short = [one for one in certainty if not one.reached and not one.futile]
    if short:
        warn_caller(
            f"{growth.batches * BATCH} seeds are the most that over allows, and {len(short)} of "
            f"{len(certainty)} statistics are not known as narrowly as until asks: {short[0]}; give more "
            "seeds, and the same store",
            FewSeedsWarning,
        )
    outcomes = sorted((one for several in cells.values() for one in several), key=lambda one: one.index)
    return growth.members(batch), outcomes, certainty


def _expected(growth: Growth, batch: int, going: list[list[Certainty]]) -> int:
    """Members that cells which go on will still take, by their half widths so far."""
    done, more = batch * BATCH, 0
    for several in going:
        worst = max(one.half_width / one.asked for one in several)
        wanted = done * min(worst, 100.0) ** 2
        more += math.ceil((min(wanted, growth.batches * BATCH) - done) / BATCH) * BATCH
    return more


def _warn_of_failed(certainty: tuple[Certainty, ...], outcomes: list[list[Outcome]]) -> None:
    """Name the statistic of which the largest share failed, and why the first did."""
    told = [(one, several) for one, several in zip(certainty, outcomes, strict=True) if one.failed]
    if not told:
        return
    worst, several = max(told, key=lambda pair: pair[0].failed / (pair[0].failed + pair[0].seeds))
    first = next(outcome for outcome in several if outcome.failure)
    warn_caller(
        f"seeds failed, and what they would have given is not known: {worst} (member {first.index}: "
        f"{first.failure[:200]}); {len(told)} of {len(certainty)} statistics have such seeds, and "
        f"{sum(one.futile for one, _ in told)} stopped because of them: mend what fails",
        FailedSeedsWarning,
    )


def members_in(store: Folder, data: Mapping[str, Any]) -> Members:
    """The members of a store, of one that grows those that are there. Raises FileFormatError for no study."""
    folder = store.path
    axes, grid, size = _axes(folder, data), bool(data.get("grid")), data.get("seeds_in_pack")
    if size:
        seeds = axes.get("seed", ())
        if (
            len(seeds) != BATCH
            or any(type(one) is not int for one in seeds)
            or size not in range(1, BATCH + 1)
        ):
            raise FileFormatError(f"{folder}: its study grows by {BATCH} seeds, and tells others")
        others = {name: values for name, values in axes.items() if name != "seed"}
        growth = Growth(first=int(seeds[0]), batches=1, others=others, size=size)
        batches = max(growth.batches_in(store), 1) if growth.cells * BATCH <= MOST_MEMBERS else 1
        members = growth.members(batches)
    else:
        members = Members(axes=axes, grid=grid)
    unlike = not grid and len({len(values) for values in axes.values()}) > 1
    if unlike or len(members) > MOST_MEMBERS:
        raise FileFormatError(f"{folder}: its study has lists of unlike lengths, or too many members")
    return members


def _axes(folder: Path, data: Mapping[str, Any]) -> dict[str, tuple[Any, ...]]:
    axes = data.get("axes")
    if isinstance(axes, dict) and axes and not axes.keys() & {*RESERVED}:
        plain = all(
            isinstance(values, list)
            and values
            and all(isinstance(one, bool | int | float | str) for one in values)
            for values in axes.values()
        )
        if plain:
            return {name: tuple(values) for name, values in axes.items()}
    raise FileFormatError(f"{folder}: its study names no parameters with values")
