"""Results as NetCDF4 files."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.description.channels import attributes, channel_of
from seacrane.errors import FileFormatError
from seacrane.inputs.netcdf_limits import open_netcdf
from seacrane.result.about import NUMBERS, PREFIX, event_arrays, events_from_arrays, parted, plain_stats
from seacrane.result.partial_file import Piece
from seacrane.scene.file import LARGEST_FILE

STATE, STATE_DIMENSION = "state", "state_byte"
SCENE, SCENE_DIMENSION = "scene_json", "scene_byte"
LARGEST_PIECE = 2**21  # bytes of one chunk of all channels
MOST_ROWS, LEAST_ROWS = 4096, 16
EVERY = slice(None)


def rows_of_piece(width: int) -> int:
    """Outputs of so many numbers that are written at once."""
    return max(LEAST_ROWS, min(MOST_ROWS, LARGEST_PIECE // (8 * max(width, 1))))


def _shape(told: Piece, dims: Sequence[str]) -> tuple[int, ...]:
    """The shape of one output of a channel."""
    return tuple(len(told.coords[dim]) for dim in dims[1:])


def rows_of_chunk(told: Piece, outputs: int) -> int:
    """Outputs that a chunk of a file with so many holds."""
    width = 1 + sum(math.prod(_shape(told, dims)) for dims in told.dims.values())
    return min(rows_of_piece(width), outputs)


def write_netcdf(path: Path, told: Piece, blocks: Iterable[Mapping[str, Any]], outputs: int) -> None:
    """Write a result of so many outputs under exactly this name.

    `told` has all but the outputs, which blocks hold one after the other: "time" and the channels, whole
    chunks except for the last.
    """
    import netCDF4

    with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
        file.setncatts({**told.stats, **told.about.to_attributes(), "interrupted": int(told.interrupted)})
        file.createDimension("time", outputs)
        rows = rows_of_chunk(told, outputs)
        _add_variable(file, "time", ("time",), (rows,))
        for dim, names in told.coords.items():
            file.createDimension(dim, len(names))
            file.createVariable(dim, str, (dim,))[:] = np.array(names, dtype=object)
        for name, dims in told.dims.items():
            _add_variable(file, name, dims, (rows, *_shape(told, dims)))
        at = 0
        for block in blocks:
            count = len(block["time"])
            for name in ("time", *told.dims):
                file[name][at : at + count] = block[name]
            at += count
        if told.events:
            file.createDimension("event", len(told.events))
            for name, array in event_arrays(told.events).items():
                file.createVariable(name, str if array.dtype == object else "f8", ("event",))[:] = array
            for key, (unit, long_name) in NUMBERS.items():
                file[PREFIX + key].setncatts({"units": unit, "long_name": long_name})
        if told.state:
            file.createDimension(STATE_DIMENSION, len(told.state))
            file.createVariable(STATE, "u1", (STATE_DIMENSION,))[:] = np.frombuffer(told.state, "u1")
        if told.scene:
            file.createDimension(SCENE_DIMENSION, len(told.scene))
            scene = file.createVariable(SCENE, "u1", (SCENE_DIMENSION,), compression="zlib")
            scene.setncatts({"long_name": "what was run, as the text of a scene file"})
            scene[:] = np.frombuffer(told.scene, "u1")


def _add_variable(file: Any, name: str, dims: tuple[str, ...], chunks: tuple[int, ...]) -> None:
    variable = file.createVariable(
        name, "f8", dims, compression="zlib", complevel=1, chunksizes=chunks, fill_value=False
    )
    # Written chunk by chunk: the library's own cache would hold 64 MB of every variable.
    variable.set_var_chunk_cache(size=2 * 8 * math.prod(chunks), nelems=2, preemption=1.0)
    variable.setncatts(attributes(name))


def read_netcdf(
    path: Path, largest: int, channels: Sequence[str] | None = None, rows: slice = EVERY
) -> Piece:
    """What is in a result's file, of channels and outputs those; FileFormatError beyond `largest` bytes."""
    fix = "raise it with Result.load(path, largest=...) if the file is yours"
    with open_netcdf(path, largest, fix) as file:
        if "time" not in file.variables:
            raise FileFormatError(f"{path} has no variable 'time'; it is not a seacrane result")
        stats, about = parted(path, {name: file.getncattr(name) for name in file.ncattrs()})
        held = {
            name: one for name, one in file.variables.items() if name not in (*file.dimensions, STATE, SCENE)
        }
        told = {name: one[:] for name, one in held.items() if "event" in one.dimensions}
        taken = {
            name: one
            for name, one in held.items()
            if name not in told and (channels is None or channel_of(name) in channels)
        }
        dims = dict.fromkeys(dim for one in taken.values() for dim in one.dimensions[1:])
        interrupted = bool(stats.pop("interrupted", 0))
        return Piece(
            arrays={name: np.asarray(one[rows]) for name, one in {"time": file["time"], **taken}.items()},
            coords={dim: [str(name) for name in file[dim][:]] for dim in dims if dim in file.variables},
            stats=plain_stats(stats), about=about, interrupted=interrupted,
            events=events_from_arrays(told) if "event" in file.dimensions else (),
            state=file[STATE][:].tobytes() if STATE in file.variables else b"", scene=_scene(path, file),
        )  # fmt: skip


def _scene(path: Path, file: Any) -> bytes:
    if SCENE not in file.variables:
        return b""
    variable = file[SCENE]
    if variable.dtype != np.uint8:
        raise FileFormatError(
            f"{path}: its {SCENE} is of {variable.dtype}, not bytes; no run wrote this file"
        )
    if variable.size > LARGEST_FILE:
        raise FileFormatError(f"{path}: its {SCENE} has {variable.size} bytes, above {LARGEST_FILE}")
    return bytes(variable[:].tobytes())
