"""What a scene most likely did not mean: each a warning by name, when a run starts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.given import floating_bodies
from seacrane.description.holding import free_drives
from seacrane.description.loads import bodies_of, kind_of
from seacrane.description.once import once, once_in_any_sea
from seacrane.description.outline import size_of_ship
from seacrane.description.places import ANGLES, placed
from seacrane.description.references import references
from seacrane.description.suspension import bodies_below
from seacrane.description.wet_parts import immersed_parts
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.plausible import angle_of
from seacrane.validity.contact_starts import warn_of_contact_starts
from seacrane.validity.hull_range import peak_of
from seacrane.validity.lifting import warn_of_loads_in_hulls
from seacrane.validity.line_checks import warn_of_line_starts
from seacrane.validity.magnitudes import warn_of_units
from seacrane.validity.unstable import carried_by, warn_of_capsize
from seacrane.warnings import (
    BallastWarning,
    CompassDirectionWarning,
    DragAxesWarning,
    FreeCraneWarning,
    MassUnitWarning,
    ScatteredWavesWarning,
)

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
EXACT = 1e-9
AGAINST = np.radians(120.0)  # between a wind and waves that it does not raise
LEAST_ENERGY = 0.01  # of the waves, which runs with the wind
HEAVIEST_AIR = 10.0  # kg/m3
LARGEST_RADIUS = 200.0  # m, of gyration
HUNG_SHARE = 1e-5  # of the vessel's mass
LARGEST_HEEL = np.radians(2.0)
LARGEST_SINKAGE = 2.0  # m
DEEP = np.pi  # of wavenumber times depth: 4 % of the wave are left
STEEP = np.radians(45.0)  # of a part's z axis from the vertical
UNLIKE = 1.5  # drag along z over that across it, or the other way round
WITHOUT_WEIGHT = ("flow force", "span drag")  # nothing of them acts at rest, or the next wave turns it


@once
def warn_of_description(
    scene: Description, *, start: float, end: float, described: bool, begins: bool
) -> None:
    """All that a scene tells by itself, from `start` to `end` (s).

    `described`: from its described pose; `begins`: from there or from its state at rest, not further on.
    """
    _warn_of_angles(scene, start, end)
    _warn_of_winds(scene)
    _warn_of_masses(scene)
    if begins:
        warn_of_units(scene, start, end, described=described)
        warn_of_free_cranes(scene)
        warn_of_loads_in_hulls(scene)
        warn_of_parts_near_hulls(scene)
        warn_of_drag_axes(scene)
    if described:
        _warn_of_ballast(scene)
        warn_of_capsize(scene)
        warn_of_line_starts(scene)
        warn_of_contact_starts(scene)


def _warn_of_angles(scene: Description, start: float, end: float) -> None:
    """An angle that comes to rest whole radians and turns away; what keeps turning is a machine."""
    for reference in references(scene):
        if reference.coordinate not in ANGLES:
            continue
        (first, _, _), (last, rate, _) = reference.curve.evaluate([start, end])
        angle = last if last == first else last - first
        if rate == 0.0 and abs(angle - round(angle)) < EXACT:
            angle_of(f"{reference.owner}: reference of {reference.joint}.{reference.coordinate}", angle)


def _warn_of_winds(scene: Description) -> None:
    """Wind against all waves: one of the two directions is where it comes from."""
    if scene.waves is None:
        return
    energy = np.square(np.asarray(scene.waves.amplitude, dtype=float)) * np.ones(len(scene.waves.omega))
    direction = np.asarray(scene.waves.direction, dtype=float)
    for name, load in scene.loads.items():
        if not (isinstance(load, _core.FlowForce) and load.density < HEAVIEST_AIR) or _still(load):
            continue
        along = np.cos(direction - load.direction) >= np.cos(AGAINST)
        if np.sum(energy * along) < LEAST_ENERGY * np.sum(energy):
            main = float(np.angle(np.sum(energy * np.exp(1j * direction))))
            warn_caller(
                f"flow force {name!r}: the wind blows to {np.degrees(load.direction):.4g} deg, the waves run "
                f"to {np.degrees(main):.4g} deg, against it. Both are where they go to; weather forecasts "
                "and compasses tell where wind comes from: turn it by 180 deg?",
                CompassDirectionWarning,
            )


def _still(wind: _core.FlowForce) -> bool:
    return not np.any(np.asarray(wind.speed.to_pieces()["coefficients"]))


@once_in_any_sea
def _warn_of_masses(scene: Description) -> None:
    for name, body in scene.bodies.items():
        radius = math.sqrt(float(np.trace(body.inertia)) / 2.0 / body.mass)
        if radius > LARGEST_RADIUS:
            warn_caller(
                f"body {name!r}: mass {body.mass:.6g} kg and inertia make a radius of gyration of "
                f"{radius:.4g} m; give both in kg and kg m2: tonnes for kg?",
                MassUnitWarning,
            )
    floating = floating_bodies(scene)
    hulls = [body.mass for name, body in scene.bodies.items() if name in floating]
    for one, below in bodies_below(scene) if hulls else []:
        mass = sum(scene.bodies[body].mass for body in below)
        if mass < HUNG_SHARE * max(hulls):
            warn_caller(
                f"body {below[0]!r}: {mass:.6g} kg hang on {one.name!r}, in a scene with a vessel of "
                f"{max(hulls):.4g} kg, which does not feel them; masses are kilograms: tonnes for kg?",
                MassUnitWarning,
            )


@once_in_any_sea
def _warn_of_ballast(scene: Description) -> None:
    """Weights on a vessel against forces on it, by its restoring; not where other loads hold it."""
    for vessel in (one for one in scene.vessels.values() if one.floats):
        hull = scene.bodies[vessel.body]
        carried = carried_by(scene, vessel.body)
        if any(_holds(scene, load, carried) for load in scene.all_loads()):
            continue
        weights = [scene.bodies[name] for name in carried - {vessel.body} if scene.bodies[name].gravity]
        restoring = np.asarray(vessel.restoring)[2:5, 2:5]
        if not weights or not np.all(np.diag(restoring) > 0.0):
            continue
        held = [force for force in scene.point_forces.values() if force.body in carried]
        bodies = [*weights, *(scene.bodies[force.body] for force in held)]
        points = np.array([*(body.center_of_mass for body in weights), *(force.point for force in held)])
        turned = rotation_matrix([body.quaternion for body in bodies]) @ points[:, :, None]
        arms = np.array([body.position for body in bodies]) + turned[:, :, 0] - hull.position
        bow = rotation_matrix(hull.quaternion)[:2, 0]
        bow = bow / np.hypot(*bow)
        forward, port = arms[:, :2] @ bow, arms[:, :2] @ [-bow[1], bow[0]]
        lift = np.array([*(-body.mass * scene.gravity for body in weights), *(f.force[2] for f in held)])
        load = [lift.sum(), lift @ port, -lift @ forward]
        _warn_of_balance(vessel, np.linalg.lstsq(restoring, load)[0], float(hull.position[2]))


def _holds(scene: Description, load: Any, carried: frozenset[str]) -> bool:
    """Whether a load pushes what a vessel carries from outside, with a force that is not known here."""
    ends = set(bodies_of(load, scene.joints))
    known = kind_of(load) == "point force" or kind_of(load) in WITHOUT_WEIGHT
    return bool(ends & carried) and not known and (len(ends) == 1 or not ends <= carried)


def _warn_of_balance(vessel: _core.VesselHydrodynamics, rest: Array, start: float) -> None:
    """`rest`: heave, roll and pitch at which the weights balance, from the described pose at `start`."""
    heave, roll, pitch = rest[0] - start, rest[1], rest[2]
    if max(abs(roll), abs(pitch)) <= LARGEST_HEEL and abs(heave) <= LARGEST_SINKAGE:
        return
    warn_caller(
        f"vessel {vessel.name!r}: starts out of balance: its loads would heel it by {np.degrees(roll):.3g} "
        f"deg, trim it by {np.degrees(pitch):.3g} deg and lift it by {heave:.3g} m, so that it swings from "
        "the start. Add ballast (Scene.add_ballast), or start from seacrane.equilibrium(scene)",
        BallastWarning,
    )


def warn_of_free_cranes(scene: Description) -> None:
    """Joints of cranes that neither a driver nor a load acts on; not where C functions may hold them."""
    for roles in scene.roles.values():
        free = [f"{label} (joint {joint!r})" for label, joint, _ in free_drives(scene, roles)]
        if free and not roles.held:
            which = f"crane {roles.prefix!r}" if roles.prefix else "crane"
            warn_caller(
                f"{which}: nothing holds {', '.join(free)}: it falls, or turns as the ship rolls. Leave out "
                "held=False of add_crane, or give each joint a driver (Scene.add_driver) or an actuator "
                "(Scene.add_actuator)",
                FreeCraneWarning,
            )


@once
def warn_of_parts_near_hulls(scene: Description) -> None:
    """Warn, once for each ship, of the part that starts nearest to its side, within its breadth."""
    if scene.waves is None or not np.any(scene.waves.amplitude):
        return
    ships = floating_bodies(scene)
    parts = [
        one for one in scene.loads.values() if isinstance(one, _core.ImmersedPart) and one.wave_factor == 1.0
    ]
    places = {one.name: placed(scene, one.body, one.point) for one in parts if one.body not in ships}
    deepest = -DEEP / peak_of(scene).wavenumber if places else 0.0
    places = {name: place for name, place in places.items() if place[2] > deepest}
    for ship in sorted(ships) if places else ():
        length, breadth = size_of_ship(scene, ship)
        away = {name: _beside(scene.bodies[ship], place, length, breadth) for name, place in places.items()}
        nearest = min(away, key=lambda name: away[name])
        if away[nearest] < breadth:
            warn_caller(
                f"immersed part {nearest!r}: starts {away[nearest]:.3g} m from the side of {ship!r}, within "
                f"its breadth of {breadth:.3g} m, in a sea. The water that it feels has neither the waves "
                "that the hull scatters nor those that it makes: before a wall waves are twice as high, in a "
                "lee lower. Give wave_factor what this hull makes of them",
                ScatteredWavesWarning,
            )


def _beside(hull: _core.Body, place: Array, length: float, breadth: float) -> float:
    """Horizontal distance of a place from the box of a hull, m; 0 within it."""
    x, y, _ = rotation_matrix(hull.quaternion).T @ (place - np.asarray(hull.position))
    return float(np.hypot(max(abs(x) - 0.5 * length, 0.0), max(abs(y) - 0.5 * breadth, 0.0)))


@once_in_any_sea
def warn_of_drag_axes(scene: Description) -> None:
    """Warn of tables of parts whose z axis is far from the vertical as described, and whose drag knows it."""
    for part in immersed_parts(scene).values():
        if part.shape != "table" or part.body not in scene.bodies:
            continue
        turn = rotation_matrix(scene.bodies[part.body].quaternion) @ np.asarray(part.axes)
        tilt = float(np.arccos(np.clip(abs(turn[2, 2]), 0.0, 1.0)))
        areas = np.asarray(part.drag) / (0.5 * part.density)
        ratio = areas[2] / max(float(areas[:2].mean()), 1e-300)
        if tilt > STEEP and not 1.0 / UNLIKE <= ratio <= UNLIKE:
            warn_caller(
                f"immersed part {part.name!r}: its z axis is {np.degrees(tilt):.3g} deg from the vertical as "
                f"described, and its drag_area of {areas[2]:.4g} m2 acts along it, not upwards. drag_area is "
                "along the axes of the part, which turn with the body: give it in their order, or turn the "
                "part by axes, if it enters the water as described",
                DragAxesWarning,
            )
