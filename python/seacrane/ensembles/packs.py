"""Packs of members: what is sent, run, kept and lost together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

from seacrane.errors import SceneError
from seacrane.inputs.shown import shown

MOST_PACKS = 250  # as a rule: a file costs far more than what one member puts into it
LARGEST_PACK = 64


@dataclass(frozen=True, kw_only=True)
class Packs:
    """All members in packs.

    Attributes
    ----------
    order : Numbers of the members, neighbours side by side; see `grouping`.
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
