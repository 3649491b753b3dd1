"""A block of memory as several, whose states do not feel each other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from seacrane.hydro.data.memory_model import MemoryBlock

MOST_STATES = 12  # of parts that share a block: each block costs its motions besides, each state the others


def independent_blocks(block: MemoryBlock) -> list[MemoryBlock]:
    """Blocks that make the same loads together: A falls apart where no state feels another.

    The passive model of a group is one block of oscillators, of which few share a damper. A block costs the
    square of its states, so that small parts share one, first fit by size.
    """
    from scipy.sparse.csgraph import connected_components

    count, part_of = connected_components(block.A != 0.0, directed=False)
    sizes = np.bincount(part_of, minlength=count)
    shared: list[list[int]] = []
    for part in np.argsort(-sizes, kind="stable"):
        room = (one for one in shared if sizes[one].sum() + sizes[part] <= MOST_STATES)
        found = next(room, None)
        if found is None:
            shared.append([part])
        else:
            found.append(part)
    blocks = []
    for place, parts in enumerate(shared):
        own = np.flatnonzero(np.isin(part_of, parts))
        direct = block.D if place == 0 else np.zeros_like(block.D)
        blocks.append(
            replace(
                block, A=block.A[np.ix_(own, own)], B=block.B[own], C=block.C[:, own], D=direct,
                state_scale=block.state_scale[own],
            )
        )  # fmt: skip
    return blocks
