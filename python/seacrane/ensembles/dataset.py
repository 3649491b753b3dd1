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
    """What one member keeps under one name.

    Attributes
    ----------
    values : Numbers, float64.
    coords : mapping of str to ndarray
        Numbers or texts along those dimensions that have any.
    attributes : mapping of str to str
        Unit and description.
    """

    values: NDArray[np.float64]
    dims: tuple[str, ...] = ()
    coords: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)

    def lies_like(self, other: Labelled) -> bool:
        """Whether both have the same dimensions and the same values along them."""
        return (
            self.dims == other.dims
            and self.values.shape == other.values.shape
            and all(np.array_equal(self.coords[dim], other.coords[dim]) for dim in other.coords)
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """What a member kept, or why it failed.

    Attributes
    ----------
    kept : mapping of str to Labelled
        Empty where it failed.
    failure : Why it failed; empty where it did not.
    validity : What was out of range in its run, as of a result's stats.
    kept_apart : str
        Why it was stepped by itself where others were to be stepped beside it; empty where it was not.
    """

    index: int
    kept: Mapping[str, Labelled] = field(default_factory=dict)
    failure: str = ""
    validity: str = ""
    kept_apart: str = ""


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


class Table:
    """Arrays over all members, filled outcome by outcome in the order of the members."""

    def __init__(self, members: Members) -> None:
        self._members, count = members, len(members)
        self._told = {name: np.full(count, "", dtype=object) for name in TEXTS}
        self._told["failure"][:] = NOT_RUN
        self._texts: dict[str, str] = {}
        self._first: dict[str, Labelled] = {}
        self._arrays: dict[str, Any] = {}

    def add(self, outcome: Outcome) -> None:
        """Take one; what lies otherwise than that of the first member that did not fail is a failure."""
        index, failure = outcome.index, failure_of(outcome, self._first)
        for name, texts in self._told.items():
            texts[index] = self._shared(failure if name == "failure" else getattr(outcome, name))
        if failure:
            return
        for name, kept in outcome.kept.items():
            if name not in self._arrays:
                self._first[name] = kept
                self._arrays[name] = np.full((len(self._members), *kept.values.shape), np.nan)
            self._arrays[name][index] = kept.values

    def _shared(self, text: str) -> str:
        """The text itself, as often as it comes one object."""
        return self._texts.setdefault(text, text)

    def dataset(self) -> xarray.Dataset:
        """A data set of what was added; members that failed or are not there are NaN."""
        import xarray

        variables: dict[str, Any] = {}
        coords: dict[str, Any] = axes_of(self._members)
        over = tuple(self._members.shape)
        lengths = tuple(self._members.shape.values())
        for name, own in own_dims(self._first).items():
            first = self._first[name]
            values = self._arrays[name].reshape(*lengths, *first.values.shape)
            variables[name] = ((*over, *own.values()), values, dict(first.attributes))
            coords |= {own[dim]: (own[dim], along) for dim, along in first.coords.items()}
        for name, texts in self._told.items():
            variables[name] = (over, texts.reshape(lengths), {"long_name": TEXTS[name]})
        return xarray.Dataset(variables, coords)


def table_of(members: Members, outcomes: Iterable[Outcome]) -> Table:
    """All outcomes, which come in the order of the members."""
    table = Table(members)
    for outcome in outcomes:
        table.add(outcome)
    return table


def failure_of(outcome: Outcome, first: Mapping[str, Labelled]) -> str:
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
