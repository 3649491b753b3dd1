"""Inverse dynamics and driven scenes: which loads does a motion need?

Both prescribe coordinates by drivers and read their multipliers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import luffing_ropes
from seacrane.description.description import GROUND, Description, Some
from seacrane.description.elements import add_driver, add_joint
from seacrane.description.given import given_at_rest, given_vessels
from seacrane.description.hydraulic_cylinders import with_ideal_cylinders
from seacrane.description.loads import without_compensation
from seacrane.description.places import ANGLES
from seacrane.description.roles import CraneRoles
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of
from seacrane.inputs.frames import heading_of, rotation_about_z

Motion = Mapping[tuple[str, str], _core.Curve]
SIX = ("x", "y", "z", "roll", "pitch", "yaw")
RESTING = 1e-4  # of gravity: an acceleration below it is rest
SMALLEST = 1e-6  # m/s2 or rad/s2: likewise without gravity
Place = tuple[str, str]
TURNING, SLIDING = 0.1, 0.2  # rad/s and m/s, at which a scene is led from pose to pose


def locked(scene: Some) -> Some:
    """The scene with actuators and hydraulic cylinders replaced by drivers at rest, vessels held, calm."""
    ideal = with_ideal_cylinders(scene)
    out = driven(ideal, references={name: _core.Curve.constant(value=0.0) for name in ideal.actuators})
    out = out.copy(waves=calm_water(out.waves), springs=dict(scene.springs))
    _hold_vessels(out, scene)
    return out


def locked_at_rest(scene: Some) -> Some:
    """As `locked`, with given ships where they are described: what moves them begins at rest."""
    return given_at_rest(locked(scene))


def at_rest(scene: Description) -> float:
    """Acceleration, m/s2 or rad/s2, below which a described scene is at rest."""
    return max(RESTING * scene.gravity, SMALLEST)


def _hold_vessels(out: Description, scene: Description) -> list[str]:
    """Hold what floats in a scene, its motion not given, where it is described; bodies, by name."""
    given, still = given_vessels(scene), _core.Curve.constant(value=0.0)
    bodies = [one.body for one in scene.vessels.values() if one.floats and one.body not in given]
    for body in bodies:
        joint = f"{body}.motion"
        start = scene.bodies[body].position
        add_joint(out, kind="free", name=joint, first=GROUND, second=body, point=start)
        _drive(out, joint, dict.fromkeys(SIX, still))
    return bodies


def hold_vessel(scene: Description, body: str, motions: Mapping[str, _core.Curve]) -> None:
    """Prescribe a vessel's motions as `vessel_motion` records them: from upright at its described heading."""
    start, joint = scene.bodies[body], f"{body}.motion"
    heading = rotation_about_z(heading_of(start.quaternion))
    add_joint(
        scene, kind="free", name=joint, first=GROUND, second=body,
        first_frame=_core.Frame(point=start.position, axes=heading),
        second_frame=_core.Frame(point=np.zeros(3), axes=np.eye(3)),
    )  # fmt: skip
    _drive(scene, joint, motions)


def _drive(scene: Description, joint: str, motions: Mapping[str, _core.Curve]) -> None:
    for motion, curve in motions.items():
        add_driver(scene, joint=joint, coordinate=motion, curve=curve, name=f"{joint}.{motion}")


def channels_at(model: _core.Model, channels: Set[str], time: float, values: Array) -> dict[str, Array]:
    """Those of these channels that a model has, at one state."""
    run = _core.Simulation(
        model=model,
        start=_core.State(time=time, values=values, inputs=np.zeros(model.slots)),
        options=_core.RunOptions(
            integrator="rk4", output_times=[time],
            channels=channels & set(model.channel_names(defaults_only=False)),
        ),
    )  # fmt: skip
    return {name: each[0] for name, each in run.channels().items() if name != "time"}


def drive_loads(model: _core.Model, names: Sequence[str], time: float, values: Array) -> Array:
    """Loads of drivers, by name, at one state."""
    if not names:
        return np.zeros(0)
    loads = channels_at(model, {"driver_force"}, time, values)["driver_force"]
    drivers = [name for name, kind, _, _ in model.elements if kind == "driver"]
    return np.array([loads[drivers.index(name)] for name in names])


def actuator_loads(scene: Description, held: Description, state: _core.State) -> Array:
    """Loads of the drivers that hold a scene's actuators, by actuator, at a state of the held scene."""
    names = [_driver_name(name) for name in scene.actuators]
    return drive_loads(compile_scene(held), names, state.time, np.array(state.values))


