"""Our NetCDF form of a database: written atomically, read back bit for bit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import astuple, fields
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from seacrane.errors import FileFormatError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.hydro_data import (
    ARRAYS,
    AdditionalMatrices,
    DriftCoefficients,
    HydroData,
    Part,
    RollDamping,
    axes_of,
)
from seacrane.hydro.data.memory_model import (
    MODEL_MATRICES,
    FitRow,
    MemoryBlock,
    MemoryModel,
    MotionError,
    MotionFit,
    Passivity,
)
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf

if TYPE_CHECKING:
    import xarray

Data = TypeVar("Data", bound=HydroData)

FORMAT = "seacrane hydrodynamic database"
FORMAT_VERSION = 1
CONVENTION = (
    "x forward, y port, z up; heading = direction waves travel to, from +x towards +y, rad; exp(+i omega t); "
    "SI units; loads and motions per metre of wave amplitude, about the reference point"
)
_TEXTS = ("name", "origin", "source")
_NUMBERS = ("rho", "g", "depth", "speed", "length", "breadth", "draught")
_DIMENSIONS = {"n": "omega", "m": "heading", "i": "motion", "j": "motion_of"}
_MATRIX = ("motion", "motion_of")
_BLOCK_AXES = {  # k states, p outputs, m inputs
    "outputs": "p", "inputs": "m", "A": "kk", "B": "km", "C": "pk", "D": "pm", "state_scale": "k",
}  # fmt: skip
_ROW_KINDS = {
    entry.name: float if entry.type == "float" else np.int64
    for entry in fields(FitRow)
    if entry.name != "cause"
}
_PASSIVITY = [entry.name for entry in fields(Passivity)]


def save_database(database: HydroData, path: str | PathLike[str]) -> None:
    """Write everything, the memory model included, to a NetCDF file, atomically and without loss."""
    import netCDF4

    with atomic_write(Path(path)) as draft:
        try:
            with netCDF4.Dataset(draft, "w", format="NETCDF4") as file:
                _write(file, database)
        except RuntimeError as error:  # the HDF5 library's failures to write arrive as RuntimeError
            raise OSError(f"the NetCDF library reports: {error}") from error


def load_database_file(kind: type[Data], path: str | PathLike[str]) -> Data:
    """Read a file written by `save_database`, as a ``kind`` of `HydroData`.

    Raises FileFormatError: the file is missing, damaged, or not one of ours.
    """
    source = Path(path)
    if not source.is_file():
        raise FileFormatError(f"{source}: no such file; give the path of a hydrodynamic database")
    with reading(source, "a hydrodynamic database", NETCDF_ERRORS), open_netcdf(source) as file:
        if getattr(file, "format", None) != FORMAT:
            raise FileFormatError(
                f"{source}: a NetCDF file, but not a seacrane hydrodynamic database; save one with "
                "HydroDatabase.save"
            )
        if int(file.format_version) != FORMAT_VERSION:
            raise FileFormatError(
                f"{source}: is of format version {int(file.format_version)}, and this seacrane reads "
                f"format version {FORMAT_VERSION}; save it again with HydroDatabase.save"
            )
        found = _read(kind, file)
    return found


def _arrays(part: Part) -> Iterator[Any]:
    """Name, array, dimensions and unit of all arrays that a part has."""
    for name, axes in axes_of(part).items():
        if getattr(part, name) is not None:
            yield name, getattr(part, name), tuple(_DIMENSIONS[axis] for axis in axes), ARRAYS[name][1]


def dataset_of(database: HydroData) -> xarray.Dataset:
    """The arrays as a labelled dataset (copies), complex values kept complex; needs xarray."""
    import xarray

    variables: dict[str, Any] = {}
    for name, array, dimensions, unit in _arrays(database):
        variables[name] = (dimensions, np.array(array), {"units": unit})
    for part in database.additional:
        for name, array, dimensions, unit in _arrays(part):
            key = f"{name}_{part.cause.replace(' ', '_')}"
            variables[key] = (dimensions, np.array(array), {"units": unit, "cause": part.cause})
    for name, array, dimensions, unit in _arrays(database.roll_damping) if database.roll_damping else ():
        variables[f"roll_damping_{name}"] = (dimensions, np.array(array), {"units": unit})
    coordinates = {"motion": list(MOTIONS), "motion_of": list(MOTIONS)}
    attributes = {name: getattr(database, name) for name in (*_TEXTS, *_NUMBERS)}
    return xarray.Dataset(variables, coordinates, {**attributes, "convention": CONVENTION})


def _write(file: Any, database: HydroData) -> None:
    file.format, file.format_version, file.convention = FORMAT, FORMAT_VERSION, CONVENTION
    for name in (*_TEXTS, *_NUMBERS):
        file.setncattr(name, getattr(database, name))
    file.port_starboard_symmetric = int(database.port_starboard_symmetric)
    if database.trusted_band is not None:
        file.trusted_band = np.array(database.trusted_band, dtype=float)
    sizes = {"omega": len(database.omega), "heading": len(database.heading)}
    for name, size in {**sizes, "motion": 6, "motion_of": 6, "reim": 2}.items():
        file.createDimension(name, size)
    places: list[tuple[Any, Part]] = [(file, database)]
    for i, part in enumerate(database.additional):
        places.append((file.createGroup(f"additional_{i}"), part))
        places[-1][0].cause = part.cause
    if (roll := database.roll_damping) is not None:
        places.append((file.createGroup("roll_damping"), roll))
        if roll.linearised_amplitude is not None:
            places[-1][0].linearised_amplitude = float(roll.linearised_amplitude)
    if (drift := database.drift) is not None:
        places.append((file.createGroup("drift"), drift))
        places[-1][0].createDimension("heading", len(drift.heading))
        places[-1][0].createDimension("omega", len(drift.omega))
    for group, one in places:
        for name, array, dimensions, unit in _arrays(one):
            _put(group, name, array, dimensions).units = unit
    if database.memory is not None:
        _write_memory(file.createGroup("memory"), database.memory)


def _write_memory(group: Any, model: MemoryModel) -> None:
    group.band, group.r2 = np.array(model.band, dtype=float), float(model.r2)
    group.passivity = np.array(astuple(model.passivity))
    if model.motion is not None:
        motion, fit = group.createGroup("motion"), model.motion
        motion.limit, motion.floor = float(fit.limit), float(fit.floor)
        motion.seas, motion.peaks = np.array(fit.error.seas), np.array(fit.error.peaks)
        motion.left_out = " ".join(f"{j + 1}{k + 1}" for j, k in fit.left_out)
    for name in MODEL_MATRICES:
        _put(group, name, getattr(model, name), _MATRIX)
    shapes = [(len(block.A), len(block.outputs), len(block.inputs)) for block in model.blocks]
    group.createDimension("block", len(model.blocks))
    group.createDimension("size", 3)
    _put(group, "block_shape", np.array(shapes, dtype=np.int64).reshape(-1, 3), ("block", "size"))
    group.block_cause = "\n".join(block.cause for block in model.blocks)
    for name in _BLOCK_AXES:
        flat = [getattr(block, name).ravel() for block in model.blocks]
        joined = np.concatenate(flat) if flat else np.zeros(0)
        group.createDimension(f"length_{name}", len(joined))
        _put(group, name, joined, (f"length_{name}",))
    group.createDimension("row", len(model.rows))
    group.row_cause = "\n".join(row.cause for row in model.rows)
    for name, kind in _ROW_KINDS.items():
        column = np.array([getattr(row, name) for row in model.rows], kind)
        _put(group, f"row_{name}", column, ("row",))


def _read_memory(group: Any) -> MemoryModel:
    shapes = [dict(zip("kpm", shape, strict=True)) for shape in _get(group, "block_shape").tolist()]
    parts: list[dict[str, Any]] = [{} for _ in shapes]
    for name, axes in _BLOCK_AXES.items():
        flat, start = _get(group, name), 0
        for part, sizes in zip(parts, shapes, strict=True):
            shape = [sizes[axis] for axis in axes]
            part[name] = flat[start : start + math.prod(shape)].reshape(shape)
            start += math.prod(shape)
    causes = str(group.block_cause).split("\n") if shapes else []
    blocks = [MemoryBlock(cause=cause, **part) for cause, part in zip(causes, parts, strict=True)]
    columns = [_get(group, f"row_{name}").tolist() for name in _ROW_KINDS]
    row_causes = str(group.row_cause).split("\n") if columns[0] else []
    rows = [
        FitRow(cause=cause, **dict(zip(_ROW_KINDS, values, strict=True)) | {"accepted": bool(values[-1])})
        for cause, *values in zip(row_causes, *columns, strict=True)
    ]
    passivity = [float(value) for value in group.passivity]
    if np.isnan([*group.band, *passivity]).any() or not np.isfinite(group.r2):
        raise ValueError("memory: band, passivity or r2 is not a number")
    motion: MotionFit | None = None
    if (of_motion := group.groups.get("motion")) is not None:
        left_out = tuple((int(pair[0]) - 1, int(pair[1]) - 1) for pair in str(of_motion.left_out).split())
        error = MotionError(seas=np.asarray(of_motion.seas), peaks=np.asarray(of_motion.peaks))
        limit, floor = float(of_motion.limit), float(of_motion.floor)
        motion = MotionFit(limit=limit, error=error, floor=floor, left_out=left_out)
    return MemoryModel(
        blocks=tuple(blocks), **{name: _get(group, name) for name in MODEL_MATRICES},
        band=(float(group.band[0]), float(group.band[1])), r2=float(group.r2), rows=tuple(rows),
        passivity=Passivity(**dict(zip(_PASSIVITY, passivity, strict=True))),
        motion=motion,
    )  # fmt: skip


def _put(group: Any, name: str, value: Any, dimensions: tuple[str, ...]) -> Any:
    """Store one array, complex ones with a last dimension of real and imaginary part."""
    array = np.asarray(value)
    if np.iscomplexobj(array):
        array, dimensions = np.stack([array.real, array.imag], axis=-1), (*dimensions, "reim")
    large = array.size > 500
    variable = group.createVariable(
        name, array.dtype, dimensions, fill_value=False, zlib=large, complevel=6, shuffle=large
    )
    variable[...] = array
    return variable


def _read(kind: type[Data], file: Any) -> Data:
    values: dict[str, Any] = {name: str(file.getncattr(name)) for name in _TEXTS}
    values |= {name: float(file.getncattr(name)) for name in _NUMBERS}
    values |= _got(kind, file)
    band, groups = getattr(file, "trusted_band", None), file.groups
    roll = None
    if "roll_damping" in groups:
        amplitude = getattr(groups["roll_damping"], "linearised_amplitude", None)
        roll = RollDamping(
            **_got(RollDamping, groups["roll_damping"]),
            linearised_amplitude=None if amplitude is None else float(amplitude),
        )
    additional = [groups[name] for name in sorted(groups) if name.startswith("additional_")]
    return kind(
        **values,
        port_starboard_symmetric=bool(file.port_starboard_symmetric),
        trusted_band=None if band is None else (float(band[0]), float(band[1])),
        additional=tuple(
            AdditionalMatrices(cause=str(group.cause), **_got(AdditionalMatrices, group))
            for group in additional
        ),
        roll_damping=roll,
        memory=_read_memory(groups["memory"]) if "memory" in groups else None,
        drift=DriftCoefficients(**_got(DriftCoefficients, groups["drift"])) if "drift" in groups else None,
    )


def _got(kind: type, group: Any) -> dict[str, Any]:
    """The arrays of a kind of part that a group of the file holds."""
    names = [entry.name for entry in fields(kind) if entry.name in ARRAYS and entry.name in group.variables]
    return {name: _get(group, name) for name in names}


def _get(group: Any, name: str) -> Any:
    """Read one array, joining real and imaginary parts."""
    variable = group.variables[name]
    array = np.asarray(variable[...])
    if variable.dimensions[-1:] == ("reim",):
        return array[..., 0] + 1j * array[..., 1]
    return array
