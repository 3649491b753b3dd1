"""Vessels of a scene: hulls that float, ships whose motion is given, hydrodynamics by matrices."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, overload

import numpy as np

from seacrane.description.description import Description
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase, HydroGroup
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.scene.afloat import MOORING_DAMPING, MOORING_PERIOD, add_hull, add_hulls, add_hydrodynamics
from seacrane.scene.given_vessel import DURATION, RAMP, add_given
from seacrane.scene.motion_history import MotionHistory

Vessels = tuple[VesselHydrodynamics, ...]


@overload
def add_vessel(
    scene: Description, what: HydroDatabase, *, name: str = "vessel", position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0, memory: str = "by-motion", kinematics: str = "yaw_following",
    mooring: Any = None, mooring_period: float | None = MOORING_PERIOD,
    mooring_damping: float = MOORING_DAMPING, slack_moment: float | tuple[float, float] = 0.0,
) -> VesselHydrodynamics: ...  # fmt: skip


@overload
def add_vessel(
    scene: Description, what: HydroGroup, *, names: Sequence[str] | None = None,
    position: Any = (0.0, 0.0, 0.0), heading_deg: float = 0.0, memory: str = "joint",
    mooring_period: float | None = MOORING_PERIOD, mooring_damping: float = MOORING_DAMPING,
) -> Vessels: ...  # fmt: skip


@overload
def add_vessel(
    scene: Description, *, motion: HydroDatabase | MotionRaos | MotionHistory | str, name: str = "vessel",
    position: Any = (0.0, 0.0, 0.0), heading_deg: float = 0.0, ramp: float = RAMP, duration: float = DURATION,
    size: Any = None,
) -> VesselHydrodynamics: ...  # fmt: skip


@overload
def add_vessel(
    scene: Description, what: HydroDatabase | None = None, *, body: str, name: str | None = None,
    **hydrodynamics: Any,
) -> VesselHydrodynamics: ...  # fmt: skip


def add_vessel(
    scene: Description,
    what: HydroDatabase | HydroGroup | None = None,
    *,
    motion: Any = None,
    body: str | None = None,
    **keywords: Any,
) -> VesselHydrodynamics | Vessels:
    """Add a vessel: a hull that floats, several in one water, one whose motion is given, or by matrices.

    From a database it floats upright, and its body frame has its origin at the database's reference point.
    From a group each hull is such a body, and `add_sea` puts each into the sea by its name, with the wave
    loads beside the others. What hulls do to each other is `scene.groups[group.name]`: added masses and one
    fluid memory of all their motions, in axes that follow the yaw of each. It holds as long as they keep
    their places and headings to each other; a run that leaves them warns.

    A ship whose motion is given carries a crane as others do, but nothing acts back on it. Its body is a
    light stand-in (1 kg, without weight), led by six drivers "<name>.motion.x" to "<name>.motion.yaw": their
    `driver_force` is the load of all that is on board. `vessel_motion` records it.

    Parameters
    ----------
    what : HydroDatabase or HydroGroup
        Hydrodynamics of the hull, or of several, without the bodies that the scene models itself. The scene
        keeps it: what needs it later, as `add_sea`, takes it from `scene.vessels[name].database`. With `body`
        and matrices: the database whose wave loads act on that body.
    motion : HydroDatabase, MotionRaos, MotionHistory or "rest"
        In its place: a motion that is given. HydroDatabase: its own displacement RAOs where its file holds
        them, else those of its linear model. With RAOs the ship rests until `Scene.add_sea` gives it the sea
        to move in; the scene keeps them, in `scene.vessels[name].database`. "rest": it never moves.
    body : str
        The body, about whose origin matrices are.
    name : str
        Of the vessel and its body, "vessel" by default; of matrices by default the body's.
    names : sequence of str, optional
        Of a group's vessels, in the order of its bodies; default: their names there.
    position : array_like, shape (3,)
        Of the reference point, or of the group's origin, at the start, m, inertial frame. A mooring has no
        load at this x and y; what floats rests at z = 0, and heaves from another z.
    heading_deg : float
        At the start, of the hull's or the group's x axis, deg from +x towards +y; default 0.
    memory : str, or list of StateSpaceBlock, or RetardationFunctions
        With a database, "by-motion" (default): fluid memory as one passive state-space model per group of
        coupled motions, the smallest that leaves the motions within 1 % of the database's own. "per-pair":
        the paper's, one model per pair of motions, eqs (28)-(31), judged by R2. "convolution": the reference,
        without a fit: the database's retardation functions convolved with the history of the motion, see
        `seacrane.hydro.retardation_functions`; the steps land on its samples. "none": without radiation
        damping, as the paper does for comparison. The database's own fitted memory is used where it is of the
        kind asked for; else one is fitted here, once for each database. Of a group: "joint" (default), one
        passive model of all motions, or "none". With matrices: the models themselves.
    kinematics : str
        Of one hull: "yaw_following" (default) or "paper", eqs (17)-(31).
    mooring : float, array_like of shape (6, 6), or list of MooringSpring, optional
        Of one hull, in place of `mooring_period`: a natural period (s); or a stiffness matrix about the
        reference point, vessel's axes, N/m to N m/rad; or horizontal springs. It holds the pose of the start.
        Default: by `mooring_period`, or the stiffness of surge, sway and yaw that the database's own
        restoring holds, with an `OwnMooringWarning`.
    mooring_period : float or None
        Natural period (s) of soft linear station keeping of each hull in surge, sway and yaw; default 200 s;
        None: no mooring.
    mooring_damping : float
        Its damping as a fraction of critical; default 0.1. With matrices: (3,), N s/m and N m s/rad.
    slack_moment : float or (float, float)
        Of one hull, or of matrices: free-surface moment of slack tanks, kg m, the density of what is in a
        tank times the second moment of its surface about the longitudinal axis, l b^3 / 12 of a rectangle;
        and about the transverse one. C44 (C55) becomes less by g times it, and GM by it over the
        displacement: `statics` tells GM with and without. No weight is added. 1 t m is 1000.
    ramp : float
        s, over which a given motion grows from rest to its full size; default 20 s, 0: full from the start,
        where all that is on board must be described.
    duration : float
        s, for which the motion by RAOs is described; default 600 s. A longer run is refused.
    size : array_like, shape (3,)
        Length, breadth and draught of the hull that pictures show of a given motion, m; default: the
        database's, else 100 x 20 x 5 m.
    added_mass, linear_damping, quadratic_damping, restoring, mooring_stiffness
        Matrices: see `seacrane.hydro.VesselHydrodynamics`.
    floats : bool
        Of matrices: whether the restoring carries the body's weight, as that of a ship does; else it weighs
        as any body, and its buoyancy is a point force of yours. Default: whether heave is restored.

    Returns
    -------
    VesselHydrodynamics, or a tuple of them in the order of a group's names

    Raises
    ------
    SceneError
        For a keyword of another kind of vessel, a memory model that this version does not have, a place or
        heading that is no finite number, matrices of another shape, a mooring that no springs have, or a
        second one beside the database's own; of a group, another number of names, or a hull whose reference
        point is not on the still water.

    Warns
    -----
    WaterMismatchWarning
        The scene's gravity is not the database's; `vessel_parameters` has warnings of its own.
    OwnMooringWarning
        The database's own mooring is used.
    AngleUnitWarning, CompassDirectionWarning
        A heading that looks like radians, or like a compass bearing.
    """
    if motion is not None:
        if what is not None or body is not None:
            raise SceneError("vessel: has a motion and a hull or body; what a motion leads takes neither")
        return named(add_given, "add_vessel(motion=)", owners=1)(scene, motion, **keywords)
    if body is not None and (what is None or (isinstance(what, HydroDatabase) and {*keywords} - {"name"})):
        return add_hydrodynamics(scene, body=body, database=what, **_buoyant(keywords))
    if body is not None:
        raise SceneError(f"vessel: body {body!r} is given beside a database, which brings its own; use name=")
    if isinstance(what, HydroGroup):
        return named(add_hulls, "add_vessel of a HydroGroup", owners=1)(scene, what, **keywords)
    if isinstance(what, HydroDatabase):
        return named(add_hull, "add_vessel of a HydroDatabase", owners=1)(scene, what, **keywords)
    raise SceneError(
        f"vessel: is {shown(what)}; give a HydroDatabase or a HydroGroup, as load_database reads, motion= of "
        "a ship that is led, or body= and its matrices"
    )


def _buoyant(hydrodynamics: dict[str, Any]) -> dict[str, Any]:
    """With `floats`: what nothing brings back in heave does not float, it only has water about it."""
    restoring = np.asarray(hydrodynamics.get("restoring", 0.0))
    held = restoring.shape == (6, 6) and bool(restoring[2, 2] > 0.0)
    return {"floats": held} | hydrodynamics
