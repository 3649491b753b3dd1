"""How stiff a lift is at its hook: rope and crane in series, the ships held."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.analysis.reduced_coordinates import NEUTRAL, POSE, ReducedCoordinates, Terms
from seacrane.analysis.rest_state import held
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.loads import changed, lines_of
from seacrane.description.rungs import ELASTIC
from seacrane.inputs.frames import rotation_matrix
from seacrane.one_thread import one_thread

Array = NDArray[np.float64]
RIGID = 1e-12  # m/N: less is none


@one_thread
def hook_stiffness(
    scene: Description, model: _core.Model, state: _core.State, *, body: str, point: ArrayLike
) -> float:
    """Vertical force over sag of a point of a body (its coordinates, m) at rest, N/m; infinite if rigid.

    The stiffness of the whole scene in its minimal coordinates and the states of its loads, as of
    `heeling_stiffness`, with the twists of floating vessels held at zero.
    """
    model, values = _elastic(scene, model, state)
    terms = Terms(model, time=state.time)
    coordinates = ReducedCoordinates.at(terms, values)
    basis, names = coordinates.basis, list(model.bodies)
    mass = basis.T @ np.asarray(terms.evaluator.terms(state.time, values)["mass"]) @ basis
    free = _held_free(scene, names, basis)
    matrix, _, _ = coordinates.rest_matrix()
    dof = coordinates.size
    inner = free.T @ mass
    small = inner @ free
    reduced = np.block([
        [np.linalg.solve(small, inner @ matrix[:dof, :dof] @ free),
         np.linalg.solve(small, inner @ matrix[:dof, dof:])],
        [matrix[dof:, :dof] @ free, matrix[dof:, dof:]],
    ])  # fmt: skip
    down = free.T @ (basis.T @ _vertical(scene, model, values, names.index(body), point))
    acceleration = np.concatenate([np.linalg.solve(small, down), np.zeros(len(matrix) - dof)])
    u, size, vt = np.linalg.svd(-reduced)
    fixed = size > NEUTRAL
    moved = vt[fixed].T @ ((u.T @ acceleration)[fixed] / size[fixed])
    sag = float(down @ moved[: free.shape[1]])
    return 1.0 / sag if sag > RIGID else np.inf


def _elastic(scene: Description, model: _core.Model, state: _core.State) -> tuple[_core.Model, Array]:
    """Model and values with lines that stretch at once: a quasi-static one has an inertia beside its EA."""
    values = np.array(state.values)
    lines = {name: line for name, line in lines_of(scene.loads).items() if line.rung != ELASTIC}
    if not lines:
        return model, values
    at_once = {name: changed(line, rung=ELASTIC) for name, line in lines.items()}
    other = compile_scene(held(scene.copy(loads=dict(scene.loads) | at_once), time=state.time))
    out, poses = np.array(other.initial_state), POSE * len(model.bodies)
    out[:poses] = values[:poses]
    known = {name: place for name, _, place, *_ in model.load_states}
    for name, _, place, *_ in other.load_states:
        out[place] = values[known[name]]
    return other, out


def _held_free(scene: Description, names: list[str], basis: Array) -> Array:
    """Directions of the coordinates (dof, k) in which no floating vessel moves."""
    floating = [names.index(one.body) for one in scene.vessels.values() if one.floats]
    if not floating:
        return np.eye(basis.shape[1])
    rows = np.concatenate([basis[6 * k : 6 * k + 6] for k in floating])
    _, size, vt = np.linalg.svd(rows)
    rank = int(np.sum(size > 1e-9 * max(size.max(initial=0.0), 1e-9)))
    return vt[rank:].T


def _vertical(scene: Description, model: _core.Model, values: Array, k: int, point: ArrayLike) -> Array:
    """A unit force upwards at a point of the k-th body, (6 n,), moments about the state points."""
    body = scene.bodies[model.bodies[k]]
    at = model.pose_index(k)
    floats = any(one.body == body.name for one in scene.vessels.values())
    start = np.zeros(3) if floats else np.asarray(body.center_of_mass)
    lever = rotation_matrix(values[at + 3 : at + 7]) @ (np.asarray(point) - start)
    out = np.zeros(6 * len(model.bodies))
    out[6 * k : 6 * k + 3] = (0.0, 0.0, 1.0)
    out[6 * k + 3 : 6 * k + 6] = (lever[1], -lever[0], 0.0)
    return out
