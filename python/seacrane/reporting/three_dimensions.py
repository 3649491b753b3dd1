"""The run as a page in three dimensions, where the result holds its scene."""

from __future__ import annotations

from seacrane.reporting.section import Section
from seacrane.result import Result
from seacrane.viewer.motion import POSES
from seacrane.viewer.view import view


def _applies(result: Result) -> bool:
    return result.kept_scene is not None and all(name in result.channels for name in POSES)


def _html(result: Result) -> str:
    note = "Space plays and pauses, the mouse turns and zooms. The caption of the page tells what is drawn."
    return f'<div class="screen">{view(result)._repr_html_()}<p class="note">{note}</p></div>'


THREE_DIMENSIONS: Section[Result] = Section(title="In three dimensions", applies=_applies, html=_html)
