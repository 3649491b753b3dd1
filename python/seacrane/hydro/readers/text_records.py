"""Line-by-line reader of numeric text files whose errors name the file and the line."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.numbers_of_text import number_of_word
from seacrane.inputs.whole_file import read_whole

FloatArray = NDArray[np.float64]


class TextRecords:
    """Records (lines of whitespace-separated numbers) of one file, taken in order."""

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            self._lines = read_whole(path).decode("latin-1").splitlines()
        except OSError as error:
            raise FileFormatError(
                f"{path}: cannot be read ({error.strerror}); check the path and its rights"
            ) from error
        self._next = 0

    def error(self, message: str) -> FileFormatError:
        """Exception that names the file and the line read last."""
        return FileFormatError(f"{self.path}, line {max(self._next, 1)}: {message}")

    def text(self) -> str:
        """Next line as it is."""
        if self._next >= len(self._lines):
            self._next = len(self._lines) + 1
            raise self.error("the file ends here, too early; it is truncated")
        self._next += 1
        return self._lines[self._next - 1]

    def rest(self) -> Iterator[str]:
        """The lines that are left, as they are."""
        while self._next < len(self._lines):
            yield self.text()

    def peek(self) -> list[str]:
        """Words of the next line, which stays."""
        words = self.text().split()
        self._next -= 1
        return words

    def expect(self, count: int, reason: str) -> None:
        """Raise unless ``count`` more lines are there, before anything is allocated for them."""
        left = len(self._lines) - self._next
        if left < count:
            self._next = len(self._lines)
            raise self.error(
                f"{count} more lines follow from {reason}, but {left} are there; the file is truncated "
                "or its counts are wrong"
            )

    def numbers(self, count: int, what: str) -> list[float]:
        """Next line as ``count`` finite numbers."""
        words = self.text().split()
        if len(words) != count:
            raise self.error(f"{what}: {count} numbers are expected, found {len(words)}")
        return [self._number(word, what) for word in words]

    def integers(self, count: int, what: str) -> list[int]:
        """Next line as ``count`` integers."""
        values = self.numbers(count, what)
        if any(value != int(value) for value in values):
            raise self.error(f"{what}: whole numbers are expected, found {values}")
        return [int(value) for value in values]

    def table(self, rows: int, columns: int, what: str) -> FloatArray:
        """Next ``rows`` lines as finite numbers (rows, columns)."""
        start = self._next
        words = [line.split() for line in self._lines[start : start + rows]]
        if len(words) == rows and all(len(line) == columns for line in words):
            try:
                values = np.array(words, dtype=float)
            except ValueError:
                values = np.full((rows, columns), np.nan)
            if np.all(np.isfinite(values)):
                self._next += rows
                return values
        return np.array([self.numbers(columns, what) for _ in range(rows)])

    def finish(self) -> None:
        """Raise if anything but blank lines is left."""
        for line in self._lines[self._next :]:
            self._next += 1
            if line.strip():
                raise self.error("more lines than the counts in the header announce; the counts are wrong")

    def _number(self, word: str, what: str) -> float:
        try:
            return number_of_word(word)
        except ValueError as error:
            raise self.error(f"{what}: {error}") from None
