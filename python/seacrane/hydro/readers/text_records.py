"""Text files of numbers: as Fortran writes them, and read so that errors name the file and the line."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.inputs.whole_file import read_whole

NUMBER = r"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[EeDd][-+]?\d+|[-+]\d{2,4})?"
LETTERLESS = re.compile(r"([-+]?(?:\d+(?:\.\d*)?|\.\d+))([-+]\d{2,4})")  # 1.2-101: no room for the E


def number_of_word(word: str) -> float:
    """The finite number that a word of a file stands for.

    Raises ValueError: the word, and what to do; the caller names file and line.
    """
    if "*" in word:
        raise ValueError(
            f"{word[:40]!r} stands for a number that did not fit its column; write the file again in wider "
            "columns, or correct the line"
        )
    plain = LETTERLESS.fullmatch(word)
    text = f"{plain[1]}E{plain[2]}" if plain else word.replace("D", "E").replace("d", "e")
    try:
        if "_" in text:
            raise ValueError
        value = float(text)
    except ValueError:
        raise ValueError(f"{word[:40]!r} is not a number") from None
    if not math.isfinite(value):
        raise ValueError(f"{word[:40]!r} is not a finite number")
    return value


def is_number(word: str) -> bool:
    """Whether a word stands for a number, or for one that did not fit its column."""
    return re.fullmatch(rf"{NUMBER}|\*+", word) is not None or word.lower().lstrip("+-") in ("nan", "inf")


def number_at(path: Path, line: int, word: str, what: str = "") -> float:
    """`number_of_word`, of a line of a file. Raises FileFormatError: which, and what stands there."""
    try:
        return number_of_word(word)
    except ValueError as error:
        raise FileFormatError(f"{path}, line {line}: {what}{error}") from None


def text_of(path: Path) -> str:
    """The characters of a file, whose lines end in a line feed. Raises FileFormatError: it cannot be read."""
    try:
        text = read_whole(path).decode("latin-1")
    except OSError as error:
        raise FileFormatError(
            f"{path}: cannot be read ({error.strerror}); check the path and its rights"
        ) from error
    return text.replace("\r\n", "\n").replace("\r", "\n")


class TextRecords:
    """Records (lines of whitespace-separated numbers) of one file, taken in order."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lines = text_of(path).removesuffix("\n").split("\n")
        self._next = 0

    def error(self, message: str) -> FileFormatError:
        """Exception that names the file and the line read last."""
        return FileFormatError(f"{self.path}, line {max(self._next, 1)}: {message}")

    def text(self, what: str) -> str:
        """Next line as it is, which holds ``what``."""
        if self._next >= len(self._lines):
            self._next = len(self._lines) + 1
            raise self.error(f"the file ends here, before {what}; it is truncated")
        self._next += 1
        return self._lines[self._next - 1]

    def rest(self) -> Iterator[str]:
        """The lines that are left, as they are."""
        while self._next < len(self._lines):
            yield self.text("its end")

    def peek(self, what: str) -> list[str]:
        """Words of the next line, which stays; a comma parts them too."""
        words = self.text(what).replace(",", " ").split()
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
        words = self.text(what).split()
        if len(words) != count:
            raise self.error(f"{what}: {count} numbers are expected, found {len(words)}")
        return [self.number(word, what) for word in words]

    def integers(self, count: int, what: str) -> list[int]:
        """Next line as ``count`` integers."""
        values = self.numbers(count, what)
        if any(value != int(value) for value in values):
            raise self.error(f"{what}: whole numbers are expected, found {values}")
        return [int(value) for value in values]

    def table(self, rows: int, columns: int, what: str) -> Array:
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

    def number(self, word: str, what: str) -> float:
        """A word of the line read last."""
        return number_at(self.path, max(self._next, 1), word, f"{what}: ")
