"""The rungs of lines; "auto" is settled by a run, and is elastic everywhere else."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from seacrane import _core
from seacrane.description.description import Description, Some
from seacrane.description.loads import changed, lines_of
from seacrane.description.once import once, sharing

RIGID, QUASI_STATIC, ELASTIC, AUTO, WITH_MASS = "rigid", "quasi-static", "elastic", "auto", "with mass"
Rung = Literal["rigid", "quasi-static", "elastic", "auto"]
StretchingRung = Literal["quasi-static", "elastic", "auto"]


def automatic(scene: Description) -> dict[str, _core.Line]:
    """The lines with rung "auto"."""
    return {name: line for name, line in lines_of(scene.loads).items() if line.rung == AUTO}


def with_rungs(scene: Some, rungs: Mapping[str, str]) -> Some:
    """The scene with the rungs of these lines; itself where none is named."""
    if not rungs:
        return scene
    made = _with_rungs(scene, tuple(rungs.items()))
    return sharing(scene.copy(loads=made.loads), made)


@once
def _with_rungs(scene: Some, rungs: tuple[tuple[str, str], ...]) -> Some:
    out = scene.copy()
    for name, rung in rungs:
        out.loads[name] = changed(out.loads[name], rung=rung)
    return out