def _driver_name(actuator: str) -> str:
    return f"{actuator} driven"


def driven(scene: Some, *, references: Mapping[str, _core.Curve] | None = None) -> Some:
    """The scene with every actuator replaced by a driver that follows its reference exactly.

    Simulating it answers "which cylinder forces does this crane motion need in these waves": the result's
    cylinder_force and slew_torque are the drivers' loads. Heave compensation of an actuator goes with it.

    Parameters
    ----------
    references : mapping of str to Curve, optional
        By actuator name, instead of the actuators' own references.
    """
    chosen = {name: actuator.reference for name, actuator in scene.actuators.items()}
    for name, curve in (references or {}).items():
        if name not in chosen:
            raise SceneError(
                f"actuator {name!r} does not exist; this scene has {', '.join(chosen) or 'none'}"
            )
        chosen[name] = curve
    out = scene.copy(actuators={}, loads=without_compensation(scene.loads))
    for name, actuator in scene.actuators.items():
        _drive_as(out, actuator, chosen[name])
    return out


def _drive_as(scene: Description, actuator: _core.Actuator, curve: _core.Curve) -> None:
    """Give a scene a driver in place of an actuator."""
    place: Any = {"joint": actuator.joint, "coordinate": actuator.coordinate}
    add_driver(scene, **place, curve=curve, name=_driver_name(actuator.name))


def inverse_dynamics(
    scene: Description,
    *,
    times: Any,
    references: Mapping[str, _core.Curve] | None = None,
) -> dict[str, Array]:
    """Loads along prescribed motions of everything, by algebra at each instant; vessels are held.

    Parameters
    ----------
    scene : Scene
        Its actuators' references are prescribed; its waves and memory act as loads only at rest (memory
        states are zero), so use `driven` and `simulate` where they matter.
    times : array_like, shape (n,)
        s.
    references : mapping of str to Curve, optional
        By actuator name, instead of the actuators' own references.

    Returns
    -------
    dict of str to ndarray
        Actuator name to load (n,), N or N m; "<body>.<motion>" to the load along that motion.

    Raises
    ------
    SceneError
        If the prescribed motions leave a degree of freedom open: use `driven` and `simulate` for that.
    """
    out = driven(scene, references=references).copy(waves=calm_water(scene.waves))
    places = {name: _driver_name(name) for name in scene.actuators}
    for body in _hold_vessels(out, scene):
        places |= {f"{body}.{motion}": f"{body}.motion.{motion}" for motion in SIX}
    model = compile_scene(out)
    if model.degrees_of_freedom > 0:
        raise SceneError(
            f"scene {scene.name!r}: {model.degrees_of_freedom} degree(s) of freedom are not prescribed; "
            "simulate driven(scene)"
        )
    instants = np.atleast_1d(numbers_of("inverse dynamics: times", times))
    rows = _follow(model, list(places.values()), instants)
    return {label: rows[:, i].copy() for i, label in enumerate(places)}


def _follow(model: _core.Model, names: Sequence[str], times: Array) -> Array:
    """Driver loads at each time; the pose is projected from one instant onto the next."""
    evaluator = _core.Evaluator(model)
    state = np.array(model.initial_state)
    now, rows = 0.0, []
    for time in times:
        for intermediate in np.linspace(now, time, max(2, int(abs(time - now) / 0.05) + 2))[1:]:
            state = evaluator.project(float(intermediate), state)
        residual, _ = evaluator.residual(float(time), state)
        if residual > 1e-8:
            raise SceneError(
                f"the prescribed motion cannot be assembled at t = {time:.6g} s: {residual:.3g} m or rad open"
            )
        now = float(time)
        rows.append(drive_loads(model, names, now, state))
    return np.array(rows)


def reflected_inertia(scene: Description) -> dict[str, float]:
    """Inertia that each actuator feels at the described pose: the others locked, the vessel held.

    Returns
    -------
    dict of str to float
        By actuator name: kg (cylinders) or kg m2 (slew).
    """
    out = {}
    for name, actuator in scene.actuators.items():
        loads = []
        for acceleration in (0.0, 1.0):
            rising = [0.0, 0.0, 0.5 * acceleration, 0.0, 0.0, 0.0]
            curve = _core.Curve.pieces(starts=[0.0], coefficients=[rising])
            held = locked(scene.copy())
            del held.drivers[_driver_name(name)]
            _drive_as(held, actuator, curve)
            model = compile_scene(held)
            loads.append(drive_loads(model, [_driver_name(name)], 0.0, np.array(model.initial_state))[0])
        out[name] = float(loads[1] - loads[0])
    return out


