"""The one place where NetCDF and HDF5 files are opened for reading: only once what they hold is looked at."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from seacrane.errors import FileFormatError
from seacrane.inputs.whole_file import size_of

LARGEST_DATABASE = 512 * 2**20  # bytes; 1,000 frequencies x 72 headings take 20 MiB
CDF5 = b"CDF\x05"  # classic, with counts of 64 bits
TOO_LARGE = "no hydrodynamic database is: write it again with fewer frequencies or headings"
# What the libraries raise for a damaged file, and NumPy for contents of another kind than expected.
NETCDF_ERRORS = (OSError, RuntimeError, LookupError, AttributeError, TypeError, ValueError, ArithmeticError)


@contextlib.contextmanager
def open_netcdf(path: Path, largest: int = LARGEST_DATABASE, fix: str = TOO_LARGE) -> Iterator[Any]:
    """A `netCDF4.Dataset` open for reading, whose arrays come as they are (not masked).

    Parameters
    ----------
    largest : int
        Bytes that all arrays together may take in memory: a compressed or unwritten array takes a few bytes
        in the file, whatever size it is of.
    fix : What the message asks for where they take more.

    Raises
    ------
    FileFormatError
        Before any array is read: for larger arrays, and for what `hdf5_structure` refuses.
    OSError, RuntimeError, ...
        What the libraries raise for a damaged file, one of `NETCDF_ERRORS`; for a device or a pipe.
    """
    import h5py
    import netCDF4

    from seacrane.inputs.hdf5_structure import Structure

    size_of(path)
    if h5py.is_hdf5(path):
        Structure(path, largest, fix).check()
    elif (kind := _first_bytes(path)) == CDF5:
        raise FileFormatError(f"{path}: is a NetCDF file of the kind CDF-5; write it as NetCDF-4")
    elif kind.startswith(b"CDF"):
        _check_classic(path, largest, fix)
    with netCDF4.Dataset(path, "r") as file:
        file.set_auto_mask(False)
        yield file


@contextlib.contextmanager
def open_hdf5(path: Path, largest: int = LARGEST_DATABASE, fix: str = TOO_LARGE) -> Iterator[Any]:
    """An `h5py.File` open for reading; parameters and errors as `open_netcdf`."""
    import h5py

    from seacrane.inputs.hdf5_structure import Structure

    size_of(path)
    Structure(path, largest, fix).check()
    with h5py.File(path, "r") as file:
        yield file


def _first_bytes(path: Path) -> bytes:
    with path.open("rb") as file:
        return file.read(len(CDF5))


def _check_classic(path: Path, largest: int, fix: str) -> None:
    """The classic format has no links and no compression, but its header may announce what is not there.

    SciPy reads the header in Python, as far as the file goes; the C library takes memory for all that the
    header counts, and ends the process where there is none.
    """
    from scipy.io import netcdf_file

    from seacrane.inputs.hdf5_structure import too_large

    total = 0
    with contextlib.closing(netcdf_file(path, "r", mmap=True)) as file:
        shapes = {name: (each.itemsize(), each.shape) for name, each in file.variables.items()}
    for name, (size, shape) in shapes.items():
        total += size * math.prod(shape)
        if total > largest:
            raise too_large(path, name, shape, total, largest, fix)
