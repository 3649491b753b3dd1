"""Hydraulic cylinders between two points, with the pressures that hold the scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import at_rest, locked_at_rest
from seacrane.analysis.rest_on_oil import add_rod, ends_of, rod_forces, without_cylinders
from seacrane.description import hydraulic_cylinders as of
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.elements import add_driver
from seacrane.description.holding import let_go
from seacrane.description.hydraulic_cylinders import (
    holding_pressures,
    hydraulic_cylinders,
    place_cylinder,
    what_of,
)
from seacrane.description.places import ORIGIN
from seacrane.errors import SceneError
from seacrane.inputs.values import told_by
from seacrane.scene.edit import replace_element


@told_by(_core.HydraulicCylinder)
def add_hydraulic_cylinder(
    scene: Description, name: str, *, first: str, second: str, full_area: float, rod_side_area: float,
    retracted_length: float, stroke: float, first_point: Any = ORIGIN, second_point: Any = ORIGIN,
    chamber: of.Chamber | None = None, rod_chamber: of.Chamber | None = None, oil: of.Oil | None = None,
    pump: of.Pump | None = None, valve: of.Valve | None = None, command: _core.Curve | float | None = None,
    reference: _core.Curve | float | None = None, relief: of.Relief | None = None,
    counterbalance: of.Counterbalance | None = None, accumulator: of.Accumulator | None = None,
    piston: of.Piston | None = None, rupture: of.Rupture | None = None,
) -> _core.HydraulicCylinder:  # fmt: skip
    """Join two points by a hydraulic cylinder: pressures of both chambers, valves, pump, leakage, friction.

    Its states are "<name>.pressure", "<name>.pressure_rod", "<name>.spool" and, of an accumulator,
    "<name>.gas_volume". All pressures are absolute. A relief valve that opens, a pressure that falls below
    the vapour's and an end of the stroke are events of kind "limit", such as "<name>.relief". See
    docs/hydraulics.md.

    Parameters
    ----------
    chamber, rod_chamber : Chamber, optional
        Start pressures and hoses of the full side and of the rod side. A cylinder whose pressures are not
        given is added after what it carries, or see `hold_pressures`.
    oil, pump, valve, relief, counterbalance, accumulator, piston, rupture : optional
        An `Oil`, a `Pump`, a `Valve` and so on. Default: usual oil; none of the others, and no friction.
    command : Curve or float, optional
        Of the spool, -1 (retracts) to 1 (extends). Default: 0.
    reference : Curve or float, optional
        m, stroke that the spool follows with the valve's `gain`. Default: the described one.

    Raises
    ------
    SceneError
        If the points are not within the stroke as described, or the holding force is not known; what else
        does not fit is said by `Scene.compile`.
    """
    keywords = {key: value for key, value in locals().items() if key != "scene"}
    return place_cylinder(scene, keywords, lambda: holding_forces(scene, what_of(keywords), [keywords])[name])


def hold_pressures(scene: Description) -> dict[str, _core.HydraulicCylinder]:
    """Let hydraulic cylinders start with the pressures that hold the scene at rest as it is now described.

    A cylinder begins with the pressures that hold what was there when it was added. Call this once the rest
    is there: a payload that hangs on an elastic line or a winch, or bodies that were added later. The rod
    sides keep their pressures, unless the full side's would fall below the tank's.

    Returns
    -------
    dict of str to HydraulicCylinder
        Those of the scene, by name.

    Raises
    ------
    SceneError
        If the scene has no hydraulic cylinder, or is not at rest as described.
    """
    cylinders = hydraulic_cylinders(scene)
    if not cylinders:
        raise SceneError(
            f"scene {scene.name!r}: has no hydraulic cylinder whose pressures would hold it; add one first"
        )
    for name, force in holding_forces(scene, f"scene {scene.name!r}", []).items():
        full, rod = holding_pressures(cylinders[name], force)
        replace_element(scene, name, kind="load", pressure=full, pressure_rod=rod)
    return hydraulic_cylinders(scene)


def holding_forces(
    scene: Description, what: str, more: list[dict[str, Any]], *, free: str = ""
) -> dict[str, float]:
    """Forces (N, positive pushes) of cylinders, by name, that hold the scene at rest as described.

    Rods of fixed length take their places; vessels, actuated coordinates and the drives of cranes are held,
    and waves left out. `more`: names and ends of cylinders, or ropes, that the scene does not have; `free`: a
    hinge that one of them holds.
    """
    cylinders = [*more, *map(ends_of, hydraulic_cylinders(scene).values())]
    held = locked_at_rest(without_cylinders(let_go(scene)))
    for one in cylinders:
        add_rod(held, one)
    _hold_cranes(held, {frozenset((one["first"], one["second"])) for one in cylinders}, free)
    model = compile_scene(held)
    evaluator = _core.Evaluator(model)
    state = np.array(model.initial_state)
    acceleration = np.abs(evaluator.terms(0.0, state)["acceleration"])
    if np.max(acceleration, initial=0.0) > at_rest(scene):
        worst = int(np.argmax(acceleration))
        raise SceneError(
            f"{what}: its holding force is not known, as body {model.bodies[worst // 6]!r} "
            f"accelerates by {acceleration[worst]:.3g} (m/s2 or rad/s2) with all cylinders held; describe "
            "the scene at rest, or give the pressures of chamber and rod_chamber"
        )
    start = _core.State(time=0.0, values=state, inputs=np.zeros(model.slots))
    return rod_forces(held, model, start)


def _hold_cranes(scene: Description, tied: set[frozenset[str]], free: str) -> None:
    """Drivers for what nothing holds of the drives of cranes; `tied`: bodies that cylinders join."""
    driven = {free, *(driver.joint for driver in scene.drivers.values())}
    for roles in scene.roles.values():
        slews = [] if roles.slew is None else [roles.slew[0]]
        luffs = [joint for joint, _ in roles.luffs.values() if free]
        for name in (*slews, *luffs, *roles.cylinders.values()):
            if name not in scene.joints or name in driven:
                continue
            joint = scene.joints[name]
            if frozenset((joint.first, joint.second)) not in tied:
                add_driver(scene, joint=name, curve=0.0)
