"""Hydraulic cylinders between two points, with the pressures that hold the scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.inverse import at_rest, locked_at_rest
from seacrane.analysis.rods import add_rod, ends_of, rod_forces, without_cylinders
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.drives import add_driver
from seacrane.description.edit import replace_element
from seacrane.description.holding import let_go
from seacrane.description.hydraulic_cylinders import (
    holding_pressures,
    hydraulic_cylinders,
    place_cylinder,
    what_of,
)
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of

NEVER = 1e7  # s


def add_hydraulic_cylinder(
    scene: Description,
    name: str,
    *,
    first: str,
    second: str,
    full_area: float,
    rod_side_area: float,
    retracted_length: float,
    stroke: float,
    first_point: Any = (0.0, 0.0, 0.0),
    second_point: Any = (0.0, 0.0, 0.0),
    pressure: float | None = None,
    pressure_rod: float | None = None,
    hose_volume: float | None = None,
    hose_volume_rod: float | None = None,
    oil_modulus: float = 1.5e9,
    hose_modulus: float = 1.5e8,
    cylinder_modulus: float = 3.15e10,
    air: float = 0.0,
    vapour_pressure: float = 2e3,
    pump_pressure: float = 0.0,
    tank_pressure: float = 1e5,
    rated_flow: float = 0.0,
    rated_flow_rod: float = 0.0,
    rated_drop: float = 3.5e6,
    laminar_drop: float = 2e5,
    overlap: float = 0.0,
    spool_lag: float = 4.547e-3,
    pump_check: bool = False,
    makeup_flow: float = 0.0,
    relief_pressure: float = 0.0,
    relief_pressure_rod: float = 0.0,
    relief_flow: float = 0.0,
    relief_override: float = 1e6,
    counterbalance_pressure: float = 0.0,
    counterbalance_pressure_rod: float = 0.0,
    counterbalance_flow: float = 0.0,
    counterbalance_range: float = 5e6,
    pilot_ratio: float = 4.0,
    command: _core.Curve | float = 0.0,
    reference: _core.Curve | float | None = None,
    gain: float = 0.0,
    rate_gain: float = 0.0,
    internal_leakage: float = 0.0,
    external_leakage: float = 0.0,
    viscous_friction: float = 0.0,
    friction: float = 0.0,
    friction_speed: float = 0.01,
    stop_stiffness: float = 1e9,
    accumulator_volume: float = 0.0,
    accumulator_pressure: float = 0.0,
    accumulator_flow: float = 0.0,
    accumulator_exponent: float = 1.4,
    rupture_time: float = NEVER,
    rupture_area: float = 0.0,
    rod_side_ruptures: bool = False,
    discharge_coefficient: float = 0.6,
    oil_density: float = 870.0,
    refuse_void: bool = False,
) -> _core.HydraulicCylinder:
    """Join two points by a hydraulic cylinder: pressures of both chambers, valves, pump, leakage, friction.

    Its states are "<name>.pressure", "<name>.pressure_rod", "<name>.spool" and, of an accumulator,
    "<name>.gas_volume". All pressures are absolute. A relief valve that opens, a pressure that falls below
    the vapour's and an end of the stroke are events of kind "limit", such as "<name>.relief". See
    docs/hydraulics.md.

    Parameters
    ----------
    first, second : str
        Bodies; "ground" is one too.
    full_area, rod_side_area : float
        Of the piston, m2; of the rod side less the rod.
    retracted_length, stroke : float
        m, between the points at stroke 0; largest.
    first_point, second_point : array_like, shape (3,)
        m, in coordinates of the bodies.
    pressure, pressure_rod : float, optional
        Pa, of the full side and of the rod side at the start. Default: those that hold the scene at rest as
        described; the chamber that carries nothing has a tenth of the pump's pressure. Add the cylinder after
        what it carries, or see `hold_pressures`.
    hose_volume, hose_volume_rod : float, optional
        m3, of oil beside the swept volume. Default: 5 % of the swept volume.
    oil_modulus, hose_modulus, cylinder_modulus : float
        Pa, of the oil, and of hoses and barrel by their volumes.
    air : float
        Share of the volume that is free air at 1e5 Pa.
    vapour_pressure : float
        Pa, at which the oil boils and a void opens: an event, and a `BoilingOilWarning`.
    pump_pressure, tank_pressure : float
        Pa; a pump pressure of 0: no pump.
    rated_flow, rated_flow_rod : float
        m3/s, of the valve's open edges to the full side and to the rod side at `rated_drop`; 0: no valve, and
        the same.
    rated_drop, laminar_drop : float
        Pa; about the laminar drop flow turns from linear to a square root.
    overlap : float
        Share of the spool's travel before an edge opens.
    spool_lag : float
        s, of the spool behind its command; 0: it follows at once, and is no state.
    pump_check : bool
        Whether a check valve keeps oil from the pump.
    makeup_flow : float
        m3/s at `rated_drop`, of check valves from the tank; 0: none.
    relief_pressure, relief_pressure_rod : float
        Pa, at which relief valves open; 0: none.
    relief_flow, relief_override : float
        m3/s that a relief valve passes at that pressure (Pa) above its opening.
    counterbalance_pressure, counterbalance_pressure_rod : float
        Pa, at which load-holding valves open without pilot; 0: none.
    counterbalance_flow, counterbalance_range : float
        m3/s of an open one at `rated_drop`; Pa from its opening to open.
    pilot_ratio : float
        Of the other side's pressure in its opening.
    command : Curve or float
        Of the spool, -1 (retracts) to 1 (extends).
    reference : Curve or float, optional
        m, stroke that the spool follows with `gain`. Default: the described one.
    gain, rate_gain : float
        1/m and s/m: spool over the missing stroke, and over the reference's rate.
    internal_leakage, external_leakage : float
        m3/s/Pa, past the piston; from each side to the tank.
    viscous_friction, friction, friction_speed : float
        N s/m; N, dry, and m/s, about which that changes its sign.
    stop_stiffness : float
        N/m, of the ends of the stroke.
    accumulator_volume, accumulator_pressure, accumulator_flow, accumulator_exponent : float
        Of a gas accumulator on the full side: m3 and Pa of its gas without oil, m3/s through its throttle at
        `rated_drop`, and the gas law's exponent.
    rupture_time, rupture_area : float
        s and m2, of a hose that bursts; 1e7 and 0: none.
    rod_side_ruptures : bool
        In place of the full side.
    discharge_coefficient, oil_density : float
        Of the hole, and of the oil that leaves through it, kg/m3.
    refuse_void : bool
        Whether a run ends with an error where oil boils.

    Raises
    ------
    SceneError
        If the points are not within the stroke as described, or the holding force is not known; what else
        does not fit is said by `Scene.compile`.
    """
    given = {key: value for key, value in locals().items() if key != "scene"}
    text_of("hydraulic cylinder: name", name)
    known = pressure is not None and pressure_rod is not None
    return place_cylinder(scene, given, None if known else _held(scene, given))


def _held(scene: Description, given: dict[str, Any]) -> float:
    for end in ("first", "second"):
        if given[end] != "ground" and given[end] not in scene.bodies:
            raise SceneError(
                f"hydraulic cylinder {given['name']!r}: there is no body {given[end]!r}; add it first"
            )
    return holding_force(scene, given)


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
    for name, force in holding_forces(scene).items():
        full, rod = holding_pressures(cylinders[name], force)
        replace_element(scene, name, kind="load", pressure=full, pressure_rod=rod)
    return hydraulic_cylinders(scene)


def holding_force(scene: Description, given: dict[str, Any]) -> float:
    """Force (N, positive pushes) between two points that holds the scene at rest as described.

    A rod of fixed length takes the cylinder's place, and that of each other cylinder; vessels, actuated
    coordinates and the drives of cranes are held, and waves left out.

    Parameters
    ----------
    scene : Without the cylinder.
    given : Entries of the cylinder.

    Raises SceneError if the scene is not at rest as described.
    """
    return _forces(scene, what_of(given), [given])[given["name"]]


def holding_forces(scene: Description) -> dict[str, float]:
    """The forces of the hydraulic cylinders that a scene has, by name."""
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
