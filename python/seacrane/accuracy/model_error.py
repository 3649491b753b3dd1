"""What the fit of a vessel's fluid memory is worth in a run: its misfit carried linearly to any motion.

Along the vessel's linear motion, the fitted memory and the database's own retardation functions make two
loads. The scene's linear model about its rest state carries their difference to every body, from zero.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.drag_in_sea import drag_in_components
from seacrane.analysis.frequency_domain import SummedResponse, response_summed
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.arrays import Array
from seacrane.description.crane_parts import payloads
from seacrane.description.databases import database_of
from seacrane.description.given import given_vessels
from seacrane.errors import SceneError
from seacrane.hydro.memory.retardation import RetardationModel, retardation_functions
from seacrane.hydro.vessel.parameters import following_yaw, rigid_part
from seacrane.inputs.caller import warn_caller
from seacrane.one_thread import one_thread
from seacrane.warnings import ModelErrorWarning

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase
    from seacrane.scene.scene import Scene

QUANTITIES = ("payload_position", "roll")
GREGORY = np.array([3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0])  # weights of the first samples, of order 4
LONGEST = 3600.0  # s of a run whose error is carried step by step
_functions = lru_cache(maxsize=4)(retardation_functions)


def model_error(
    scene: Scene,
    *,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    times: ArrayLike,
) -> Array:
    """Error that the fitted fluid memory leaves in the motion of a point of any body, in the scene's waves.

    To first order, by the database's own retardation functions less by the fit. What coefficients of a load
    in water are worth, `seacrane.required` tells.

    Parameters
    ----------
    scene : Scene
        With waves on one vessel, whose memory has states. Its motion starts at rest at the first time.
    point : array_like, shape (3,)
        Body coordinates, from the body origin, m.
    times : array_like, shape (n,)
        s, increasing, over no more than an hour.

    Returns
    -------
    ndarray, shape (n, 6)
        Translation (m) and rotation vector (rad), inertial axes.

    Raises
    ------
    SceneError
        Without waves, for a vessel without a database or a memory of states, for times that do not increase,
        or as `linear_model`.
    """
    carried = _carried(scene, np.asarray(times, dtype=float))
    return np.asarray(carried.error @ carried.linear.output(body=body, point=point).T)


def model_errors(scene: Scene, times: Array, limits: Mapping[str, float]) -> dict[str, float]:
    """Largest error of each quantity that a linear model knows; none where nothing can be said.

    Warns with ModelErrorWarning of an error above its limit.
    """
    wanted = [name for name in limits if name in QUANTITIES]
    if not wanted or scene.waves is None or given_vessels(scene):
        return {}
    try:
        carried = _carried(scene, times)
        found = {name: _largest(scene, carried, name) for name in wanted}
    except SceneError:
        return {}
    kinds = {known.memory for known in scene.provenance.values()}
    closer = "by-motion of a smaller limit" if "by-motion" in kinds else "by-motion"
    for name, error in found.items():
        if error > limits[name]:
            warn_caller(
                f"accuracy: {name} of {limits[name]:g} was asked, and the fit of the vessel's fluid memory "
                f"leaves an error of {error:.2g} by itself; give the vessel a memory {closer}, or "
                "memory='convolution', or ask for less",
                ModelErrorWarning,
            )
    return found


@dataclass(frozen=True, kw_only=True, eq=False)
class _Carried:
    """Errors (n, k) of the states of a linear model over time."""

    linear: LinearModel
    error: Array


@one_thread
def _carried(scene: Scene, times: Array) -> _Carried:
    if times.ndim != 1 or len(times) < 2 or not np.all(np.diff(times) > 0.0):
        raise SceneError("model error: times do not increase; give two or more times in s")
    if times[-1] - times[0] > LONGEST:
        raise SceneError(f"model error: times span {times[-1] - times[0]:g} s; give at most {LONGEST:g} s")
    if scene.waves is None or len(scene.waves.hulls) != 1:
        raise SceneError(f"scene {scene.name!r}: a model error needs waves on one vessel")
    vessel = next(iter(scene.waves.hulls))
    element = next(each for each in scene.vessels.values() if each.body == vessel)
    if isinstance(element.memory, _core.RetardationFunctions) or not element.memory:
        raise SceneError(f"vessel {vessel!r}: has no fitted memory whose error could be told")
    known = database_of(scene, vessel, "the error of its memory")
    linear = drag_in_components(linear_model(scene, vessel=vessel), scene.waves)
    functions = _functions(database=known)
    even = np.arange(times[0], times[-1] + functions.step, functions.step)
    states = _from_rest(linear, response_summed(linear, body=vessel), even)
    load = _misfit(linear, element, known, functions, states)
    at = (times - times[0]) / functions.step
    error = _driven(linear, load, functions.step)
    low = np.minimum(at.astype(int), len(error) - 2)  # straight lines join the even times
    share = (at - low)[:, None]
    return _Carried(linear=linear, error=(1.0 - share) * error[low] + share * error[low + 1])


def _from_rest(linear: LinearModel, summed: SummedResponse, times: Array) -> Array:
    """States (n, k) at even times of the waves' response that is at rest at the first of them."""
    from scipy.linalg import expm

    phases = np.exp(1j * times[:, None] * summed.omega)
    out = np.asarray((phases @ summed.state_amplitude).real)
    with one_thread:
        ahead, free = expm(linear.a * (times[1] - times[0])), -out[0]
    for row in out:
        row += free
        free = ahead @ free
    return out


