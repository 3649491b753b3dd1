"""The one place where a file is taken into memory whole: never more than a file of its kind may have."""

from __future__ import annotations

import errno
import stat
from pathlib import Path

from seacrane.errors import FileFormatError

BYTE_ORDERS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16", b"\xef\xbb\xbf": "utf-8-sig"}
LARGEST_TABLE = 128 * 2**20  # bytes; VERES files of ten speeds take a few dozen MiB


def read_whole(path: Path, largest: int = LARGEST_TABLE, fix: str = "export less into one file") -> bytes:
    """The bytes of a file.

    Raises FileFormatError, which asks for `fix`, where it has more than the `largest` of its kind, and
    OSError where it cannot be read, or is a device or a pipe, which may have no end.
    """
    size = size_of(path)
    if size > largest:
        raise FileFormatError(f"{path}: is larger than {largest} bytes; {fix}")
    with path.open("rb") as file:
        return file.read(size)


def decoded(data: bytes) -> str:
    """The text of a file: UTF-16 or UTF-8 as its first bytes say, else UTF-8, else ISO-8859-1."""
    kind = BYTE_ORDERS.get(data[:3]) or BYTE_ORDERS.get(data[:2]) or "utf-8"
    try:
        return data.decode(kind)
    except UnicodeDecodeError:
        return data.decode("latin-1")


def size_of(path: Path) -> int:
    """Bytes of a file. Raises OSError where it is a device or a pipe: to open one could wait for ever."""
    found = path.stat()
    if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):
        raise OSError(errno.EINVAL, "is a device or a pipe, no file", str(path))
    return found.st_size
