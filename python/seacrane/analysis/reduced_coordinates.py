"""Minimal coordinates about a state at rest: null space of the constraints, rotations as small vectors."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.one_thread import one_thread

NEUTRAL = 1e-6  # 1/s2: a weaker stiffness over mass (a period beyond 6283 s) counts as none
INDEPENDENT = 1e-9  # ratio of pivots of constraints
POSE = 7  # states of a body's pose: place and quaternion
POSE_STEP = 1e-3  # m and rad
TWIST_STEP = 1e-3  # m/s and rad/s
LARGEST_MOVE = 0.5  # m and rad in one step
MOST_STEPS = 800
SETTLED = 1e-3  # m/s2, rad/s2 and 1/s: from here on Newton's method converges
UPRIGHT = 1.4  # rad
FIRST_STEP = 0.1  # s
LONGEST_STEP = 100.0
GROWTH = (0.2, 4.0)  # of a step to the next
AHEAD = 0.9  # cosine between forces: the motion goes on as before
SHORTER, LONGER = 0.5, 1.5
RETURN = 1.15  # of the longest step, at each step that is none
BEYOND = 1.5  # 1/step^2 over the fastest growth


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
        poses, moves = y[: POSE * self.bodies].reshape(-1, POSE), displacement.reshape(-1, 6)
        poses[:, :3] += moves[:, :3]
        poses[:, 3:] = _turned(poses[:, 3:], moves[:, 3:])
        y[self.twists] += twist
        return y

    def rates(self, values: Array) -> Array:
        """Accelerations (6 n), then rates of the memory states."""
        rate = self.evaluator.derivative(self.time, values)
        return np.concatenate([rate[self.twists], rate[self.memory]])

    def acceleration_and_drift(self, values: Array) -> tuple[Array, Array]:
        """Accelerations (6 n), m/s2 and rad/s2, and rates of the states of loads over their scales, 1/s."""
        rate = self.evaluator.derivative(self.time, values)
        return rate[self.twists], np.asarray(rate[self.load_states] / self.load_scales)

    def exact_rates(self, values: Array) -> Array | None:
        """d(accelerations, memory rates) / d(states); None where no exact Jacobian is."""
        try:
            jacobian = np.asarray(self.evaluator.jacobian(self.time, values))
        except ValueError:
            return None
        return np.asarray(np.vstack([jacobian[self.twists], jacobian[self.memory]]))

    def pose_directions(self, values: Array, displacement: Array) -> Array:
        """Change of the state (states, k) with translations and rotation vectors (6 n, k), inertial axes."""
        out = np.zeros((values.size, displacement.shape[1]))
        rates = out[: POSE * self.bodies].reshape(self.bodies, POSE, -1)
        moves = displacement.reshape(self.bodies, 6, -1)
        turn, quaternion = moves[:, 3:], values[: POSE * self.bodies].reshape(-1, POSE)[:, 3:, None]
        w, v = quaternion[:, :1], quaternion[:, 1:]
        rates[:, :3] = moves[:, :3]
        rates[:, 3] = -0.5 * (v * turn).sum(axis=1)
        rates[:, 4:] = 0.5 * (w * turn + _cross(turn, v))
        return out


def at_rest(model: _core.Model, values: Array) -> Array:
    """The same poses and states of loads, with all velocities, states of the fluid and work at zero."""
    y = np.array(values)
    y[model.twist_index(0) :] = 0.0
    kept = [place for _, _, place, *_ in model.load_states]
    y[kept] = np.asarray(values)[kept]
    return y


def _turned(quaternions: Array, rotations: Array) -> Array:
    """exp(rotation) (n, 3) applied after quaternions (n, 4), (w, x, y, z)."""
    half = 0.5 * rotations
    angle = np.linalg.norm(half, axis=1, keepdims=True)
    w, v = np.cos(angle), half * np.sinc(angle / np.pi)
    scalar, vector = quaternions[:, :1], quaternions[:, 1:]
    turned = w * vector + scalar * v + _cross(v, vector)
    return np.hstack([w * scalar - (v * vector).sum(axis=1, keepdims=True), turned])


def _cross(a: Array, b: Array) -> Array:
    """Cross products of vectors along the second axis; numpy.cross takes ten times longer for a few."""
    return np.stack([
        a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
        a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
    ], axis=1)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class ReducedCoordinates:
    """Orthonormal basis (6 n, degrees of freedom) of what the constraints allow at one state."""

    terms: Terms
    values: Array
    basis: Array

    @classmethod
    @one_thread
    def at(cls, terms: Terms, values: Array) -> ReducedCoordinates:
        """A basis of the null space of the constraint Jacobian D (paper eq. 4) at a state."""
        jacobian = terms.evaluator.terms(terms.time, values)["jacobian"]
        basis = np.eye(6 * terms.bodies)
        if jacobian.size:
            _, _, vt = np.linalg.svd(jacobian)
            basis = vt[vt.shape[0] - terms.model.degrees_of_freedom :].T
        return cls(terms=terms, values=values, basis=basis)

    @classmethod
    def quickly_at(cls, terms: Terms, values: Array) -> ReducedCoordinates:
        """As `at` with another basis, by QR where no constraint depends on others: a third of the time."""
        jacobian = terms.evaluator.terms(terms.time, values)["jacobian"]
        rows = len(jacobian)
        if not rows or rows != 6 * terms.bodies - terms.model.degrees_of_freedom:
            return cls.at(terms, values)
        q, r = np.linalg.qr(jacobian.T, mode="complete")
        pivots = np.abs(np.diagonal(r))
        if pivots.min() <= INDEPENDENT * pivots.max():
            return cls.at(terms, values)
        return cls(terms=terms, values=values, basis=q[:, rows:])

    @property
    def size(self) -> int:
        """Degrees of freedom."""
        return int(self.basis.shape[1])

    @cached_property
    def _exact(self) -> Array | None:
        return self.terms.exact_rates(self.values)

    def pose_columns(self) -> Array:
        """d(accelerations, memory rates) / d(coordinates).

        Exact; by central differences of fourth order for a model without an exact Jacobian.
        """
        if self._exact is not None:
            return np.asarray(self._exact @ self.terms.pose_directions(self.values, self.basis))
        return self._stacked([(4.0 * n - f) / 3.0 for n, f in self._differences("displacement", POSE_STEP)])

    def twist_columns(self) -> Array:
        """d(accelerations, memory rates) / d(speeds).

        Exact; else by differences: loads are linear, quadratic, or u |u| in the speeds, and 2 D(h) - D(2h)
        of the central differences D keeps the linear part alone.
        """
        if self._exact is not None:
            directions = np.zeros((self.values.size, self.size))
            directions[self.terms.twists] = self.basis
            return np.asarray(self._exact @ directions)
        return self._stacked([2.0 * near - far for near, far in self._differences("twist", TWIST_STEP)])

    def memory_columns(self) -> Array:
        """d(accelerations, memory rates) / d(memory states), which is linear."""
        terms = self.terms
        if self._exact is not None:
            return self._exact[:, terms.memory]
        scale = np.array(terms.model.scale)
        columns = []
        for i in range(terms.memory.start, terms.memory.stop):
            step = float(scale[i]) if np.isfinite(scale[i]) else 1.0
            high, low = np.array(self.values), np.array(self.values)
            high[i] += step
            low[i] -= step
            columns.append((terms.rates(high) - terms.rates(low)) / (2.0 * step))
        return self._stacked(columns)

    def state_rows(self) -> Array:
        """d(accelerations of the coordinates, memory rates) / d(coordinates, speeds, memory states)."""
        bodies = 6 * self.terms.bodies
        every = (self.pose_columns(), self.twist_columns(), self.memory_columns())
        reduced = [np.concatenate([self.basis.T @ one[:bodies], one[bodies:]]) for one in every]
        return np.hstack(reduced)

    def stiffness(self) -> Array:
        """d(acceleration) / d(coordinates) in the coordinates, (dof, dof), 1/s2."""
        return np.asarray(self.basis.T @ self.pose_columns()[: 6 * self.terms.bodies])

    @one_thread
    def rest_matrix(self) -> tuple[Array, Array, Array]:
        """What a rest state is solved by: `stiffness` with the states of loads as further unknowns.

        A state on which no rate of a state depends, such as a paid-out length, rests anywhere: it is held.
        Its (dof + k) rows are accelerations, and k combinations of the drift, columns coordinates, and k of
        the n states over their scales; and these combinations, (n, k), of the drift and of the states.
        """
        if not len(self.terms.load_scales):
            none = np.zeros((0, 0))
            return self.stiffness(), none, none
        whole, dof = self.static_matrix(), self.size
        u, size, vt = np.linalg.svd(whole[dof:, dof:])
        rows, columns = u[:, size > NEUTRAL], vt[size > NEUTRAL].T
        both = np.hstack([whole[:, :dof], whole[:, dof:] @ columns])
        return np.vstack([both[:dof], rows.T @ both[dof:]]), rows, columns

    def static_matrix(self) -> Array:
        """d(accelerations, rates of the states of loads) / d(coordinates, these states over their scales)."""
        scales = self.terms.load_scales
        if not len(scales):
            return self.stiffness()
        last = slice(-len(scales), None)
        both = np.hstack([self.pose_columns(), self.memory_columns()[:, last] * scales])
        return np.vstack([self.basis.T @ both[: 6 * self.terms.bodies], both[last] / scales[:, None]])

    def _differences(self, what: str, step: float) -> Iterator[tuple[Array, Array]]:
        """Central differences of the rates along each coordinate, by a step and by two."""
        terms, none = self.terms, np.zeros(6 * self.terms.bodies)

        def rates(move: Array) -> Array:
            given = {"displacement": none, "twist": none, what: move}
            return terms.rates(terms.moved(self.values, **given))

        for way in self.basis.T:
            near, far = ((rates(h * way) - rates(-h * way)) / (2.0 * h) for h in (step, 2.0 * step))
            yield near, far

    def _stacked(self, columns: list[Array]) -> Array:
        rows = 6 * self.terms.bodies + self.terms.model.memory_states
        return np.column_stack(columns) if columns else np.zeros((rows, 0))


def relaxed(
    model: _core.Model, time: float, values: Array, *, capsized: Callable[[Array], float],
    level: Callable[[Array], Array],
) -> Array | None:  # fmt: skip
    """A state near rest that a damped motion from `values` comes to; None where it does not settle.

    `capsized` tells by how much (rad) a vessel is turned: beyond `UPRIGHT` there is no rest to be found.
    `level` takes water in compartments to where it stays.

    Implicit steps h of a motion without inertia from step to step, (1/h^2 - dF/dq) dq = F in minimal
    coordinates, and (1/h - dr/dx) dx = r of the states that loads have. A load that nothing holds yet falls
    until its line is taut; what would grow moves away from where it stands. h grows as the forces vanish.
    """
    terms = Terms(model, time=time)
    y = level(terms.evaluator.project(time, at_rest(model, values)))
    step, most, last = FIRST_STEP, LONGEST_STEP, np.zeros(0)
    for _ in range(MOST_STEPS):
        coordinates = ReducedCoordinates.at(terms, y)
        acceleration, drift = terms.acceleration_and_drift(y)
        force = np.concatenate([coordinates.basis.T @ acceleration, drift])
        size = float(np.max(np.abs(force), initial=0.0))
        if not np.isfinite(size) or capsized(y) > UPRIGHT:
            return None
        if size < SETTLED:
            return y
        growth = _growth(force, last)
        # What swings to and fro at one step does so again: steps as long come back only slowly.
        most = min(most * RETURN, LONGEST_STEP) if growth > SHORTER else max(SHORTER * step, FIRST_STEP)
        step = min(step * growth, most)
        last = force
        moved = _moved(terms, coordinates, force, step)
        if moved is None:
            return None
        y = level(at_rest(model, terms.evaluator.project(time, moved)))
    return None


def _growth(force: Array, last: Array) -> float:
    """Growth of the step as the forces vanish; shorter where they swing, as between two slack lines."""
    if not last.size:
        return 1.0
    sizes = float(np.linalg.norm(last)), float(np.linalg.norm(force))
    cosine = float(force @ last) / max(sizes[0] * sizes[1], 1e-300)
    if cosine > AHEAD:
        return max(LONGER, min(sizes[0] / sizes[1], GROWTH[1]))
    if sizes[1] > SHORTER * sizes[0] and cosine < SHORTER:
        return min(SHORTER, sizes[0] / sizes[1])
    return float(np.clip(sizes[0] / sizes[1], *GROWTH))


def _moved(terms: Terms, coordinates: ReducedCoordinates, force: Array, step: float) -> Array | None:
    dof, matrix = coordinates.size, coordinates.static_matrix()
    if not np.all(np.isfinite(matrix)):
        return None
    growth = float(np.max(np.linalg.eigvals(matrix[:dof, :dof]).real, initial=0.0))
    rate = max(1.0 / step**2, BEYOND * growth)
    left = -matrix
    left[np.diag_indices(dof)] += rate
    states = np.arange(dof, len(left))
    left[states, states] += np.sqrt(rate)
    change = np.linalg.solve(left, force)
    move = coordinates.basis @ change[:dof]
    wound = change[dof:] * terms.load_scales
    farthest = max(float(np.max(np.abs(part), initial=0.0)) for part in (move, wound))
    share = min(1.0, LARGEST_MOVE / max(farthest, 1e-300))
    y = terms.moved(coordinates.values, displacement=share * move)
    y[terms.load_states] += share * wound
    return y
