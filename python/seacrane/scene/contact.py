"""add_contact(): points of a body that press and rub on the surface of another, or on the seabed."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import GROUND, Description
from seacrane.description.forces import add_load
from seacrane.description.welded import borne_mass
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, not_negative_of, positive_of, rows_of, shaped_of, text_of
from seacrane.inputs.frames import axes_along
from seacrane.inputs.shown import shown
from seacrane.warnings import SeabedWarning

Array = NDArray[np.float64]
SINKS = 0.01  # m, under its own weight
HOLD = 1e-3  # m
DAMPING = 1.0  # s/m
SEABED, BED_FRICTION = "seabed", 0.5
SURFACES = ("plane", "box", "post", "pipe")


def add_contact(
    scene: Description, body: str, *, points: Any, on: str, surface: str = "plane",
    place: Any = (0.0, 0.0, 0.0), axis: Any = (0.0, 0.0, 1.0), size: Any = None, edge: float | None = None,
    stiffness: float | None = None, damping: float = DAMPING, table: Any = None,
    friction: float | None = None, hold: float = HOLD, depth: float | None = None, name: str | None = None,
) -> _core.Contact:  # fmt: skip
    """Let points of a body touch the surface of another: they press, never pull, stick and slide.

    A point presses with stiffness p (1 + damping p') at a compression p. Friction sticks without creep: up to
    friction times that force a spring from an anchor on the surface holds the point, and only what slides
    moves the anchor. Each step ends where a point touches, lifts off, slides or sticks; these are events of
    kind "contact", "release", "slip" and "stick", named "<name>.1" and on. What friction takes is the
    state "<name>.friction_loss" (J), in the channel `load_state`.

    Parameters
    ----------
    body : str
        Whose points they are.
    points : array_like, shape (n, 3)
        Feet, corners or bumpers, m, coordinates of `body`; 15 at most.
    on : str
        Whose surface it is: another body, "ground", or "seabed", a level plane of the ground.
    surface : str
        "plane": all below it is inside; "box", "post" (a round bar), "pipe" (a round wall, hollow).
    place : array_like, shape (3,)
        A point of a plane, else the middle of the surface, m, coordinates of `on`.
    axis : array_like, shape (3,)
        Away from a plane, up in a box, along a post or a pipe; coordinates of `on`.
    size : array_like, optional
        m. Of a box its edges along x, y and `axis`; of a post its diameter and length; of a pipe its inner
        and outer diameter and its length. A plane has none.
    edge : float, optional
        Radius of its edges, m: 0.05, or half of its least thickness where that is less.
    stiffness : float, optional
        Of each point, N/m. Default: the weight of `body` and of what is welded to it by now, shared by its
        points, sinks by 1 cm.
    damping : float
        s/m. At a low speed v the point rebounds with about v (1 - 2/3 damping v).
    table : array_like, shape (n, 2), optional
        Compression (m) and elastic force (N) of each point, both from 0, in place of `stiffness`: a fender.
        Its last slope goes on.
    friction : float, optional
        Coefficient, of sticking and sliding; default: 0.5 on the seabed, else 0.
    hold : float
        m: what a point gives before it slides under its share of the weight.
    depth : float, optional
        m, of the seabed below z = 0.
    name : str, optional
        Default: "<body> on <on>".

    Returns
    -------
    Contact

    Raises
    ------
    SceneError
        For bodies that are not there, friction without stiffness, a wall thinner than its edges are round,
        bad numbers; with `Scene.compile`, for points that start deep inside.

    Warns
    -----
    SeabedWarning
        Of a seabed: it is no model of soil: nothing sinks in, sticks or flows.

    Notes
    -----
    Normal force: K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975). The spring of friction is
    friction N / hold with N the share of the weight, damped by half of what is critical with the share of the
    mass.
    """
    owner, other = text_of("contact: body", body), text_of("contact: on", on)
    label = name_of("contact", name, f"{owner} on {other}")
    what = f"contact {label!r}"
    at = shaped_of(f"{what}: place", place, (3,))
    bed = other == SEABED and SEABED not in scene.bodies
    if bed != (depth is not None):
        raise SceneError(
            f"{what}: on is {other!r} and depth {shown(depth)}; a seabed has a depth, m below z = 0"
        )
    if bed:
        if surface != "plane" or at.any():
            raise SceneError(f"{what}: surface or place is given; the seabed is a level plane at its depth")
        other, at = GROUND, np.array([0.0, 0.0, -positive_of(f"{what}: depth", depth, "m")])
    if friction is None:
        friction = BED_FRICTION if bed else 0.0
    for key in (owner, other):
        if key != GROUND and key not in scene.bodies:
            raise SceneError(f"{what}: there is no body {key!r}; add it first")
    if owner == other:
        raise SceneError(f"{what}: has body and on {other!r}; give two bodies, or one and 'ground'")
    rows = rows_of(f"{what}: points", points, 3)
    if not len(rows):
        raise SceneError(f"{what}: points is empty; give at least one")
    shape = text_of(f"{what}: surface", surface)
    extent = _extent(what, shape, size)
    share = borne_mass(scene, owner, other) / len(rows)
    weight = share * scene.gravity
    steps = None if table is None else rows_of(f"{what}: table", table, 2)
    mu, give = not_negative_of(f"{what}: friction", friction), positive_of(f"{what}: hold", hold, "m")
    k = _stiffness(what, stiffness, steps, weight, mu)
    shear = mu * (weight if weight > 0.0 else k * SINKS) / give
    element = _core.Contact(
        name=label, body=owner, on=other, points=rows, surface=shape,
        place=at, axes=axes_along(f"{what}: axis", axis), size=extent,
        edge=_edge(what, shape, extent, edge), stiffness=k,
        damping=not_negative_of(f"{what}: damping", damping, "s/m"),
        compressions=[] if steps is None else steps[:, 0], forces=[] if steps is None else steps[:, 1],
        friction=mu, shear_stiffness=shear, shear_damping=np.sqrt(shear * share), hold=give,
    )  # fmt: skip
    add_load(scene, element)
    if bed:
        warn_caller(
            f"{what}: the seabed is a plane with {element.stiffness:.3g} N/m at each point, and no model "
            "of soil: give a stiffness from the soil's own, and look at how the result depends on it",
            SeabedWarning,
        )
    return element


def _extent(what: str, surface: str, size: Any) -> Array:
    """The size as the core has it: of what is round, inner and outer diameter and length."""
    given = {"box": 3, "post": 2, "pipe": 3}.get(surface, 0)
    if surface not in SURFACES:
        raise SceneError(f"{what}: surface is {surface!r}; choose one of {', '.join(SURFACES)}")
    if given == 0:
        if size is not None:
            raise SceneError(f"{what}: a plane has no size; leave it out, or choose another surface")
        return np.zeros(3)
    if size is None:
        raise SceneError(f"{what}: a {surface} needs a size; give {given} lengths, m")
    lengths = shaped_of(f"{what}: size", size, (given,))
    return np.array([0.0, *lengths]) if surface == "post" else lengths


def _edge(what: str, surface: str, extent: Array, edge: float | None) -> float:
    if edge is not None:
        return positive_of(f"{what}: edge", edge, "m")
    wall = (extent[1] - extent[0]) / 2.0
    least = {"plane": 0.1, "box": min(extent), "post": min(extent[1:]), "pipe": min(wall, extent[2])}[surface]
    return float(min(0.05, 0.5 * least)) if least > 0.0 else 0.05


def _stiffness(what: str, given: float | None, steps: Array | None, weight: float, friction: float) -> float:
    if given is not None and steps is not None:
        raise SceneError(f"{what}: has a stiffness and a table; give one of them")
    if given is not None:
        if friction > 0.0 and given == 0.0:
            raise SceneError(
                f"{what}: has friction {friction:g} and a stiffness of 0 N/m: nothing presses; give a "
                "stiffness"
            )
        return positive_of(f"{what}: stiffness", given, "N/m")
    if steps is not None and len(steps) > 1 and steps[1, 0] > 0.0 and steps[1, 1] > 0.0:
        return float(steps[1, 1] / steps[1, 0])
    if not weight > 0.0:
        raise SceneError(f"{what}: nothing has weight, from which a stiffness could follow; give one, N/m")
    return weight / SINKS
