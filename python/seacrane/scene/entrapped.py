"""add_entrapped_water(): water that comes into a compartment of a body, and leaves it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.forces import add_load
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of, name_of, not_negative_of, positive_of, shaped_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.water.density import SEA_WATER, density_of
from seacrane.water.openings import Opening

LARGEST_LEAN = np.radians(60.0)
ATMOSPHERE = 101325.0  # Pa
AIR = ("free", "vented", "shut")
IN_LID = 1e-9  # of the height, as in the engine


def add_entrapped_water(
    scene: Description, body: str, *, area: float, height: float,
    openings: Sequence[Opening | Mapping[str, Any]], point: Any = (0.0, 0.0, 0.0),
    air: str | None = None, exponent: float | None = None, air_pressure: float = ATMOSPHERE,
    discharge_coefficient: float = 0.6, initial: float = 0.0, density: float = SEA_WATER,
    wave_factor: float = 1.0, name: str | None = None,
) -> _core.EntrappedWater:  # fmt: skip
    """Let water come into a compartment of a body, and leave it, through openings.

    The compartment is a prism that stands on `point` along the body's z axis: a suction anchor, a tube, a
    bucket. The volume of its water is the state "<name>.volume" (m3), what is lost in the openings
    "<name>.flow_loss" (J), air that is shut in "<name>.air" (m3 at 101,325 Pa), in the channel `load_state`.
    It is full at the event
    "<name>.full", empty at "<name>.empty"; at "<name>.leans" its axis is 30 deg from vertical.

    Parameters
    ----------
    body : str
        Name of the body. Its mass and weight are without the water.
    area : float
        m2, of its section.
    height : float
        m, from its bottom to its top.
    openings : sequence
        `seacrane.water.Opening`, or tables {"point": ..., "area": ...}; 12 at most.
    point : array_like, shape (3,)
        Centre of its bottom, m, body coordinates.
    air : str, optional
        Above the water: "vented", which comes and goes by the openings alone, against their resistance;
        "free", against none; or "shut", whose mass stays while no opening lets air through, and which expands
        and is compressed. Default: "vented" with an opening in the lid; without one, it is asked for.
    exponent : float, optional
        Of air that is shut in, p V^exponent stays: 1 (slow) to 1.4 (quick).
    air_pressure : float
        Pa, absolute, of air that is shut in, at the start.
    discharge_coefficient : float
        C_d of the openings, above 0 to 1: 0.6 of a sharp edge.
    initial : float
        m3 of water in it at the start.
    density : float
        kg/m3, of the water.
    wave_factor : float
        By which the waves of the sea are multiplied at the openings, as of `add_immersed`.
    name : str, optional
        Default: "water in <body>".

    Returns
    -------
    EntrappedWater

    Raises
    ------
    SceneError
        For a body that is not there or leans by more than 60 deg as described, openings outside the
        compartment, more water than it holds, bad numbers, and a density that is in t/m3; when the scene is
        compiled, for no opening in its lid and no word on its air, and outside its body's parts.

    Notes
    -----
    V' = sum of C_d A_o sign(dh) sqrt(2 g |dh|), with dh the head of the undisturbed sea over an opening less
    that of the water inside, each zero where the opening is above it, less that of the air. The root is
    rounded off over a head of 1 mm. The water is a mass with the body, a rod along the axis up to its
    surface; along the axis only what the bottom less its openings carries, and the lid once it is full. So
    is its weight. What comes in takes -density V' (v - u); what leaves keeps its velocity. The outer shape's
    buoyancy is that of `add_immersed`, with fill=1 for a compartment.
    """
    owner = name_of("entrapped water", body)
    label = name_of("entrapped water", name, f"water in {owner}")
    what = f"entrapped water {label!r}"
    if owner not in scene.bodies:
        raise SceneError(f"{what}: there is no body {owner!r}; add it first")
    holes = _openings(what, openings)
    bottom, tall = shaped_of(f"{what}: point", point, (3,)), positive_of(f"{what}: height", height, "m")
    kept = _air(what, air, [np.asarray(hole.point, dtype=float)[2] - bottom[2] for hole in holes], tall)
    element = _core.EntrappedWater(
        name=label, body=owner, point=bottom, air=kept, exponent=_exponent(what, kept, exponent),
        area=positive_of(f"{what}: area", area, "m2"), height=tall,
        opening_points=np.array([np.asarray(hole.point, dtype=float) for hole in holes]),
        opening_areas=[float(hole.area) for hole in holes],
        air_pressure=not_negative_of(f"{what}: air_pressure", air_pressure, "Pa"),
        discharge_coefficient=finite_of(f"{what}: discharge_coefficient", discharge_coefficient),
        initial=not_negative_of(f"{what}: initial", initial, "m3"), density=density_of(what, density),
        wave_factor=not_negative_of(f"{what}: wave_factor", wave_factor),
    )  # fmt: skip
    _check_upright(what, scene.bodies[owner])
    add_load(scene, element)
    return element


def _openings(what: str, given: Any) -> list[Opening]:
    if isinstance(given, Mapping | str) or not isinstance(given, Sequence) or not given:
        raise SceneError(f"{what}: openings is {shown(given)}; give a list of seacrane.water.Opening")
    return [_opening(what, one) for one in given]


def _opening(what: str, given: Any) -> Opening:
    if isinstance(given, Opening):
        return given
    if not isinstance(given, Mapping):
        raise SceneError(f"{what}: openings holds {shown(given)}; give seacrane.water.Opening")
    try:
        return Opening(**given)
    except TypeError as error:
        raise SceneError(f"{what}: {error}") from None


def _air(what: str, given: str | None, heights: list[float], top: float) -> str:
    """As told; an opening in the lid tells it too."""
    if given is None:  # "" is asked for when the scene is compiled
        return "vented" if max(heights) > (1.0 - IN_LID) * top else ""
    if given not in AIR:
        raise SceneError(f"{what}: air is {shown(given)}; give one of {', '.join(AIR)}")
    return given


def _exponent(what: str, air: str, given: float | None) -> float:
    if (air == "shut") == (given is None):
        asked = "give exponent, 1 (slow) to 1.4 (quick)" if given is None else "leave exponent out"
        raise SceneError(f"{what}: air is {air!r}, and exponent is {shown(given)}; {asked}")
    return 0.0 if given is None else finite_of(f"{what}: exponent", given)


def _check_upright(what: str, body: _core.Body) -> None:
    """Refuse a compartment that lies: one whose height is along another axis of the body."""
    lean = float(np.arccos(np.clip(rotation_matrix(body.quaternion)[2, 2], -1.0, 1.0)))
    if lean > LARGEST_LEAN:
        raise SceneError(
            f"{what}: its axis, z of the body, leans by {np.degrees(lean):.3g} deg as described, and levels "
            f"are right up to {np.degrees(LARGEST_LEAN):.3g} deg; turn the body's axes so that z is upright"
        )
