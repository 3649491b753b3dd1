"""Modes of a scene at states of a run: the fastest, and oscillations with little damping."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linearise import jacobian
from seacrane.one_thread import one_thread

MOST_DAMPING = 0.05  # ratio: what is damped more, waves and drives keep in bounds


@dataclass(frozen=True, kw_only=True)
class Fastest:
    """A mode: |eigenvalue| (1/s), the body that it moves most, and the time of the state (s)."""

    mode: float
    body: str
    time: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Oscillations:
    """Eigenvalues (1/s) with a positive imaginary part, and the body that each moves most."""

    values: NDArray[np.complex128]
    bodies: tuple[str, ...]


class Modes:
    """Found when they are first asked for.

    Parameters
    ----------
    model : Model
    bodies : sequence of str
        Their names, in the order of the model.
    states : sequence of State
        At least one.
    most_damping : float
        Ratio up to which an oscillation counts.
    """

    def __init__(
        self, model: _core.Model, bodies: Sequence[str], states: Sequence[_core.State],
        most_damping: float = MOST_DAMPING,
    ) -> None:  # fmt: skip
        self.model, self._bodies, self._states = model, list(bodies), list(states)
        self._most_damping = most_damping

    @cached_property
    def fastest(self) -> Fastest:
        """The fastest of all states; zero where it is not finite."""
        found = [self._fastest(state) for state in self._states]
        return max(found, key=lambda one: (one.mode, one.body, one.time))

    @cached_property
    def oscillations(self) -> tuple[Oscillations, ...]:
        """With little damping, at rest in the pose of each state."""
        return tuple(self._oscillations(state) for state in self._states)

    @property
    def _speeds(self) -> slice:
        first = (6 if self.model.euler_angles else 7) * len(self._bodies)
        return slice(first, first + 6 * len(self._bodies))

    def _sizes(self, vectors: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Speeds of bodies in modes, over their scales."""
        scale = np.array(self.model.scale)
        return np.asarray((np.abs(vectors) / scale[np.isfinite(scale), None])[self._speeds])

    @one_thread
    def _fastest(self, state: _core.State) -> Fastest:
        matrix = jacobian(self.model, state=np.array(state.values), time=state.time)
        if not np.all(np.isfinite(matrix)):
            return Fastest(mode=0.0, body="", time=state.time)
        eigenvalues, vectors = np.linalg.eig(matrix)
        worst = int(np.abs(eigenvalues).argmax())
        twists = self._sizes(vectors[:, worst : worst + 1])[:, 0]
        body = self._bodies[int(twists.argmax()) // 6] if self._bodies else ""
        return Fastest(mode=float(np.abs(eigenvalues[worst])), body=body, time=state.time)

    @one_thread
    def _oscillations(self, state: _core.State) -> Oscillations:
        values = np.array(state.values)
        values[self._speeds] = 0.0
        matrix = jacobian(self.model, state=values, time=state.time)
        if not self._bodies or not np.all(np.isfinite(matrix)):
            return Oscillations(values=np.zeros(0, complex), bodies=())
        modes, shapes = np.linalg.eig(matrix)
        little = (modes.imag > 0.0) & (np.abs(modes.real) < self._most_damping * np.abs(modes))
        sizes = self._sizes(shapes[:, little])
        moved = tuple(self._bodies[int(column.argmax()) // 6] for column in sizes.T)
        return Oscillations(values=modes[little], bodies=moved)
