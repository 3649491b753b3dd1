"""The lift sheet of a run, where its scene states factors or breaking loads."""

from __future__ import annotations

from seacrane.answers.blocks import note
from seacrane.answers.lift_sheet import UNVERIFIED, lift_sheet
from seacrane.answers.section import Section
from seacrane.description.suspension import hung_loads
from seacrane.errors import SeacraneError
from seacrane.result import Result

WORDS = (
    f'"{UNVERIFIED}": nobody has said where the number is from. The steps are those of GL Noble Denton '
    "0027/ND Rev. 11, 6.2 and 7.2."
)


def _loads(result: Result) -> list[str]:
    """With factors, or on a rope whose breaking load is known."""
    try:
        scene = result.scene
    except SeacraneError:
        return []
    if scene is None:
        return []
    hung = [one.load for one in hung_loads(scene)]
    return list(dict.fromkeys([*(one for one in scene.lift_factors if one in hung),
                               *(hung if scene.ratings else ())]))  # fmt: skip


def _html(result: Result) -> str:
    sheets = "".join(_sheet(result, load) for load in _loads(result))
    return sheets + note(WORDS) if sheets else ""


def _sheet(result: Result, load: str) -> str:
    try:
        return lift_sheet(result, load=load).html()
    except SeacraneError as error:
        return note(f"No sheet of {load}: {error}.")


SHEET: Section[Result] = Section("Lift sheet", _html)
