"""A `HydroGroup` with its memory in a file of ours."""

from __future__ import annotations

import zlib
from os import PathLike
from pathlib import Path
from typing import TypeVar

from seacrane.errors import FileFormatError
from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.hydro.data.packed import NOT_PACKED, packed, unpacked
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.shown import shown
from seacrane.inputs.user_cache import read_kept

Group = TypeVar("Group", bound=HydroGroupData)

MAGIC = b"seacrane hydro group "
VERSION = 1
MOST_BYTES = 1_000_000_000  # of the numbers, so that no damaged file fills the memory


def save_group(group: HydroGroupData, path: str | PathLike[str]) -> None:
    """Write ``group`` to ``path``: complete under its name, or not at all."""
    with atomic_write(Path(path)) as draft:
        draft.write_bytes(MAGIC + b"%d\n" % VERSION + zlib.compress(packed(group), 9))


def load_group(kind: type[Group], path: str | PathLike[str]) -> Group:
    """Read a file written by `save_group`, as a ``kind`` of `HydroGroupData`.

    Raises FileFormatError: the file is missing, damaged, or not one of ours.
    """
    source = Path(path)
    if not source.is_file():
        raise FileFormatError(f"{source}: no such file; give the path of a group that HydroGroup.save wrote")
    try:
        data = read_kept(source)
        if not data.startswith(MAGIC):
            raise FileFormatError(
                f"{source}: no group of seacrane; save one with HydroGroup.save, or read a panel code's "
                "files with load_database"
            )
        version, _, body = data[len(MAGIC) :].partition(b"\n")
        if version != b"%d" % VERSION:
            raise FileFormatError(
                f"{source}: is of format version {shown(version[:8].decode('ascii', 'replace'))}, and this "
                f"seacrane reads format version {VERSION}; save it again with HydroGroup.save"
            )
        reader = zlib.decompressobj()
        numbers = reader.decompress(body, MOST_BYTES)
        if not reader.eof:
            raise ValueError("it ends within its numbers")
        found: Group = unpacked(numbers, (kind,))
    except (OSError, zlib.error, *NOT_PACKED) as error:
        if isinstance(error, FileFormatError):
            raise
        raise FileFormatError(f"{source}: damaged group of seacrane ({error}); save it again") from error
    return found
