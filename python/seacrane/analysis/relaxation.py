"""Damped relaxation to a rest state: where lines are slack, Newton's method has nothing to go by."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.reduced_coordinates import ReducedCoordinates, Terms, at_rest

Array = NDArray[np.float64]
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
