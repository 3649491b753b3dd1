"""The order in which members are packed, so that those that can be stepped side by side are neighbours.

It follows from the members alone, and not from the order in which their parameters are named: what is
resumed, or run by other workers, has the same neighbours.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.ensembles.members import Members, Value
from seacrane.ensembles.other_sea import WORDS
from seacrane.ensembles.stage_values import START_TIME
from seacrane.ensembles.study import Study
from seacrane.inputs.caller import silently

SEED = "seed"


def order_of(study: Study, members: Members) -> Sequence[int]:
    """Numbers of all members, those of one lift next to each other, with seeds fastest.

    Parameters that part lifts, as kinds of crane do, come first. Other numbers, such as masses, lie by size,
    and the words of the sea behind them: neighbours cost about the same.
    """
    if study.lanes == 1:
        return range(len(members))
    others = sorted(name for name in members.axes if name not in WORDS)
    sea = sorted(name for name in members.axes if name in WORDS and name != SEED)
    parting = _parting(study, members, others) if len(others) > 1 else []
    slowest_first = [*parting, *(name for name in others if name not in parting), *sea]
    slowest_first += [SEED] if SEED in members.axes else []
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
