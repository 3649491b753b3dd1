"""Rest states of a scene with its references held, found by Newton's method on the accelerations."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from seacrane import _core
from seacrane.analysis.reduced_coordinates import NEUTRAL, ReducedCoordinates, Terms, at_rest, relaxed
from seacrane.analysis.rest_on_oil import rest_on_oil
from seacrane.analysis.stability import most_turned, tips_over, warn_of_rest, why_none
from seacrane.analysis.taut_lines import has_masses, kept_lengths, tautened, unbounded, with_what_hangs
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description, Some
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import changed, lines_of
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of
from seacrane.inputs.keywords import named
from seacrane.one_thread import one_thread

Rest = tuple[_core.Model, _core.State]
CONVERGED = 1e-9  # m/s2 and rad/s2
ROUNDED = 1e-4  # likewise, 1e-5 of gravity, where no step is left that the digits of positions can hold
CREEP = 1e-8  # likewise, in which a minute is 0.02 mm; and 1/s, of the states of loads
DIGITS = 1e-15  # of the largest position
ROUGHEST = 1e3  # times that, where a step has not brought the scene nearer to rest
SMALLEST_MOVE = 1e-8  # m and rad, likewise where what acts is the rounding of a stiff line
SET_DOWN = 1e-3  # m
LARGEST_MOVE = 0.5  # m and rad in one step
LEAST_LED = 0.01  # m: by less, what hangs is moved by Newton's method alone
MOST_STEPS = 100
PATIENCE = 5  # steps
FALLING = 10.0  # ratio of what acts where nothing brings anything back to what acts elsewhere
DAMPING = 0.03  # 1/m and 1/rad, of the accelerations that are left
STAGE = 5.0  # s of the references between two rest states on the way to a later time
MOST_STAGES = 200
FOLLOW = 0.05  # s between projections on drivers
HALVINGS = 60  # of a volume, until its last digit
MOST_AIR = 1e3  # times the compartment, at one atmosphere


def held(scene: Some, *, time: float = 0.0) -> Some:
    """The scene without waves, its references, drivers, tabulated forces and lines held as at `time`.

    Its state of orientation is the quaternion and it has no Baumgarte stabilisation: motions are the same.
    """
    out = scene.copy(waves=calm_water(scene.waves), orientation="quaternion", baumgarte=0.0)
    for name, actuator in scene.actuators.items():
        still = {key: _frozen(getattr(actuator, key), time) for key in ("feed_forward", "reference")}
        out.actuators[name] = changed(actuator, **still)
    for name, driver in scene.drivers.items():
        # The described pose belongs to the value at the start, so the held value takes over on the way.
        curve = _frozen(driver.curve, 0.0)
        if time > 0.0:
            curve = curve.then(time=0.5 * time, curve=_frozen(driver.curve, time))
        out.drivers[name] = changed(driver, curve=curve)
    for name, table in scene.force_tables.items():
        wrench = [float(np.interp(time, table.times, column)) for column in np.asarray(table.wrenches).T]
        out.force_tables[name] = changed(table, times=[0.0, 1.0], wrenches=np.array([wrench] * 2))
    for name, line in lines_of(scene.loads).items():
        still = {key: _frozen(getattr(line, key), time) for key in ("length", "tension", "brake")}
        out.loads[name] = changed(line, **still, rate=0.0)
    return out


def _frozen(curve: _core.Curve, time: float) -> _core.Curve:
    return _core.Curve.constant(value=float(curve.evaluate([time])[0, 0]))


@named
@one_thread
def equilibrium(scene: Description, *, state: _core.State | None = None, time: float = 0.0) -> _core.State:
    """State at rest of the scene with its references held at one time, without waves.

    Newton's method on the accelerations in minimal coordinates, and on the rates of the states that loads
    have. Hydraulic cylinders stand where their spools are shut, with the pressures that hold. Water in
    compartments has come in or run out as far as it does. Where nothing fixes a position (a vessel without
    mooring, a payload about its link) or a state (the length of a line on a winch), it stays where it is.

    Parameters
    ----------
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
        If there is no rest state near the start of the search: the body that accelerates most is named, and
        the line that could hold it and is slack.

    Warns
    -----
    UnstableRestWarning
        If the scene rests there as a pencil on its tip: what grows, and how fast.
    LargeHeelWarning
        If a vessel heels or trims by more than 20 deg there, beyond which restoring is not linear.
    CreepingRestWarning
        If a hydraulic cylinder leaks, so that what it holds creeps from there.
    """
    if state is not None:
        found = _rest(scene, float(state.time), state_values(scene, state))
    else:
        end = not_negative_of("equilibrium: time", time, "s")
        found = next(_rests(scene, [end]))
    warn_of_rest("equilibrium", scene, *found)
    return found[1]


def rest_from(scene: Description, state: _core.State) -> _core.State:
    """The state at rest near another one, whether the scene stays there or not."""
    return _rest(scene, float(state.time), state_values(scene, state))[1]


def led(scene: Description, state: _core.State, *, time: float) -> _core.State:
    """A state at rest with its poses led along the drivers of a scene to a later time (s), as of its own."""
    return changed(state, values=_followed(scene, state, time))


def rest_states(scene: Description, *, times: Iterable[float]) -> Iterator[_core.State]:
    """States at rest at times that increase, each found from the one before along the references."""
    return (state for _, state in _rests(scene, times))


def _rests(scene: Description, times: Iterable[float]) -> Iterator[Rest]:
    found = _rest(scene, 0.0, None)
    for time in times:
        start = found[1].time
        stages = min(int(np.ceil((time - start) / STAGE)), MOST_STAGES)
        for stage in np.linspace(start, time, stages + 1)[1:]:
            found = _rest(scene, float(stage), _followed(scene, found[1], float(stage)))
        yield found


def _followed(scene: Description, state: _core.State, time: float) -> Array:
    """Poses led along the drivers to a later time; projection takes only small steps."""
    values = np.array(state.values)
    if not scene.drivers:
        return values
    model = compile_scene(scene.copy(waves=calm_water(scene.waves), orientation="quaternion", baumgarte=0.0))
    evaluator = _core.Evaluator(model)
    for instant in np.linspace(state.time, time, int(np.ceil((time - state.time) / FOLLOW)) + 1)[1:]:
        values = evaluator.project(float(instant), values)
    return with_what_hangs(scene, model, np.array(state.values), values)


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
def _rest(scene: Description, time: float, values: Array | None) -> Rest:
    still = held(scene, time=time)
    model = compile_scene(still)
    y = np.array(model.initial_state) if values is None else Terms(model, time=time).checked(values)
    if hydraulic_cylinders(scene):
        return model, rest_on_oil(still, time, y, lambda *given: _rest(*given)[1])
    if lines_of(scene.loads):
        return _hung(still, model, time, y)
    return model, _searched(still, model, time, y)


def _hung(still: Description, model: _core.Model, time: float, values: Array) -> Rest:
    """The rest with elastic lines, those that are slack by little taken as taut at first."""
    free = unbounded(still)
    model = model if free is still else compile_scene(free)
    taut, y = tautened(free, values), values
    if taut is not None:
        try:
            y = np.array(_searched(taut[0], compile_scene(taut[0]), time, taut[1]).values)
        except SceneError:
            y = values
        stay = kept_lengths(free, model)
        y[stay] = values[stay]
    return model, _searched(free, model, time, y)


def _searched(scene: Description, model: _core.Model, time: float, values: Array) -> _core.State:
    """By Newton's method; where that comes to nothing, or to what tips over, from where a damped motion ends.

    Newton's method goes to any rest: to a load that stands on its hook as well as to one that hangs.
    """
    hung: Callable[[Array, Array], Array] = partial(with_what_hangs, scene, model, least=LEAST_LED)
    led = hung if has_masses(scene) else lambda _before, after: after
    level = leveled(scene, model, time=time)
    found = _search(model, time, values, led, level)
    if found.state is None or found.tips:
        damped = partial(relaxed, model, time, capsized=partial(most_turned, scene, model), level=level)
        near = damped(values)
        if near is None and (standing := _set_down(scene, model, values)) is not None:
            near = damped(standing)
        other = found if near is None else _search(model, time, near, led, level)
        if found.state is None or (other.state is not None and not other.tips):
            found = other
    if found.state is None:
        why = why_none(scene, model, time, found.values)
        raise SceneError(f"scene {model.name!r}: no rest state found; {why}")
    return found.state


def _set_down(scene: Description, model: _core.Model, values: Array) -> Array | None:
    """Bodies with points on surfaces, a little lower: what only touches does not press yet, nor stick."""
    bodies = list(model.bodies)
    standing = {load.body for load in scene.loads.values() if isinstance(load, _core.Contact)}
    out = values.copy()
    for body in standing.intersection(bodies):
        out[model.pose_index(bodies.index(body)) + 2] -= SET_DOWN
    return out if standing else None


class _Search(NamedTuple):
    """Where a search ended: at a rest state, or none; and whether it is one that tips over."""

    state: _core.State | None
    values: Array
    tips: bool = False


def _search(
    model: _core.Model, time: float, values: Array, led: Callable[[Array, Array], Array],
    level: Callable[[Array], Array],
) -> _Search:  # fmt: skip
    """By Newton's method. Whether a rest tips over is told by the last stiffness on the way to it.

    `led` takes what hangs along with a step, given the states before and after it, for masses of a line would
    be strained by its square. `level` then takes water in compartments to where it stays.
    """
    terms = Terms(model, time=time)
    y = at_rest(model, values)
    y = level(terms.evaluator.project(time, y))
    before, stiffness = np.inf, np.zeros((0, 0))
    for steps in range(MOST_STEPS):
        acceleration, drift = terms.acceleration_and_drift(y)
        moving = float(np.max(np.abs(acceleration)))
        drifting = float(np.max(np.abs(drift), initial=0.0))
        if moving < CONVERGED and drifting < CONVERGED:
            return _found(model, time, y, stiffness)
        if not np.isfinite(moving):
            break
        coordinates = ReducedCoordinates.at(terms, y)
        matrix, rows, columns = coordinates.rest_matrix()
        stiffness = matrix[: coordinates.size, : coordinates.size]
        u, size, vt = np.linalg.svd(matrix)
        fixed = size > NEUTRAL
        # Away from rest even a neutral direction shows some stiffness: damped (Levenberg-Marquardt) steps.
        damped = size / (size**2 + (DAMPING * moving) ** 2)
        along = u.T @ np.concatenate([coordinates.basis.T @ acceleration, rows.T @ drift])
        step = vt[fixed].T @ (-along * damped)[fixed]
        move = coordinates.basis @ step[: coordinates.size]
        finest = DIGITS * float(np.max(np.abs(y[: model.twist_index(0)])))
        left, free = (float(np.max(np.abs(along[part]), initial=0.0)) for part in (fixed, ~fixed))
        rounding = float(size[0]) * finest  # acceleration that the digits of positions make
        roughest = SMALLEST_MOVE if left < rounding else ROUGHEST * finest
        stands = np.max(np.abs(move)) <= (finest if moving < 0.5 * before else roughest)
        done = left < CONVERGED or (stands and moving < ROUNDED and drifting < CREEP)
        before = moving
        if done and max(free, drifting) < CREEP:
            return _found(model, time, y, stiffness)
        if done or (steps >= PATIENCE and free > max(FALLING * left, CREEP)):
            break  # what is left acts where nothing brings anything back
        share = min(1.0, LARGEST_MOVE / max(float(np.max(np.abs(move))), 1e-300))
        moved = terms.moved(y, displacement=share * move)
        moved[terms.load_states] += share * (columns @ step[coordinates.size :]) * terms.load_scales
        y = level(at_rest(model, led(y, terms.evaluator.project(time, moved))))
    return _Search(state=None, values=y)


def _found(model: _core.Model, time: float, values: Array, stiffness: Array) -> _Search:
    parts = _core.initial_state(model).parts
    state = _core.State(time=time, values=values, inputs=np.zeros(model.slots), parts=parts)
    return _Search(state=state, values=values, tips=tips_over(stiffness))


def leveled(scene: Description, model: _core.Model, *, time: float) -> Callable[[Array], Array]:
    """Takes a state to that with the same poses in which no compartment takes or gives water.

    What flows is the root of a head, between whose sides Newton's method steps to and fro: volumes go first,
    by bisection, with the air that is shut in above.
    """
    waters = {name: load for name, load in scene.loads.items() if isinstance(load, _core.EntrappedWater)}
    places = {name: place for name, _, place, *_ in model.load_states}
    evaluator = _core.Evaluator(model)

    def flow(values: Array, place: int, volume: float) -> float:
        y = np.array(values)
        y[place] = volume
        return float(evaluator.derivative(time, y)[place])

    def found(values: Array) -> Array:
        out = np.array(values)
        for name, water in waters.items():
            whole, place = water.area * water.height, places[f"{name}.volume"]
            out[place] = _settled(partial(flow, out, place), out[place], whole)
            if water.air == "shut":
                air = places[f"{name}.air"]
                out[air] = _settled(partial(flow, out, air), out[air], MOST_AIR * whole)
                out[place] = _settled(partial(flow, out, place), out[place], whole)
        return out

    return found if waters else np.array


def _settled(flow: Callable[[float], float], volume: float, whole: float) -> float:
    """The volume nearest to a first one at which the flow ends."""
    now = flow(volume)
    if now == 0.0:
        return volume
    flows, still = volume, whole if now > 0.0 else 0.0
    for _ in range(HALVINGS):
        middle = 0.5 * (flows + still)
        if flow(middle) * now > 0.0:
            flows = middle
        else:
            still = middle
    return still
