"""Results as NetCDF4 files."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.description.channels import NAMED, attributes, channel_of
from seacrane.errors import FileFormatError
from seacrane.inputs.netcdf_limits import open_netcdf
from seacrane.inputs.state import state_from_bytes
from seacrane.result.about import About, parted
from seacrane.result.events import NUMBERS, PREFIX, Event, event_arrays, events_from_arrays
from seacrane.result.kept_scene import KeptScene
from seacrane.scene.file import LARGEST_FILE

STATE, STATE_DIMENSION = "state", "state_byte"
SCENE, SCENE_DIMENSION = "scene_json", "scene_byte"
LARGEST_CHUNKS = 2**21  # bytes of one chunk of all channels
MOST_ROWS, LEAST_ROWS = 4096, 16


@dataclass(frozen=True, kw_only=True)
class Contents:
    """What a result's file holds beside its outputs; names as in `Result`.

    Attributes
    ----------
    outputs : How many.
    dims : mapping of str to tuple of str
        Of each channel.
    state : As a state file; empty where there is none.
    scene : As a scene file; empty where there is none.
    """

    outputs: int
    dims: Mapping[str, tuple[str, ...]]
    coords: Mapping[str, Sequence[str]]
    stats: Mapping[str, Any]
    about: About
    events: Sequence[Event]
    interrupted: bool
    state: bytes
    scene: bytes

    def shape(self, dims: Sequence[str]) -> tuple[int, ...]:
        """The shape of one output of a channel."""
        return tuple(len(self.coords[dim]) for dim in dims[1:])

    @property
    def rows(self) -> int:
        """Outputs that a chunk of the file holds."""
        width = 1 + sum(math.prod(self.shape(dims)) for dims in self.dims.values())
        return min(max(LEAST_ROWS, min(MOST_ROWS, LARGEST_CHUNKS // (8 * width))), self.outputs)


def write_netcdf(path: Path, contents: Contents, blocks: Iterable[Mapping[str, Any]]) -> None:
    """Write a result under exactly this name.

    Blocks hold "time" and the channels of outputs that follow each other, whole chunks except for the last.
    """
    import netCDF4

    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        told = {**contents.about.to_attributes(), "interrupted": int(contents.interrupted)}
        file.setncatts({**contents.stats, **told})
        file.createDimension("time", contents.outputs)
        _add_variable(file, "time", ("time",), contents)
        for dim, names in contents.coords.items():
            file.createDimension(dim, len(names))
            file.createVariable(dim, str, (dim,))[:] = np.array(names, dtype=object)
        for name, dims in contents.dims.items():
            _add_variable(file, name, dims, contents)
        at = 0
        for block in blocks:
            count = len(block["time"])
            for name in ("time", *contents.dims):
                file[name][at : at + count] = block[name]
            at += count
        if contents.events:
            _add_events(file, contents.events)
        if contents.state:
            file.createDimension(STATE_DIMENSION, len(contents.state))
            file.createVariable(STATE, "u1", (STATE_DIMENSION,))[:] = np.frombuffer(contents.state, "u1")
        if contents.scene:
            file.createDimension(SCENE_DIMENSION, len(contents.scene))
            scene = file.createVariable(SCENE, "u1", (SCENE_DIMENSION,), compression="zlib")
            scene.setncatts({"long_name": "what was run, as the text of a scene file"})
            scene[:] = np.frombuffer(contents.scene, "u1")


def _add_variable(file: Any, name: str, dims: tuple[str, ...], contents: Contents) -> None:
    chunks = (contents.rows, *contents.shape(dims))
    variable = file.createVariable(
        name, "f8", dims, compression="zlib", complevel=1, chunksizes=chunks, fill_value=False
    )
    # Written chunk by chunk: the library's own cache would hold 64 MB of every variable.
    variable.set_var_chunk_cache(size=2 * 8 * math.prod(chunks), nelems=2, preemption=1.0)
    variable.setncatts(attributes(name))


def _add_events(file: Any, events: Sequence[Event]) -> None:
    file.createDimension("event", len(events))
    for name, array in event_arrays(events).items():
        file.createVariable(name, str if array.dtype == object else "f8", ("event",))[:] = array
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
        stats, about = parted(path, {name: file.getncattr(name) for name in file.ncattrs()})
        interrupted = bool(stats.pop("interrupted", 0))
        return {
            "time": np.asarray(file["time"][:]),
            "arrays": {
                name: variable[:]
                for name, variable in file.variables.items()
                if name not in ("time", STATE, SCENE)
                and name not in file.dimensions
                and "event" not in variable.dimensions
                and (channels is None or channel_of(name) in channels)
            },
            "coords": {dim: [str(name) for name in file[dim][:]] for dim in NAMED if dim in file.variables},
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
            "about": about,
            "interrupted": interrupted,
            "state": _state(path, file),
            "scene": _scene(path, file),
        }


def _state(path: Path, file: Any) -> Any:
    if STATE not in file.variables:
        return None
    return state_from_bytes(file[STATE][:].tobytes(), path)


def _scene(path: Path, file: Any) -> KeptScene | None:
    """The text, unread."""
    if SCENE not in file.variables:
        return None
    variable = file[SCENE]
    if variable.dtype != np.uint8:
        raise FileFormatError(
            f"{path}: its {SCENE} is of {variable.dtype}, not bytes; no run wrote this file"
        )
    if variable.size > LARGEST_FILE:
        raise FileFormatError(f"{path}: its {SCENE} has {variable.size} bytes, above {LARGEST_FILE}")
    data = variable[:]
    return KeptScene.from_text(data.tobytes(), f"{path.name}: its scene")
