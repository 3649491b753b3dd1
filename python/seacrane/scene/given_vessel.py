"""A ship whose motion is given: nothing on board and no wave changes it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.inverse import SIX, hold_vessel
from seacrane.analysis.linear_system import linear_model
from seacrane.description.curves import curves_of_sum
from seacrane.description.databases import source_of
from seacrane.description.description import Description
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import Source, VesselHydrodynamics
from seacrane.description.waves import HullLoads, Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, not_negative_of, positive_of, shaped_of
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.shown import shown
from seacrane.scene.afloat import add_hull, add_hydrodynamics
from seacrane.scene.bodies import add_body
from seacrane.scene.motion_history import MotionHistory
from seacrane.warnings import OutsideRaosWarning

LIGHT = 1.0  # kg and kg m2 of the body that stands for the ship: what drives it carries what is on board
RAMP = 20.0  # s
DURATION = 600.0  # s
MOST_OUTSIDE = 0.02  # of the energy of the waves
Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
AT_ONCE = 4096  # components whose transfer is interpolated together, to bound the memory it takes


def add_given(
    scene: Description, motion: Any, *, name: str = "vessel", position: Any = (0.0, 0.0, 0.0),
    heading_deg: float = 0.0, ramp: float = RAMP, duration: float = DURATION, size: Any = None,
) -> VesselHydrodynamics:  # fmt: skip
    """A ship whose motion is given, as `Scene.add_vessel` describes it."""
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
        database=motion.name if isinstance(motion, HydroDatabase) else None, motion=kind,
        ramp=None if kind == "rest" else grown, duration=None if kind == "rest" else lasting, size=outline,
        record=motion.record or None if isinstance(motion, MotionHistory) else None,
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


def _kind_of(what: str, motion: Any) -> str:
    if isinstance(motion, Source):
        return "raos"
    if isinstance(motion, MotionHistory):
        return "history"
    if isinstance(motion, str) and motion == "rest":
        return "rest"
    raise SceneError.of(
        f"{what}: motion",
        f"is {shown(motion)}; give a HydroDatabase or MotionRaos, a MotionHistory, or 'rest'",
    )


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


def raos_of(database: HydroDatabase) -> MotionRaos:
    """The displacement RAOs that a database's own file holds.

    Raises SceneError for a database of a ship under way.
    """
    if database.speed != 0.0:
        raise SceneError(
            f"database {database.name!r}: its motions are those at {database.speed:g} m/s, and a given ship "
            "keeps its place; give one of zero speed"
        )
    return MotionRaos(
        omega=database.omega, heading=database.heading, values=database.motion_rao, depth=database.depth,
        symmetric=database.port_starboard_symmetric, name=database.name, g=database.g,
    )  # fmt: skip


def motion_of_components(
    source: HydroDatabase | MotionRaos, waves: Waves, *, place: tuple[float, float], heading: float,
    gravity: float,
) -> Complex:  # fmt: skip
    """Complex amplitude (n, 6) of the motion in each component: m and rad, sum Re of them exp(i omega t).

    In axes of the ship at rest, at a place (x, y), m, and a heading, rad. A database without motions of its
    own has those of the linear model of the ship alone, floating as `Scene.add_vessel` describes it.

    Warns
    -----
    OutsideRaosWarning
        More than 2 % of the energy of the waves is outside the table's frequencies.
    """
    sea = waves.components()
    omega, direction = np.array(sea.omega), np.array(sea.direction)
    along = np.cos(direction) * place[0] + np.sin(direction) * place[1]
    wave = np.array(sea.amplitude) * np.exp(1j * (np.array(sea.phase) - np.array(sea.wavenumber) * along))
    if isinstance(source, HydroDatabase) and source.motion_rao is None:
        return np.asarray(wave[:, None] * linear_motion(source, omega, direction - heading, gravity=gravity))
    table = raos_of(source) if isinstance(source, HydroDatabase) else source
    _warn_of_outside(table, omega, np.array(sea.amplitude))
    return np.asarray(wave[:, None] * table.at(omega, direction - heading))


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
    return np.concatenate(rows).astype(complex).reshape(-1, 6)
