"""The one place where a NetCDF file is opened for reading: only once what it holds has been looked at."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

LARGEST_DATABASE = 512 * 2**20  # bytes; 1,000 frequencies x 72 headings take 20 MiB
TOO_LARGE = "no hydrodynamic database is: write it again with fewer frequencies or headings"
# What the libraries raise for a damaged file, and NumPy for contents of another kind than expected.
NETCDF_ERRORS = (OSError, RuntimeError, LookupError, AttributeError, TypeError, ValueError, ArithmeticError)


@contextlib.contextmanager
def open_netcdf(path: Path, largest: int = LARGEST_DATABASE, fix: str = TOO_LARGE) -> Iterator[Any]:
    """A `netCDF4.Dataset` open for reading, whose arrays come as they are (not masked).

    Parameters
    ----------
    path : Path
    largest : int
        Bytes that all arrays together may take in memory: a compressed or unwritten array takes a few bytes
        in the file, whatever size it is of.
    fix : str
        What the message asks for where they take more.

    Raises
    ------
    FileFormatError
        Before any array is read: for larger arrays, and for what `hdf5_structure` refuses.
    OSError, RuntimeError, ...
        What the libraries raise for a damaged file, one of `NETCDF_ERRORS`.
    """
    import h5py
    import netCDF4

    from seacrane.files.hdf5_structure import Structure

    if h5py.is_hdf5(path):
        Structure(path, largest, fix).check()
    with netCDF4.Dataset(path, "r") as file:
        file.set_auto_mask(False)
        if file.data_model.startswith("NETCDF3"):
            _require_size(path, file, largest, fix)
        yield file


def _require_size(path: Path, file: Any, largest: int, fix: str) -> None:
    """The classic format has no links and no compression, but may announce what was never written."""
    from seacrane.files.hdf5_structure import too_large

    total = 0
    for name, variable in file.variables.items():
        total += variable.dtype.itemsize * math.prod(variable.shape)
        if total > largest:
            raise too_large(path, name, variable.shape, total, largest, fix)
