"""What a NetCDF file says that it holds, looked at before any of it is read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from seacrane.errors import FileFormatError

LARGEST_DATABASE = 512 * 2**20  # bytes; 1,000 frequencies x 72 headings take 20 MiB
TOO_LARGE = "no hydrodynamic database is: write it again with fewer frequencies or headings"
# What the libraries raise for a damaged file, and NumPy for contents of another kind than expected.
NETCDF_ERRORS = (OSError, RuntimeError, LookupError, AttributeError, TypeError, ValueError, ArithmeticError)
POINTER = 64  # bytes counted for a text or another value of variable length
DEEPEST = 8  # groups within groups


def require_size(path: Path, file: Any, largest: int, fix: str) -> None:
    """Raise unless all arrays together take ``largest`` bytes or less; nothing is read.

    A compressed or unwritten array takes a few bytes in the file, whatever size it is of in memory.

    Parameters
    ----------
    path : Path
    file : netCDF4.Dataset
        Open for reading.
    largest : int
        Bytes.
    fix : str
        What the message asks for.

    Raises
    ------
    FileFormatError
    """
    total = 0
    for place, variable in _variables(path, file, 0):
        total += _bytes(variable)
        if total > largest:
            raise FileFormatError(
                f"{path}: {place[:80]} has shape {tuple(variable.shape)}; with it the file's arrays take "
                f"{total / 2**20:.6g} MiB, above {largest / 2**20:g} MiB; {fix}"
            )


def _variables(path: Path, group: Any, depth: int) -> list[tuple[str, Any]]:
    if depth > DEEPEST:
        raise FileFormatError(f"{path}: groups are nested more than {DEEPEST} deep; write the file again")
    found = list(group.variables.items())
    for inner in group.groups.values():
        found += _variables(path, inner, depth + 1)
    return found


def _bytes(variable: Any) -> int:
    kind = variable.dtype
    each = kind.itemsize if isinstance(kind, np.dtype) else POINTER
    count = 1
    for size in variable.shape:
        count *= int(size)
    return int(count * each)
