"""Vessels of a scene: hulls that float, ships whose motion is given, hydrodynamics by matrices."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.inverse import SIX, hold_vessel
from seacrane.analysis.linear_system import linear_model
from seacrane.arrays import Array, Complex
from seacrane.description.curves import curves_of_sum
from seacrane.description.databases import source_of
from seacrane.description.description import Description
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import Source, VesselHydrodynamics
from seacrane.description.waves import HullLoads, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase, HydroGroup
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, not_negative_of, positive_of, shaped_of
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.scene.afloat import MOORING_DAMPING, add_hull, add_hulls, add_hydrodynamics
from seacrane.scene.bodies import add_body
from seacrane.scene.mooring import USUAL
from seacrane.scene.motion_history import MotionHistory
from seacrane.warnings import OutsideRaosWarning

LIGHT = 1.0  # kg and kg m2 of the body that stands for the ship: what drives it carries what is on board
RAMP = 20.0  # s
DURATION = 600.0  # s
MOST_OUTSIDE = 0.02  # of the energy of the waves
AT_ONCE = 4096  # components whose transfer is interpolated together, to bound the memory it takes
Vessels = tuple[VesselHydrodynamics, ...]


@overload
def add_vessel(
    scene: Description, what: HydroDatabase, *, name: str = "vessel", position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0, memory: str = "by-motion", kinematics: str = "yaw_following",
    mooring: Any = USUAL, mooring_damping: float = MOORING_DAMPING,
    slack_moment: float | tuple[float, float] = 0.0,
) -> VesselHydrodynamics: ...  # fmt: skip


@overload
def add_vessel(
    scene: Description, what: HydroGroup, *, names: Sequence[str] | None = None,
    position: Any = (0.0, 0.0, 0.0), heading_deg: float = 0.0, memory: str = "joint",
    mooring: float | None = USUAL, mooring_damping: float = MOORING_DAMPING,
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
        With a database, "by-motion" (default): one passive state-space model per group of coupled motions,
        the smallest that leaves the motions within 1 % of the database's own. "per-pair": the paper's, eqs
        (28)-(31), judged by R2. "convolution": the reference, `seacrane.hydro.retardation_functions` with the
        history of the motion; the steps land on its samples. "none": without radiation damping. The
        database's own memory is used where it is of that kind; else one is fitted here, once for each. Of a
        group: "joint" (default), one passive model of all motions, or "none". With matrices: the models.
    kinematics : str
        Of one hull: "yaw_following" (default) or "paper", eqs (17)-(31).
    mooring : float, array_like of shape (6, 6), list of MooringSpring, or None
        Of each hull: natural period (s) of soft linear station keeping in surge, sway and yaw; default 200 s.
        Of one hull also a stiffness matrix about the reference point, vessel's axes, N/m to N m/rad, or
        horizontal springs; it holds the pose of the start. None: no mooring. The stiffness that the
        database's own restoring holds takes its place, with an `OwnMooringWarning`.
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
        restoring = np.asarray(keywords.get("restoring", 0.0))
        held = restoring.shape == (6, 6) and bool(
            restoring[2, 2] > 0.0
        )  # in heave, or it only has water about it
        return add_hydrodynamics(scene, body=body, database=what, **{"floats": held} | keywords)
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


def add_given(
    scene: Description, motion: Any, *, name: str = "vessel", position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0, ramp: float = RAMP, duration: float = DURATION, size: Any = None,
) -> VesselHydrodynamics:  # fmt: skip
    """A ship whose motion is given, as `Scene.add_vessel` describes it."""
    what = f"vessel {name_of('vessel', name)!r}"
    history = motion if isinstance(motion, MotionHistory) else None
    source = motion if isinstance(motion, Source) else None
    kind = "raos" if source is not None else "rest" if history is None else "history"
    if kind == "rest" and not (isinstance(motion, str) and motion == kind):
        raise SceneError.of(
            f"{what}: motion",
            f"is {shown(motion)}; give a HydroDatabase or MotionRaos, a MotionHistory, or 'rest'",
        )
    grown = not_negative_of(f"{what}: ramp", ramp, "s")
    lasting = positive_of(f"{what}: duration", duration, "s")
    outline = _size_of(what, motion, size)
    place = shaped_of(f"{what}: position", position, (3,))
    heading = direction_of(f"{what}: heading_deg", heading_deg)
    if not np.isfinite([*place, heading]).all():
        raise SceneError(f"{what}: stands at {place.tolist()} m, {heading} deg; give finite numbers")
    half = 0.5 * np.radians(heading)
    add_body(
        scene, name=name, mass=LIGHT, inertia=(LIGHT, LIGHT, LIGHT), position=place,
        quaternion=(np.cos(half), 0.0, 0.0, np.sin(half)),
    )  # fmt: skip
    added = add_hydrodynamics(scene, body=name, database=source)
    still = _core.Curve.constant(value=0.0)
    curves = (still,) * 6 if history is None else history.curves(grown)
    hold_vessel(scene, name, dict(zip(SIX, curves, strict=True)))
    if history is not None:
        lasting = float(history.time[-1])
    scene.provenance[name] = VesselProvenance(
        database=motion.name if isinstance(motion, HydroDatabase) else None, motion=kind,
        ramp=None if kind == "rest" else grown, duration=None if kind == "rest" else lasting, size=outline,
        record=None if history is None else history.record or None,
    )  # fmt: skip
    return added


def put_into_sea(
    scene: Description, waves: Waves, *, vessel: str, place: tuple[float, float], heading: float,
) -> Waves:  # fmt: skip
    """The sea with a given ship in it, which it does not load; one that follows RAOs is set moving."""
    known, source = scene.provenance[vessel], source_of(scene, vessel)
    if known.motion == "raos":
        if source is None:
            raise SceneError(
                f"sea: vessel {vessel!r} has no RAOs; give it those that it was added with: "
                f"scene.replace({vessel!r}, kind='vessel', database=raos)"
            )
        amplitude = motion_of_components(source, waves, place=place, heading=heading, gravity=scene.gravity)
        curves = curves_of_sum(
            np.asarray(waves.omega, dtype=float), amplitude, ramp=known.ramp or 0.0,
            duration=known.duration or DURATION,
        )  # fmt: skip
        for motion, curve in zip(SIX, curves, strict=True):
            driver = scene.drivers[f"{vessel}.motion.{motion}"]
            scene.drivers[driver.name] = _core.Driver(
                name=driver.name, joint=driver.joint, coordinate=driver.coordinate, curve=curve
            )
    unloaded = HullLoads(
        transfer=np.zeros((np.size(waves.omega), 6), dtype=complex), position=place, heading=heading
    )
    return replace(waves, hulls={**waves.hulls, vessel: unloaded})


def _size_of(what: str, motion: Any, size: Any) -> tuple[float, float, float] | None:
    if size is None and isinstance(motion, HydroDatabase):
        return motion.length, motion.breadth, motion.draught
    if size is None:
        return None
    length, breadth, draught = (float(one) for one in shaped_of(f"{what}: size", size, (3,)))
    if not (np.isfinite([length, breadth, draught]).all() and min(length, breadth, draught) > 0.0):
        raise SceneError.of(
            f"{what}: size", f"is {shown(size)}; give positive length, breadth and draught, m"
        )
    return length, breadth, draught


def motion_of_components(
    source: HydroDatabase | MotionRaos, waves: Waves, *, place: tuple[float, float], heading: float,
    gravity: float,
) -> Complex:  # fmt: skip
    """Complex amplitude (n, 6) of the motion in each component: m and rad, sum Re of them exp(i omega t).

    In axes of the ship at rest, at a place (x, y), m, and a heading, rad. A database without motions of its
    own has those of the linear model of the ship alone, floating as `Scene.add_vessel` describes it.
    """
    sea = waves.components()
    omega, direction = np.array(sea.omega), np.array(sea.direction)
    along = np.cos(direction) * place[0] + np.sin(direction) * place[1]
    wave = np.array(sea.amplitude) * np.exp(1j * (np.array(sea.phase) - np.array(sea.wavenumber) * along))
    if isinstance(source, HydroDatabase):
        if source.motion_rao is None:
            motion = linear_motion(source, omega, direction - heading, gravity=gravity)
            return np.asarray(wave[:, None] * motion)
        if source.speed != 0.0:
            raise SceneError(
                f"database {source.name!r}: its motions are those at {source.speed:g} m/s, and a given ship "
                "keeps its place; give one of zero speed"
            )
        source = MotionRaos(
            omega=source.omega, heading=source.heading, values=source.motion_rao, depth=source.depth,
            symmetric=source.port_starboard_symmetric, name=source.name, g=source.g,
        )  # fmt: skip
    _warn_of_outside(source, omega, np.array(sea.amplitude))
    return np.asarray(wave[:, None] * source.at(omega, direction - heading))


def linear_motion(database: HydroDatabase, omega: Array, heading: Array, *, gravity: float) -> Complex:
    """Motions (n, 6) per metre of wave of a ship alone, floating as `Scene.add_vessel` describes it."""
    alone = Description(name="ship alone", gravity=gravity)
    add_hull(alone, database)
    linear = linear_model(alone)
    x = linear.response(omega=omega, force=force_of_components(database, omega, heading))
    return np.asarray(x @ linear.output(body="vessel").T)


def _warn_of_outside(table: MotionRaos, omega: Array, amplitude: Array) -> None:
    outside = (omega < table.omega[0] * (1.0 - 1e-9)) | (omega > table.omega[-1] * (1.0 + 1e-9))
    energy = amplitude**2
    share = float(energy[outside].sum() / max(energy.sum(), np.finfo(float).tiny))
    if share > MOST_OUTSIDE:
        warn_caller(
            f"RAOs {table.name!r}: {share:.1%} of the energy of the waves is outside their "
            f"{table.omega[0]:.4g} to {table.omega[-1]:.4g} rad/s: below it those of the lowest are taken, "
            "above it none; give a table of the frequencies of the sea",
            OutsideRaosWarning,
        )


def force_of_components(database: HydroDatabase, omega: Array, heading: Array) -> NDArray[np.complex128]:
    """N/m and N m/m, (n, 6), at frequencies (n,), rad/s, and headings (n,), rad, relative to the vessel."""
    rows = [
        database.force_at(omega[i : i + AT_ONCE], heading[i : i + AT_ONCE], outside="limits")
        for i in range(0, omega.size, AT_ONCE)
    ]
    return np.concatenate(rows) if len(rows) > 1 else rows[0]
