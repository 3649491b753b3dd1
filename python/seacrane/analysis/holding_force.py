"""The forces that hydraulic cylinders hold, by the statics of the scene as it is described."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import at_rest, locked_at_rest
from seacrane.analysis.rods import add_rod, ends_of, rod_forces, without_cylinders
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.drives import add_driver
from seacrane.description.holding import let_go
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, what_of
from seacrane.errors import SceneError


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
    return _forces(scene, what_of(given), [given])[given["name"]]


def holding_forces(scene: Description) -> dict[str, float]:
    """Likewise of the hydraulic cylinders that a scene has, by name."""
    return _forces(scene, f"scene {scene.name!r}", [])


def _forces(scene: Description, what: str, more: list[dict[str, Any]]) -> dict[str, float]:
    cylinders = [*more, *map(ends_of, hydraulic_cylinders(scene).values())]
    held = locked_at_rest(without_cylinders(let_go(scene)))
    for one in cylinders:
        add_rod(held, one)
    _hold_cranes(held, {frozenset((one["first"], one["second"])) for one in cylinders})
    model = compile_scene(held)
    evaluator = _core.Evaluator(model)
    state = np.array(model.initial_state)
    acceleration = np.abs(evaluator.terms(0.0, state)["acceleration"])
    if np.max(acceleration, initial=0.0) > at_rest(scene):
        worst = int(np.argmax(acceleration))
        raise SceneError(
            f"{what}: its holding force is not known, as body {model.bodies[worst // 6]!r} "
            f"accelerates by {acceleration[worst]:.3g} (m/s2 or rad/s2) with all cylinders held; describe "
            "the scene at rest, or give pressure and pressure_rod"
        )
    start = _core.State(time=0.0, values=state, inputs=np.zeros(model.slots))
    return rod_forces(held, model, start)


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
