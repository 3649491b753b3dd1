"""Breaking loads of lines and slings, and the safety factors asked of them."""

from __future__ import annotations

from dataclasses import dataclass

from seacrane.description.description import Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of


@dataclass(frozen=True, kw_only=True)
class Rating:
    """What a rope breaks at; it exerts no load.

    Attributes
    ----------
    name : str
        Of the line, of a sling, or of the whole of a line with mass.
    breaking_load : float
        Minimum breaking load of one fall, N.
    safety_factor : float or None
        Least breaking load over largest tension; None where none is asked for.
    """

    name: str
    breaking_load: float
    safety_factor: float | None = None


def rating_of(name: str, breaking_load: float | None, safety_factor: float | None) -> Rating | None:
    """What a line breaks at; None where no breaking load is given.

    Raises
    ------
    SceneError
        For a breaking load that is not positive, and a safety factor below 1 or without one.
    """
    what = f"line {name!r}"
    if breaking_load is None:
        if safety_factor is not None:
            raise SceneError(f"{what}: has a safety_factor and no breaking_load; give it in N")
        return None
    load = positive_of(f"{what}: breaking_load", breaking_load, "N")
    if safety_factor is not None and not number_of(f"{what}: safety_factor", safety_factor) >= 1.0:
        raise SceneError(
            f"{what}: safety_factor is {safety_factor:g}; give breaking load over largest tension, 1 or more"
        )
    factor = None if safety_factor is None else float(safety_factor)
    return Rating(name=name, breaking_load=load, safety_factor=factor)


def note_rating(scene: Description, rating: Rating | None) -> None:
    """Keep what a line breaks at, where it is known."""
    if rating is not None:
        scene.ratings[rating.name] = rating
