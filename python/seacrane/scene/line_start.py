"""The unstretched length of a line that starts with a given tension."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.line_path import path_length
from seacrane.description.scene import GROUND, Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of

UNKNOWN_LENGTH = 1.0  # m, of a line that is made to be measured


def starting_line(scene: Description, tension: float | None, given: dict[str, Any]) -> _core.Line:
    """A line with the length at which it carries a tension (N) along its path as described.

    Parameters
    ----------
    scene : Scene
    tension : float, optional
        0 or None: the length is that of the path.
    given : dict
        All of the line but its length.
    """
    line = _core.Line(**given, length=UNKNOWN_LENGTH)
    what = f"line {line.name!r}"
    pull = 0.0 if tension is None else number_of(f"{what}: tension_at_start", tension)
    if not (np.isfinite(pull) and pull >= 0.0):
        raise SceneError(f"{what}: tension_at_start is {pull!r} N; give zero or more")
    absent = [body for body in line.bodies if body != GROUND and body not in scene.bodies]
    if absent:
        raise SceneError(
            f"{what}: its path is measured as described, and body {absent[0]!r} is not in the scene; add it "
            "first, or give the length"
        )
    path = path_length(scene, line)
    if not (np.isfinite(path) and path > 0.0):
        raise SceneError(f"{what}: its path is {path:g} m long as described; correct its points")
    return _core.Line(**given, length=path / (1.0 + _strain(line, pull)))


def _strain(line: _core.Line, tension: float) -> float:
    """At which the line carries a tension."""
    if not len(line.strains):
        return tension / float(line.stiffness)
    from scipy.interpolate import PchipInterpolator

    table = PchipInterpolator(line.strains, line.tensions)
    last, highest = float(line.strains[-1]), float(line.tensions[-1])
    if tension >= highest:
        return last + (tension - highest) / float(table.derivative()(last))
    return float(table.solve(tension, extrapolate=False)[0])
