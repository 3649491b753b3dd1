"""An ensemble that grows by batches of seeds until each of its cells is known.

Members, packs and batches are numbered before anything runs, and whether a cell takes another batch depends
on the results of its own batches before alone: so the ensemble is the same whatever runs it, whether it was
resumed, and whether parts of its cells were run apart.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from seacrane.ensembles.dataset import RESERVED, Outcome
from seacrane.ensembles.filling import Progress, run_packs
from seacrane.ensembles.job import Job
from seacrane.ensembles.members import MOST_MEMBERS, Members, Value
from seacrane.ensembles.store import Folder, Store, packs_of
from seacrane.ensembles.targets import Certainty, Target, certainty_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.run.interrupts import interrupts_kept
from seacrane.warnings import FailedSeedsWarning, FewSeedsWarning

BATCH = 20  # seeds: fewer would be judged too often, by intervals that scatter too much
GROWTH = ("size", "batch", "within")  # of `Growth`, as a study tells them
IN_A_PACK = 2  # as a rule, so that one combination of parameters still fills several cores


@dataclass(frozen=True, kw_only=True)
class Growth:
    """Members by seed and by combination of the other parameters, of which some together are a cell."""

    seeds: tuple[int, ...]  # that there may be
    others: Mapping[str, tuple[Value, ...]]  # the other parameters: all combinations are run
    size: int  # members in a pack
    batch: int = BATCH  # seeds
    within: int = 1  # combinations in a cell: those of the last of the other parameters

    @property
    def batches(self) -> int:
        """How many there may be."""
        return math.ceil(len(self.seeds) / self.batch)

    @property
    def cells(self) -> int:
        """How many there are."""
        return self._combinations // self.within

    @property
    def _combinations(self) -> int:
        return math.prod(len(values) for values in self.others.values())

    def members(self, batches: int) -> Members:
        """The members of so many batches."""
        return Members(axes={"seed": self.seeds[: batches * self.batch], **self.others}, grid=True)

    def batches_in(self, packs: Iterable[int]) -> int:
        """How many batches packs of these numbers belong to."""
        return max((pack // (self._chunks * self.cells) + 1 for pack in packs), default=0)

    @property
    def _chunks(self) -> int:
        return math.ceil(self.batch * self.within / self.size)

    def packs(self, batch: int, cell: int) -> dict[int, Sequence[int]]:
        """Numbers of the members of each pack of a batch of a cell, by the number of the pack."""
        first = (batch * self.cells + cell) * self._chunks
        seeds = range(batch * self.batch, min((batch + 1) * self.batch, len(self.seeds)))
        combinations = range(cell * self.within, (cell + 1) * self.within)
        own = [seed * self._combinations + one for one in combinations for seed in seeds]
        return {first + number: some for number, some in packs_of(own, self.size).items()}

    def packs_of_cells(self, batch: int, cells: Iterable[int]) -> dict[int, Sequence[int]]:
        """Those of a batch of several cells."""
        return {number: own for cell in cells for number, own in self.packs(batch, cell).items()}

    def parameters(self, cell: int) -> dict[str, Value]:
        """What the members of a cell of one combination share."""
        values = self.members(1).values(cell)
        return {name: value for name, value in values.items() if name != "seed"}


class Judge(ABC):
    """Says how an ensemble grows, and of each cell whether it is known.

    Attributes
    ----------
    cells : That are wanted, by number; None: all.
    asked : In which sense a cell is known, as plain data.
    """

    cells: Sequence[int] | None = None
    asked: Mapping[str, float]

    @abstractmethod
    def growth(self, members: Members, pack: int | None, size: int) -> Growth:
        """Of all members that there may be, in packs that were asked for, or of a usual size."""

    @abstractmethod
    def knows(self, growth: Growth, cell: int, outcomes: Sequence[Outcome]) -> bool:
        """Whether a cell is known by its outcomes so far."""

    def expected(self, growth: Growth, batches: int, cells: Sequence[int]) -> int:
        """Members that cells which are not known after so many batches will still take."""
        return len(cells) * growth.batch * growth.within


@dataclass(kw_only=True, eq=False)
class Certain(Judge):
    """Knows a cell where its targets are reached, or out of reach, and how certainly."""

    targets: tuple[Target, ...]
    asked: Mapping[str, float]
    known: dict[int, list[Certainty]] = field(default_factory=dict)
    failures: dict[int, Outcome] = field(default_factory=dict)  # the first of a cell

    def growth(self, members: Members, pack: int | None, size: int) -> Growth:
        """By whole batches."""
        return growth_of(members, pack)

    def knows(self, growth: Growth, cell: int, outcomes: Sequence[Outcome]) -> bool:
        """As of `Judge`."""
        self.known[cell] = [certainty_of(one, outcomes, growth.parameters(cell)) for one in self.targets]
        if self.known[cell][0].failed:
            self.failures[cell] = next(one for one in outcomes if one.failure)
        return all(one.reached or one.futile for one in self.known[cell])

    def expected(self, growth: Growth, batches: int, cells: Sequence[int]) -> int:
        """By the half widths so far."""
        done, more = batches * BATCH, 0
        for cell in cells:
            worst = max(one.half_width / one.asked for one in self.known[cell])
            wanted = done * min(worst, 100.0) ** 2
            more += math.ceil((min(wanted, len(growth.seeds)) - done) / BATCH) * BATCH
        return more

    def told(self, growth: Growth) -> tuple[Certainty, ...]:
        """Of all cells. Warns with FailedSeedsWarning of seeds that failed, FewSeedsWarning of too few."""
        certainty = tuple(one for cell in sorted(self.known) for one in self.known[cell])
        _warn_of_failed(self.known, self.failures)
        short = [one for one in certainty if not one.reached and not one.futile]
        if short:
            warn_caller(
                f"{len(growth.seeds)} seeds are the most that over allows, and {len(short)} of "
                f"{len(certainty)} statistics are not known as narrowly as until asks: {short[0]}; give more "
                "seeds, and the same store",
                FewSeedsWarning,
            )
        return certainty


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
    return Growth(seeds=seeds[: len(seeds) // BATCH * BATCH], others=others, size=size)  # type: ignore[arg-type]


def grow(
    growth: Growth,
    job: Job,
    store: Store,
    executor: Executor | None,
    judge: Judge,
    cells: Sequence[int],
    *,
    raises: bool,
    progress: bool,
) -> tuple[Members, list[Outcome]]:
    """Add batches of seeds to these cells until the judge knows each, or there are no more.

    Members of the seeds that were needed, and their outcomes.
    """
    members = growth.members(growth.batches)
    outcomes: dict[int, list[Outcome]] = {cell: [] for cell in cells}
    going, batch = list(cells), 0
    progressed = Progress(growth.batch * growth.within * len(going), progress, job.study.lanes)
    with progressed.bar:
        while going and batch < growth.batches:
            packs = growth.packs_of_cells(batch, going)
            run_packs(store, job, members, packs, executor, progressed, raises=raises)
            left = []
            for cell in going:
                with interrupts_kept():
                    outcomes[cell] += [one for number in growth.packs(batch, cell) for one in store[number]]
                    if not judge.knows(growth, cell, outcomes[cell]):
                        left.append(cell)
            batch, going = batch + 1, left
            progressed.left(judge.expected(growth, batch, going) if batch < growth.batches else 0)
    found = sorted((one for several in outcomes.values() for one in several), key=lambda one: one.index)
    return growth.members(max(batch, 1)), found


def _warn_of_failed(known: Mapping[int, Sequence[Certainty]], failures: Mapping[int, Outcome]) -> None:
    """Name the statistic of which the largest share failed, and why the first did."""
    told = [(cell, one) for cell, several in sorted(known.items()) for one in several if one.failed]
    if not told:
        return
    cell, worst = max(told, key=lambda pair: pair[1].failed / (pair[1].failed + pair[1].seeds))
    first = failures[cell]
    warn_caller(
        f"seeds failed, and what they would have given is not known: {worst} (member {first.index}: "
        f"{first.failure[:200]}); {len(told)} of {sum(map(len, known.values()))} statistics have such seeds, "
        f"and {sum(one.futile for _, one in told)} stopped because of them: mend what fails",
        FailedSeedsWarning,
    )


def growth_in(store: Folder, data: Mapping[str, Any], seeds: int | None = None) -> Growth | None:
    """How the ensemble of a store grows, to so many seeds, or those that are there; None where it does not.

    Raises FileFormatError for no study.
    """
    told = data.get("growth")
    if told is None:
        return None
    folder, axes = store.path, _axes(store.path, data)
    first = axes.pop("seed", ())
    fits = isinstance(told, dict) and all(type(told.get(name)) is int for name in GROWTH)
    if not fits or len(first) != told["batch"] or any(type(one) is not int for one in first):
        raise FileFormatError(f"{folder}: its study grows by batches of seeds, and tells no batch")
    growth = Growth(seeds=first, others=axes, **{name: told[name] for name in GROWTH})
    if min(growth.size, growth.within) < 1 or growth.cells * growth.within * len(first) > MOST_MEMBERS:
        raise FileFormatError(f"{folder}: its study grows by packs or cells that there are not, or too many")
    more = max(growth.batches_in(store), 1) * growth.batch if seeds is None else seeds
    return replace(growth, seeds=(*first, *range(first[-1] + 1, first[-1] + 1 + more - len(first))))


def members_in(store: Folder, data: Mapping[str, Any]) -> Members:
    """The members of a store, of one that grows those that are there. Raises FileFormatError for no study."""
    growth = growth_in(store, data)
    if growth is not None:
        return growth.members(growth.batches)
    axes, grid = _axes(store.path, data), bool(data.get("grid"))
    members = Members(axes=axes, grid=grid)
    unlike = not grid and len({len(values) for values in axes.values()}) > 1
    if unlike or len(members) > MOST_MEMBERS:
        raise FileFormatError(f"{store.path}: its study has lists of unlike lengths, or too many members")
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
