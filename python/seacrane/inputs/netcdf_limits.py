"""The one place where NetCDF and HDF5 files are opened for reading: once their arrays are known to fit."""

from __future__ import annotations

import contextlib
import math
import mmap
import re
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from seacrane.errors import FileFormatError
from seacrane.inputs.whole_file import size_of

LARGEST_DATABASE = 512 * 2**20  # bytes; 1,000 frequencies x 72 headings take 20 MiB
LOOSEST, NAMES = 2, 256 * 2**20  # a file may have this times the bytes of its arrays, or so many bytes
CDF5 = b"CDF\x05"  # classic, with counts of 64 bits
TOO_LARGE = "no hydrodynamic database is: write it again with fewer frequencies or headings"
HEAP, HEAP_HEADER = b"GCOL\x01\0\0\0", 16  # mark and bytes of the head of an HDF5 heap, of texts
PIECE = struct.Struct("<H6xQ")  # index and size of a piece of a heap
# What the libraries raise for a damaged file, and NumPy for contents of another kind than expected.
NETCDF_ERRORS = (OSError, RuntimeError, LookupError, AttributeError, TypeError, ValueError, ArithmeticError)
Arrays = Iterator[tuple[str, tuple[int, ...], int]]  # name, shape, and bytes in memory


@contextlib.contextmanager
def open_netcdf(path: Path, largest: int = LARGEST_DATABASE, fix: str = TOO_LARGE) -> Iterator[Any]:
    """A `netCDF4.Dataset` open for reading, whose arrays come as they are (not masked).

    Raises FileFormatError, which asks for `fix`, before any array is read, where all together would take
    more than `largest` bytes in memory, and for damaged heaps; one of `NETCDF_ERRORS` for other damage.
    """
    import netCDF4

    _require_fit(path, largest, fix)
    with netCDF4.Dataset(path, "r") as file:
        file.set_auto_mask(False)
        yield file


@contextlib.contextmanager
def open_hdf5(path: Path) -> Iterator[Any]:
    """An `h5py.File` of a database open for reading; errors as `open_netcdf`."""
    import h5py

    _require_fit(path, LARGEST_DATABASE, TOO_LARGE)
    with h5py.File(path, "r") as file:
        yield file


def _require_fit(path: Path, largest: int, fix: str) -> None:
    size, total = size_of(path), 0
    if size > max(LOOSEST * largest, NAMES):
        raise FileFormatError(
            f"{path}: has {size / 2**20:.6g} MiB, for arrays of at most {largest / 2**20:g} MiB; {fix}"
        )
    for name, shape, taken in arrays_in(path):
        total += taken
        if total > largest:
            raise FileFormatError(
                f"{path}: {name[:80]} has shape {shape}; with it the file's arrays take "
                f"{total / 2**20:.6g} MiB, above {largest / 2**20:g} MiB; {fix}"
            )


def arrays_in(path: Path) -> Arrays:
    """The arrays that a file announces; raises FileFormatError, or one of `NETCDF_ERRORS`."""
    import h5py

    if h5py.is_hdf5(path):
        _require_sound_heaps(path)
        yield from _in_hdf5(path)
        return
    with path.open("rb") as file:
        kind = file.read(len(CDF5))
    if kind == CDF5:
        raise FileFormatError(f"{path}: is a NetCDF file of the kind CDF-5; write it as NetCDF-4")
    if kind.startswith(b"CDF"):
        yield from _in_classic(path)


def _in_hdf5(path: Path) -> Arrays:
    """Each array once; HDF5 unfolds a chunk as a whole."""
    import h5py

    found: list[tuple[str, Any]] = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, one: found.append((name, one)))
        for name, one in [("/", file), *found]:
            if isinstance(one, h5py.Group):
                _require_tree(path, name, one)
            if isinstance(one, h5py.Dataset) and one.shape is not None:
                count = max(math.prod(one.shape), math.prod(one.chunks or ()))
                yield name, one.shape, one.dtype.itemsize * count


def _require_tree(path: Path, name: str, group: Any) -> None:
    """netCDF-C follows a link from a group to one above for ever, and ends the process."""
    import h5py

    linked = [key for key in group if not isinstance(group.get(key, getlink=True), h5py.HardLink)]
    if linked or h5py.h5o.get_info(group.id).rc > 1:
        fault = f"has a link {linked[0]}" if linked else "stands in more than one place"
        raise FileFormatError(f"{path}: group {name} {fault}; write the file again without links")


def _in_classic(path: Path) -> Arrays:
    """By SciPy, in Python: the C library takes memory for all that is counted, and may end the process."""
    from scipy.io import netcdf_file

    with contextlib.closing(netcdf_file(path, "r", mmap=True)) as file:
        shapes = {name: (each.itemsize(), each.shape) for name, each in file.variables.items()}
    yield from ((name, shape, size * math.prod(shape)) for name, (size, shape) in shapes.items())


def _require_sound_heaps(path: Path) -> None:
    """HDF5 reads for ever where the pieces of a heap, each of which has its length, do not end in it."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        for start in [found.start() for found in re.finditer(HEAP, data)]:
            at = start + HEAP_HEADER
            end = start + int.from_bytes(data[start + len(HEAP) : at], "little")
            while at + PIECE.size <= end:
                index, size = PIECE.unpack_from(data, at) if at + PIECE.size <= len(data) else (1, end)
                length = PIECE.size + -(-size // 8) * 8 if index else size  # 0 is the free piece
                at += length if length >= PIECE.size else end
            if at > end:
                raise FileFormatError(f"{path}: has a damaged heap at byte {start}; write the file again")
