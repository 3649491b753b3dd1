"""Channels over time as a figure, a panel for each channel and unit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from seacrane.arrays import Array
from seacrane.description.pick import Pick, pick_of
from seacrane.errors import SceneError
from seacrane.inputs.frames import AXES_NOTE
from seacrane.plotting.panel import COLOURS, Line, Panel, Sheet
from seacrane.result.record import Record
from seacrane.result.traces import Trace, traces

STYLES = ("-", "--", ":")
EVENTS = {
    "contact": "contact: taut, or pressed", "rebound": "rebound", "release": "release: slack, or off",
    "through": "through the seat that it left",
    "stage": "stage begins", "connection": "connection",
    "limit": "bound reached",
}  # fmt: skip


def title_of(result: Record) -> str:
    return f"{result.stats['scene']}{' (interrupted)' if result.interrupted else ''}"


def wanted_traces(
    result: Record, channels: Sequence[str | Pick], names: dict[str, str]
) -> dict[str, list[Trace]]:
    """Traces of each channel; each name picks where the channel has its dimension.

    Raises SceneError for a channel that was not recorded, or a name that no channel holds.
    """
    if not channels:
        raise SceneError(f"channels: none is named; this result holds {', '.join(result.channels)}")
    picks = [pick_of("plot", channel, held=result.channels) for channel in channels]
    for dim in names:
        if not any(dim in result.dims[pick.channel] for pick in picks):
            raise SceneError(
                f"{dim}={names[dim]!r}: none of {', '.join(map(str, channels))} has this dimension"
            )
    found: dict[str, list[Trace]] = {}
    try:
        for pick in picks:
            own = {dim: name for dim, name in names.items() if dim in result.dims[pick.channel]}
            found.setdefault(pick.channel, []).extend(traces(result, pick.channel, **own, **pick.names))
    except (TypeError, ValueError) as error:
        raise SceneError(str(error)) from error
    return found


def panels_of(quantity: str, found: Iterable[Trace], *, skip: int = 0) -> list[Panel]:
    """A panel for each unit; labels are the names of a trace but the first `skip`."""
    by_unit: dict[str, list[Trace]] = {}
    for one in found:
        by_unit.setdefault(one.unit, []).append(one)
    panels = []
    for unit, group in by_unit.items():
        lines = tuple(
            Line(
                label=" ".join(one.names[skip:]), values=one.values, bounds=one.bounds, colour=i,
                style=STYLES[i // len(COLOURS) % len(STYLES)],
            )
            for i, one in enumerate(group)
        )  # fmt: skip
        panels.append(Panel(quantity=quantity, unit=unit, lines=lines))
    return panels


def marks_of(result: Record) -> Mapping[str, Array]:
    """Times of the events of limits, by what happened."""
    return {
        text: np.array([event.time for event in result.events if event.kind == kind])
        for kind, text in EVENTS.items()
        if any(event.kind == kind for event in result.events)
    }


def axes_note(result: Record, channels: Iterable[str]) -> str:
    """The axis convention, for a figure of channels that have directions."""
    directed = any({"axis", "motion"} & set(result.dims[channel]) for channel in channels)
    return AXES_NOTE if directed else ""


def history_sheet(result: Record, *channels: str | Pick, **names: str) -> Sheet:
    """The panels of `Result.plot` with their numbers."""
    found = wanted_traces(result, channels, names)
    panels = [
        panel for channel, every in found.items() for panel in panels_of(channel.replace("_", " "), every)
    ]
    return Sheet(
        title=title_of(result), caption=f"Triangles mark the largest and the smallest value. {AXES_NOTE}",
        abscissa=result.time, panels=tuple(panels), columns=2 if len(panels) > 3 else 1,
        marks=marks_of(result), extremes=True,
    )  # fmt: skip
