"""What a scene most likely did not mean: each a warning by name, when a run starts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core, warnings
from seacrane.analysis.hull_range import beside, peak_of
from seacrane.analysis.lifting import warn_of_loads_in_hulls
from seacrane.analysis.line_checks import warn_of_line_starts
from seacrane.analysis.magnitudes import warn_of_units
from seacrane.arrays import Array
from seacrane.description.description import all_loads
from seacrane.description.given import (
    beside_surface,
    borne_mass,
    elastic_force,
    floating_bodies,
    welded_mass,
    with_mass,
)
from seacrane.description.holding import free_drives
from seacrane.description.line_path import described_poses
from seacrane.description.loads import bodies_of, kind_of, named
from seacrane.description.once import once, once_in_any_sea
from seacrane.description.outline import size_of_ship
from seacrane.description.places import ANGLES, placed
from seacrane.description.references import references
from seacrane.description.suspension import bodies_below
from seacrane.description.wet_parts import immersed_parts
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.plausible import angle_of

if TYPE_CHECKING:
    from seacrane.description.description import Description

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
SUNK = 0.1  # m of a contact's point, as the core has it of what is described
CRUSHED = 10.0  # times the weight on a point, likewise
SHOT = 1.0  # m/s2, away from a surface: a tenth of the weight
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
        if not (isinstance(load, _core.FlowForce) and load.density < HEAVIEST_AIR):
            continue
        if not np.any(load.speed.to_pieces()["coefficients"]):
            continue
        along = np.cos(direction - load.direction) >= np.cos(AGAINST)
        if np.sum(energy * along) < LEAST_ENERGY * np.sum(energy):
            main = float(np.angle(np.sum(energy * np.exp(1j * direction))))
            warn_caller(
                f"flow force {name!r}: the wind blows to {np.degrees(load.direction):.4g} deg, the waves run "
                f"to {np.degrees(main):.4g} deg, against it; forecasts say where wind comes from: turn it by "
                "180 deg?",
                warnings.CompassDirectionWarning,
            )


@once_in_any_sea
def _warn_of_masses(scene: Description) -> None:
    for name, body in scene.bodies.items():
        radius = math.sqrt(float(np.trace(body.inertia)) / 2.0 / body.mass)
        if radius > LARGEST_RADIUS:
            warn_caller(
                f"body {name!r}: mass {body.mass:.6g} kg and inertia make a radius of gyration of "
                f"{radius:.4g} m; give both in kg and kg m2: tonnes for kg?",
                warnings.MassUnitWarning,
            )
    floating = floating_bodies(scene)
    hulls = [body.mass for name, body in scene.bodies.items() if name in floating]
    for one, below in bodies_below(scene) if hulls else []:
        mass = sum(scene.bodies[body].mass for body in below)
        if mass < HUNG_SHARE * max(hulls):
            warn_caller(
                f"body {below[0]!r}: {mass:.6g} kg hang on {one.name!r}, in a scene with a vessel of "
                f"{max(hulls):.4g} kg, which does not feel them; masses are kilograms: tonnes for kg?",
                warnings.MassUnitWarning,
            )


@once_in_any_sea
def _warn_of_ballast(scene: Description) -> None:
    """Weights on a vessel against forces on it, by its restoring; not where other loads hold it."""
    for vessel in (one for one in scene.vessels.values() if one.floats):
        hull = scene.bodies[vessel.body]
        carried = carried_by(scene, vessel.body)
        if any(_holds(scene, load, carried) for load in all_loads(scene)):
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
        heave, roll, pitch = np.linalg.lstsq(restoring, load)[0] - [hull.position[2], 0.0, 0.0]
        if max(abs(roll), abs(pitch)) <= LARGEST_HEEL and abs(heave) <= LARGEST_SINKAGE:
            continue
        warn_caller(
            f"vessel {vessel.name!r}: starts out of balance: its loads would heel it by "
            f"{np.degrees(roll):.3g} deg, trim it by {np.degrees(pitch):.3g} deg and lift it by "
            f"{heave:.3g} m. Add ballast (Scene.add_ballast), or start from seacrane.equilibrium(scene)",
            warnings.BallastWarning,
        )


def _holds(scene: Description, load: Any, carried: frozenset[str]) -> bool:
    """Whether a load pushes what a vessel carries from outside, with a force that is not known here."""
    ends = set(bodies_of(load, scene.joints))
    known = kind_of(load) == "point force" or kind_of(load) in WITHOUT_WEIGHT
    return bool(ends & carried) and not known and (len(ends) == 1 or not ends <= carried)


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
                warnings.FreeCraneWarning,
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
        away = {name: beside(scene.bodies[ship], place, length, breadth) for name, place in places.items()}
        nearest = min(away, key=lambda name: away[name])
        if away[nearest] < breadth:
            warn_caller(
                f"immersed part {nearest!r}: starts {away[nearest]:.3g} m from the side of {ship!r}, within "
                f"its breadth of {breadth:.3g} m, in a sea without the waves that the hull scatters and "
                "makes. Give wave_factor what this hull makes of them",
                warnings.ScatteredWavesWarning,
            )


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
                f"described, and its drag_area of {areas[2]:.4g} m2 acts along it, not upwards. Give it in "
                "the order of the part's axes, or turn these by axes, if it enters the water as described",
                warnings.DragAxesWarning,
            )


@once_in_any_sea
def warn_of_capsize(scene: Description) -> None:
    """Warn of vessels whose roll restoring the weights on them outweigh, as they are described.

    Weights that hang count at the upper end of what they hang on.
    """
    for vessel in (one for one in scene.vessels.values() if one.floats):
        restoring = float(np.asarray(vessel.restoring)[3, 3])
        carried = carried_by(scene, vessel.body)
        if restoring == 0.0 or vessel.body not in scene.bodies:
            continue
        hull = scene.bodies[vessel.body]
        weights = [scene.bodies[name] for name in carried - {vessel.body} if scene.bodies[name].gravity]
        hung = [one for one in reversed(bodies_below(scene)) if one[0].held_at[0] in scene.bodies]
        held = {body: one.held_at for one, below in hung for body in below}
        lowered = 0.0
        for body in weights:
            at, point = held.get(body.name, (body.name, body.center_of_mass))
            lowered += body.mass * scene.gravity * _above(scene.bodies[at], point, hull)
        raised = sum(
            float(force.force[2]) * _above(scene.bodies[force.body], force.point, hull)
            for force in scene.point_forces.values()
            if force.body in carried
        )
        left = restoring - lowered + raised
        if left < 0.0:
            warn_caller(
                f"vessel {vessel.name!r}: has a GM of about {left / (hull.mass * scene.gravity):.3g} m with "
                "the weights on it as described, and capsizes: its C44 holds its own weight alone. Lower the "
                "weights, put less of them on it, or look at seacrane.statics",
                warnings.UnstableRestWarning,
            )


@once_in_any_sea
def carried_by(scene: Description, vessel: str) -> frozenset[str]:
    """Bodies whose weight comes to a vessel; none where another support shares it."""
    stopped = {joint for load in scene.loads.values() for joint in named(load, "joint")}
    driven = {driver.joint for driver in scene.drivers.values()}
    neighbours: dict[str, list[str]] = {}
    for name, joint in scene.joints.items():
        if joint.kind != "free" or name in stopped | driven:
            neighbours.setdefault(joint.first, []).append(joint.second)
            neighbours.setdefault(joint.second, []).append(joint.first)
    for one, below in bodies_below(scene):
        neighbours.setdefault(one.held_at[0], []).extend(below)
    found, open_ = {vessel}, [vessel]
    while open_:
        new = set(neighbours.get(open_.pop(), ())) - found
        found |= new
        open_ += new
    floating = floating_bodies(scene)
    alone = found <= set(scene.bodies) and found & floating == {vessel}
    return frozenset(found if alone else ())


def _above(body: _core.Body, point: object, hull: _core.Body) -> float:
    turned = rotation_matrix(body.quaternion) @ np.asarray(point, dtype=float)
    return float(body.position[2] + turned[2] - hull.position[2])


def warn_of_contact_starts(scene: Description) -> None:
    """Warn of bodies that surfaces press away at once, as a scene is described."""
    contacts = [one for one in scene.loads.values() if isinstance(one, _core.Contact)]
    if not contacts:
        return
    pose = described_poses(scene)
    places = {one.name: [beside_surface(one, i, pose) for i in range(len(one.points))] for one in contacts}
    for body in with_mass(scene, *dict.fromkeys(one.body for one in contacts)):
        mass = welded_mass(scene, body)
        of_body = [one for one in contacts if one.body == body]
        total = np.array([0.0, 0.0, -mass * scene.gravity if scene.bodies[body].gravity else 0.0])
        for one in of_body:
            total += sum((elastic_force(one, -gap) * way for gap, way in places[one.name]), np.zeros(3))
        for one in of_body:
            _warn_of_shot(one, places[one.name], total / mass)


def _warn_of_shot(contact: _core.Contact, places: list[tuple[float, Array]], acceleration: Array) -> None:
    """Warn of the deepest point, where the body is pressed away from the surface there."""
    depth, way, point = max((-gap, tuple(way), i) for i, (gap, way) in enumerate(places))
    away = float(acceleration @ way)
    if depth <= 0.0 or away <= SHOT:
        return
    warn_caller(
        f"contact {contact.name!r}: point {point + 1} of {contact.body!r} starts {depth:.4g} m inside the "
        f"surface of {contact.on!r}, which presses the body away with {away:.3g} m/s2 at once: move the body "
        "out, or correct the place of the surface",
        warnings.ContactStartWarning,
    )


def check_contact_connected(
    title: str, scene: Description, name: str, measured: Mapping[str, Array], time: float
) -> None:
    """Refuse a contact that a stage connects at `time` (s) with a point deep inside."""
    contacts = {key: one for key, one in scene.loads.items() if isinstance(one, _core.Contact)}
    contact, count = contacts[name], len(contacts[name].points)
    before = sum(len(contacts[key].points) for key in list(contacts)[: list(contacts).index(name)])
    gaps = np.ravel(measured["contact_gap"])[before : before + count]
    worst = int(np.argmin(gaps))
    force = elastic_force(contact, -float(gaps[worst]))
    share = borne_mass(scene, contact.body, contact.on) * scene.gravity / count
    if -gaps[worst] <= SUNK or force <= CRUSHED * share:
        return
    raise SceneError(
        f"{title}: contact {name!r} connects with point {worst + 1} of {contact.body!r} "
        f"{-gaps[worst]:.4g} m inside {contact.on!r} at t = {time:.6g} s, where it is pressed out with "
        f"{force:.4g} N; connect it before the point is inside, or correct the place of the surface"
    )
