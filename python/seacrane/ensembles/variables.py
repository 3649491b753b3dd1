"""Names of the variables and dimensions that the dataset of an ensemble has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.members import Members

NOT_RUN = "not run"  # as a failure
TEXTS: Mapping[str, str] = {
    "failure": "why a member failed",
    "validity": "what was out of range in a member",
    "kept_apart": "why a member was not stepped beside others",
}
"""Of every member, beside what it kept."""
RESERVED = ("member", "time", *TEXTS)


def axes_of(members: Members) -> dict[str, tuple[str, Any]]:
    """Dimension and values of each parameter, and the numbers of members that are no grid."""
    if members.grid:
        return {name: (name, np.array(values)) for name, values in members.axes.items()}
    own = {"member": ("member", np.arange(len(members)))}
    return own | {name: ("member", np.array(values)) for name, values in members.axes.items()}


def own_dims(first: Mapping[str, Labelled]) -> dict[str, dict[str, str]]:
    """By variable: the names of its own dimensions, with its name where another has them otherwise."""
    shared = _shared(first)
    return {
        name: {dim: dim if shared[dim] else f"{dim}_{name}" for dim in kept.dims}
        for name, kept in first.items()
    }


def _shared(first: Mapping[str, Labelled]) -> dict[str, bool]:
    """Whether each dimension has the same length and values in all that have it."""
    found: dict[str, tuple[int, Any]] = {}
    shared: dict[str, bool] = {}
    for kept in first.values():
        for dim, length in zip(kept.dims, kept.values.shape, strict=True):
            known = found.setdefault(dim, (length, kept.coords.get(dim)))
            same = known[0] == length and np.array_equal(known[1], kept.coords.get(dim))  # type: ignore[arg-type]
            shared[dim] = shared.get(dim, True) and same
    return shared
