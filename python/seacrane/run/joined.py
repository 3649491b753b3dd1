"""Results of runs, one after the other, joined to one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, COUNTED_ON, DERIVED, NAMED, channel_of
from seacrane.result.about import About, Event, StageSpan, added_stats
from seacrane.result.result import Result
from seacrane.run.derived import derived_channels, squeezed
from seacrane.run.lanes import joined_lanes
from seacrane.scene.scene import Scene

LOST = "impact_energy_lost_J"
NOTHING = ("N", "N m", "N or N m", "W", "Pa")  # units of what is zero where its element is not there


@dataclass
class Piece:
    """One finished run of a sequence: its result, and its counters at both ends."""

    result: Result
    names: Mapping[str, Sequence[str]]  # along each dimension, also of channels that are not recorded
    start: Mapping[str, Array]  # values of `COUNTED_ON`, and of angles that count turns
    end: Mapping[str, Array]
    reached: Mapping[str, Any]  # `COUNTED_ON` before the changes, counted from the first start
    lost: float = 0.0  # J, in connections made and released just before it
    before: list[Event] = field(default_factory=list)  # these changes

    @property
    def added(self) -> dict[str, Any]:
        """What to add to `COUNTED_ON` so that they count from the first start."""
        out = {name: self.reached[name] - self.start.get(name, 0.0) for name in COUNTED_ON}
        return out | {"impact_loss": out["impact_loss"] + self.lost}

    def counting_on(self) -> _core.State | None:
        """The state at its end, which counts from the first start: a run from there goes on with it."""
        state = self.result.state
        record = None if state is None else state.record
        if state is None or record is None:
            return state
        added = self.added
        record = _core.RecordHistory(
            **record.__getstate__() | {
                "start_energy": record.start_energy - float(added["energy_balance"]),
                "impact_loss": float(self.end.get("impact_loss", 0.0) + added["impact_loss"]),
            }
        )  # fmt: skip
        return _core.State(**state.__getstate__() | {"record": record})


def counted(scene: Scene, model: _core.Model, snapshot: Mapping[str, Array]) -> dict[str, Array]:
    """What a run counts from where its record begins, at a snapshot of the core."""
    wanted = [name for name in model.channel_names() if name in COUNTED_ON and name in snapshot]
    turning = [name for name, channel in DERIVED.items() if channel.turns]
    now = {name: snapshot[name] for name in wanted} | derived_channels(scene, snapshot, turning)
    return {name: values[0] for name, values in now.items()}


def joined(
    pieces: Sequence[Piece],
    *,
    scene: Scene,
    spans: Sequence[StageSpan],
    interrupted: bool,
    after: Sequence[Event],
    before: str = "",
) -> Result:
    """One result of all pieces: of two outputs at one time the earlier stays.

    `before` is what was out of range before the first of them, one message a line.

    What an element does where it is not there is nothing for forces and powers, and not a number else.
    """
    offsets = _offsets(pieces)
    names = _all_names(pieces)
    kept, last = [], -np.inf
    for piece in pieces:
        kept.append(piece.result.time > last)
        last = max(last, float(piece.result.time[-1]))
    every = list(dict.fromkeys(name for piece in pieces for name in piece.result.arrays))
    arrays = {}
    for channel in every:
        parts = [
            _whole(channel, piece, names) + offsets[i].get(channel, 0.0) for i, piece in enumerate(pieces)
        ]
        array = np.concatenate([part[keep] for part, keep in zip(parts, kept, strict=True)])
        arrays[channel] = squeezed(channel, array)
    events = [event for piece in pieces for event in (*piece.before, *piece.result.events)]
    return Result.from_arrays(
        time=np.concatenate([piece.result.time[keep] for piece, keep in zip(pieces, kept, strict=True)]),
        arrays=arrays, coords=names, events=[*events, *after], stats=_stats(pieces, before),
        about=_about(pieces, spans), interrupted=interrupted, state=pieces[-1].counting_on(),
        scene=scene.copy(notes={}),
    )  # fmt: skip


def _offsets(pieces: Sequence[Piece]) -> list[dict[str, Any]]:
    """What to add to counters of each piece so that they go on from the piece before."""
    out: list[dict[str, Any]] = []
    before: Mapping[str, Any] = pieces[0].start
    for piece in pieces:
        added = piece.added
        for name in (name for name in piece.start if CHANNELS[name].turns and name in before):
            added[name] = 2.0 * np.pi * np.round((before[name] - piece.start[name]) / (2.0 * np.pi))
        before = {**piece.end, **{name: piece.end.get(name, 0.0) + more for name, more in added.items()}}
        out.append(added)
    return out


def _all_names(pieces: Sequence[Piece]) -> dict[str, list[str]]:
    """Names along each dimension in any piece, each behind the one that it follows where it first appears."""
    out: dict[str, list[str]] = {}
    for piece in pieces:
        for dim, names in piece.names.items():
            known, at = out.setdefault(dim, []), 0
            for name in names:
                if name not in known:
                    known.insert(at, name)
                at = known.index(name) + 1
    return out


def _whole(name: str, piece: Piece, names: Mapping[str, Sequence[str]]) -> Array:
    """A channel of a piece, or its least or largest values, with all names along its dimensions."""
    channel = channel_of(name)
    dims = CHANNELS[channel].dims_of_several
    sizes = [len(names[dim]) for dim in dims[1:] if dim in NAMED]
    fixed = [len(piece.names[dim]) for dim in dims[1:] if dim not in NAMED]
    assert all(dim in NAMED for dim in dims[1 : 1 + len(sizes)]), "named dimensions come first"
    count = piece.result.time.size
    nothing = 0.0 if CHANNELS[channel].unit in NOTHING or channel in COUNTED_ON else np.nan
    out = np.full((count, *sizes, *fixed), nothing)
    if channel not in piece.result:
        return out
    array = piece.result.arrays.get(name, piece.result[channel])
    own = [piece.names[dim] for dim in dims[1:] if dim in NAMED]
    array = array.reshape(count, *(len(part) for part in own), *fixed)
    place = [[names[dim].index(name) for name in part] for dim, part in zip(dims[1:], own, strict=False)]
    out[np.ix_(range(count), *place, *(range(n) for n in fixed))] = array
    return out


def _lost_in_impacts(piece: Piece) -> float:
    """J, in this piece and in what met as it was connected; a run that goes on counts on."""
    before = float(np.sum(piece.start.get("impact_loss", 0.0)))
    met = sum(event.energy_lost for event in piece.before if event.kind == "contact")
    return float(piece.result.stats.get(LOST, before)) - before + float(met)


def _about(pieces: Sequence[Piece], spans: Sequence[StageSpan]) -> About:
    """As of the last stage, with what hangs in any, and its weight."""
    every = [piece.result.about for piece in pieces]
    weights = {name: weight for one in every for name, weight in one.hanging_weight.items()}
    hung = {hook["label"]: hook for one in every for hook in one.hung}
    settings = {**every[-1].settings, "t_end": float(pieces[-1].result.time[-1])}
    return replace(
        every[-1], settings=settings, stages=tuple(spans), hanging_weight=weights, hung=tuple(hung.values())
    )


def _stats(pieces: Sequence[Piece], before: str) -> dict[str, Any]:
    every = [piece.result.stats for piece in pieces]
    out: dict[str, Any] = reduce(added_stats, every, {"validity": before} if before else {})
    out.pop("kept_apart", None)
    out |= joined_lanes(every)
    if any(one.get("rank_changed") for one in every):
        out["rank_changed"] = 1
    if any(LOST in one for one in every):
        out[LOST] = sum(_lost_in_impacts(piece) for piece in pieces)
    return out
