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
    caption = (
        "What was recorded over time; triangles mark the largest and the smallest value. What is zero up to "
        "rounding is left out."
    )
    return drawn(draw(overview_sheet(result)), "Histories", caption)


def _track(result: Result) -> str:
    return drawn(draw_track(result), "Payload", "Track of the centre of mass in inertial axes.")


LOADS: Section[Result] = Section(
    title="Hook load and tension", applies=lambda result: bool(_tensions(result)), html=_loads
)
HISTORIES: Section[Result] = Section(title="Histories", applies=_drawable, html=_histories)
TRACKS: Section[Result] = Section(
    title="Payload track",
    applies=lambda result: "position" in result.channels and bool(payload_bodies(result)),
    html=_track,
)


def _scene(result: Result) -> str:
    caption = (
        f"First ({result.time[0]:g} s) and last ({result.time[-1]:g} s) recorded pose, inertial axes. Bodies "
        "are lines through their joints; ships have the length and breadth of their radii of gyration, boxes "
        "the inertia of their bodies."
    )
    return drawn(plot_scene(result), "Scene", caption)


SCENE_PICTURE: Section[Result] = Section(
    title="Scene", applies=lambda result: bool(outlined_skeleton(result)), html=_scene
)


def _has_poses(result: Result) -> bool:
    return result.kept_scene is not None and all(name in result.channels for name in POSES)


def _page(result: Result) -> str:
    note = "Space plays and pauses, the mouse turns and zooms. The caption of the page tells what is drawn."
    return f'<div class="screen">{view(result)._repr_html_()}<p class="note">{note}</p></div>'


THREE_DIMENSIONS: Section[Result] = Section(title="In three dimensions", applies=_has_poses, html=_page)
