"""Where a line runs in the described pose, and the unstretched length with which it starts."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.description import GROUND, Description
from seacrane.description.line_path import path_length
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, text_of

UNKNOWN_LENGTH = 1.0  # m, of a line that is made to be measured


def path_between(
    scene: Description, what: str, bodies: tuple[Any, Any], points: tuple[ArrayLike | None, ArrayLike | None]
) -> tuple[list[str], list[ArrayLike]]:
    """The bodies of both ends and a point on each, by default the one of `hung_from`."""
    for role, body in zip(("first", "second"), bodies, strict=True):
        if body is None:
            raise SceneError(f"{what}: has no {role}; name the body of that end, which may be 'ground'")
    names = [text_of(f"{what}: {role}", body) for role, body in zip(("first", "second"), bodies, strict=True)]
    places = [
        hung_from(scene, body) if point is None else point for body, point in zip(names, points, strict=True)
    ]
    return names, places


def hung_from(scene: Description, body: str) -> tuple[float, float, float]:
    """Where a line is tied to a body unless a point is given, in its coordinates, m.

    That is the top centre of a body that has a size, else its origin.
    """
    described = scene.bodies.get(body)
    if described is None or not np.any(described.size):
        return (0.0, 0.0, 0.0)
    x, y, z = map(float, described.center_of_mass)
    return (x, y, z + 0.5 * float(described.size[2]))


def starting_length(scene: Description, line: _core.Line, tension: float | None) -> float:
    """The unstretched length at which a line carries a tension (N) along its path as described, m.

    Parameters
    ----------
    line : Its own length does not count.
    tension : 0 or None: the length is that of the path.
    """
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
    return path / (1.0 + _strain(line, pull))


def _strain(line: _core.Line, tension: float) -> float:
    """At which the line carries a tension."""
    if not len(line.strains):
        return tension / float(line.EA)
    from scipy.interpolate import PchipInterpolator

    table = PchipInterpolator(line.strains, line.tensions)
    last, highest = float(line.strains[-1]), float(line.tensions[-1])
    if tension >= highest:
        return last + (tension - highest) / float(table.derivative()(last))
    return float(table.solve(tension, extrapolate=False)[0])
