"""Rest states of a scene with its references held, found by Newton's method on the accelerations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.reduced_coordinates import NEUTRAL, ReducedCoordinates, Terms
from seacrane.description.compilation import compile_scene
from seacrane.description.scene import Description, Some
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of

Array = NDArray[np.float64]
CONVERGED = 1e-9  # m/s2 and rad/s2
LARGEST_MOVE = 0.5  # m and rad in one step
MOST_STEPS = 100
DAMPING = 0.03  # 1/m and 1/rad, of the accelerations that are left
STAGE = 5.0  # s of the references between two rest states on the way to a later time
MOST_STAGES = 200
FOLLOW = 0.05  # s between projections on drivers


def held(scene: Some, *, time: float = 0.0) -> Some:
    """The scene without waves, its references, drivers and tabulated forces held at their values at `time`.

    Its state of orientation is the quaternion and it has no Baumgarte stabilisation: motions are the same.
    """
    out = scene.copy(waves=None, orientation="quaternion", baumgarte=0.0)
    for name, actuator in scene.actuators.items():
        out.actuators[name] = _core.Actuator(
            name=name, joint=actuator.joint, coordinate=actuator.coordinate,
            stiffness=actuator.stiffness, damping=actuator.damping,
            feed_forward=_frozen(actuator.feed_forward, time), reference=_frozen(actuator.reference, time),
        )  # fmt: skip
    for name, driver in scene.drivers.items():
        # The described pose belongs to the value at the start, so the held value takes over on the way.
        curve = _frozen(driver.curve, 0.0)
        if time > 0.0:
            curve = curve.then(time=0.5 * time, curve=_frozen(driver.curve, time))
        out.drivers[name] = _core.Driver(
            name=name, joint=driver.joint, coordinate=driver.coordinate, curve=curve
        )
    for name, table in scene.force_tables.items():
        wrench = [float(np.interp(time, table.times, column)) for column in np.asarray(table.wrenches).T]
        out.force_tables[name] = _core.ForceTable(
            name=name, body=table.body, point=table.point, times=[0.0, 1.0], wrenches=np.array([wrench] * 2)
        )
    return out


def _frozen(curve: _core.Curve, time: float) -> _core.Curve:
    return _core.Curve.constant(value=float(curve.evaluate([time])[0, 0]))


def equilibrium(scene: Description, *, state: _core.State | None = None, time: float = 0.0) -> _core.State:
    """State at rest of the scene with its references held at one time, without waves.

    Newton's method on the accelerations in minimal coordinates. Where nothing fixes a position (a vessel
    without mooring, a payload about its link), it stays where it is.

    Parameters
    ----------
    scene : Scene
    state : State, optional
        Where the search starts, for example the last state of a run; the held time is its time. Default:
        the described pose, led along the references from 0 to `time`.
    time : float
        s; not with `state`.

    Returns
    -------
    State
        At that time, velocities and memory states zero.

    Raises
    ------
    SceneError
        If there is no rest state near the start of the search: the body that accelerates most is named.
    """
    if state is not None:
        return _rest(scene, float(state.time), state_values(scene, state))
    end = number_of("equilibrium: time", time)
    if not (np.isfinite(end) and end >= 0.0):
        raise SceneError(f"equilibrium: time is {end} s; give a finite time, zero or later")
    return next(rest_states(scene, times=[end]))


def rest_states(scene: Description, *, times: Iterable[float]) -> Iterator[_core.State]:
    """States at rest at times that increase, each found from the one before along the references."""
    found = _rest(scene, 0.0, None)
    for time in times:
        stages = min(int(np.ceil((time - found.time) / STAGE)), MOST_STAGES)
        for stage in np.linspace(found.time, time, stages + 1)[1:]:
            found = _rest(scene, float(stage), _followed(scene, found, float(stage)))
        yield found


def _followed(scene: Description, state: _core.State, time: float) -> Array:
    """Poses led along the drivers to a later time; projection takes only small steps."""
    values = np.array(state.values)
    if not scene.drivers:
        return values
    model = compile_scene(scene.copy(waves=None, orientation="quaternion", baumgarte=0.0))
    evaluator = _core.Evaluator(model)
    for instant in np.linspace(state.time, time, int(np.ceil((time - state.time) / FOLLOW)) + 1)[1:]:
        values = evaluator.project(float(instant), values)
    return values


def state_values(scene: Description, state: Any) -> Array:
    """Values of a state of this scene; raises SceneError where they do not fit."""
    if not isinstance(state, _core.State):
        raise SceneError(f"state is {state!r}; give a seacrane.State")
    if scene.orientation != "quaternion":
        raise SceneError(
            f"scene {scene.name!r}: its states hold {scene.orientation} angles; run it with "
            "orientation='quaternion' for a state to linearise at"
        )
    return np.array(state.values)


def _rest(scene: Description, time: float, values: Array | None) -> _core.State:
    model = compile_scene(held(scene, time=time))
    terms = Terms(model, time=time)
    y = at_rest(model, np.array(model.initial_state) if values is None else terms.checked(values))
    y = terms.evaluator.project(time, y)
    for _ in range(MOST_STEPS):
        coordinates = ReducedCoordinates.at(terms, y)
        acceleration = terms.acceleration(y)
        if np.max(np.abs(acceleration)) < CONVERGED:
            return _core.State(time=time, values=y, inputs=np.zeros(model.slots))
        u, size, vt = np.linalg.svd(coordinates.stiffness())
        fixed = size > NEUTRAL
        # Away from rest even a neutral direction shows some stiffness: damped (Levenberg-Marquardt) steps.
        damped = size / (size**2 + (DAMPING * np.max(np.abs(acceleration))) ** 2)
        reduced = coordinates.basis.T @ acceleration
        move = coordinates.basis @ (vt[fixed].T @ (-(u.T @ reduced) * damped)[fixed])
        move *= min(1.0, LARGEST_MOVE / max(float(np.max(np.abs(move))), 1e-300))
        y = at_rest(model, terms.evaluator.project(time, terms.moved(y, displacement=move)))
    acceleration = terms.acceleration(y)
    worst = int(np.argmax(np.abs(acceleration)))
    raise SceneError(
        f"scene {scene.name!r}: no rest state found; body {model.bodies[worst // 6]!r} still accelerates by "
        f"{acceleration[worst]:.3g} (m/s2 or rad/s2); start from a state nearer to rest, or hold what drifts"
    )


def at_rest(model: _core.Model, values: Array) -> Array:
    """The same poses with all velocities, memory states and work at zero."""
    y = np.array(values)
    y[model.twist_index(0) :] = 0.0
    return y
