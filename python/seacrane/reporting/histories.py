"""Figures: the tensions, everything over time, and where the payload went."""

from __future__ import annotations

from seacrane.figures.overview import PANELS, overview_sheet, payload_bodies
from seacrane.figures.plots import draw_track
from seacrane.plotting.panel import draw
from seacrane.reporting.blocks import drawn
from seacrane.reporting.section import Section
from seacrane.result import Result
from seacrane.result.history import history_sheet

TENSIONS = ("link_tension", "limit_force")


def _tensions(result: Result) -> list[str]:
    return [name for name in TENSIONS if name in result.channels]


def _loads(result: Result) -> str:
    figure = draw(history_sheet(result, *_tensions(result)))
    return drawn(
        figure, "Tension", "Links and limits over time; triangles mark the largest and the smallest value."
    )


def _drawable(result: Result) -> bool:
    """Whether anything but the body positions, which only payloads show, is drawn."""
    shown = set(PANELS) & set(result.channels)
    return bool(shown - {"position"} or (shown and payload_bodies(result)))


def _histories(result: Result) -> str:
    caption = (
        "What was recorded over time; triangles mark the largest and the smallest value. What is zero up to "
        "rounding is left out."
    )
    return drawn(draw(overview_sheet(result)), "Histories", caption)


def _track(result: Result) -> str:
    return drawn(draw_track(result), "Payload", "Track of the centre of mass in inertial axes.")


LOADS: Section[Result] = Section(
    title="Link and wire tension", applies=lambda result: bool(_tensions(result)), html=_loads
)
HISTORIES: Section[Result] = Section(title="Histories", applies=_drawable, html=_histories)
TRACKS: Section[Result] = Section(
    title="Payload track",
    applies=lambda result: "position" in result.channels and bool(payload_bodies(result)),
    html=_track,
)
