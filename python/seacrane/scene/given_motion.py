"""The motion of a ship that follows its displacement RAOs in a realised sea."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.linear_system import linear_model
from seacrane.description.description import Description
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.inputs.caller import warn_caller
from seacrane.scene.vessel import add_vessel
from seacrane.scene.wave_force import force_of_components
from seacrane.warnings import OutsideRaosWarning

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
MOST_OUTSIDE = 0.02  # of the energy of the waves


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
    source: HydroDatabase | MotionRaos,
    waves: Waves,
    *,
    place: tuple[float, float],
    heading: float,
    gravity: float,
) -> Complex:
    """Complex amplitude (n, 6) of the motion in each component: m and rad, sum Re of them exp(i omega t).

    In axes of the ship at rest.

    Parameters
    ----------
    source : HydroDatabase or MotionRaos
        A database without motions of its own has those of the linear model of the ship alone, floating as
        `Scene.add_vessel` describes it.
    place, heading
        Of the ship at rest: (x, y), m; rad.
    gravity : m/s2.

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
    add_vessel(alone, database)
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
