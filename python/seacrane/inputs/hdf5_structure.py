"""What an HDF5 file holds, looked at through h5py before the NetCDF library opens it.

That library follows every link when it opens a file, and takes what an array or a text announces: a file of
some hundred bytes could take all memory, or have another file of the machine read.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

import h5py
import numpy as np

from seacrane.errors import FileFormatError

LOOSEST = 2  # times the bytes of its arrays, which a file may take: all of it is read once
LARGEST_TEXTS = 128 * 2**20  # bytes; thousands of names, and events by the hundred thousand, take less
TEXT = 64  # bytes that Python takes for a text beside its characters
MOST_ENTRIES = 20_000  # groups, arrays and attributes; a result has some 300
MOST_AT_ONCE = 32  # texts in an attribute, which is read at once
DEEPEST = 8  # groups within groups
REFERENCE = np.dtype([("length", "<u4"), ("address", "<u8"), ("index", "<u4")])  # to a text, in the file
HEAP, HEAP_HEADER = b"GCOL\x01\0\0\0", 16  # mark and bytes of the head of a heap
PIECE = struct.Struct("<H6xQ")  # index and size of a piece of a heap
BLOCK = 2**24  # bytes read at a time
FILTERS = (h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32)


class Structure:
    """Every object of a file, each once, and what its arrays and texts take in memory.

    Nothing of an array is read but the lengths of its texts: many may be one and the same in the file.
    """

    def __init__(self, path: Path, largest: int, fix: str) -> None:
        self.path, self.largest, self.fix = path, largest, fix
        self.size = path.stat().st_size
        self.arrays = self.texts = self.entries = 0
        self.seen: set[int] = set()

    def check(self) -> None:
        """Raise FileFormatError for what no NetCDF writer makes, and for what takes too much memory.

        That is: links and storage that lead to another file, objects that are there twice (groups could then
        hold themselves), filters but deflate, shuffle and checksums, values of variable length but texts.
        """
        if self.size > LOOSEST * max(self.largest, LARGEST_TEXTS):
            raise FileFormatError(
                f"{self.path}: has {self.size / 2**20:.6g} MiB, for arrays of at most "
                f"{self.largest / 2**20:g} MiB; {self.fix or 'write the file again'}"
            )
        self._heaps()
        with h5py.File(self.path, "r") as file:
            if file.userblock_size or file.id.get_create_plist().get_sizes() != (8, 8):
                raise self._refuse("it", "has a user block or short addresses")
            left = [("", h5py.h5g.open(file.id, b"/"), 0)]
            while left:
                place, thing, depth = left.pop()
                self._enter(place or "the file", thing)
                if isinstance(thing, h5py.h5d.DatasetID):
                    self._array(place, thing)
                elif isinstance(thing, h5py.h5g.GroupID):
                    if depth > DEEPEST:
                        raise FileFormatError(
                            f"{self.path}: groups are nested more than {DEEPEST} deep; write the file again"
                        )
                    left += [(name, inner, depth + 1) for name, inner in self._members(place, thing)]

    def _refuse(self, place: str, what: str) -> FileFormatError:
        return FileFormatError(f"{self.path}: {place[:80]} {what}; write the file again")

    def _heaps(self) -> None:
        """Where a piece of a heap, which holds texts and references, has no size, HDF5 reads without end."""
        walked = 0
        with self.path.open("rb") as file:
            for start in _found(file, HEAP):
                file.seek(start + len(HEAP))
                (size,) = struct.unpack("<Q", file.read(8).ljust(8, b"\0"))
                walked += size
                if walked > 2 * self.size:
                    raise self._refuse("it", "has heaps that are larger than the file")
                file.seek(start)
                if not _sound_heap(file.read(size)):
                    raise self._refuse("it", f"has a damaged heap at byte {start}")

    def _count(self, more: int) -> None:
        self.entries += more
        if self.entries > MOST_ENTRIES:
            raise self._refuse("it", f"holds more than {MOST_ENTRIES} groups, arrays and attributes")

    def _members(self, place: str, group: Any) -> list[tuple[str, Any]]:
        self._count(group.get_num_objs())
        names: list[bytes] = []
        group.links.iterate(names.append)
        found = []
        for name in names:
            at = f"{place}/{name.decode('utf-8', 'replace')}".lstrip("/")
            if group.links.get_info(name).type != h5py.h5l.TYPE_HARD:
                raise self._refuse(at, "is a link to another place or file")
            found.append((at, h5py.h5o.open(group, name)))
        return found

    def _enter(self, place: str, thing: Any) -> None:
        """An object that was not met before, and its attributes."""
        address = h5py.h5o.get_info(thing).addr
        if address in self.seen:
            raise self._refuse(place, "is in the file more than once; a group could hold itself")
        self.seen.add(address)

        self._count(h5py.h5a.get_num_attrs(thing))
        names: list[bytes] = []
        h5py.h5a.iterate(thing, names.append)
        for name in names:
            attribute = h5py.h5a.open(thing, name)
            self._attribute(f"{place}: attribute {name.decode('utf-8', 'replace')}", attribute)

    def _attribute(self, place: str, attribute: Any) -> None:
        kind = attribute.get_type()
        if attribute.get_space().get_simple_extent_type() == h5py.h5s.NULL:
            return
        count = math.prod(attribute.shape)
        self._add_texts(place, count * kind.get_size())
        if _is_text(kind):
            if count > MOST_AT_ONCE and count * self.size > LARGEST_TEXTS:
                raise self._refuse(place, f"holds {count} texts")
            values = np.empty(attribute.shape, attribute.dtype)
            attribute.read(values)
            self._add_texts(place, sum(len(text) for text in values.ravel() if text is not None))
        elif _varies(kind) and not (attribute.name == b"DIMENSION_LIST" and count <= MOST_AT_ONCE):
            raise self._refuse(place, "has values of variable length that are no texts")

    def _array(self, place: str, array: Any) -> None:
        made, kind, shape = array.get_create_plist(), array.get_type(), array.shape
        if made.get_layout() == h5py.h5d.VIRTUAL or made.get_external_count():
            raise self._refuse(place, "is stored in another file")
        filters = [made.get_filter(i)[0] for i in range(made.get_nfilters())]
        if not set(filters) <= set(FILTERS) or len(set(filters)) < len(filters):
            raise self._refuse(place, "is packed by more than deflate, shuffle and a checksum, each once")
        if _varies(kind):
            raise self._refuse(place, "has values of variable length that are no texts")
        chunk = made.get_chunk() if made.get_layout() == h5py.h5d.CHUNKED else ()  # read as a whole
        each = TEXT if _is_text(kind) else kind.get_size()
        self.arrays += each * max(math.prod(shape), math.prod(chunk))
        if self.arrays > self.largest:
            raise too_large(self.path, place, shape, self.arrays, self.largest, self.fix)
        if _is_text(kind):
            self._texts(place, array)

    def _texts(self, place: str, array: Any) -> None:
        """The lengths of texts, as the references to them say that are stored in their place."""
        self._add_texts(place, TEXT * math.prod(array.shape))
        made, stored = array.get_create_plist(), []
        if made.get_layout() == h5py.h5d.CHUNKED and made.get_nfilters() == 0:
            each = math.prod(made.get_chunk())
            array.chunk_iter(lambda chunk: stored.append((chunk.byte_offset, each)))
        elif made.get_layout() == h5py.h5d.CONTIGUOUS:
            stored = [(array.get_offset(), math.prod(array.shape))] if array.get_storage_size() else []
        else:
            raise self._refuse(place, "holds texts that are packed")
        for offset, count in stored:
            references = np.fromfile(self.path, REFERENCE, count, offset=offset or 0)
            self._add_texts(place, int(references["length"].sum(dtype=np.int64)))

    def _add_texts(self, place: str, size: int) -> None:
        self.texts += size
        if self.texts > LARGEST_TEXTS:
            raise self._refuse(place, f"brings its texts and attributes above {LARGEST_TEXTS // 2**20} MiB")


def too_large(path: Path, name: str, shape: Any, total: int, largest: int, fix: str) -> FileFormatError:
    """The refusal of arrays that take too much memory."""
    return FileFormatError(
        f"{path}: {name[:80]} has shape {tuple(shape)}; with it the file's arrays take "
        f"{total / 2**20:.6g} MiB, above {largest / 2**20:g} MiB; {fix}"
    )


def _found(file: BinaryIO, mark: bytes) -> Iterator[int]:
    """Places of a mark in a file."""
    at, rest = 0, b""
    while block := file.read(BLOCK):
        window = rest + block
        place = window.find(mark)
        while place >= 0:
            back = file.tell()
            yield at - len(rest) + place
            file.seek(back)
            place = window.find(mark, place + 1)
        at, rest = at + len(block), window[1 - len(mark) :]


def _sound_heap(heap: bytes) -> bool:
    """Whether the pieces of a heap, each of which says how long it is, end within it; 0 is the free one."""
    at = HEAP_HEADER
    while at + PIECE.size <= len(heap):
        index, size = PIECE.unpack_from(heap, at)
        length = PIECE.size + -(-size // 8) * 8 if index else size
        if length < PIECE.size or at + length > len(heap):
            return False
        at += length
    return True


def _is_text(kind: Any) -> bool:
    return bool(kind.get_class() == h5py.h5t.STRING and kind.is_variable_str())


def _varies(kind: Any) -> bool:
    """Whether values are of variable length, or hold such, without being texts."""
    parts = (h5py.h5t.COMPOUND, h5py.h5t.ARRAY, h5py.h5t.VLEN)
    return kind.get_class() in parts and (
        kind.detect_class(h5py.h5t.VLEN) or kind.detect_class(h5py.h5t.STRING)
    )
