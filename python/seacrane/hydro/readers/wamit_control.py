"""What the control files (``.frc``, ``.cfg``) of a WAMIT run say of the body."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.numbers_of_text import is_number, number_of_word
from seacrane.hydro.readers.wamit_listing import listing_lines

FloatArray = NDArray[np.float64]

IOPTN_MOTIONS = 3  # the fourth option of the second line


@dataclass(frozen=True, eq=False)
class ForceControl:
    """A ``.frc`` file of either form; what its form does not hold is None.

    Form 1 (IALTFRC=1): ``height_of_gravity`` and ``radii`` (3, 3) of gyration, m. Form 2 (IALTFRC=2):
    ``rho``, ``center_of_gravity`` (3,), ``mass``, ``damping``, ``stiffness`` (6, 6), all dimensional.
    ``motions_option`` is 1 for motions from Haskind forces, 2 from diffraction forces, 0 for none.
    """

    path: Path
    motions_option: int
    height_of_gravity: float | None = None
    radii: FloatArray | None = None
    rho: float | None = None
    center_of_gravity: FloatArray | None = None
    mass: FloatArray | None = None
    damping: FloatArray | None = None
    stiffness: FloatArray | None = None


def read_force_control(path: Path) -> ForceControl:
    """Read a ``.frc`` file of form 1 or 2, told apart by its fifth line (three radii, or the flag IMASS)."""
    reader = _ListDirected(path)
    reader.line("the heading")
    options = reader.take(9, "the nine options")
    motions = abs(int(options[IOPTN_MOTIONS]))
    first = reader.take(1, "VCG or the density")[0]
    row = reader.take(3, "the first radii of gyration or the centre of gravity")
    second_form = reader.count_numbers() < 3
    if second_form and not first > 0.0:
        raise FileFormatError(f"{path}, line 3: density {first:g}; give a positive one")
    if not second_form:
        radii = np.array([row, *(reader.take(3, "radii of gyration") for _ in range(2))])
        reader.take(1, "NBETAH")
        return ForceControl(path, motions, height_of_gravity=first, radii=radii)
    names = ("mass", "damping", "stiffness")
    matrices = [reader.matrix(f"external {name}") for name in names]
    reader.take(1, "NBETAH")
    mass, damping, stiffness = matrices
    return ForceControl(
        path,
        motions,
        rho=first,
        center_of_gravity=np.array(row),
        mass=mass,
        damping=damping,
        stiffness=stiffness,
    )


def check_period_output(path: Path) -> None:
    """Raise if a ``.cfg`` file makes the numeric files list something else than periods."""
    for number, line in enumerate(listing_lines(path), start=1):
        match = re.match(r"\s*(IPEROUT|IPERIO)\s*=\s*(-?\d+)", line, re.IGNORECASE)
        if match and match.group(2) != "1":
            raise FileFormatError(
                f"{path}, line {number}: {match.group(1)}={match.group(2)[:20]}: the files list frequencies "
                "or wave numbers; run WAMIT with periods (1)"
            )


class _ListDirected:
    """Numbers as Fortran's list-directed input takes them: over several lines, rest of a line dropped."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lines = listing_lines(path)
        self._next = 0

    def error(self, message: str) -> FileFormatError:
        return FileFormatError(f"{self.path}, line {max(self._next, 1)}: {message}")

    def line(self, what: str) -> str:
        if self._next >= len(self._lines):
            self._next = len(self._lines) + 1
            raise self.error(f"the file ends here, before {what}; it is truncated")
        self._next += 1
        return self._lines[self._next - 1]

    def take(self, count: int, what: str, *, over_lines: bool = False) -> list[float]:
        """The next ``count`` numbers, from the start of the next line."""
        values: list[float] = []
        while len(values) < count:
            if values and not over_lines:
                raise self.error(f"{what}: {count} numbers are expected, found {len(values)}")
            for word in self.line(what).replace(",", " ").split():
                if len(values) < count:
                    values.append(self._value(word, what))
        return values

    def matrix(self, what: str) -> FloatArray | None:
        """A flag, and a matrix (6, 6) if it is 1."""
        flag = self.take(1, f"the flag of the {what}")[0]
        if flag not in (0.0, 1.0):
            raise self.error(f"flag {flag:g} of the {what}: 0 or 1 is expected")
        if flag == 0.0:
            return None
        return np.array(self.take(36, f"the {what} matrix", over_lines=True)).reshape(6, 6)

    def count_numbers(self) -> int:
        """How many numbers the next line starts with, which stays."""
        words = self.line("IMASS or radii of gyration").replace(",", " ").split()
        self._next -= 1
        return sum(1 for _ in takewhile(is_number, words))

    def _value(self, word: str, what: str) -> float:
        try:
            return number_of_word(word)
        except ValueError as error:
            raise self.error(f"{what}: {error}") from None
