"""What came of each member, and all of it as one labelled dataset."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.ensembles.members import Members

if TYPE_CHECKING:
    import xarray

NOT_RUN = "not run"  # as a failure
TEXTS: Mapping[str, str] = {
    "failure": "why a member failed",
    "validity": "what was out of range in a member",
    "kept_apart": "why a member was not stepped beside others",
}
"""Of every member, beside what it kept."""
RESERVED = ("member", "time", *TEXTS)


@dataclass(frozen=True, kw_only=True, eq=False)
class Labelled:
    """What one member keeps under one name."""

    values: NDArray[np.float64]
    dims: tuple[str, ...] = ()
    coords: Mapping[str, NDArray[Any]] = field(default_factory=dict)  # along dimensions that have any
    attributes: Mapping[str, str] = field(default_factory=dict)  # unit and description

    def lies_like(self, other: Labelled) -> bool:
        """Whether both have the same dimensions and the same values along them."""
        return (
            self.dims == other.dims
            and self.values.shape == other.values.shape
            and all(np.array_equal(self.coords[dim], other.coords[dim]) for dim in other.coords)
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a member kept by name, or why it failed."""

    index: int
    kept: Mapping[str, Labelled] = field(default_factory=dict)
    failure: str = ""
    validity: str = ""  # what was out of range in its run, as of a result's stats
    kept_apart: str = ""  # why it was stepped by itself where others were to be stepped beside it
    begun_s: float = 0.0  # processor time until its run had begun, s; no store has it
    stepped_s: float = 0.0  # and from then on; of members side by side each has its share


def dataset_of(members: Members, outcomes: Iterable[Outcome]) -> xarray.Dataset:
    """Outcomes, as they come, over the members; those that failed or are not there are NaN.

    What lies otherwise than that of the first member that did not fail is a failure.
    """
    import xarray

    count, first, arrays = len(members), dict[str, Labelled](), dict[str, NDArray[np.float64]]()
    told, texts = {name: np.full(count, "", dtype=object) for name in TEXTS}, dict[str, str]()
    told["failure"][:] = NOT_RUN
    for one in outcomes:
        failure = _failure_of(one, first)
        for name, column in told.items():
            text = failure if name == "failure" else getattr(one, name)
            column[one.index] = texts.setdefault(text, text)  # as often as it comes one object
        for name, kept in ({} if failure else one.kept).items():
            if name not in arrays:
                first[name], arrays[name] = kept, np.full((count, *kept.values.shape), np.nan)
            arrays[name][one.index] = kept.values
    over, lengths = tuple(members.shape), tuple(members.shape.values())
    coords: dict[str, Any] = {} if members.grid else {"member": ("member", np.arange(count))}
    for name, values in members.axes.items():
        coords[name] = (name if members.grid else "member", np.array(values))
    variables: dict[str, Any] = {}
    several = _several(first.values())
    for name, kept in first.items():
        own = {dim: f"{dim}_{name}" if dim in several else dim for dim in kept.dims}
        shaped = arrays[name].reshape(*lengths, *kept.values.shape)
        variables[name] = ((*over, *own.values()), shaped, dict(kept.attributes))
        coords |= {own[dim]: (own[dim], along) for dim, along in kept.coords.items()}
    for name, column in told.items():
        variables[name] = (over, column.reshape(lengths), {"long_name": TEXTS[name]})
    return xarray.Dataset(variables, coords)


def _several(kept: Iterable[Labelled]) -> set[str]:
    """Dimensions that are of other lengths, or have other values, in some that have them."""
    found: dict[str, tuple[int, Any]] = {}
    several = set()
    for one in kept:
        for dim, length in zip(one.dims, one.values.shape, strict=True):
            along: Any = one.coords.get(dim)
            known = found.setdefault(dim, (length, along))
            if known[0] != length or not np.array_equal(known[1], along):
                several.add(dim)
    return several


def _failure_of(outcome: Outcome, first: Mapping[str, Labelled]) -> str:
    """Why a member failed, which it also did where its arrays lie otherwise than the first ones."""
    if outcome.failure:
        return outcome.failure
    for name, kept in outcome.kept.items():
        known = first.get(name, kept)
        if not kept.lies_like(known):
            return (
                f"SceneError: {name} has dimensions {kept.dims} of lengths {kept.values.shape}, or "
                f"values along them, unlike the first member's: {known.dims} of {known.values.shape}"
            )
    return ""
