"""A ship whose motion is given: nothing on board and no wave changes it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import SIX, hold_vessel
from seacrane.description.bodies import add_body
from seacrane.description.databases import source_of
from seacrane.description.description import Description
from seacrane.description.hydrodynamics import add_hydrodynamics
from seacrane.description.provenance import VesselProvenance
from seacrane.description.sum_of_cosines import curves_of_sum
from seacrane.description.vessel_hydrodynamics import Source, VesselHydrodynamics
from seacrane.description.waves import HullLoads, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.inputs.checked import name_of, not_negative_of, positive_of, shaped_of
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.scene.given_motion import motion_of_components
from seacrane.scene.motion_history import MotionHistory

LIGHT = 1.0  # kg and kg m2 of the body that stands for the ship: what drives it carries what is on board
RAMP = 20.0  # s
DURATION = 600.0  # s


def add_given_vessel(
    scene: Description,
    motion: Any,
    *,
    name: str = "vessel",
    position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0,
    ramp: float = RAMP,
    duration: float = DURATION,
    size: Any = None,
) -> VesselHydrodynamics:
    """Add a ship whose motion is given: by its displacement RAOs in the sea, by a history, or at rest.

    It takes the place of a vessel from a database, and carries a crane as that does, but nothing acts back on
    it. Its body is a light stand-in (1 kg, without weight), led by six drivers "<name>.motion.x" to
    "<name>.motion.yaw": their `driver_force` is the load of all that is on board. `vessel_motion` records it.

    Parameters
    ----------
    motion : HydroDatabase, MotionRaos, MotionHistory or "rest"
        HydroDatabase: its own displacement RAOs where its file holds them, else those of its linear model.
        With RAOs the ship rests until `Scene.add_sea` gives it the sea to move in; the scene keeps them, in
        `scene.vessels[name].database`. "rest": it never moves.
    name : str
        Of the body and of the vessel.
    position : array_like, shape (3,)
        Of the reference point at rest, m, inertial frame.
    heading_deg : float
        At rest, deg from +x towards +y; default 0.
    ramp : float
        s, over which RAOs or a history grow from rest to their full motion; default 20 s, 0: full from the
        start, where all that is on board must be described.
    duration : float
        s, for which the motion by RAOs is described; default 600 s. A longer run is refused.
    size : array_like, shape (3,)
        Length, breadth and draught of the hull that pictures show, m; default: the database's, else
        100 x 20 x 5 m.

    Returns
    -------
    VesselHydrodynamics
        Without any hydrodynamics.

    Raises
    ------
    SceneError
        For a motion of another kind, or a value that is no finite number.

    Warns
    -----
    AngleUnitWarning, CompassDirectionWarning
        A heading that looks like radians, or like a compass bearing.
    """
    what = f"vessel {name_of('vessel', name)!r}"
    kind = _kind_of(what, motion)
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
    source = motion if isinstance(motion, Source) else None
    added = add_hydrodynamics(scene, body=name, database=source)
    still = _core.Curve.constant(value=0.0)
    curves = motion.curves(grown) if isinstance(motion, MotionHistory) else (still,) * 6
    hold_vessel(scene, name, dict(zip(SIX, curves, strict=True)))
    if isinstance(motion, MotionHistory):
        lasting = float(motion.time[-1])
    scene.provenance[name] = VesselProvenance(
        database=motion.name if isinstance(motion, HydroDatabase) else None,
        motion=kind,
        ramp=None if kind == "rest" else grown,
        duration=None if kind == "rest" else lasting,
        size=outline,
        record=motion.record or None if isinstance(motion, MotionHistory) else None,
    )
    return added


def put_into_sea(
    scene: Description,
    waves: Waves,
    *,
    vessel: str,
    place: tuple[float, float],
    heading: float,
) -> Waves:
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


def _kind_of(what: str, motion: Any) -> str:
    if isinstance(motion, Source):
        return "raos"
    if isinstance(motion, MotionHistory):
        return "history"
    if isinstance(motion, str) and motion == "rest":
        return "rest"
    raise SceneError(
        f"{what}: motion is {shown(motion)}; give a HydroDatabase or MotionRaos, a MotionHistory, or 'rest'"
    )


def _size_of(what: str, motion: Any, size: Any) -> tuple[float, float, float] | None:
    if size is None and isinstance(motion, HydroDatabase):
        return motion.length, motion.breadth, motion.draught
    if size is None:
        return None
    length, breadth, draught = (float(one) for one in shaped_of(f"{what}: size", size, (3,)))
    if not (np.isfinite([length, breadth, draught]).all() and min(length, breadth, draught) > 0.0):
        raise SceneError(f"{what}: size is {shown(size)}; give positive length, breadth and draught, m")
    return length, breadth, draught
