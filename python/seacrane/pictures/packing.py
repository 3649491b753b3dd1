"""Arrays of numbers as compact text that the page unpacks: rounded, differenced, gzip, base64."""

from __future__ import annotations

import base64
import gzip
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
LARGEST_COUNT = 2**28  # steps that a rounded value may be from zero: second differences then fit 32 bits


@dataclass
class Blob:
    """Arrays one after another, and where each is; `text` is what the page holds.

    Of a series, rows are what changes and columns are times. Its values are whole numbers of `step`, stored
    as second differences along the times, which are small, byte by byte of equal weight, which gzip likes.
    """

    parts: list[bytes] = field(default_factory=list)
    size: int = 0

    def series(self, values: Any, step: float) -> dict[str, Any]:
        """Add values (rows, times); each comes back within half a step. A step too fine for 32 bits grows."""
        rows = np.asarray(values, dtype=float)
        step = usable_step(rows, step)
        counts = np.rint(rows / step).astype(np.int64)
        second = np.diff(counts, n=2, axis=1, prepend=np.zeros((len(rows), 2), np.int64))
        folded = np.where(second >= 0, 2 * second, -2 * second - 1).astype("<u4")
        data = folded.reshape(-1).view(np.uint8).reshape(-1, 4).T.tobytes()
        return {**self._add(data), "shape": list(rows.shape), "step": step}

    def floats(self, values: Any) -> dict[str, Any]:
        """Add values as they are, in single precision."""
        return self._plain(np.asarray(values, dtype="<f4"))

    def whole(self, values: Any) -> dict[str, Any]:
        """Add indices."""
        return self._plain(np.asarray(values, dtype="<u4"))

    def _plain(self, array: NDArray[Any]) -> dict[str, Any]:
        return {**self._add(array.tobytes()), "shape": list(array.shape)}

    def _add(self, data: bytes) -> dict[str, Any]:
        at = self.size
        self.parts.append(data)
        self.size += len(data)
        return {"at": at}

    def text(self) -> str:
        """All of it; the same values make the same text."""
        return base64.b64encode(gzip.compress(b"".join(self.parts), compresslevel=6, mtime=0)).decode("ascii")


def usable_step(values: Array, step: float) -> float:
    """The step, or the finest with which the values fit."""
    largest = float(np.abs(values).max(initial=0.0))
    return max(step, largest / LARGEST_COUNT)


def rounded(values: Any, step: float) -> Array:
    """What the page reads of a series."""
    array = np.asarray(values, dtype=float)
    step = usable_step(array, step)
    return np.asarray(np.rint(array / step) * step)
