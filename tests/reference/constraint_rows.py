"""Constraint equations by kind, each vectorised over its instances.

Every row is c(q) = 0 with D v = 0 and D a = gamma, v stacked as (velocity of the centre of mass, angular
velocity), both inertial, body after body (paper eqs. 3, 7, 8). Kinds: `coincide` (two points, three rows),
`perpendicular` (two body-fixed vectors), `slide` (distance along a vector fixed in the first body),
`distance` (between two points).
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy import vecdot as dot

from .kinematics import Indices, VectorMotion
from .rotation import Array, cross, skew


@dataclass
class RowValues:
    """Residual (m), matrix D (m, n + 1, 6) with the ground last, right side gamma (m)."""

    residual: Array
    matrix: Array
    gamma: Array


@dataclass
class ConstraintRows:
    """All rows of a system. Add them joint by joint, then `freeze`."""

    bodies: int
    count: int = 0
    row_joint: list[int] = field(default_factory=list)
    row_second: list[int] = field(default_factory=list)
    entries: dict[str, list[tuple[float, ...]]] = field(default_factory=lambda: {kind: [] for kind in FILL})

    def add(self, kind: str, joint: int, first: int, second: int, *data: float) -> None:
        """Append an instance; `data` are vector indices, then a constant."""
        height = 3 if kind == "coincide" else 1
        self.entries[kind].append((self.count, first, second, *data))
        self.row_joint += [joint] * height
        self.row_second += [second] * height
        self.count += height

    def freeze(self) -> None:
        """Turn the lists into index arrays."""
        self.index = {
            kind: np.array([e[:6] for e in entries], dtype=float).astype(int).T if entries else None
            for kind, entries in self.entries.items()
        }
        self.constant = {kind: np.array([e[-1] for e in entries]) for kind, entries in self.entries.items()}
        self.joint_of_row = np.array(self.row_joint, dtype=int)
        self.second_of_row = np.array(self.row_second, dtype=int)

    def evaluate(self, x: VectorMotion) -> RowValues:
        n = self.count
        out = RowValues(np.zeros(n), np.zeros((n, self.bodies + 1, 6)), np.zeros(n))
        for kind, fill in FILL.items():
            index = self.index[kind]
            if index is not None:
                fill(out, x, index, self.constant[kind])
        return out


def _coincide(out: RowValues, x: VectorMotion, index: Indices, _: Array) -> None:
    row, first, second, i1, i2 = index[:5]
    rows = row[:, None] + np.arange(3)
    out.residual[rows] = x.point(i2) - x.point(i1)
    out.matrix[rows, first[:, None], :3] = -np.eye(3)
    out.matrix[rows, second[:, None], :3] = np.eye(3)
    out.matrix[rows, first[:, None], 3:] = skew(x.g[i1])
    out.matrix[rows, second[:, None], 3:] = -skew(x.g[i2])
    out.gamma[rows] = x.bias[i1] - x.bias[i2]


def _perpendicular(out: RowValues, x: VectorMotion, index: Indices, _: Array) -> None:
    row, first, second, i1, i2 = index[:5]
    g1, g2 = x.g[i1], x.g[i2]
    normal = cross(g2, g1)
    out.residual[row] = dot(g1, g2)
    out.matrix[row, first, 3:] = -normal
    out.matrix[row, second, 3:] = normal
    out.gamma[row] = -(dot(x.bias[i1], g2) + 2.0 * dot(x.rate[i1], x.rate[i2]) + dot(g1, x.bias[i2]))


def _slide(out: RowValues, x: VectorMotion, index: Indices, constant: Array) -> None:
    row, first, second, i1, i2, axis = index
    a = x.g[axis]
    d, rate = x.point(i2) - x.point(i1), x.point_velocity(i2) - x.point_velocity(i1)
    out.residual[row] = dot(a, d) - constant
    out.matrix[row, first, :3] = -a
    out.matrix[row, first, 3:] = cross(a, d) - cross(x.g[i1], a)
    out.matrix[row, second, :3] = a
    out.matrix[row, second, 3:] = cross(x.g[i2], a)
    out.gamma[row] = -(dot(x.bias[axis], d) + 2.0 * dot(x.rate[axis], rate) + dot(a, x.bias[i2] - x.bias[i1]))


def _distance(out: RowValues, x: VectorMotion, index: Indices, length: Array) -> None:
    row, first, second, i1, i2 = index[:5]
    d, rate = x.point(i2) - x.point(i1), x.point_velocity(i2) - x.point_velocity(i1)
    e = d / length[:, None]
    out.residual[row] = 0.5 * (dot(d, e) - length)
    out.matrix[row, first, :3] = -e
    out.matrix[row, first, 3:] = -cross(x.g[i1], e)
    out.matrix[row, second, :3] = e
    out.matrix[row, second, 3:] = cross(x.g[i2], e)
    out.gamma[row] = -dot(rate, rate) / length - dot(e, x.bias[i2] - x.bias[i1])


FILL = {"coincide": _coincide, "perpendicular": _perpendicular, "slide": _slide, "distance": _distance}
