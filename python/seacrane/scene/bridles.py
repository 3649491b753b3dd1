"""Slings from one point to several points of a load."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.forces import add_load
from seacrane.description.line_path import described_poses
from seacrane.description.ratings import note_rating, rating_of
from seacrane.description.rungs import StretchingRung
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, rows_of, shaped_of, text_of, vector_of
from seacrane.inputs.shown import shown
from seacrane.scene.lines import STRETCHING


def add_bridle(
    scene: Description,
    name: str,
    *,
    hook: str,
    load: str,
    points: ArrayLike,
    EA: ArrayLike,
    hook_point: ArrayLike = (0.0, 0.0, 0.0),
    lengths: ArrayLike = (),
    damping_ratio: float = 0.02,
    rung: StretchingRung = "elastic",
    settling: float = 0.2,
    breaking_load: float | None = None,
    safety_factor: float | None = None,
) -> list[_core.Line]:
    """Slings from one point of a hook to points of a load: a line for each, "<name> 1", "<name> 2" and so on.

    Four or more share a load by their EA and lengths: the scene need not be determined by statics.

    Parameters
    ----------
    hook, load : str
        Bodies that are there; the hook may be "ground".
    points : array_like, shape (n, 3)
        On the load, in its coordinates, m.
    EA : array_like, shape (n,) or ()
        Axial stiffness of each sling, N; one number for all.
    hook_point : array_like, shape (3,)
        On the hook, in its coordinates, m.
    lengths : array_like, shape (n,), optional
        Unstretched, m; by default the distances between the bodies as they are described.
    damping_ratio, rung, settling, breaking_load, safety_factor
        Of each, as in `add_line`; the mass on each is its share of the load's.

    Returns
    -------
    list of Line

    Raises
    ------
    SceneError
        For fewer than two points, bodies that are not there, another rung, and what `add_line` refuses.
    """
    what = f"bridle {name_of('bridle', name)!r}"
    ends = rows_of(f"{what}: points", points, 3)
    if len(ends) < 2:
        raise SceneError(f"{what}: has {len(ends)} points; give two or more, or add_line for one sling")
    for role, body in (("hook", text_of(f"{what}: hook", hook)), ("load", text_of(f"{what}: load", load))):
        if body not in scene.bodies and (role == "load" or body != "ground"):
            raise SceneError(f"{what}: {role} {body!r} is no body of the scene; add it first")
    if rung not in STRETCHING:
        raise SceneError(f"{what}: rung is {shown(rung)}; choose one of {', '.join(map(repr, STRETCHING))}")
    poses = described_poses(scene)
    top = shaped_of(f"{what}: hook_point", hook_point, (3,))
    origin, rotation = poses(hook)
    foot, turned = poses(load)
    apart = np.linalg.norm(foot + ends @ turned.T - origin - rotation @ top, axis=1)
    given = _for_each(f"{what}: lengths", lengths, len(ends)) if np.size(lengths) else apart.tolist()
    axial = _for_each(f"{what}: EA", EA, len(ends))
    ratings = [rating_of(f"{name} {i + 1}", breaking_load, safety_factor) for i in range(len(ends))]
    slings = [
        add_load(scene, _core.Line(
            name=f"{name} {i + 1}", bodies=[hook, load], points=[top, end], EA=axial[i],
            length=given[i], damping_ratio=damping_ratio, mass=scene.bodies[load].mass / len(ends),
            rung=rung, settling=settling,
        ))
        for i, end in enumerate(ends)
    ]  # fmt: skip
    for rating in ratings:
        note_rating(scene, rating)
    return slings


def _for_each(what: str, values: ArrayLike, count: int) -> list[float]:
    numbers = vector_of(what, np.atleast_1d(np.asarray(values, dtype=object)))
    if len(numbers) not in (1, count):
        raise SceneError(f"{what} are {len(numbers)} numbers; give one for each of {count} points, or one")
    return numbers * count if len(numbers) == 1 else numbers
