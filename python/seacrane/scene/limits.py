"""What holds one way only: wires that go slack, end stops, seats that are lifted off; and dry friction.

A limit either holds, and is then a constraint with a reaction, or is open. Which ones hold changes at events,
located in time by the integrator; see docs/events.md.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from seacrane import _core
from seacrane.description.description import GROUND, Description, coordinate_of
from seacrane.description.forces import add_load
from seacrane.description.places import place_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, text_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import taken

CLOSE = 1e-6  # m
STICKING_SPEED = 1e-3  # m/s or rad/s


def _limit(
    scene: Description, kind: str, joint: str, name: str | None, *, coordinate: str = "", **values: float
) -> _core.Limit:
    if text_of(f"{kind}: joint", joint) not in scene.joints:
        raise SceneError(f"{kind}: there is no joint {joint!r}; add it first")
    name = name_of(kind, name or joint)
    numbers = {key: number_of(f"{kind} {name!r}: {key}", value) for key, value in values.items()}
    limit = _core.Limit(name=name, kind=kind, joint=joint, coordinate=coordinate, **numbers)
    added: _core.Limit = add_load(scene, limit)
    return added


def add_wire(
    scene: Description, joint: str, restitution: float, sticking_speed: float, name: str | None
) -> _core.Limit:
    """Let a distance joint pull only: it goes slack when its tension would turn negative, and snatches.

    Slack, its ends move freely within its length. Stretched again, an impact keeps momentum, in the mass
    metric, over all joints: M (v+ - v-) = D^T Lambda; the rate of its length turns to -restitution times what
    it was. It starts slack if its points are described closer than its length, by more than 1e-6 of it, or
    approach each other.
    """
    return _limit(scene, "wire", joint, name, restitution=restitution, sticking_speed=sticking_speed)


LAWS: Mapping[str, tuple[str, ...]] = {
    "stop": ("coordinate", "minimum", "maximum", "restitution", "sticking_speed"),
    "soft stop": ("coordinate", "minimum", "maximum", "stiffness", "damping"),
    "seat": (),
}


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
    sticking_speed : float
        m/s or rad/s; slower impacts do not rebound, so that rebounds come to an end; default 1e-3.
    stiffness : float
        N/m or N m/rad; default: rigid.
    damping : float
        s/m or s/rad, with a stiffness; default 0.
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
    added: _core.SoftStop = add_load(scene, _core.SoftStop(name=name, joint=joint, **given))
    return added


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


def add_friction(
    scene: Description,
    joint: str,
    *,
    load: float,
    speed: float,
    coordinate: str | None = None,
    name: str | None = None,
) -> _core.Friction:
    """Add dry friction on a joint coordinate: -load tanh(rate / speed).

    Coulomb friction, made smooth: within 1e-4 of it where the coordinate is faster than 5 times `speed`. It
    does not stick: under a steady F below `load` the coordinate creeps at speed atanh(F / load). A slower
    `speed` creeps less and makes the equations stiffer, by load / speed.

    Parameters
    ----------
    joint, coordinate
        As `add_stop`.
    load : float
        N or N m.
    speed : float
        m/s or rad/s.
    name : str, optional
        Default: the joint's, and "friction".

    Raises
    ------
    SceneError
    """
    where = coordinate_of(scene, "friction", joint, coordinate)
    name = name_of("friction", name or f"{joint} friction")
    friction = _core.Friction(name=name, joint=joint, coordinate=where, load=load, speed=speed)
    added: _core.Friction = add_load(scene, friction)
    return added
