"""A NetCDF file written out as JSON, so that a mutation reaches the reader and not only HDF5's checksums.

An object has "attrs", "dims", "vars" (each with "type", "dims", "data", "attrs") and "groups" of the same
kind. Numbers that JSON lacks are the texts "nan", "inf" and "-inf".
"""

from __future__ import annotations

import contextlib
import json
import math
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

LARGEST = 10**15
CONTIGUOUS = 10**6  # numbers; more are stored in chunks, of which those unwritten take no room
WORDS = {"nan": float("nan"), "inf": float("inf"), "-inf": float("-inf")}


def spec_of(path: Path) -> bytes:
    """The contents of a file as a specification."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        return json.dumps(_described(file)).encode()


def _described(group: Any) -> dict[str, Any]:
    variables = {
        name: {
            "type": "str" if variable.dtype is str else variable.dtype.str[1:],
            "dims": list(variable.dimensions),
            "data": _plain(np.asarray(variable[...])),
            "attrs": {key: _plain(variable.getncattr(key)) for key in variable.ncattrs()},
        }
        for name, variable in group.variables.items()
    }
    return {
        "attrs": {key: _plain(group.getncattr(key)) for key in group.ncattrs()},
        "dims": {name: len(dimension) for name, dimension in group.dimensions.items()},
        "vars": variables,
        "groups": {name: _described(inner) for name, inner in group.groups.items()},
    }


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    if isinstance(value, list):
        return [_plain(item) for item in value]
    if isinstance(value, bytes):
        return value.decode("latin-1")
    return value if not isinstance(value, float) or np.isfinite(value) else str(value)


def build(case: bytes, path: Path) -> bool:
    """Write what the specification says, but what makes no file; False where it is no object."""
    path.unlink(missing_ok=True)  # a file that HDF5 could not close stays locked
    try:
        spec = json.loads(case)
        if not isinstance(spec, dict):
            return False
        with netCDF4.Dataset(path, "w", format="NETCDF4") as file:
            _fill(file, spec, 0)
    except (ValueError, OSError, RuntimeError):  # of nesting, too
        return False
    return True


def _fill(group: Any, spec: dict[str, Any], depth: int) -> None:
    for name, value in _entries(spec, "attrs"):
        with contextlib.suppress(*UNWRITABLE):
            group.setncattr(name, _value(value))
    for name, size in _entries(spec, "dims"):
        with contextlib.suppress(*UNWRITABLE):
            group.createDimension(name, None if size is None else min(int(size), LARGEST))
    for name, variable in _entries(spec, "vars"):
        with contextlib.suppress(*UNWRITABLE):
            _variable(group, name, variable)
    for name, inner in _entries(spec, "groups"):
        if isinstance(inner, dict) and depth < 8:
            with contextlib.suppress(*UNWRITABLE):
                _fill(group.createGroup(name), inner, depth + 1)


def _entries(spec: dict[str, Any], key: str) -> list[tuple[str, Any]]:
    found = spec.get(key)
    return list(found.items()) if isinstance(found, dict) else []


# Whatever cannot be written is no case for a reader.
UNWRITABLE = (
    AttributeError, LookupError, MemoryError, OSError, OverflowError, RuntimeError, TypeError, ValueError
)  # fmt: skip


def _variable(group: Any, name: str, spec: dict[str, Any]) -> None:
    kind = str if spec["type"] == "str" else np.dtype(spec["type"])
    sizes = [len(_dimension(group, dimension)) for dimension in spec["dims"]]
    large = bool(spec.get("zlib")) or math.prod(sizes) > CONTIGUOUS
    variable = group.createVariable(name, kind, tuple(spec["dims"]), fill_value=False, zlib=large)
    for key, value in _entries(spec, "attrs"):
        with contextlib.suppress(*UNWRITABLE):
            variable.setncattr(key, _value(value))
    data = spec.get("data")
    if data is not None and math.prod(sizes) <= CONTIGUOUS:  # else nothing is written: refused anyway
        array = np.array(_value(data), dtype=object if kind is str else kind)
        variable[tuple(slice(0, size) for size in array.shape) if array.ndim else ...] = array


def _dimension(group: Any, name: str) -> Any:
    """A dimension of the group or of one around it."""
    while name not in group.dimensions:
        group = group.parent
    return group.dimensions[name]


def _value(value: Any) -> Any:
    if isinstance(value, list):
        return [_value(item) for item in value]
    return WORDS.get(value, value) if isinstance(value, str) else value
