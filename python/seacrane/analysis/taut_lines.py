"""Elastic lines that a search for rest takes as taut: one without stretch has no stiffness either."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.compilation import compile_scene
from seacrane.description.loads import lines_of, path_of
from seacrane.description.scene import Description, Some
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]
LARGEST_SLACK = 0.01  # of the length: a line with more of it is meant to hang
STRAIN = 1e-6  # that it is given


def tautened(scene: Some, values: Array) -> tuple[Some, Array] | None:
    """The scene and its state with lines shortened that are slack by little; None if there is none.

    `values` is a state of the scene, whose orientation is the quaternion.
    """
    model = compile_scene(scene, merge=False)
    places = {name: place for name, _, place, *_ in model.load_states}
    out, state, found = scene.copy(), np.array(values), False
    for name, line in lines_of(scene.loads).items():
        length = state[places[f"{name}.length"]] if line.winch else line.length.evaluate([0.0])[0, 0]
        path = _path_length(scene, model, line, values)
        if not (1.0 - LARGEST_SLACK) * length <= path <= (1.0 + STRAIN) * length:
            continue
        found = True
        if line.winch:
            state[places[f"{name}.length"]] = path / (1.0 + STRAIN)
        else:
            out.loads[name] = _core.Line(**line.__getstate__() | {"length": path / (1.0 + STRAIN)})
    return (out, state) if found else None


def _path_length(scene: Description, model: _core.Model, line: _core.Line, values: Array) -> float:
    points = [_place(scene, model, body, np.asarray(point), values) for body, point in path_of(line)]
    return float(sum(np.linalg.norm(end - start) for start, end in pairwise(points)))


def _place(scene: Description, model: _core.Model, body: str, point: Array, values: Array) -> Array:
    """A point of a body in inertial axes; the state holds the centre of mass, of a vessel its origin."""
    if body not in scene.bodies:
        return point
    at = model.pose_index(list(model.bodies).index(body))
    floating = {vessel.body for vessel in scene.vessels.values()}
    start = np.zeros(3) if body in floating else np.asarray(scene.bodies[body].center_of_mass)
    return np.asarray(values[at : at + 3] + rotation_matrix(values[at + 3 : at + 7]) @ (point - start))