def tuned_gains(
    inertia: Mapping[str, float], *, natural_frequency: float, damping_ratio: float
) -> dict[str, tuple[float, float]]:
    """Stiffness and damping (N/m and N s/m, or N m/rad and N m s/rad) of actuators of these inertias.

    By actuator, as `reflected_inertia` gives them (kg or kg m2), for a natural frequency (rad/s).
    """
    omega = natural_frequency
    return {name: (value * omega**2, 2.0 * damping_ratio * omega * value) for name, value in inertia.items()}


def crane_of(scene: Description, prefix: str | None) -> CraneRoles:
    """The crane of a prefix, or the only one; SceneError where that is not clear."""
    if prefix is None and len(scene.roles) == 1:
        return next(iter(scene.roles.values()))
    known = ", ".join(map(repr, scene.roles)) or "none"
    if prefix is None:
        fix = "name one as crane" if scene.roles else "add one by add_crane, or tell its parts by add_roles"
        raise SceneError(f"scene {scene.name!r}: its cranes have prefixes {known}; {fix}")
    if prefix not in scene.roles:
        raise SceneError(f"crane {prefix!r}: is not in the scene, whose cranes have prefixes {known}")
    return scene.roles[prefix]


def places_of(roles: CraneRoles) -> dict[str, Place]:
    """Joint and coordinate of the slew drive, as "slew", and of every luff and cylinder by its label."""
    found = {} if roles.slew is None else {"slew": roles.slew}
    sliding = {label: (joint, "displacement") for label, joint in roles.cylinders.items()}
    return found | dict(roles.luffs) | sliding


def places_in(scene: Description) -> dict[str, Place]:
    """Those of all cranes, with their prefixes."""
    return {
        f"{one.prefix}{label}": place
        for one in scene.roles.values()
        for label, place in places_of(one).items()
    }


def drive_name(place: Place) -> str:
    """The name of the driver that holds a coordinate in a posed scene."""
    return f"{'.'.join(place)} posed"


def posed(scene: Some, places: Mapping[str, Place], path: Mapping[str, _core.Curve]) -> Some:
    """The scene without waves, all drives held, and the cranes' coordinates led along curves of time.

    Of `places`, every coordinate of its cranes, those in `path` go from their described value 0 on.
    """
    out = driven(with_ideal_cylinders(scene)).copy(waves=calm_water(scene.waves))
    for rope in luffing_ropes(scene).values():  # its hinge is led; what it carries is told from the moment
        out.loads.pop(rope.name, None)
    still = _core.Curve.constant(value=0.0)
    for name, driver in list(out.drivers.items()):
        if (driver.joint, driver.coordinate) in places.values():
            del out.drivers[name]
    for label, (joint, coordinate) in places.items():
        curve = path.get(label, still)
        add_driver(out, joint=joint, coordinate=coordinate, curve=curve, name=drive_name((joint, coordinate)))
    return out


def path_through(
    places: Mapping[str, Place], poses: Sequence[Mapping[str, float]]
) -> tuple[dict[str, _core.Curve], Array]:
    """Curves from the described pose through others, slowly and in straight lines; and the times of these."""
    labels = list(dict.fromkeys(label for pose in poses for label in pose))
    values = np.array([[0.0] * len(labels), *([pose[label] for label in labels] for pose in poses)])
    speed = np.array([TURNING if places[label][1] in ANGLES else SLIDING for label in labels])
    spans = np.max(np.abs(np.diff(values, axis=0)) / speed, axis=1, initial=0.0)
    times = np.concatenate([[0.0], np.cumsum(spans)])
    at, first = np.unique(times, return_index=True)
    moves, curve = at.size > 1, _core.Curve
    curves = {
        label: curve.table(at, column[first]) if moves else curve.constant(value=float(column[0]))
        for label, column in zip(labels, values.T, strict=True)
    }
    return curves, times[1:]


def values_of(what: str, given: Any) -> Array:
    """One finite number or a row of them; SceneError for anything else."""
    values = np.atleast_1d(numbers_of(what, given))
    if values.ndim != 1 or not values.size or not np.all(np.isfinite(values)):
        raise SceneError(f"{what} has shape {values.shape}; give a finite number, or a row of them")
    return values