def _misfit(
    linear: LinearModel,
    element: _core.VesselHydrodynamics,
    database: HydroDatabase,
    functions: RetardationModel,
    states: Array,
) -> Array:
    """Load (n, 6) that the database's retardation functions add to that of the fitted memory."""
    from scipy.signal import fftconvolve

    step, dof = functions.step, linear.degrees_of_freedom
    along = linear.motion_of(element.body)[:, :dof]
    place, velocity = states[:, :dof] @ along.T, states[:, dof : 2 * dof] @ along.T
    count = min(len(states), len(functions.kernel))
    kernel = functions.kernel[:count] - _impulse_response(element, step, count)
    kernel[: len(GREGORY)] *= GREGORY[:count, None, None]
    past = sum(fftconvolve(kernel[:, :, k], velocity[:, k, None], axes=0)[: len(states)] for k in range(6))
    inertia = functions.added_mass + functions.additional_added_mass + rigid_part(database)[1]
    spring = database.restoring + functions.additional_stiffness
    spring = following_yaw(spring + sum(part.restoring[0] for part in database.additional))
    more_mass = inertia - np.array(element.added_mass)
    acceleration = np.gradient(velocity, step, axis=0)
    stiffness = spring - np.array(element.restoring)
    return np.asarray(-(step * past + acceleration @ more_mass.T + place @ stiffness.T))


def _impulse_response(element: _core.VesselHydrodynamics, step: float, count: int) -> Array:
    """K (n, 6, 6) of a vessel's blocks at even times."""
    from scipy.linalg import expm

    out = np.zeros((count, 6, 6))
    blocks = element.memory
    assert not isinstance(blocks, _core.RetardationFunctions)
    for block in blocks:
        with one_thread:
            ahead, states = expm(np.asarray(block.a) * step), np.array(block.b)
        at = np.ix_(list(block.outputs), list(block.inputs))
        for sample in out:
            sample[at] += np.asarray(block.c) @ states
            states = ahead @ states
    return out


def _driven(linear: LinearModel, load: Array, step: float) -> Array:
    """States (n, k) under loads (n, 6) on the vessel that are straight lines between even times."""
    from scipy.linalg import expm

    size, inputs = linear.b.shape
    whole = np.zeros((size + 2 * inputs, size + 2 * inputs))
    whole[:size, :size], whole[:size, size : size + inputs] = linear.a * step, linear.b * step
    whole[size : size + inputs, size + inputs :] = np.eye(inputs)
    with one_thread:
        ahead = expm(whole)[:size]
    free, constant, slope = ahead[:, :size], ahead[:, size : size + inputs], ahead[:, size + inputs :]
    pushes = load[:-1] @ constant.T + np.diff(load, axis=0) @ slope.T
    out = np.zeros((len(load), size))
    for i, push in enumerate(pushes):
        out[i + 1] = free @ out[i] + push
    return out


def _largest(scene: Scene, carried: _Carried, name: str) -> float:
    """Largest error of a quantity over the times, in its unit."""
    linear = carried.linear
    if name == "roll":
        assert linear.vessel is not None
        return float(np.abs(carried.error @ linear.motion_of(linear.vessel)[3]).max())
    errors = [
        np.linalg.norm(carried.error @ linear.output(body=body)[:3].T, axis=1).max()
        for body in payloads(scene).values()
    ]
    return float(max(errors))
