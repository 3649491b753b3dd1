"""Roll damping beside radiation, in place of what a database holds."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from seacrane.errors import SceneError
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.motion import natural_frequency
from seacrane.inputs.checked import not_negative_of

Database = TypeVar("Database", bound=HydroData)


def with_roll_damping(database: Database, linear: float, quadratic: float, fraction: float) -> Database:
    """See `HydroDatabase.with_roll_damping`."""
    for what, value in (("linear", linear), ("quadratic", quadratic), ("fraction", fraction)):
        not_negative_of(f"database {database.name!r}: roll damping, {what}", value)
    whole, squares = database.linear_damping.copy(), database.quadratic_damping.copy()
    whole[3, 3] = linear + (fraction and roll_damping_of(database, fraction))
    squares[3] = quadratic
    return replace(database, linear_damping=whole, quadratic_damping=squares, roll_damping=None)


def roll_damping_of(database: HydroData, fraction: float) -> float:
    """N m s/rad: a fraction of the critical roll damping at the roll natural frequency."""
    resonance = natural_frequency(database, 3)
    if resonance is None:
        raise SceneError(
            f"hull {database.name!r}: the roll natural frequency lies outside {database.omega[0]:.4g} to "
            f"{database.omega[-1]:.4g} rad/s; widen omega, or check centre of gravity and radii of gyration"
        )
    inertia = database.mass_matrix[3, 3] + np.interp(resonance, database.omega, database.added_mass[:, 3, 3])
    return float(fraction * 2.0 * np.sqrt(database.restoring[3, 3] * inertia))
