"""Outcomes as one labelled dataset."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.members import Members
from seacrane.ensembles.outcome import Outcome

if TYPE_CHECKING:
    import xarray


class Table:
    """Arrays over all members, filled outcome by outcome in the order of the members."""

    def __init__(self, members: Members) -> None:
        self._members, count = members, len(members)
        self.failures: dict[int, str] = {}
        self._validity = np.full(count, "", dtype=object)
        self._done = np.zeros(count, dtype=bool)
        self._texts: dict[str, str] = {}
        self._first: dict[str, Labelled] = {}
        self._arrays: dict[str, Any] = {}

    def add(self, outcome: Outcome) -> None:
        """Take one; what lies otherwise than that of the first member that did not fail is a failure."""
        self._done[outcome.index] = True
        self._validity[outcome.index] = self._shared(outcome.validity)
        failure = outcome.failure or self._unlike(outcome)
        if failure:
            self.failures[outcome.index] = self._shared(failure)
            return
        for name, kept in outcome.kept.items():
            if name not in self._arrays:
                self._first[name] = kept
                self._arrays[name] = np.full((len(self._members), *kept.values.shape), np.nan)
            self._arrays[name][outcome.index] = kept.values

    def _shared(self, text: str) -> str:
        """The text itself, as often as it comes one object."""
        return self._texts.setdefault(text, text)

    def _unlike(self, outcome: Outcome) -> str:
        for name, kept in outcome.kept.items():
            first = self._first.get(name, kept)
            if not kept.lies_like(first):
                return (
                    f"SceneError: {name} has dimensions {kept.dims} of lengths {kept.values.shape}, or "
                    f"values along them, unlike the first member's: {first.dims} of {first.values.shape}"
                )
        return ""

    def dataset(self) -> xarray.Dataset:
        """Of what was added; members that failed or are not there are NaN."""
        import xarray

        texts = np.full(len(self._members), "", dtype=object)
        texts[~self._done] = "not run"
        for index, failure in self.failures.items():
            texts[index] = failure
        variables: dict[str, Any] = {}
        coords: dict[str, Any] = self._axes()
        over = tuple(self._members.shape)
        lengths = tuple(self._members.shape.values())
        alone = _shared_dims(self._first)
        for name, first in self._first.items():
            own = {dim: dim if alone[dim] else f"{dim}_{name}" for dim in first.dims}
            dims = (*over, *own.values())
            values = self._arrays[name].reshape(*lengths, *first.values.shape)
            variables[name] = (dims, values, dict(first.attributes))
            coords |= {own[dim]: (own[dim], along) for dim, along in first.coords.items()}
        variables["failure"] = (
            over,
            texts.reshape(lengths),
            {"long_name": "why a member failed"},
        )
        remarks = self._validity.reshape(lengths)
        variables["validity"] = (over, remarks, {"long_name": "what was out of range in a member"})
        return xarray.Dataset(variables, coords)

    def _axes(self) -> dict[str, Any]:
        axes = self._members.axes
        if self._members.grid:
            return {name: (name, np.array(values)) for name, values in axes.items()}
        own = {"member": ("member", np.arange(len(self._members)))}
        return own | {name: ("member", np.array(values)) for name, values in axes.items()}


def table_of(members: Members, outcomes: Iterable[Outcome]) -> Table:
    """All outcomes, which come in the order of the members."""
    table = Table(members)
    for outcome in outcomes:
        table.add(outcome)
    return table


def _shared_dims(first: dict[str, Labelled]) -> dict[str, bool]:
    """Whether each dimension has the same length and values in all that have it."""
    found: dict[str, tuple[int, Any]] = {}
    shared: dict[str, bool] = {}
    for kept in first.values():
        for dim, length in zip(kept.dims, kept.values.shape, strict=True):
            known = found.setdefault(dim, (length, kept.coords.get(dim)))
            same = known[0] == length and np.array_equal(known[1], kept.coords.get(dim))  # type: ignore[arg-type]
            shared[dim] = shared.get(dim, True) and same
    return shared
