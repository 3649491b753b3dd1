"""Minimal coordinates about a state at rest: null space of the constraints, rotations as small vectors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.one_thread import one_thread

Array = NDArray[np.float64]
NEUTRAL = 1e-6  # 1/s2: a weaker stiffness over mass (a period beyond 6283 s) counts as none
POSE_STEP = 1e-3  # m and rad
TWIST_STEP = 1e-3  # m/s and rad/s


class Terms:
    """Accelerations of a model at one time, over poses moved by small displacements and rotations."""

    def __init__(self, model: _core.Model, *, time: float) -> None:
        self.model = model
        self.time = time
        self.evaluator = _core.Evaluator(model)
        self.bodies = len(model.bodies)
        self.twists = slice(model.twist_index(0), model.twist_index(0) + 6 * self.bodies)
        self.memory = slice(self.twists.stop, self.twists.stop + model.memory_states)
        self.load_states = slice(self.memory.stop - len(model.load_states), self.memory.stop)
        self.load_scales = np.array([scale for *_, scale in model.load_states])

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(Terms, time=self.time), (self.model,)

    def checked(self, values: Array) -> Array:
        """The values, if there are as many finite ones as the model has states."""
        if values.shape != (self.model.states,) or not np.all(np.isfinite(values)):
            raise SceneError(
                f"state: holds {values.size} values, scene {self.model.name!r} needs {self.model.states} "
                "finite ones; give a state of this scene"
            )
        return values

    def moved(self, values: Array, *, displacement: Array, twist: Array | float = 0.0) -> Array:
        """State with bodies moved: (6 n) translations (m) and rotation vectors (rad), inertial axes."""
        y = np.array(values)
        for body, (shift, rotation) in enumerate(displacement.reshape(-1, 2, 3)):
            at = self.model.pose_index(body)
            y[at : at + 3] += shift
            y[at + 3 : at + 7] = _turned(y[at + 3 : at + 7], rotation)
        y[self.twists] += twist
        return y

    def rates(self, values: Array) -> Array:
        """Accelerations (6 n), then rates of the memory states."""
        rate = self.evaluator.derivative(self.time, values)
        return np.concatenate([rate[self.twists], rate[self.memory]])

    def drift(self, values: Array) -> Array:
        """Rates of the states that loads have of their own, over their scales, 1/s."""
        rate = self.evaluator.derivative(self.time, values)
        return np.asarray(rate[self.load_states] / self.load_scales)

    def exact_columns(self, values: Array, directions: Array) -> Array | None:
        """d(accelerations, memory rates) along directions (states, k); None where no exact Jacobian is."""
        try:
            jacobian = np.asarray(self.evaluator.jacobian(self.time, values))
        except ValueError:
            return None
        return np.asarray(np.vstack([jacobian[self.twists], jacobian[self.memory]]) @ directions)

    def pose_directions(self, values: Array, displacement: Array) -> Array:
        """Change of the state (states, k) with translations and rotation vectors (6 n, k), inertial axes."""
        out = np.zeros((values.size, displacement.shape[1]))
        for body, move in enumerate(displacement.reshape(self.bodies, 6, -1)):
            at = self.model.pose_index(body)
            w, v = values[at + 3], values[at + 4 : at + 7]
            out[at : at + 3] = move[:3]
            out[at + 3] = -0.5 * v @ move[3:]
            out[at + 4 : at + 7] = 0.5 * (w * move[3:] + np.cross(move[3:].T, v).T)
        return out

    def acceleration(self, values: Array) -> Array:
        """Accelerations (6 n), inertial axes, m/s2 and rad/s2."""
        return np.asarray(self.evaluator.derivative(self.time, values)[self.twists])


def _turned(quaternion: Array, rotation: Array) -> Array:
    """exp(rotation) applied after a quaternion (w, x, y, z)."""
    half = 0.5 * rotation
    angle = float(np.linalg.norm(half))
    w, v = np.cos(angle), half * np.sinc(angle / np.pi)
    scalar, vector = quaternion[0], quaternion[1:]
    return np.append(w * scalar - v @ vector, w * vector + scalar * v + np.cross(v, vector))


@dataclass(frozen=True, kw_only=True)
class ReducedCoordinates:
    """Orthonormal basis (6 n, degrees of freedom) of what the constraints allow at one state."""

    terms: Terms
    values: Array
    basis: Array

    @classmethod
    @one_thread
    def at(cls, terms: Terms, values: Array) -> ReducedCoordinates:
        """Of the null space of the constraint Jacobian D (paper eq. 4) at a state."""
        jacobian = terms.evaluator.terms(terms.time, values)["jacobian"]
        basis = np.eye(6 * terms.bodies)
        if jacobian.size:
            _, _, vt = np.linalg.svd(jacobian)
            basis = vt[vt.shape[0] - terms.model.degrees_of_freedom :].T
        return cls(terms=terms, values=values, basis=basis)

    @property
    def size(self) -> int:
        """Degrees of freedom."""
        return int(self.basis.shape[1])

    def pose_columns(self) -> Array:
        """d(accelerations, memory rates) / d(coordinates).

        Exact; by central differences of fourth order for a model without an exact Jacobian.
        """
        terms = self.terms
        exact = terms.exact_columns(self.values, terms.pose_directions(self.values, self.basis))
        if exact is not None:
            return exact
        columns = []
        for direction in self.basis.T:
            near, far = (
                self._difference(displacement=step * direction) / (2.0 * step)
                for step in (POSE_STEP, 2.0 * POSE_STEP)
            )
            columns.append((4.0 * near - far) / 3.0)
        return self._stacked(columns)

    def twist_columns(self) -> Array:
        """d(accelerations, memory rates) / d(speeds).

        Exact; else by differences: loads are linear, quadratic, or u |u| in the speeds, and 2 D(h) - D(2h)
        of the central differences D keeps the linear part alone.
        """
        directions = np.zeros((self.values.size, self.size))
        directions[self.terms.twists] = self.basis
        exact = self.terms.exact_columns(self.values, directions)
        if exact is not None:
            return exact
        columns = []
        for direction in self.basis.T:
            near, far = (
                self._difference(twist=step * direction) / (2.0 * step)
                for step in (TWIST_STEP, 2.0 * TWIST_STEP)
            )
            columns.append(2.0 * near - far)
        return self._stacked(columns)

    def memory_columns(self) -> Array:
        """d(accelerations, memory rates) / d(memory states), which is linear."""
        terms = self.terms
        exact = terms.exact_columns(self.values, np.eye(self.values.size)[:, terms.memory])
        if exact is not None:
            return exact
        scale = np.array(terms.model.scale)
        columns = []
        for i in range(terms.memory.start, terms.memory.stop):
            step = float(scale[i]) if np.isfinite(scale[i]) else 1.0
            high, low = np.array(self.values), np.array(self.values)
            high[i] += step
            low[i] -= step
            columns.append((terms.rates(high) - terms.rates(low)) / (2.0 * step))
        return self._stacked(columns)

    def stiffness(self) -> Array:
        """d(acceleration) / d(coordinates) in the coordinates, (dof, dof), 1/s2."""
        return np.asarray(self.basis.T @ self.pose_columns()[: 6 * self.terms.bodies])

    @one_thread
    def rest_matrix(self) -> tuple[Array, Array, Array]:
        """What a rest state is solved by: `stiffness` with the states of loads as further unknowns.

        A state on which no rate of a state depends, such as a paid-out length, rests anywhere: it is held.

        Returns
        -------
        ndarray, shape (dof + k, dof + k)
            Rows: accelerations, and k combinations of the drift; columns: coordinates, and k combinations of
            the states over their scales.
        ndarray, ndarray, shape (n, k)
            These combinations, of the drift and of the n states.
        """
        terms, scales = self.terms, self.terms.load_scales
        if not len(scales):
            none = np.zeros((0, 0))
            return self.stiffness(), none, none
        last = slice(-len(scales), None)
        poses, states = self.pose_columns(), self.memory_columns()[:, last] * scales
        u, size, vt = np.linalg.svd(states[last] / scales[:, None])
        rows, columns = u[:, size > NEUTRAL], vt[size > NEUTRAL].T
        both = np.hstack([poses, states @ columns])
        accelerations = self.basis.T @ both[: 6 * terms.bodies]
        return np.vstack([accelerations, rows.T @ (both[last] / scales[:, None])]), rows, columns

    def _difference(self, *, displacement: Array | float = 0.0, twist: Array | float = 0.0) -> Array:
        terms, y, still = self.terms, self.values, np.zeros(6 * self.terms.bodies)
        move, speed = still + displacement, still + twist
        high = terms.moved(y, displacement=move, twist=speed)
        low = terms.moved(y, displacement=-move, twist=-speed)
        return terms.rates(high) - terms.rates(low)

    def _stacked(self, columns: list[Array]) -> Array:
        rows = 6 * self.terms.bodies + self.terms.model.memory_states
        return np.column_stack(columns) if columns else np.zeros((rows, 0))
