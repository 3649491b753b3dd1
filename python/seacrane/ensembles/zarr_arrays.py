"""Whether the arrays of a Zarr group are those that an ensemble writes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.members import Members
from seacrane.ensembles.variables import TEXTS, own_dims

CODECS = {"bytes", "vlen-utf8", "zstd"}
LARGEST = 2**30  # bytes of what one member keeps
LONGEST = 2 * 10**7  # values along a dimension


def require_bounded(group: Any, over: int) -> None:
    """Refuse arrays that take too much memory for one member, or along a dimension, and foreign codecs.

    Parameters
    ----------
    group : zarr.Group
    over : int
        Number of dimensions of the ensemble.

    Raises
    ------
    ValueError
    """
    for name, array in group.arrays():
        found = {codec.to_dict()["name"] for codec in array.metadata.codecs}
        if not found <= CODECS:
            raise ValueError(f"array {name[:60]!r} is packed by {', '.join(sorted(found - CODECS))[:60]}")
        if any(length > LONGEST for length in array.shape) or 8 * math.prod(array.shape[over:]) > LARGEST:
            raise ValueError(f"array {name[:60]!r} has shape {array.shape}")


def require_arrays(group: Any, members: Members, first: Mapping[str, Labelled]) -> None:
    """Refuse arrays of other shapes, chunks or names.

    Parameters
    ----------
    group : zarr.Group
    members : Members
        That there is room for.
    first : mapping of str to Labelled
        How arrays lie.

    Raises
    ------
    ValueError, KeyError
    """
    over = tuple(members.shape.values())
    names = {*TEXTS, *members.axes, "member", *first}
    for dims in own_dims(first).values():
        names |= set(dims.values())
    arrays = dict(group.arrays())
    strange = arrays.keys() - names
    if strange:
        raise ValueError(f"it holds an array {min(strange)[:60]!r}, which no ensemble writes")
    for name, array in arrays.items():
        if name not in TEXTS and name not in first and array.ndim != 1:
            raise ValueError(f"array {name[:60]!r} has shape {array.shape}")
    for name in (*TEXTS, *first):
        array, own = arrays[name], first[name].values.shape if name in first else ()
        there = tuple(array.shape)
        if there[1 : len(over)] != over[1:] or there[0] < over[0] or there[len(over) :] != own:
            raise ValueError(f"array {name[:60]!r} has shape {there}, for {(*over, *own)}")
        if tuple(array.chunks) != (*(1 for _ in over), *(max(length, 1) for length in own)):
            raise ValueError(f"array {name[:60]!r} has chunks {array.chunks}")
