"""Loads that hold a scene at rest, and a constant force that carries what a vessel has on it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import SIX, actuator_loads, at_rest, channels_at, drive_loads, locked_at_rest
from seacrane.analysis.rest_state import held, rest_states
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.elements import add_force
from seacrane.description.given import floating_bodies, given_vessels
from seacrane.description.places import place_of, position_of
from seacrane.description.wet_parts import immersed_parts, waters_in, wet_bodies
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named

WET = {"position", "quaternion", "load_force", "load_moment"}


@dataclass(frozen=True, kw_only=True)
class Balance:
    """Loads that hold a scene at rest.

    Attributes
    ----------
    vessel_wrenches : mapping of str to ndarray, shape (6,)
        By the vessel's body: force (N) and moment (N m) on it about its origin, inertial axes.
    loads : mapping of str to float
        Along each actuated joint coordinate, by actuator name: N (cylinders, positive pushes) or N m.
    weight : Of all bodies that have weight, N, less what water carries of them.
    weight_center : ndarray, shape (3,)
        Where it acts, inertial frame, m: without water the common centre of mass at the start.
    """

    vessel_wrenches: Mapping[str, Array]
    loads: Mapping[str, float]
    weight: float
    weight_center: Array

    @property
    def vessel_wrench(self) -> Array | None:
        """The wrench on the only vessel; None without one, SceneError with several."""
        if len(self.vessel_wrenches) > 1:
            raise SceneError(
                f"balance: vessels {', '.join(map(repr, self.vessel_wrenches))} have a wrench each; take it "
                "from vessel_wrenches by its name"
            )
        return next(iter(self.vessel_wrenches.values()), None)


@named
def balance(scene: Description) -> Balance:
    """Loads that keep the described scene at rest.

    Drivers hold the vessel's six motions and every actuated coordinate; what hangs is taken to hang at
    rest. Where parts of it are in water they carry it too, so that it hangs higher than described: its rest
    is looked for first. Waves are left out.

    Raises
    ------
    SceneError
        If a body would accelerate although everything driven is held (it is described off its rest pose);
        with parts in water, if there is no rest near.
    """
    still = locked_at_rest(scene)
    state = next(rest_states(still, times=[0.0])) if wet_bodies(scene) else _as_described(still)
    still = held(still) if wet_bodies(scene) else still
    model = compile_scene(still)
    wrenches = {}
    for vessel in (one for one in scene.vessels.values() if one.floats):
        names = [f"{vessel.body}.motion.{motion}" for motion in SIX]
        wrenches[vessel.body] = drive_loads(model, names, state.time, np.array(state.values))
    weight, center = weight_of(scene)
    loads = dict(zip(scene.actuators, actuator_loads(scene, still, state).tolist(), strict=True))
    return Balance(vessel_wrenches=wrenches, loads=loads, weight=weight, weight_center=center)


def _as_described(still: Description) -> _core.State:
    """The state that is described; SceneError where it is no rest."""
    model = compile_scene(still)
    values = np.array(model.initial_state)
    acceleration = _core.Evaluator(model).terms(0.0, values)["acceleration"]
    worst = int(np.argmax(np.abs(acceleration)))
    if abs(acceleration[worst]) > at_rest(still):
        raise SceneError(
            f"body {model.bodies[worst // 6]!r}: accelerates by {acceleration[worst]:.3g} (m/s2 or rad/s2) "
            "with all driven coordinates held; describe it at its rest pose"
        )
    return _core.State(time=0.0, values=values, inputs=np.zeros(model.slots))


def weight_of(scene: Description) -> tuple[float, Array]:
    """Weight of all bodies that have weight but vessels, less what water carries, N; where it acts, m.

    In the inertial frame, as described; with parts in water, at the rest of what hangs.
    """
    floating = floating_bodies(scene)
    heavy = [body for body in scene.bodies.values() if body.gravity and body.name not in floating]
    weights = scene.gravity * np.array([body.mass for body in heavy])
    if wet_bodies(scene) - floating:
        return _weight_in_water(scene, heavy, weights)
    centers = [place_of(scene, body=body.name, point=body.center_of_mass) for body in heavy]
    center = np.average(centers, axis=0, weights=weights) if heavy else np.zeros(3)
    return float(weights.sum()), center


def _weight_in_water(scene: Description, heavy: Sequence[_core.Body], weights: Array) -> tuple[float, Array]:
    """Of the bodies, and of what water does to their parts where they rest."""
    still = held(locked_at_rest(scene))
    state, model = next(rest_states(still, times=[0.0])), compile_scene(still)
    told = channels_at(model, WET, 0.0, np.array(state.values))
    poses = {name: told[name][None] for name in ("position", "quaternion")}
    centers = np.array([position_of(scene, poses, body.name, body.center_of_mass)[0] for body in heavy])
    force = np.array([0.0, 0.0, -float(weights.sum())])
    moment = np.cross(centers, np.outer(weights, [0.0, 0.0, -1.0])).sum(axis=0)
    on = {body.name for body in heavy}
    wet: list[Any] = [*immersed_parts(scene).values(), *waters_in(scene)]
    for load in wet:
        if load.body in on:
            at = model.axes["load"].index(load.name)
            push = told["load_force"][at]
            origin = position_of(scene, poses, load.body, (0.0, 0.0, 0.0))[0]
            force, moment = force + push, moment + told["load_moment"][at] + np.cross(origin, push)
    weight = -float(force[2])
    place = np.array([moment[1], -moment[0]]) / weight  # of a downward force with that moment
    return weight, np.array([*place, np.average(centers[:, 2], weights=weights)])


def balance_by_force(scene: Description, *, body: str = "vessel", name: str = "balance") -> Balance:
    """Add the force on the only vessel that carries the weight of all other bodies at the start.

    Returns the balance of the scene without it. Raises SceneError if `body` is not the only vessel, or the
    scene is not at rest as it is described; see `seacrane.balance`.
    """
    if body in given_vessels(scene):
        raise SceneError(f"balance: the motion of {body!r} is given: it needs no ballast, leave it out")
    floating = sorted(floating_bodies(scene))
    if floating != [body]:
        raise SceneError(
            f"balance: vessel is {body!r}, and the vessels are {', '.join(map(repr, floating)) or 'none'}; "
            "only the one vessel of a scene is balanced so, give several a force each"
        )
    found, vessel = balance(scene), scene.bodies[body]
    center = rotation_matrix(vessel.quaternion).T @ (found.weight_center - vessel.position)
    add_force(scene, body, name=name, point=(center[0], center[1], 0.0), force=(0.0, 0.0, found.weight))
    return found
