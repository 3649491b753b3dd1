"""The file of a run in progress: pieces of its outputs, each with the state where it ends.

A file is the line "seacrane partial result" and records. A record is its length (8 bytes), a body, and the
SHA-256 of both. A body is a line of JSON, the arrays that it lists as little-endian doubles, the state as
in a state file, and in the first record the scene as in a scene file. Records are added at the end and never
changed: whenever the writer is killed, what comes before the last one is whole, and a record that was broken
off is known by its length or its checksum.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import channel_of, dims_of
from seacrane.errors import FileFormatError
from seacrane.inputs import sole_writer
from seacrane.result.about import About, Event, parted

MAGIC = b"seacrane partial result\n"
LENGTH = struct.Struct("<Q")
DIGEST = hashlib.sha256().digest_size


@dataclass(frozen=True, kw_only=True, eq=False)
class Piece:
    """Outputs of a run from one moment to another, or all of them, as files hold them.

    Attributes
    ----------
    arrays : "time" and the channels.
    coords, about : As of `Result`.
    stats : Likewise, of all of the run until here.
    events : Of this piece.
    interrupted : False for the last piece of a run that reached its end.
    state : Where the piece ends, as a state file; empty where there is none.
    scene : What is run, as a scene file, in the first piece of a file; empty in the others.
    """

    arrays: Mapping[str, Array]
    coords: Mapping[str, Sequence[str]]
    stats: Mapping[str, Any]
    about: About = field(default_factory=About, repr=False)
    events: Sequence[Event] = ()
    interrupted: bool = True
    state: bytes = field(default=b"", repr=False)
    scene: bytes = field(default=b"", repr=False)

    @property
    def outputs(self) -> int:
        """How many."""
        return int(self.arrays["time"].size)

    @property
    def dims(self) -> dict[str, tuple[str, ...]]:
        """The dimensions of each channel."""
        return {name: dims_of(name, array.ndim) for name, array in self.arrays.items() if name != "time"}

    def to_bytes(self) -> bytes:
        """The body of a record."""
        header = {
            "arrays": [[name, list(array.shape)] for name, array in self.arrays.items()],
            "coords": {dim: list(names) for dim, names in self.coords.items()},
            "stats": {**self.stats, **self.about.to_attributes()},
            "events": [vars(event) for event in self.events],
            "interrupted": self.interrupted,
            "state": len(self.state),
            "scene": len(self.scene),
        }
        numbers = (np.ascontiguousarray(array, dtype="<f8").tobytes() for array in self.arrays.values())
        return b"".join([json.dumps(header).encode("ascii"), b"\n", *numbers, self.state, self.scene])

    @classmethod
    def from_bytes(cls, body: bytes, place: object) -> Piece:
        """What `to_bytes` made, found at a place.

        Raises FileFormatError for another version, ValueError, KeyError or TypeError for anything else.
        """
        end = body.index(b"\n") + 1
        header = json.loads(body[:end])
        arrays = {}
        for name, shape in header["arrays"]:
            count = int(np.prod(shape, dtype=object))
            if not all(type(n) is int and n >= 0 for n in shape) or 8 * count > len(body) - end:
                raise ValueError(f"array {name!r} of shape {shape} does not fit")
            arrays[name] = np.frombuffer(body, "<f8", count, end).reshape(shape).astype(np.float64)
            end += 8 * count
        stats, about = parted(place, header["stats"])
        last, scene = end + header["state"], header["scene"]
        if last + scene != len(body) or min(last - end, scene) < 0:
            raise ValueError("arrays, state and scene do not fill the record")
        if len({len(array) for array in arrays.values()}) != 1:
            raise ValueError("arrays differ in their outputs")
        return cls(
            arrays=arrays, coords=header["coords"], stats=stats, about=about, state=body[end:last],
            events=[Event(**event) for event in header["events"]], scene=body[last:],
            interrupted=bool(header["interrupted"]),
        )  # fmt: skip


def partial_path(path: Path) -> Path:
    """Where the outputs of a result are while its run is in progress."""
    return path.with_name(f"{path.name}.partial")


def is_partial(path: Path) -> bool:
    """Whether a file is one of these."""
    with path.open("rb") as file:
        return file.read(len(MAGIC)) == MAGIC


def pieces_of(file: BinaryIO, name: str | Path) -> Iterator[tuple[Piece, int]]:
    """All whole pieces, and the places where they end.

    Raises FileFormatError for a file of another kind, or a whole record that is no piece.
    """
    file.seek(0)
    start = file.read(len(MAGIC))
    if start != MAGIC:
        if MAGIC.startswith(start):
            return  # broken off before anything was in it
        raise FileFormatError(f"{name}: is not the file of a run; move it away")
    while True:
        head = file.read(LENGTH.size)
        if len(head) < LENGTH.size:
            return
        (length,) = LENGTH.unpack(head)
        if length > os.fstat(file.fileno()).st_size - file.tell() - DIGEST:
            return
        body = file.read(length)
        end = file.tell() + DIGEST
        if file.read(DIGEST) != hashlib.sha256(head + body).digest():
            return
        try:
            piece = Piece.from_bytes(body, name)
        except FileFormatError:
            raise
        except (LookupError, TypeError, ValueError, RecursionError) as error:
            raise FileFormatError(f"{name}: holds a piece that no run wrote: {error}") from error
        del body
        yield piece, end
        file.seek(end)


def read_partial(path: Path, largest: int, channels: Sequence[str] | None = None) -> Piece:
    """What is in the file of a run in progress, as `result_file.read_netcdf` gives it."""
    parts: dict[str, list[Array]] = {}
    events: list[Event] = []
    last, state, scene, total = None, b"", b"", 0
    with path.open("rb") as file:
        for piece, _ in pieces_of(file, path):
            for name, array in piece.arrays.items():
                if name == "time" or channels is None or channel_of(name) in channels:
                    parts.setdefault(name, []).append(array)
                    total += array.nbytes
            if total > largest:
                raise FileFormatError(
                    f"{path}: its arrays take more than {largest / 2**20:g} MiB; raise it with "
                    "Result.load(path, largest=...) if the file is yours"
                )
            events += piece.events
            last, state, scene = piece, piece.state or state, piece.scene or scene
    if last is None:
        raise FileFormatError(f"{path}: holds no outputs yet")
    arrays = {name: np.concatenate(several) for name, several in parts.items()}
    return replace(last, arrays=arrays, events=events, state=state, scene=scene)


class PartialFile:
    """Such a file, open for one writer: another one is refused while this one lives."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._number = -1
        self._end = 0

    def claim(self) -> None:
        """Open the file, made if absent, for this writer alone; FileExistsError if another one has it."""
        while self._number < 0:
            self._number = sole_writer.opened(self.path)
            if not sole_writer.claim(self._number):
                self._close()
                raise FileExistsError(
                    f"{self.path} is being written by another run; wait for its end, or give another name"
                )
            if not self.is_there():  # the run that had it has finished in between
                self._close()

    def is_there(self) -> bool:
        """Whether the file still has its name: nobody moved, removed or replaced it."""
        try:
            return os.path.samestat(os.fstat(self._number), os.stat(self.path))
        except FileNotFoundError:
            return False

    def pieces(self) -> Iterator[tuple[Piece, int]]:
        """As `pieces_of`."""
        with os.fdopen(os.dup(self._number), "rb") as file:
            yield from pieces_of(file, self.path)

    def keep_until(self, end: int) -> None:
        """Go on after a place where a piece ends; 0: after nothing."""
        os.ftruncate(self._number, end)
        self._end = end or sole_writer.write_at(self._number, MAGIC, 0)

    def append(self, piece: Piece) -> None:
        """Add a piece, which the disk holds when this returns.

        Raises OSError if there is no room; what was there before stays as it was.
        """
        body = piece.to_bytes()
        head = LENGTH.pack(len(body))
        left = memoryview(head + body + hashlib.sha256(head + body).digest())
        at = self._end
        try:
            while left:
                count = sole_writer.write_at(self._number, left, at)
                at, left = at + count, left[count:]
            os.fsync(self._number)
        except BaseException:
            with contextlib.suppress(OSError):
                os.ftruncate(self._number, self._end)
            raise
        self._end = at

    def release(self, *, remove: bool = False) -> None:
        """Give it up, and remove it where it holds nothing, or nothing that is of use any more."""
        if self._number < 0:
            return
        useless = (remove or os.fstat(self._number).st_size <= len(MAGIC)) and self.is_there()
        if useless and sole_writer.REMOVES_OPEN_FILES:
            self.path.unlink()
        self._close()
        if useless and not sole_writer.REMOVES_OPEN_FILES:
            with contextlib.suppress(PermissionError):  # another run has it by now
                self.path.unlink()

    def _close(self) -> None:
        os.close(self._number)
        self._number = -1
