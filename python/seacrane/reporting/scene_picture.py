"""The scene's picture: first and last pose."""

from __future__ import annotations

from seacrane.figures.pose import outlined_skeleton, plot_scene
from seacrane.reporting.blocks import drawn
from seacrane.reporting.section import Section
from seacrane.result import Result


def _html(result: Result) -> str:
    caption = (
        f"First ({result.time[0]:g} s) and last ({result.time[-1]:g} s) recorded pose, inertial axes. Bodies "
        "are lines through their joints; ships have the length and breadth of their radii of gyration, boxes "
        "the inertia of their bodies."
    )
    return drawn(plot_scene(result), "Scene", caption)


SCENE_PICTURE: Section[Result] = Section(
    title="Scene", applies=lambda result: bool(outlined_skeleton(result)), html=_html
)
