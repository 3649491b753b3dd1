"""A vessel at rest: heel, trim, change of draught, and what brings it back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.reduced_coordinates import NEUTRAL, ReducedCoordinates, Terms
from seacrane.description.scene import Description
from seacrane.inputs.frames import heading_of, rotation_matrix
from seacrane.one_thread import one_thread

Array = NDArray[np.float64]


def displaced_weight(scene: Description, vessel: _core.VesselHydrodynamics, motion: Array) -> float:
    """Weight of the water that a vessel displaces at rest, N; `motion`: from upright at z = 0, (6,)."""
    own = scene.bodies[vessel.body].mass * scene.gravity
    return float(own - np.asarray(vessel.restoring)[2, 2:5] @ motion[2:5])


@one_thread
def heeling_stiffness(model: _core.Model, values: Array, time: float, body: str) -> float:
    """Heeling moment for each radian of heel, N m/rad, at rest: all else follows, hanging loads swing.

    The stiffness of the whole scene, K = -M da/dq in its minimal coordinates, is solved for a heeling moment.
    What nothing brings back stays where it is.
    """
    terms = Terms(model, time=time)
    coordinates = ReducedCoordinates.at(terms, values)
    basis, mass = coordinates.basis, np.asarray(terms.evaluator.terms(time, values)["mass"])
    k = list(model.bodies).index(body)
    at = model.pose_index(k)
    heading = heading_of(values[at + 3 : at + 7])
    forward = np.array([np.cos(heading), np.sin(heading), 0.0])
    turn = basis[6 * k + 3 : 6 * k + 6].T @ forward
    acceleration = np.linalg.solve(basis.T @ mass @ basis, turn)
    u, size, vt = np.linalg.svd(-coordinates.stiffness())
    fixed = size > NEUTRAL
    moved = vt[fixed].T @ ((u.T @ acceleration)[fixed] / size[fixed])
    return float(1.0 / (turn @ moved))


def attitude(values: Array, model: _core.Model, body: str) -> Array:
    """Height (m), roll and pitch (rad) of a vessel's reference point, as (6,) motions without the others."""
    at = model.pose_index(list(model.bodies).index(body))
    turn = rotation_matrix(values[at + 3 : at + 7])
    pitch = -np.arcsin(np.clip(turn[2, 0], -1.0, 1.0))
    roll = np.arctan2(turn[2, 1], turn[2, 2])
    return np.array([0.0, 0.0, values[at + 2], roll, pitch, 0.0])
