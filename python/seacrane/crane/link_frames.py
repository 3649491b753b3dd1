"""The frames in which the points of a crane's file are given."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.file_table import FileTable
from seacrane.crane.mass_properties import Point
from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Placed:
    """A frame in the crane-foot frame at home: its axes (columns) and its origin, m."""

    axes: Array
    origin: Array

    def point(self, at: Array) -> Array:
        """A point of this frame, in the crane-foot frame."""
        return np.asarray(self.axes @ at + self.origin)

    def inner(self, axes: Array, origin: Array) -> Placed:
        """A frame that is given in this one."""
        return Placed(self.axes @ axes, self.point(origin))


FOOT_FRAME = Placed(np.eye(3), np.zeros(3))


@dataclass(frozen=True, eq=False)
class Frames:
    """Frame of every body by its name, and those of frames that are fixed to one.

    Attributes
    ----------
    placed : mapping of str to Placed
    holder : mapping of str to str
        The body that each frame is fixed to, where that is another.
    """

    placed: Mapping[str, Placed]
    holder: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of_foot(cls, bodies: Iterable[str]) -> Frames:
        """Where every point is given in the crane-foot frame at home."""
        return cls(dict.fromkeys(bodies, FOOT_FRAME))

    def body(self, name: str) -> str:
        """The body that a frame is fixed to."""
        return self.holder.get(name, name)

    def point(self, table: FileTable, body: str, at: Point) -> Array:
        """A point of a body's frame in the crane-foot frame at home, m."""
        return self._of(table, body).point(np.array(at))

    def axis(self, table: FileTable, body: str, key: str) -> Array:
        """A unit vector in the crane-foot frame at home; FileFormatError for none."""
        given = np.array(table.space_point(key))
        length = float(np.linalg.norm(given))
        if length == 0.0:
            raise FileFormatError(
                f"{table.source}: {table.label(key)} is all zero; write a direction, such as [0.0, 0.0, 1.0]."
            )
        return np.asarray(self._of(table, body).axes @ (given / length))

    def _of(self, table: FileTable, body: str) -> Placed:
        if body not in self.placed:
            known = ", ".join(self.placed) or "none"
            raise FileFormatError(
                f"{table.source}: {table.where} names body {shown(body)}; the crane has {known}."
            )
        return self.placed[body]
