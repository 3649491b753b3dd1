"""What holds one way only: wires that go slack, end stops, seats that lift off, contacts; and dry friction.

A limit either holds, and is then a constraint with a reaction, or is open. Which ones hold changes at events,
located in time by the integrator; see docs/events.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import GROUND, Description, coordinate_of, require
from seacrane.description.elements import put_load
from seacrane.description.given import borne_mass
from seacrane.description.places import place_of
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, not_negative_of, positive_of, rows_of, shaped_of, text_of
from seacrane.inputs.frames import axes_along, rotation_matrix
from seacrane.inputs.keywords import taken
from seacrane.inputs.shown import shown
from seacrane.inputs.values import told_by
from seacrane.warnings import SeabedWarning

CLOSE = 1e-6  # m
STICKING_SPEED = 1e-3  # m/s or rad/s
LAWS: Mapping[str, tuple[str, ...]] = {
    "stop": ("coordinate", "minimum", "maximum", "restitution", "sticking_speed"),
    "soft stop": ("coordinate", "minimum", "maximum", "stiffness", "damping"),
    "seat": (),
}
SINKS = 0.01  # m, under its own weight
HOLD = 1e-3  # m
DAMPING = 1.0  # s/m
SEABED, BED_FRICTION = "seabed", 0.5
SURFACES = ("plane", "box", "post", "pipe")


def _limit(
    scene: Description, kind: str, joint: str, name: str | None, *, coordinate: str = "", **values: float
) -> _core.Limit:
    require(scene, kind, "joint", joint, "joints")
    name = name_of(kind, name or joint)
    return put_load(scene, _core.Limit(name=name, kind=kind, joint=joint, coordinate=coordinate, **values))


def add_wire(
    scene: Description, joint: str, restitution: float, sticking_speed: float, name: str | None
) -> _core.Limit:
    """Let a distance joint pull only: it goes slack where its tension would turn negative, and snatches."""
    return _limit(scene, "wire", joint, name, restitution=restitution, sticking_speed=sticking_speed)


@told_by(_core.Limit, _core.SoftStop)
def add_stop(
    scene: Description, joint: str, *, coordinate: str | None = None, minimum: float | None = None,
    maximum: float | None = None, restitution: float | None = None, sticking_speed: float | None = None,
    stiffness: float | None = None, damping: float | None = None, name: str | None = None,
) -> _core.Limit | _core.SoftStop:  # fmt: skip
    """Keep a joint coordinate within bounds, rigid ones or such that give; on a weld: a seat that lets go.

    A rigid bound that is hit is an impact, as of a rigid line (`add_line`). It holds, as a constraint, while
    it has to push, and lets go when it would have to pull.

    With a stiffness, a bound pushes by stiffness p (1 + damping p') at a depth p beyond it, never a pull: a
    load, without events, for any formulation, with steps as short as the stiffness asks for. Damping of this
    form (K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42, 1975) leaves the load continuous when the bound is
    touched; hit at a low speed v it returns about v (1 - 2/3 damping v).

    A weld from a support to what stands on it, its axis z pointing away from the support, holds only while
    the second body is pressed onto the first: where the force on it along z would be negative, the joint
    opens and stays open. Sliding and tipping before that are not modelled. To hit the deck again after
    lift-off, or to set the body down, add a free joint with a stop.

    Parameters
    ----------
    coordinate : str, optional
        Of the joint; default "angle" of a revolute, else "displacement". "z" of a free joint is a deck that
        its second body stands on, without friction, at the joint's point.
    minimum, maximum : float
        m or rad; leave out the one that is not there. A rigid angle needs both, between -pi and pi.
    restitution : float
        0 (default: it stays at the bound) to 1 (no energy is lost).
    name : str, optional
        Default: the joint's; with a stiffness the joint's, and "soft stop".

    Raises
    ------
    SceneError
        For a joint that is not there, a number that such a stop does not take, and a body with a size whose
        centre is described below the plane of its seat. What only the whole scene shows, such as a start
        beyond a bound or a driver on the same coordinate, comes with `Scene.compile`.
    """
    where = coordinate_of(scene, "stop", joint, coordinate)
    weld = scene.joints[joint].kind == "weld"
    law = "seat" if weld else "stop" if stiffness is None else "soft stop"
    given = taken(
        f"stop of joint {joint!r}", law, LAWS[law],
        coordinate=coordinate, minimum=minimum, maximum=maximum, restitution=restitution,
        sticking_speed=sticking_speed, stiffness=stiffness, damping=damping,
    )  # fmt: skip
    if law == "seat":
        _require_above(scene, scene.joints[joint])
        return _limit(scene, law, joint, name)
    given |= {"coordinate": where}
    if law == "stop":
        return _limit(scene, law, joint, name, **{"sticking_speed": STICKING_SPEED} | given)
    name = name_of(law, name or f"{joint} {law}")
    return put_load(scene, _core.SoftStop(name=name, joint=joint, **given))


def _require_above(scene: Description, joint: _core.Joint) -> None:
    """SceneError for a box that is described inside its support, or below it."""
    body = scene.bodies.get(joint.second)
    if body is None or not np.any(body.size) or (joint.first != GROUND and joint.first not in scene.bodies):
        return
    turn = np.eye(3) if joint.first == GROUND else rotation_matrix(scene.bodies[joint.first].quaternion)
    normal = turn @ np.asarray(joint.first_frame.axes)[:, 2]
    plane = place_of(scene, body=joint.first, point=joint.first_frame.point)
    own = rotation_matrix(body.quaternion)
    height = float(normal @ (body.position + own @ np.asarray(body.center_of_mass) - plane))
    half = 0.5 * float(np.abs(normal @ own) @ np.asarray(body.size))
    if height < -CLOSE:
        which = "below" if height <= -half else "inside"
        raise SceneError(
            f"seat on joint {joint.name!r}: body {body.name!r} is described {which} {joint.first!r}, its "
            f"centre {-height:.4g} m below the plane that it stands on; raise it by {half - height:.4g} m, "
            "or turn the joint's axis away from the support"
        )


@told_by(_core.Friction)
def add_friction(
    scene: Description, joint: str, *, load: float, speed: float, coordinate: str | None = None,
    name: str | None = None,
) -> _core.Friction:  # fmt: skip
    """Add dry friction on a joint coordinate: -load tanh(rate / speed).

    Coulomb friction, made smooth: within 1e-4 of it where the coordinate is faster than 5 times `speed`. It
    does not stick: under a steady F below `load` the coordinate creeps at speed atanh(F / load). A slower
    `speed` creeps less and makes the equations stiffer, by load / speed.

    Parameters
    ----------
    name : str, optional
        Default: the joint's, and "friction".

    Raises
    ------
    SceneError
    """
    where = coordinate_of(scene, "friction", joint, coordinate)
    name = name_of("friction", name or f"{joint} friction")
    friction = _core.Friction(name=name, joint=joint, coordinate=where, load=load, speed=speed)
    return put_load(scene, friction)


@told_by(_core.Contact)
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
    points : array_like, shape (n, 3)
        Feet, corners or bumpers, m, coordinates of `body`; 64 at most.
    on : str
        Whose surface it is: another body, "ground", or "seabed", a level plane of the ground.
    surface : str
        "plane": all below it is inside; "box", "post" (a round bar), "pipe" (a round wall, hollow).
    axis : array_like, shape (3,)
        Away from a plane, up in a box, along a post or a pipe; coordinates of `on`.
    size : array_like, optional
        m. Of a box its edges along x, y and `axis`; of a post its diameter and length; of a pipe its inner
        and outer diameter and its length. A plane has none.
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
        raise SceneError.of(
            f"{what}: on", f"is {other!r} and depth {shown(depth)}; a seabed has a depth, m below z = 0"
        )
    if bed:
        if surface != "plane" or at.any():
            raise SceneError(f"{what}: surface or place is given; the seabed is a level plane at its depth")
        other, at = GROUND, np.array([0.0, 0.0, -positive_of(f"{what}: depth", depth, "m")])
    if friction is None:
        friction = BED_FRICTION if bed else 0.0
    require(scene, what, "body", owner, ground=True)
    require(scene, what, "on", other, ground=True)
    if owner == other:
        raise SceneError(f"{what}: has body and on {other!r}; give two bodies, or one and 'ground'")
    rows = rows_of(f"{what}: points", points, 3)
    if not len(rows):
        raise SceneError.of(f"{what}: points", "is empty; give at least one")
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
        edge=_edge(what, shape, extent, edge), stiffness=k, damping=damping,
        compressions=[] if steps is None else steps[:, 0], forces=[] if steps is None else steps[:, 1],
        friction=mu, shear_stiffness=shear, shear_damping=np.sqrt(shear * share), hold=give,
    )  # fmt: skip
    put_load(scene, element)
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
        raise SceneError.of(f"{what}: surface", f"is {surface!r}; choose one of {', '.join(SURFACES)}")
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
        raise SceneError.of(
            f"{what}: nothing", "has weight, from which a stiffness could follow; give one, N/m"
        )
    return weight / SINKS
