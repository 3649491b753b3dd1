"""Results as NetCDF4 files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.errors import FileFormatError
from seacrane.netcdf_limits import open_netcdf
from seacrane.result.channels import attributes
from seacrane.result.events import NUMBERS, PREFIX, Event, event_arrays, events_from_arrays

if TYPE_CHECKING:
    from seacrane.result.result import Result

# Dimensions whose names belong to the scene, and the arguments of `Result.from_arrays` that take them.
NAMED = {
    "body": "bodies",
    "joint": "joints",
    "cylinder": "cylinders",
    "joint_coordinate": "coordinates",
    "actuator": "actuators",
    "driver": "drivers",
    "link": "links",
    "limit": "limits",
    "vessel": "vessels",
}


def write_netcdf(path: Path, result: Result) -> None:
    """Write a result under exactly this name."""
    import netCDF4

    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        file.setncatts({**result.stats, "interrupted": int(result.interrupted)})
        file.createDimension("time", result.time.size)
        file.createVariable("time", "f8", ("time",))[:] = result.time
        for dim, names in result.coords.items():
            file.createDimension(dim, len(names))
            file.createVariable(dim, str, (dim,))[:] = np.array(names, dtype=object)
        for name, array in result.channels.items():
            variable = file.createVariable(name, "f8", result.dims[name], compression="zlib", complevel=1)
            variable[:] = array
        for name in ("time", *result.channels):
            file[name].setncatts(attributes(name))
        if result.events:
            add_events(file, result.events, 0)


def add_events(file: Any, events: Sequence[Event], place: int) -> None:
    """Write events from a place in a file's list on, which is made if there is none."""
    made = "event" not in file.dimensions
    if made:
        file.createDimension("event", None)
    for name, array in event_arrays(events).items():
        if made:
            file.createVariable(name, str if array.dtype == object else "f8", ("event",))
        file[name][place : place + len(events)] = array
    for key, (unit, long_name) in NUMBERS.items():
        file[PREFIX + key].setncatts({"units": unit, "long_name": long_name})


def read_arrays(path: Path, largest: int, channels: Sequence[str] | None = None) -> dict[str, Any]:
    """What is in a result's file, or those channels of it, as the arguments of `Result.from_arrays`.

    FileFormatError beyond `largest` bytes.
    """
    fix = "raise it with Result.load(path, largest=...) if the file is yours"
    with open_netcdf(path, largest, fix) as file:
        if "time" not in file.variables:
            raise FileFormatError(f"{path} has no variable 'time'; it is not a seacrane result")
        stats = {name: file.getncattr(name) for name in file.ncattrs()}
        interrupted = bool(stats.pop("interrupted", 0))
        time = np.asarray(file["time"][:])
        outputs = _timed(time)
        return {
            "time": time[outputs],
            "arrays": {
                name: variable[outputs]
                for name, variable in file.variables.items()
                if name != "time"
                and name not in file.dimensions
                and "event" not in variable.dimensions
                and (channels is None or name in channels)
            },
            **{
                argument: [str(name) for name in file[dim][:]]
                for dim, argument in NAMED.items()
                if dim in file.variables
            },
            "events": events_from_arrays(
                {
                    name: variable[:]
                    for name, variable in file.variables.items()
                    if "event" in variable.dimensions
                }
            )
            if "event" in file.dimensions
            else (),
            "stats": stats,
            "interrupted": interrupted,
        }


def _timed(time: Any) -> slice:
    """All outputs, without those at the end whose writing was broken off before they had a time."""
    if time.ndim == 1 and time.dtype.kind == "f" and np.isnan(time[-1:]).any():
        return slice(int(np.argmax(np.isnan(time))))
    return slice(None)
