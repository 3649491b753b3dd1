"""The files of a Zarr store's chunks: what each pack left of them, and whether it is still there.

Zarr reads a chunk that is missing as its fill value, without a word. So the mark of a pack tells the size and
the CRC-32 of every chunk of its members.
"""

from __future__ import annotations

import os
import re
import stat
import zlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.errors import FileFormatError
from seacrane.inputs.json_text import json_of
from seacrane.inputs.whole_file import read_whole

LARGEST_MARK = 2**26  # bytes
LARGEST_CHUNK = 2**31  # bytes
LARGEST_DESCRIPTION = 2**24  # bytes of a zarr.json
MISSING = "is missing"
UNFINISHED = re.compile(r".+\.[0-9a-f]{32}\.partial")  # what Zarr's own writing leaves where it is killed

Noted = list[int] | None
"""Size in bytes and CRC-32 of a file; None where there is none, as of a chunk of nothing but fill values."""


def chunks_of(
    folder: Path, dims: Mapping[str, int], indices: Sequence[int], shape: Sequence[int]
) -> Iterator[tuple[str, list[str]]]:
    """By variable, the files of members.

    Parameters
    ----------
    folder : Of the group.
    dims : mapping of str to int
        Number of own dimensions of each variable, each of one chunk.
    indices, shape
        Numbers of members, and lengths of the ensemble.
    """
    places = np.stack(np.unravel_index(indices, tuple(shape)), axis=1).tolist()
    for name, own in dims.items():
        yield name, ["/".join(map(str, (folder, name, "c", *place, *[0] * own))) for place in places]


def noted(file: str) -> Noted:
    """What a mark tells of a file."""
    if not os.path.exists(file):
        return None
    data = read_whole(Path(file), LARGEST_CHUNK, "no chunk is")
    return [len(data), zlib.crc32(data)]


def wrong(file: str, there: Noted, *, read: bool) -> str:
    """What is wrong with a file, by its size, and where it is to be read by its contents too; or nothing."""
    try:
        found = os.stat(file, follow_symlinks=False)
    except FileNotFoundError:
        return "" if there is None else MISSING
    if not stat.S_ISREG(found.st_mode):
        return "is no file"
    if there is None:
        return "was not written by its pack"
    if found.st_size != there[0]:
        return f"has {found.st_size} bytes for {there[0]}"
    return "has other contents than were written" if read and noted(file) != there else ""


def mark_text(indices: Sequence[int], chunks: Mapping[str, Sequence[Noted]]) -> dict[str, Any]:
    """What the mark of a pack says."""
    return {"members": list(indices), "chunks": {name: list(each) for name, each in chunks.items()}}


def read_mark(path: Path) -> tuple[list[int], dict[str, list[Noted]]]:
    """Members of a pack, and what it left of each.

    Raises FileFormatError if it is no mark.
    """
    found = json_of(read_whole(path, LARGEST_MARK, "no mark of a pack is"), str(path))
    told: dict[str, Any] = found if isinstance(found, dict) else {}
    members, chunks = told.get("members"), told.get("chunks")
    sound = isinstance(members, list) and all(type(one) is int and one >= 0 for one in members)
    if not (members and sound and _are_noted(chunks, len(members))):
        raise FileFormatError(f"{path}: is no mark of a pack")
    return list(members), dict(chunks or {})


def _are_noted(chunks: Any, count: int) -> bool:
    return isinstance(chunks, dict) and all(
        isinstance(each, list)
        and len(each) == count
        and all(
            one is None or (isinstance(one, list) and [type(n) for n in one] == [int, int]) for one in each
        )
        for each in chunks.values()
    )


def require_files(folder: Path) -> None:
    """Refuse a device, a pipe or a link within a group, and too large a description: Zarr would read them.

    Raises
    ------
    FileFormatError
    """
    left = [folder]
    while left:
        with os.scandir(left.pop()) as entries:
            for entry in entries:
                if entry.is_dir(follow_symlinks=False):
                    left.append(Path(entry.path))
                elif not entry.is_file(follow_symlinks=False):
                    raise FileFormatError(f"{entry.path}: is a device, a pipe or a link, no file; remove it")
                elif entry.name == "zarr.json" and entry.stat().st_size > LARGEST_DESCRIPTION:
                    raise FileFormatError(
                        f"{entry.path}: is larger than {LARGEST_DESCRIPTION} bytes; no array of ours is"
                    )


def remove_unfinished(folder: Path) -> None:
    """Remove what Zarr did not end to write; for who knows that nobody else writes there."""
    for within, _, names in os.walk(folder):
        for name in filter(UNFINISHED.fullmatch, names):
            os.unlink(os.path.join(within, name))
