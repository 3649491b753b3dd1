"""Relative motions of two named points."""

from __future__ import annotations

from dataclasses import dataclass

from seacrane.description.description import GROUND, Description, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, text_of


@dataclass(frozen=True, kw_only=True)
class Relative:
    """Two points whose relative position and velocity are recorded; it exerts no load.

    Attributes
    ----------
    point, to : Named by `Scene.add_point`: what is looked at, and from where.
    axes : str
        The body along whose axes the motion is told, or "ground": along those of the inertial frame.
    """

    name: str
    point: str
    to: str
    axes: str


def add_relative(scene: Description, name: str, *, point: str, to: str, axes: str = GROUND) -> Relative:
    """Record where a point is over another: the channels relative_position and relative_velocity.

    The velocity is the rate of the position as it is told: along axes that turn, without their turning.
    Height and speed of a load over a deck are the z of its lowest point over a point of the deck, along the
    axes of the body that has the deck.

    Parameters
    ----------
    name : str
        Along the dimension "pair" of the channels.
    point : str
        Named by `add_point`.
    to : str
        The point, named likewise, from which it is looked at.
    axes : str
        A body along whose axes it is told; default: the inertial frame.

    Raises
    ------
    SceneError
        For a point or a body that is not there.
    """
    what = f"relative {name_of('relative', name)!r}"
    for key, one in (("point", point), ("to", to)):
        if text_of(f"{what}: {key}", one) not in scene.points:
            known = ", ".join(map(repr, scene.points)) or "none"
            raise SceneError(f"{what}: there is no point {one!r}; add_point it first, the scene has {known}")
    if text_of(f"{what}: axes", axes) not in scene.bodies and axes != GROUND:
        raise SceneError(f"{what}: there is no body {axes!r}; add it first")
    inserted: Relative = insert(
        "relative", scene.relatives, Relative(name=name, point=point, to=to, axes=axes)
    )
    return inserted
