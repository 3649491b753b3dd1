"""The linearised right-hand side of a compiled model at one state."""

from __future__ import annotations

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.one_thread import one_thread

LARGEST = 1500  # states; beyond, the dense eigenvalue problem takes longer than most runs


def jacobian(model: _core.Model, *, state: Array | None = None, time: float = 0.0) -> Array:
    """Jacobian of dy/dt, shape (n, n), in the state variables of the model (work left out).

    Exact to rounding, the history of a convolution held; central differences for what has none (paper
    kinematics, constraints that depend on each other).
    """
    y = np.array(model.initial_state if state is None else state, dtype=float)
    scale = np.array(model.scale)
    kept = np.flatnonzero(np.isfinite(scale))
    evaluator = _core.Evaluator(model)
    try:
        return np.asarray(evaluator.jacobian(time, y))[np.ix_(kept, kept)]
    except ValueError:  # by differences below
        pass
    out = np.empty((kept.size, kept.size))
    for column, i in enumerate(kept):
        step = 1e-6 * scale[i]
        high, low = y.copy(), y.copy()
        high[i] += step
        low[i] -= step
        difference = evaluator.derivative(time, high) - evaluator.derivative(time, low)
        out[:, column] = difference[kept] / (2.0 * step)
    return out


@one_thread
def fastest_mode(model: _core.Model) -> float | None:
    """Largest |eigenvalue| (1/s) at the start; None where the model is too large for a dense problem, or its
    rates are not finite there (of which the run itself tells)."""
    if model.states > LARGEST:
        return None
    matrix = jacobian(model)
    return float(np.max(np.abs(np.linalg.eigvals(matrix)))) if np.all(np.isfinite(matrix)) else None
