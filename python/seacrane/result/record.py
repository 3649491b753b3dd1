"""What was recorded, and how it is looked up: by channel, names, stage and time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import MOTIONS, dims_of, unit_of
from seacrane.description.pick import Pick, column_name, pick_of
from seacrane.errors import SceneError
from seacrane.inputs.keywords import named
from seacrane.plotting.table import Column, Table
from seacrane.result.about import About, Event, StageSpan, Stat

Extremes = Mapping[str, tuple[Array, Array]]  # least and largest values by channel


@named
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Record(Mapping[str, Array]):
    """What curves are read from: the part of a `Result` that was recorded."""

    time: Array
    channels: Mapping[str, Array]
    coords: Mapping[str, tuple[str, ...]]
    stats: Mapping[str, Stat]
    interrupted: bool = False
    events: tuple[Event, ...] = ()
    about: About = field(default_factory=About)
    extremes: Extremes = field(default_factory=dict)
    dims: Mapping[str, tuple[str, ...]] = field(init=False)

    def __post_init__(self) -> None:
        for name in ("channels", "coords", "stats", "extremes"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))
        dims = {name: dims_of(name, array.ndim) for name, array in self.channels.items()}
        object.__setattr__(self, "dims", MappingProxyType(dims))

    def __getitem__(self, name: str) -> Array:
        """The channel of that name; the error lists what was recorded."""
        try:
            return self.channels[name]
        except KeyError:
            known = ", ".join(self.channels) or "nothing"
            raise KeyError(f"no channel {name!r} in this result; it holds {known}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.channels)

    def __len__(self) -> int:
        """The number of channels."""
        return len(self.channels)

    __eq__ = object.__eq__  # two results are the same only if they are one: a mapping would compare arrays
    __hash__ = object.__hash__

    def __bool__(self) -> bool:
        """True also without channels: a result is there."""
        return True

    @property
    def settings(self) -> Mapping[str, Any]:
        """The settings of the run by the words of `simulate`, with what is known of its vessels and sea."""
        return self.about.settings

    @property
    def stages(self) -> tuple[StageSpan, ...]:
        """When each stage began and ended, and what ended it; none: it was one run."""
        return self.about.stages

    def stage(self, name: str) -> slice:
        """The outputs of a stage, to index time and channels: after its start and up to its end.

        Those of the first stage include its start. Raises ValueError for a stage that was not run.
        """
        for place, span in enumerate(self.stages):
            if span.name == name:
                after, upto = np.searchsorted(self.time, [span.start, span.end], side="right")
                return slice(0 if place == 0 else int(after), int(upto))
        known = ", ".join(span.name for span in self.stages) or "none"
        raise ValueError(f"no stage {name!r} in this result; choose from {known}")

    def part(self, *, after: float | None = None, stage: str | None = None) -> slice:
        """The outputs from a time (s) on, or those of a stage, or both, to index time and channels."""
        whole = slice(0, self.time.size) if stage is None else self.stage(stage)
        first = 0 if after is None else int(np.searchsorted(self.time, after))
        return slice(max(first, whole.start), max(first, whole.stop))

    def select(self, channel: str | Pick, /, **names: str) -> Array:
        """A channel at named coordinates, as a read-only view.

        Parameters
        ----------
        channel : str or Pick
            Channel name, or a short text with names in brackets, such as ``"position[load, z]"`` or "roll".
        **names : str
            One name per dimension to pick, for instance ``body="payload", axis="z"``.

        Returns
        -------
        ndarray
            The channel without the picked dimensions; unit as in `CHANNELS`.

        Raises
        ------
        KeyError
            If the channel was not recorded.
        ValueError
            For a dimension the channel has not, or a name it does not hold; for a text that says from when
            on, which is for `to_dataframe`.
        """
        if isinstance(channel, Pick) or channel in MOTIONS or channel not in self.channels:
            pick = self._picked(channel, names)
            if pick.parts:
                raise SceneError(f"select {channel!s}: a view has all outputs; index it by time")
            channel, names = pick.channel, dict(pick.names)
        picked: Array = self[channel][self._index(channel, names)]
        return picked

    def _index(self, channel: str, names: Mapping[str, str]) -> tuple[Any, ...]:
        """The place of names in the array of a channel."""
        dims = self.dims[channel]
        for dim in names:
            if dim not in dims[1:]:
                raise ValueError(f"channel {channel!r} has dimensions {dims}, not {dim!r}")
        index: list[Any] = [slice(None)] * len(dims)
        for dim, name in names.items():
            if name not in self.coords[dim]:
                raise ValueError(
                    f"no {dim} {name!r} in this result; choose from {', '.join(self.coords[dim])}"
                )
            index[dims.index(dim)] = self.coords[dim].index(name)
        return tuple(index)

    def reached(
        self, channel: str | Pick, /, *, part: slice | None = None, **names: str
    ) -> tuple[Array, Array]:
        """Least and largest values of a channel at named coordinates since the output before.

        They come from the steps of the run, also between outputs, where it kept them: of what
        docs/channels.md lists, of others they are the values of the outputs.

        Parameters
        ----------
        channel, **names
            As of `select`.
        part : slice, optional
            Of the outputs, as `part` and `stage` give it; default: all.

        Raises
        ------
        KeyError, ValueError
            As `select`.
        """
        pick = self._picked(channel, names)
        values = self.select(pick.channel, **pick.names)
        whole = slice(0, self.time.size) if part is None else part
        if pick.channel not in self.extremes:
            return values[whole], values[whole]
        index = self._index(pick.channel, pick.names)
        least, largest = (inside(self, whole, values, one[index]) for one in self.extremes[pick.channel])
        return least, largest

    def curve(self, channel: str | Pick, /, **names: str) -> Array:
        """One curve, shape (n,): as `select`, where dimensions with a single name need none.

        Raises
        ------
        SceneError
            If the channel was not recorded, for names that are not there, or where several curves are left.
        """
        try:
            pick = self._picked(channel, names)
            values = self.select(pick.channel, **pick.names)
        except (KeyError, ValueError) as error:
            raise SceneError(str(error.args[0])) from error
        left = [dim for dim in self.dims[pick.channel][1:] if dim not in pick.names]
        several = {dim: self.coords[dim] for dim in left if len(self.coords[dim]) > 1}
        if several:
            listed = "; ".join(f"{dim}: one of {', '.join(known)}" for dim, known in several.items())
            raise SceneError(f"channel {pick.channel!r} holds several curves; give {listed}")
        return values.reshape(self.time.size)

    def _picked(self, channel: str | Pick, names: Mapping[str, str]) -> Pick:
        """A selector as a value; KeyError for a plain name that is no channel."""
        if isinstance(channel, str) and "[" not in channel and channel not in MOTIONS:
            self[channel]
        return pick_of("select", channel, names)

    def _curves(self, channels: Sequence[str | Pick]) -> Table:
        """A column for each curve of each selector, by the times of the part that they are of."""
        picks = [self._picked(channel, {}) for channel in channels or self.channels]
        parts = {(pick.after, pick.stage) for pick in picks}
        if len(parts) > 1:
            raise SceneError(
                "table: its columns are of one part of the run; give all the same after= and stage="
            )
        (after, stage) = next(iter(parts), (None, None))
        part = self.part(after=after, stage=stage)
        found: dict[str, Column] = {}
        for pick in picks:
            self.select(pick.channel, **pick.names)  # which refuses what is not there
            for names, curve in pick.curves(self[pick.channel], self.dims[pick.channel], self.coords):
                name = column_name(pick.channel, list(names.values()))
                unit = unit_of(pick.channel, names.values())
                found[name] = Column(name=name, values=curve[part], unit=unit)
        return Table(
            axes=[Column(name="time", values=self.time[part], unit="s")], columns=list(found.values())
        )


def inside(result: Record, part: slice, values: Array, bound: Array) -> Array:
    """Least or largest values (n,) of a part of the outputs, whose values are `values`.

    What was before the first output of the part counts if the part begins at the output before it: at the
    start of a stage.
    """
    out = bound[part]
    if not len(out) or part.start == 0:
        return out
    before = float(result.time[part.start - 1])
    if any(span.start == before for span in result.about.stages):
        return out
    return np.concatenate([values[part][:1], out[1:]])
