"""The factors of a lift's calculation sheet, each with its source."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.description.description import Description, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of, shaped_of, text_of, vector_of
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown

Vector = tuple[float, float, float]
LARGEST = 10.0  # a factor beyond it is a percentage, or a load
AT_LEAST_ONE = ("weight_contingency", "dynamic_factor", "sling_safety_factor", "shackle_safety_factor")


@dataclass(frozen=True, kw_only=True)
class LiftFactors:
    """What a lift is calculated with beside its scene. Made by `Scene.add_lift_factors`.

    Attributes
    ----------
    name : str
        Of the load, a body.
    weight_contingency : float
        Design weight over the weight as described.
    center_of_gravity : (float, float, float)
        By how much it may be off to either side, along the body's axes, m: its envelope is a box.
    skew_load : tuple of float
        SKL: force in a sling over that of statics; one for all, or one for each sling in their order.
    dynamic_factor : float or None
        Dynamic factor, in place of the one that a run gives.
    sling_safety_factor, shackle_safety_factor : float or None
        Least breaking load over largest force.
    shackle_breaking_load : float or None
        Of the shackle at each sling, N.
    alpha : float
        Operational over design wave height, above 0 to 1.
    sources : mapping of str to str
        Where each of these is from, by its name: standard, edition and table, or "weighed".
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
    scene: Description,
    load: str = "load",
    *,
    weight_contingency: float = 1.0,
    center_of_gravity: ArrayLike = (0.0, 0.0, 0.0),
    skew_load: ArrayLike = 1.0,
    dynamic_factor: float | None = None,
    sling_safety_factor: float | None = None,
    shackle_safety_factor: float | None = None,
    shackle_breaking_load: float | None = None,
    alpha: float = 1.0,
    sources: Mapping[str, str] | None = None,
) -> LiftFactors:
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

    Returns
    -------
    LiftFactors

    Raises
    ------
    SceneError
        For a load that is not there, a factor out of range, a source of something else.
    """
    what = f"lift factors of {text_of('lift factors: load', load)!r}"
    if load not in scene.bodies:
        known = ", ".join(map(repr, scene.bodies)) or "none"
        raise SceneError(f"{what}: there is no body {load!r}; add it first, the bodies are {known}")
    given = (weight_contingency, dynamic_factor, sling_safety_factor, shackle_safety_factor)
    for key, value in zip(AT_LEAST_ONE, given, strict=True):
        _factor(what, key, value)
    if shackle_breaking_load is not None:
        positive_of(f"{what}: shackle_breaking_load", shackle_breaking_load, "N")
    if not 0.0 < number_of(f"{what}: alpha", alpha) <= 1.0:
        raise SceneError(f"{what}: alpha is {alpha:g}; give operational over design Hs, above 0 to 1")
    skews = vector_of(f"{what}: skew_load", np.atleast_1d(np.asarray(skew_load, dtype=object)))
    for skew in skews:
        _factor(what, "skew_load", skew)
    x, y, z = np.abs(shaped_of(f"{what}: center_of_gravity", center_of_gravity, (3,))).tolist()
    if not all(map(math.isfinite, (x, y, z))):
        raise SceneError(f"{what}: center_of_gravity is {shown(center_of_gravity)}; give finite numbers, m")
    factors = LiftFactors(
        name=load, weight_contingency=weight_contingency, center_of_gravity=(x, y, z),
        skew_load=tuple(skews), dynamic_factor=dynamic_factor, sling_safety_factor=sling_safety_factor,
        shackle_safety_factor=shackle_safety_factor, shackle_breaking_load=shackle_breaking_load,
        alpha=float(alpha), sources=_sources(what, sources or {}),
    )  # fmt: skip
    added: LiftFactors = insert("lift factors", scene.lift_factors, factors)
    return added


def _factor(what: str, key: str, value: Any) -> None:
    if value is not None and not 1.0 <= number_of(f"{what}: {key}", value) <= LARGEST:
        raise SceneError(f"{what}: {key} is {value:g}; give a factor from 1 to {LARGEST:g}")


def _sources(what: str, given: Any) -> dict[str, str]:
    if not isinstance(given, Mapping):
        raise SceneError(f"{what}: sources are {shown(given)}; give texts by the names of factors")
    for key in given:
        if key not in NUMBERS:
            raise SceneError(f"{what}: sources has {shown(key)}; the factors are {', '.join(NUMBERS)}")
    return {key: text_of(f"{what}: source of {key}", value) for key, value in given.items()}
