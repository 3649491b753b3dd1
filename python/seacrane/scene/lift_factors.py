"""What ropes break at, and the factors of a lift's calculation sheet, each with its source."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.description.description import Description, insert, require
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of, shaped_of, text_of, vector_of
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown

Vector = tuple[float, float, float]
LARGEST = 10.0  # a factor beyond it is a percentage, or a load
AT_LEAST_ONE = ("weight_contingency", "dynamic_factor", "sling_safety_factor", "shackle_safety_factor")


@dataclass(frozen=True, kw_only=True)
class Rating:
    """What a line, a sling or the whole of a line with mass breaks at, as `Scene.add_line` takes it."""

    name: str
    breaking_load: float
    safety_factor: float | None = None


def rating_of(name: str, breaking_load: float | None, safety_factor: float | None) -> Rating | None:
    """What a line breaks at; None without a breaking load. SceneError for a factor below 1, or alone."""
    what = f"line {name!r}"
    if breaking_load is None:
        if safety_factor is not None:
            raise SceneError(f"{what}: has a safety_factor and no breaking_load; give it in N")
        return None
    load = positive_of(f"{what}: breaking_load", breaking_load, "N")
    if safety_factor is not None and not number_of(f"{what}: safety_factor", safety_factor) >= 1.0:
        raise SceneError.of(
            f"{what}: safety_factor",
            f"is {safety_factor:g}; give breaking load over largest tension, 1 or more",
        )
    factor = None if safety_factor is None else float(safety_factor)
    return Rating(name=name, breaking_load=load, safety_factor=factor)


def note_rating(scene: Description, rating: Rating | None) -> None:
    """Keep what a line breaks at, where it is known."""
    if rating is not None:
        scene.ratings[rating.name] = rating


@dataclass(frozen=True, kw_only=True)
class LiftFactors:
    """What a lift is calculated with beside its scene: the words of `Scene.add_lift_factors`.

    Attributes
    ----------
    name : str
        Of the load, a body.
    """

    name: str
    weight_contingency: float = 1.0
    center_of_gravity: Vector = (0.0, 0.0, 0.0)
    skew_load: tuple[float, ...] = (1.0,)
    dynamic_factor: float | None = None
    sling_safety_factor: float | None = None
    shackle_safety_factor: float | None = None
    shackle_breaking_load: float | None = None
    alpha: float = 1.0
    sources: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "sources", ReadOnly(self.sources))


NUMBERS = tuple(one.name for one in fields(LiftFactors) if one.name not in ("name", "sources"))


def add_lift_factors(
    scene: Description, load: str = "load", *, weight_contingency: float = 1.0,
    center_of_gravity: ArrayLike = (0.0, 0.0, 0.0), skew_load: ArrayLike = 1.0,
    dynamic_factor: float | None = None, sling_safety_factor: float | None = None,
    shackle_safety_factor: float | None = None, shackle_breaking_load: float | None = None,
    alpha: float = 1.0, sources: Mapping[str, str] | None = None,
) -> LiftFactors:  # fmt: skip
    """State what a lift is calculated with beside its scene: `lift_sheet` and the report print its sheet.

    None of them moves anything. No standard's numbers are here: take those of the edition that the project is
    under, and say in `sources` where each is from. What has no source is printed as unverified.

    Parameters
    ----------
    load : str
        The body that is lifted.
    weight_contingency : float
        Design weight over the weight as described, 1 or more.
    center_of_gravity : array_like, shape (3,)
        By how much it may be off to either side, along the body's axes, m: statics take the worst corner of
        this box.
    skew_load : float or array_like, shape (n,)
        SKL, 1 or more, by which tolerances of length raise the force in a sling: one for all, or one for each
        sling in their order. 1 where the slings of the scene have the lengths that they are made with.
    dynamic_factor : float, optional
        Dynamic factor, 1 or more. Default: the one of the run; of a scene alone none.
    sling_safety_factor, shackle_safety_factor : float, optional
        Least breaking load over largest force, 1 or more. A sling's own safety_factor comes first.
    shackle_breaking_load : float, optional
        Of the shackle at each sling, N.
    alpha : float
        Operational over design wave height, above 0 to 1.
    sources : mapping of str to str, optional
        By these names, such as ``{"skew_load": "DNV-ST-N001, the edition and its table"}``.

    Raises
    ------
    SceneError
        For a load that is not there, a factor out of range, a source of something else.
    """
    given: dict[str, Any] = {key: one for key, one in locals().items() if key not in ("scene", "load")}
    what = f"lift factors of {load!r}"
    require(scene, "lift factors", "load", load)
    skews = vector_of(f"{what}: skew_load", np.atleast_1d(np.asarray(skew_load, dtype=object)))
    for key, value in (*((key, given[key]) for key in AT_LEAST_ONE), *(("skew_load", one) for one in skews)):
        if value is not None and not 1.0 <= number_of(f"{what}: {key}", value) <= LARGEST:
            raise SceneError.of(f"{what}: {key}", f"is {value:g}; give a factor from 1 to {LARGEST:g}")
    if shackle_breaking_load is not None:
        positive_of(f"{what}: shackle_breaking_load", shackle_breaking_load, "N")
    if not 0.0 < number_of(f"{what}: alpha", alpha) <= 1.0:
        raise SceneError.of(f"{what}: alpha", f"is {alpha:g}; give operational over design Hs, above 0 to 1")
    x, y, z = np.abs(shaped_of(f"{what}: center_of_gravity", center_of_gravity, (3,))).tolist()
    if not all(map(math.isfinite, (x, y, z))):
        raise SceneError.of(
            f"{what}: center_of_gravity", f"is {shown(center_of_gravity)}; give finite numbers, m"
        )
    given |= {"center_of_gravity": (x, y, z), "skew_load": tuple(skews), "alpha": float(alpha)}
    factors = LiftFactors(name=load, **given | {"sources": _sources(what, sources or {})})
    return insert("lift factors", scene.lift_factors, factors)


def _sources(what: str, given: Any) -> dict[str, str]:
    if not isinstance(given, Mapping):
        raise SceneError.of(f"{what}: sources", f"are {shown(given)}; give texts by the names of factors")
    for key in given:
        if key not in NUMBERS:
            raise SceneError.of(f"{what}: sources", f"has {shown(key)}; the factors are {', '.join(NUMBERS)}")
    return {key: text_of(f"{what}: source of {key}", value) for key, value in given.items()}
