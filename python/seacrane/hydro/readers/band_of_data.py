"""The trusted band of sources that do not tell their panels: as far as their matrices are smooth."""

from __future__ import annotations

from dataclasses import replace

from seacrane.hydro.data.roughness import first_rough_value
from seacrane.hydro.database.database import HydroDatabase
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import RoughDataWarning


def with_band_of_data(database: HydroDatabase) -> HydroDatabase:
    """The database; where it has no trusted band and its matrices jump, with a band that ends below.

    Warns
    -----
    RoughDataWarning : they jump.
    """
    found = None if database.trusted_band is not None else first_rough_value(database)
    if found is None or found[0] < 2:
        return database
    at, entry = found
    low, high = float(database.omega[0]), float(database.omega[at - 1])
    warn_caller(
        f"database {database.name!r}: its files do not say how far their panels can be trusted, and {entry} "
        f"jumps at {database.omega[at]:.4g} rad/s, as of waves too short for the panels or of an irregular "
        f"frequency. The trusted band ends at {high:.4g} rad/s; nothing above it is fitted. For another one "
        "give load_database(path, trusted_band=(low, high)) in rad/s",
        RoughDataWarning,
    )
    return replace(database, trusted_band=(low, high))
