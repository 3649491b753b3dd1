"""Figures: the scene, the tensions, everything over time, the payload's track, and the page in 3D."""

from __future__ import annotations

from seacrane.answers.blocks import drawn
from seacrane.answers.section import Section
from seacrane.pictures.overview import PANELS, overview_sheet, payload_bodies
from seacrane.pictures.plots import draw_track
from seacrane.pictures.pose import outlined_skeleton, plot_scene
from seacrane.pictures.pose_curves import POSES
from seacrane.pictures.view import view
from seacrane.plotting.panel import draw
from seacrane.result import Result
from seacrane.result.history import history_sheet

TENSIONS = ("hook_load", "line_tension", "limit_force")


def _tensions(result: Result) -> list[str]:
    return [name for name in TENSIONS if name in result.channels]


def _loads(result: Result) -> str:
    if not _tensions(result):
        return ""
    figure = draw(history_sheet(result, *_tensions(result)))
    return drawn(
        figure,
        "Tension",
        "Hook loads, lines and limits over time; triangles mark the largest and the smallest value.",
    )


def _drawable(result: Result) -> bool:
    """Whether anything but the body positions, which only payloads show, is drawn."""
    shown = set(PANELS) & set(result.channels)
    return bool(shown - {"position"} or (shown and payload_bodies(result)))


def _histories(result: Result) -> str:
    if not _drawable(result):
        return ""
    caption = (
        "What was recorded over time; triangles mark the largest and the smallest value. What is zero up to "
        "rounding is left out."
    )
    return drawn(draw(overview_sheet(result)), "Histories", caption)


def _track(result: Result) -> str:
    if "position" not in result.channels or not payload_bodies(result):
        return ""
    return drawn(draw_track(result), "Payload", "Track of the centre of mass in inertial axes.")


def _scene(result: Result) -> str:
    if not outlined_skeleton(result):
        return ""
    caption = (
        f"First ({result.time[0]:g} s) and last ({result.time[-1]:g} s) recorded pose, inertial axes. Bodies "
        "are lines through their joints; ships have the length and breadth of their radii of gyration, boxes "
        "the inertia of their bodies."
    )
    return drawn(plot_scene(result), "Scene", caption)


def _page(result: Result) -> str:
    if result.kept_scene is None or not all(name in result.channels for name in POSES):
        return ""
    note = "Space plays and pauses, the mouse turns and zooms. The caption of the page tells what is drawn."
    return f'<div class="screen">{view(result)._repr_html_()}<p class="note">{note}</p></div>'


LOADS: Section[Result] = Section("Hook load and tension", _loads)
HISTORIES: Section[Result] = Section("Histories", _histories)
TRACKS: Section[Result] = Section("Payload track", _track)
SCENE_PICTURE: Section[Result] = Section("Scene", _scene)
THREE_DIMENSIONS: Section[Result] = Section("In three dimensions", _page)
