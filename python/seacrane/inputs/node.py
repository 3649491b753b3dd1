"""One value inside a parsed scene file, which knows its place in it."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.shown import shown


@dataclass(frozen=True)
class Node:
    """A value of a JSON document and its path, such as "lift.json: bodies[2].mass"."""

    value: Any
    path: str

    def fail(self, fix: str) -> NoReturn:
        """Raise a FileFormatError that names the place, the value and the fix."""
        raise FileFormatError(f"{self.path} is {shown(self.value)}; {fix}")

    @contextlib.contextmanager
    def scene_errors(self) -> Iterator[None]:
        """What the scene refuses inside the block is refused at this place of the file."""
        try:
            yield
        except (SceneError, TypeError) as error:
            raise FileFormatError(f"{self.path}: {error}") from error

    def expect(self, keys: Sequence[str]) -> None:
        """Fail unless this is an object with these keys, and no others."""
        if not isinstance(self.value, dict):
            self.fail(f"give an object with {', '.join(keys)}")
        missing = [key for key in keys if key not in self.value]
        unknown = [key for key in self.value if key not in keys]
        if missing:
            raise FileFormatError(f"{self.path}: has no {missing[0]!r}; add it")
        if unknown:
            raise FileFormatError(
                f"{self.path}: has an unknown entry {shown(unknown[0])}; known are {', '.join(keys)}"
            )

    def at(self, key: str) -> Node:
        """The entry of that name."""
        if not isinstance(self.value, dict) or key not in self.value:
            raise FileFormatError(f"{self.path}: has no {key!r}; add it")
        return Node(self.value[key], f"{self.path}{'.' if ': ' in self.path else ': '}{key}")

    def values(self) -> list[Any]:
        """The members of a list as they are."""
        if not isinstance(self.value, list):
            self.fail("give a list")
        return self.value

    def items(self) -> Iterator[Node]:
        """The members of a list, one after the other: a node takes a hundred times what a number does."""
        for i, value in enumerate(self.values()):
            yield Node(value, f"{self.path}[{i}]")

    def text(self) -> str:
        """A text."""
        if not isinstance(self.value, str):
            self.fail("give a text")
        return str(self.value)

    def flag(self) -> bool:
        """true or false."""
        if not isinstance(self.value, bool):
            self.fail("give true or false")
        return bool(self.value)

    def whole(self) -> int:
        """A whole number that fits 32 bits."""
        if not isinstance(self.value, int) or isinstance(self.value, bool) or abs(self.value) >= 2**31:
            self.fail("give a whole number")
        return int(self.value)

    def number(self) -> float:
        """A finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, (int, float)):
            self.fail("give a number")
        try:
            number = float(self.value)
        except OverflowError:
            self.fail("give a number below 1.8e308")
        if not math.isfinite(number):
            self.fail("give a finite number")
        return number

    def array(self, shape: tuple[int, ...]) -> Array:
        """Numbers of that shape, -1 standing for any length; an empty list has every length 0."""
        values = self.values()
        if shape[0] not in (-1, len(values)):
            raise FileFormatError(f"{self.path}: has {len(values)} entries; give {shape[0]}")
        if len(shape) == 1:
            return self._numbers(values)
        rows = [item.array(shape[1:]) for item in self.items()]
        inner = rows[0].shape if rows else tuple(max(length, 0) for length in shape[1:])
        if any(row.shape != inner for row in rows):
            raise FileFormatError(f"{self.path}: has rows of several lengths; give rows of one length")
        return np.array(rows, dtype=float).reshape(len(rows), *inner)

    def _numbers(self, values: list[Any]) -> Array:
        if {int, float}.issuperset(map(type, values)):
            with contextlib.suppress(OverflowError):
                array = np.array(values, dtype=float)
                if np.isfinite(array).all():
                    return array
        return np.array([item.number() for item in self.items()], dtype=float)  # names the one that is none

    def curve(self) -> _core.Curve:
        """A reference curve, as `Curve.to_pieces` gives it."""
        self.expect(("starts", "coefficients", "cosines"))
        starts, coefficients = self.at("starts").array((-1,)), self.at("coefficients").array((-1, 6))
        cosines = self.at("cosines").array((-1, 3))
        with self.scene_errors():
            return _core.Curve.pieces(
                starts=starts.tolist(), coefficients=coefficients.tolist(), cosines=cosines.tolist()
            )
