"""The set of choices that costs least while the changes together stay within the limits."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from seacrane.needs.answer import Loss

SAVES = 0.03  # share of the cost that is worth a choice


def least_of(rows: Sequence[Loss], limits: Mapping[str, float], noise: Mapping[str, float]) -> list[Loss]:
    """Of the choices about one thing at most one; changes add by their sizes, costs multiply."""
    about: dict[str, list[Loss]] = {}
    for row in rows:
        if row.stable and row.share < 1.0 - max(SAVES, row.spread):
            about.setdefault(row.of, []).append(row)
    groups = [[_Item(row, limits, noise) for row in group] for group in about.values()]
    groups.sort(key=lambda group: -max(item.saved for item in group))
    best: tuple[float, list[_Item]] = (0.0, [])
    ahead = [sum(max(item.saved for item in group) for group in groups[i:]) for i in range(len(groups) + 1)]

    def look(at: int, saved: float, taken: list[_Item], used: dict[str, float]) -> None:
        nonlocal best
        if saved > best[0]:
            best = (saved, taken)
        if at == len(groups) or saved + ahead[at] <= best[0]:
            return
        for item in groups[at]:
            more = {name: used[name] + item.used[name] for name in limits}
            if all(share <= 1.0 for share in more.values()):
                look(at + 1, saved + item.saved, [*taken, item], more)
        look(at + 1, saved, taken, used)

    look(0, 0.0, [], dict.fromkeys(limits, 0.0))
    return [item.row for item in best[1]]


class _Item:
    """A row, what it saves (logarithm of its share) and what it uses of each limit."""

    def __init__(self, row: Loss, limits: Mapping[str, float], noise: Mapping[str, float]) -> None:
        self.row, self.saved = row, -math.log(row.share)
        self.used = {
            name: (abs(row.changes[name]) / limit if limit > 0.0 else math.inf)
            if abs(row.changes[name]) > noise.get(name, 0.0)
            else 0.0
            for name, limit in limits.items()
        }
