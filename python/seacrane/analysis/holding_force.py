"""The force that a hydraulic cylinder holds, by the statics of the scene as it is described."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import locked
from seacrane.description.compilation import compile_scene
from seacrane.description.drives import add_driver
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, what_of
from seacrane.description.joints import add_joint
from seacrane.description.scene import Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.frames import rotation_matrix

AT_REST = 1e-6  # m/s2 or rad/s2
ENDS = ("first", "second", "first_point", "second_point")


def holding_force(scene: Description, given: dict[str, Any]) -> float:
    """Force (N, positive pushes) between two points that holds the scene at rest as described.

    A rod of fixed length takes the cylinder's place, and that of each other cylinder; vessels, actuated
    coordinates and the drives of cranes are held, and waves left out.

    Parameters
    ----------
    scene : Scene
        Without the cylinder.
    given : dict
        Entries of the cylinder.

    Raises
    ------
    SceneError
        If the scene is not at rest as described.
    """
    others = hydraulic_cylinders(scene)
    held = locked(scene.copy(loads={name: load for name, load in scene.loads.items() if name not in others}))
    own = _tie(held, given)
    for other in others.values():
        _tie(held, ends_of(other))
    _hold_cranes(
        held, {frozenset((one["first"], one["second"])) for one in (given, *map(ends_of, others.values()))}
    )
    model = compile_scene(held)
    evaluator = _core.Evaluator(model)
    state = np.array(model.initial_state)
    acceleration = np.abs(evaluator.terms(0.0, state)["acceleration"])
    if np.max(acceleration, initial=0.0) > AT_REST:
        worst = int(np.argmax(acceleration))
        raise SceneError(
            f"{what_of(given)}: its holding force is not known, as body {model.bodies[worst // 6]!r} "
            f"accelerates by {acceleration[worst]:.3g} (m/s2 or rad/s2) with all cylinders held; describe "
            "the scene at rest, or give pressure and pressure_rod"
        )
    run = _core.Simulation(
        model=model,
        start=_core.State(time=0.0, values=state, inputs=np.zeros(model.slots)),
        options=_core.RunOptions(integrator="rk4", output_times=[0.0], channels={"tension"}),
    )
    ties = [name for name, joint in held.joints.items() if joint.kind == "distance"]
    return -float(run.channels()["tension"][0][ties.index(own)])


def ends_of(cylinder: _core.HydraulicCylinder) -> dict[str, Any]:
    """Name, bodies and points of a cylinder."""
    return {key: getattr(cylinder, key) for key in ("name", *ENDS)}


def _hold_cranes(scene: Description, tied: set[frozenset[str]]) -> None:
    """Drivers for what nothing holds of the drives of cranes; `tied`: bodies that cylinders join."""
    driven = {driver.joint for driver in scene.drivers.values()}
    for roles in scene.roles.values():
        for name in (*([roles.slew[0]] if roles.slew else []), *roles.cylinders.values()):
            if name not in scene.joints or name in driven:
                continue
            joint = scene.joints[name]
            if frozenset((joint.first, joint.second)) not in tied:
                add_driver(scene, joint=name, curve=0.0)


def _tie(scene: Description, given: dict[str, Any]) -> str:
    """A rod of fixed length in place of a cylinder; its name."""
    name = f"{given['name']} held"
    places = {}
    for end in ("first", "second"):
        point = np.asarray(given.get(f"{end}_point", (0.0, 0.0, 0.0)), dtype=float)
        body = scene.bodies.get(given[end])
        turn = np.eye(3) if body is None else rotation_matrix(body.quaternion)
        places[end] = turn @ point + (0.0 if body is None else np.asarray(body.position))
    add_joint(
        scene, kind="distance", name=name, first=given["first"], second=given["second"],
        point=places["first"], second_point=places["second"],
        length=number_of(name, np.linalg.norm(places["second"] - places["first"])),
    )  # fmt: skip
    return name
