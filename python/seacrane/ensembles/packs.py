"""The order of members, by which those that go side by side are neighbours, and their packs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.ensembles.members import Members, Value
from seacrane.ensembles.other_sea import WORDS
from seacrane.ensembles.stage_values import START_TIME
from seacrane.ensembles.study import Study
from seacrane.errors import SceneError
from seacrane.inputs.caller import silently
from seacrane.inputs.shown import shown

MOST_PACKS = 250  # as a rule: a file costs far more than what one member puts into it
LARGEST_PACK = 64


@dataclass(frozen=True, kw_only=True)
class Packs:
    """All members in packs.

    Attributes
    ----------
    order : Numbers of the members, neighbours side by side; see `order_of`.
    size : Members in a pack.
    """

    order: Sequence[int]
    size: int

    def __len__(self) -> int:
        return ceil(len(self.order) / self.size)

    def __getitem__(self, number: int) -> Sequence[int]:
        """Numbers of the members of a pack."""
        return self.order[number * self.size : (number + 1) * self.size]


def pack_size(pack: int | None, count: int, lanes: int, together: int) -> int:
    """Members in a pack. `together` is how many members share what is done before the first of them.

    Raises SceneError for a pack that is no number, or no multiple of the lanes.
    """
    if pack is None and together:
        return min(LARGEST_PACK, together)
    if pack is None:
        return lanes * ceil(min(LARGEST_PACK, ceil(count / MOST_PACKS)) / lanes)
    if not isinstance(pack, int) or isinstance(pack, bool) or pack < 1:
        raise SceneError(f"pack is {shown(pack)}; give a whole number from 1 on")
    if pack % lanes:
        raise SceneError(f"pack is {pack} and lanes is {lanes}; give a pack that is a multiple of lanes")
    return pack


def order_of(study: Study, members: Members) -> Sequence[int]:
    """Numbers of all members, those of one lift next to each other, with seeds fastest.

    Parameters that part lifts, as kinds of crane do, come first. Other numbers, such as masses, lie by size,
    and the words of the sea behind them: neighbours cost about the same.
    """
    if study.lanes == 1:
        return range(len(members))
    others = sorted(name for name in members.axes if name not in WORDS)
    sea = sorted(name for name in members.axes if name in WORDS and name != "seed")
    parting = _parting(study, members, others) if len(others) > 1 else []
    slowest_first = [*parting, *(name for name in others if name not in parting), *sea]
    slowest_first += ["seed"] if "seed" in members.axes else []
    ranks = [_ranks(members, name) for name in slowest_first]
    return np.lexsort(ranks[::-1]).tolist()  # type: ignore[no-any-return]


def _ranks(members: Members, name: str) -> NDArray[np.int64]:
    """The place of every member's value among those of a parameter, by size."""
    values = members.axes[name]
    sizes = {value: rank for rank, value in enumerate(sorted(set(values), key=_size))}
    ranks = np.array([sizes[value] for value in values])
    if not members.grid:
        return ranks
    axis, shape = list(members.axes).index(name), tuple(members.shape.values())
    return np.broadcast_to(ranks.reshape([-1 if i == axis else 1 for i in range(len(shape))]), shape).ravel()


def _size(value: Value) -> tuple[bool, Any]:
    return isinstance(value, str), value


def _parting(study: Study, members: Members, names: Sequence[str]) -> list[str]:
    """Parameters whose values keep lifts apart, as two lifts that differ in nothing else tell."""
    base = {name: min(values, key=_size) for name, values in sorted(members.axes.items())}
    usual = _model(study, base)
    found = []
    for name in names:
        if name == START_TIME:
            continue
        several = sorted(set(members.axes[name]), key=_size)
        for value in {several[len(several) // 2], several[-1]} - {base[name]}:
            other = _model(study, {**base, name: value})
            if usual is None or other is None or _core.lanes_differ(usual, other):
                found.append(name)
                break
    return found


def _model(study: Study, values: dict[str, Value]) -> _core.Model | None:
    """The compiled lift of these values; None where there is none, which its member will say."""
    with silently():
        try:
            return study.scene(values).compile()
        except Exception:
            return None
