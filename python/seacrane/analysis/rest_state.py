"""Rest states of a scene with its references held, found by Newton's method on the accelerations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.reduced_coordinates import NEUTRAL, ReducedCoordinates, Terms
from seacrane.analysis.rest_on_oil import rest_on_oil
from seacrane.analysis.taut_lines import tautened
from seacrane.description.compilation import compile_scene
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import lines_of
from seacrane.description.scene import Description, Some
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.one_thread import one_thread

Array = NDArray[np.float64]
CONVERGED = 1e-9  # m/s2 and rad/s2
ROUNDED = 1e-6  # likewise, where no step is left that the digits of positions can hold
DIGITS = 1e-15  # of the largest position
LARGEST_MOVE = 0.5  # m and rad in one step
MOST_STEPS = 100
DAMPING = 0.03  # 1/m and 1/rad, of the accelerations that are left
STAGE = 5.0  # s of the references between two rest states on the way to a later time
MOST_STAGES = 200
FOLLOW = 0.05  # s between projections on drivers


def held(scene: Some, *, time: float = 0.0) -> Some:
    """The scene without waves, its references, drivers, tabulated forces and lines held as at `time`.

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
    for name, line in lines_of(scene.loads).items():
        held_curves = {key: _frozen(getattr(line, key), time) for key in ("length", "tension", "brake")}
        out.loads[name] = _core.Line(**line.__getstate__() | held_curves | {"rate": 0.0})
    return out


def _frozen(curve: _core.Curve, time: float) -> _core.Curve:
    return _core.Curve.constant(value=float(curve.evaluate([time])[0, 0]))


def equilibrium(scene: Description, *, state: _core.State | None = None, time: float = 0.0) -> _core.State:
    """State at rest of the scene with its references held at one time, without waves.

    Newton's method on the accelerations in minimal coordinates, and on the rates of the states that loads
    have. Hydraulic cylinders stand where their spools are shut, with the pressures that hold. Where nothing
    fixes a position (a vessel without mooring, a payload about its link) or a state (the length of a line on
    a winch), it stays where it is.

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
        At that time, velocities and states of the fluid memory zero.

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


@one_thread
def _rest(scene: Description, time: float, values: Array | None) -> _core.State:
    still = held(scene, time=time)
    model = compile_scene(still)
    y = np.array(model.initial_state) if values is None else Terms(model, time=time).checked(values)
    if hydraulic_cylinders(scene):
        return rest_on_oil(still, time, y, _rest)
    taut = tautened(still, y) if lines_of(scene.loads) else None
    if taut is not None:
        lengths = y[_load_states(model)]
        y = np.array(_search(compile_scene(taut[0]), time, taut[1]).values)
        y[_load_states(model)] = lengths
    return _search(model, time, y)


def _load_states(model: _core.Model) -> list[int]:
    return [place for _, _, place, *_ in model.load_states]


def _search(model: _core.Model, time: float, values: Array) -> _core.State:
    terms = Terms(model, time=time)
    y = at_rest(model, values)
    y = terms.evaluator.project(time, y)
    for _ in range(MOST_STEPS):
        coordinates = ReducedCoordinates.at(terms, y)
        acceleration = terms.acceleration(y)
        drift = terms.drift(y)
        if np.max(np.abs(acceleration)) < CONVERGED and np.max(np.abs(drift), initial=0.0) < CONVERGED:
            parts = _core.initial_state(model).parts
            return _core.State(time=time, values=y, inputs=np.zeros(model.slots), parts=parts)
        matrix, rows, columns = coordinates.rest_matrix()
        u, size, vt = np.linalg.svd(matrix)
        fixed = size > NEUTRAL
        # Away from rest even a neutral direction shows some stiffness: damped (Levenberg-Marquardt) steps.
        damped = size / (size**2 + (DAMPING * np.max(np.abs(acceleration))) ** 2)
        reduced = np.concatenate([coordinates.basis.T @ acceleration, rows.T @ drift])
        step = vt[fixed].T @ (-(u.T @ reduced) * damped)[fixed]
        move = coordinates.basis @ step[: coordinates.size]
        finest = DIGITS * float(np.max(np.abs(y[: model.twist_index(0)])))
        if np.max(np.abs(move)) <= finest and np.max(np.abs(acceleration)) < ROUNDED:
            return _core.State(time=time, values=y, inputs=np.zeros(model.slots))
        share = min(1.0, LARGEST_MOVE / max(float(np.max(np.abs(move))), 1e-300))
        y = terms.moved(y, displacement=share * move)
        y[terms.load_states] += share * (columns @ step[coordinates.size :]) * terms.load_scales
        y = at_rest(model, terms.evaluator.project(time, y))
    acceleration = terms.acceleration(y)
    worst = int(np.argmax(np.abs(acceleration)))
    raise SceneError(
        f"scene {model.name!r}: no rest state found; body {model.bodies[worst // 6]!r} still accelerates by "
        f"{acceleration[worst]:.3g} (m/s2 or rad/s2); start from a state nearer to rest, or hold what drifts"
    )


def at_rest(model: _core.Model, values: Array) -> Array:
    """The same poses and states of loads, with all velocities, states of the fluid and work at zero."""
    y = np.array(values)
    y[model.twist_index(0) :] = 0.0
    kept = _load_states(model)
    y[kept] = np.asarray(values)[kept]
    return y
