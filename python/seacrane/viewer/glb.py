"""The container of binary glTF 2.0: two chunks, a JSON document and the numbers that it points into."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from typing import Any

import numpy as np

FLOAT, UNSIGNED = 5126, 5125
VERTICES, INDICES = 34962, 34963
TYPES = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}
HEADER, CHUNK = struct.Struct("<4sII"), struct.Struct("<I4s")
LARGEST = 2**32 - 2**20  # bytes: lengths have 32 bits


@dataclass
class Glb:
    """A document that grows: it holds lists of glTF, and `add` stores numbers and gives their accessor."""

    document: dict[str, Any]
    parts: list[bytes] = field(default_factory=list)
    size: int = 0

    def add(self, values: Any, *, target: int | None = None, bounds: bool = False) -> int:
        """Numbers (n,) or (n, 3 or 4) in single precision, or as indices if they are whole.

        Parameters
        ----------
        values : array_like
        target : int, optional
            VERTICES or INDICES.
        bounds : bool
            Whether to tell the lowest and highest, as glTF demands of positions and times.
        """
        array = np.asarray(values)
        whole = array.dtype.kind in "iu"
        array = array.astype("<u4" if whole else "<f4")
        data = array.tobytes()
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": len(data)}
        self._list("bufferViews").append(view | ({} if target is None else {"target": target}))
        accessor = {
            "bufferView": len(self._list("bufferViews")) - 1,
            "componentType": UNSIGNED if whole else FLOAT,
            "count": len(array),
            "type": TYPES[1 if array.ndim == 1 else array.shape[1]],
        }
        if bounds:
            rows = array.reshape(len(array), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        self._list("accessors").append(accessor)
        self.parts.append(data)
        self.size += len(data)
        return len(self._list("accessors")) - 1

    def _list(self, key: str) -> list[Any]:
        found: list[Any] = self.document.setdefault(key, [])
        return found

    def to_bytes(self) -> bytes:
        """The file; ValueError where it would be too large for the format."""
        document = self.document | {"buffers": [{"byteLength": self.size}]}
        text = json.dumps(document, allow_nan=False, separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)
        total = HEADER.size + 2 * CHUNK.size + len(text) + self.size
        if total > LARGEST:
            raise ValueError(f"takes {total} bytes, above {LARGEST}")
        chunks = [CHUNK.pack(len(text), b"JSON"), text, CHUNK.pack(self.size, b"BIN\0"), *self.parts]
        return b"".join([HEADER.pack(b"glTF", 2, total), *chunks])
