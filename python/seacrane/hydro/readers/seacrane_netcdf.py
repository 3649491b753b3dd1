"""Our own NetCDF form among the formats that `load_database` reads."""

from __future__ import annotations

from pathlib import Path

from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.readers.format import Format, is_file_of, of_one_speed

NETCDF = (".nc", ".nc4")


def _is_netcdf(path: Path) -> bool:
    """Any NetCDF file: one that is of no known kind is refused by what it lacks of ours."""
    return is_file_of(path, NETCDF)


def _speeds(path: Path) -> tuple[float, ...]:
    return (HydroDatabase.load(path).speed,)


FORMAT = Format(
    name="seacrane",
    files="a NetCDF file (.nc) of seacrane",
    can_open=_is_netcdf,
    read=of_one_speed(HydroDatabase.load),
    speeds=_speeds,
)
