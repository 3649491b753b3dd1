"""A block of memory as several, whose states do not feel each other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.sparse.csgraph import connected_components

from seacrane.hydro.data.memory_model import MemoryBlock


def independent_blocks(block: MemoryBlock) -> list[MemoryBlock]:
    """Blocks that make the same loads together: A falls apart where no state feels another.

    The passive model of a group is one block of oscillators, of which few share a damper. A block costs the
    square of its states.
    """
    count, part_of = connected_components(block.A != 0.0, directed=False)
    parts = []
    for k in range(count):
        own = np.flatnonzero(part_of == k)
        direct = block.D if k == 0 else np.zeros_like(block.D)
        parts.append(
            replace(
                block, A=block.A[np.ix_(own, own)], B=block.B[own], C=block.C[:, own], D=direct,
                state_scale=block.state_scale[own],
            )
        )  # fmt: skip
    return parts
