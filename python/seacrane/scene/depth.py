"""A sea and the database of a vessel in it must be of waves of one length."""

from __future__ import annotations

import numpy as np

from seacrane.description.vessel_hydrodynamics import Source
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.sea.dispersion import wavenumber

LEAST_DIFFERENCE = 0.01  # of a wavenumber, between the depths of a sea and of a database


def require_depth(waves: Waves, database: Source, vessel: str) -> None:
    """Refuse a database computed at a depth where the waves of a sea have another length than in that sea."""
    there, computed = (
        wavenumber(waves.omega, g=database.g, depth=depth) for depth in (waves.depth, database.depth)
    )
    difference = float(np.max(np.abs(there / computed - 1.0)))
    if difference > LEAST_DIFFERENCE:
        raise SceneError(
            f"sea of vessel {vessel!r}: it is {waves.depth:g} m deep, the forces of database "
            f"{database.name!r} are for {database.depth:g} m, and wavenumbers differ by up to "
            f"{difference:.0%}; take SeaState(depth={database.depth:g}), or a database of the sea's depth"
        )
