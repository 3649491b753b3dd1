"""Outcomes as one labelled dataset."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.members import Members
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.variables import NOT_RUN, TEXTS, axes_of, own_dims

if TYPE_CHECKING:
    import xarray


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
