"""State of all bodies, and vectors fixed in bodies: their inertial components and derivatives."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .rotation import Array, cross

Indices = NDArray[np.int_]


@dataclass
class Motion:
    """n bodies, with the fixed ground as the last row: centres of mass r and their velocities v (n + 1, 3),
    rotations (n + 1, 3, 3) body to inertial, angular velocities w (n + 1, 3), all inertial."""

    r: Array
    rotation: Array
    v: Array
    w: Array

    def twists(self) -> Array:
        """Velocities (6 n) of the moving bodies: v, w of body 0, v, w of body 1, ..."""
        return np.concatenate([self.v[:-1], self.w[:-1]], axis=1).ravel()

    def copy(self) -> Motion:
        return Motion(self.r.copy(), self.rotation.copy(), self.v.copy(), self.w.copy())


@dataclass
class BodyVectors:
    """Registry of body-fixed vectors, so that all of them are rotated in one vectorised operation."""

    owners: list[int] = field(default_factory=list)
    local: list[Array] = field(default_factory=list)

    def add(self, body: int, rotation: Array, inertial: ArrayLike) -> int:
        """Register the vector that has these inertial components when the body has this rotation."""
        self.owners.append(body)
        self.local.append(rotation.T @ np.asarray(inertial, dtype=float))
        return len(self.owners) - 1

    def freeze(self) -> None:
        """Turn the lists into arrays; no vector may be added afterwards."""
        self.owner_array = np.array(self.owners, dtype=int)
        self.local_array = np.array(self.local).reshape(-1, 3, 1)

    def evaluate(self, motion: Motion) -> VectorMotion:
        """Rotate every registered vector."""
        g = np.matmul(motion.rotation[self.owner_array], self.local_array)[:, :, 0]
        w = motion.w[self.owner_array]
        rate = cross(w, g)
        return VectorMotion(motion, self.owner_array, g, rate, cross(w, rate))


@dataclass
class VectorMotion:
    """Inertial components g (k, 3), their rates, and second derivatives without angular acceleration."""

    motion: Motion
    owner: Indices
    g: Array
    rate: Array
    bias: Array

    def point(self, index: Indices | int) -> Array:
        """Inertial position of centre of mass plus vector."""
        return np.asarray(self.motion.r[self.owner[index]] + self.g[index])

    def point_velocity(self, index: Indices | int) -> Array:
        return np.asarray(self.motion.v[self.owner[index]] + self.rate[index])
