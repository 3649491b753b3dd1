"""What goes wrong with the load of a crane: it swings far, is too heavy, or starts inside the hull."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core
from seacrane.analysis.after_run import Finding, peak
from seacrane.arrays import Array
from seacrane.description.crane_parts import placed, tip_radius
from seacrane.description.once import once_in_any_sea
from seacrane.description.outline import box_edges, size_of_ship
from seacrane.description.places import place_of
from seacrane.description.roles import allowed_at
from seacrane.description.rungs import WITH_MASS
from seacrane.description.suspension import bodies_below, hung_loads, suspensions, weights_on
from seacrane.description.wet_parts import carried_by_water
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import LargeSwingWarning, LoadInHullWarning, LoadOffDeckWarning, OverloadWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Channels = Mapping[str, Array]
_Place = tuple[str, Any]  # a body and a point in its coordinates, m
LARGEST_SWING = np.radians(20.0)
CLEAR = 0.01  # m of a load below a deck on which it stands
PEDESTAL = 3.0  # m from the deck on which a load stands up to where a crane's lowest joint may be
STANDS = 0.5  # m over a plane, below which a load is described as standing on it
LEVEL = 0.9  # cosine, from which a plane is a deck
ASIDE = 1.1  # times a hull's half size, up to which a load may stand on what sticks out
WATER = 1025.0  # kg/m3
BLOCK = 0.7  # of a hull: its volume over that of the box around it


def lifting(scene: Description, time: Array, channels: Channels) -> list[Finding]:
    """Swing and overload of every crane's load, as far as the poses were recorded."""
    if not {"position", "quaternion"} <= set(channels):
        return []
    poses = channels["position"], channels["quaternion"]
    return [*_swings(scene, time, *poses), *_overloads(scene, time, *poses)]


def _swings(scene: Description, time: Array, position: Array, quaternion: Array) -> Iterator[Finding]:
    for what, upper_end, lower_end in _hanging(scene):
        upper, _ = placed(scene, *upper_end, position, quaternion)
        lower, _ = placed(scene, *lower_end, position, quaternion)
        hung = np.broadcast_to(lower - upper, (time.size, 3))
        swing = np.arctan2(np.hypot(hung[:, 0], hung[:, 1]), -hung[:, 2])
        slanted = what.startswith("line") and swing[0] > LARGEST_SWING  # as a tugger does
        for angle, at in peak(swing, above=LARGEST_SWING) if not slanted else ():
            period = 2.0 * np.pi * np.sqrt(np.linalg.norm(hung[at]) / max(scene.gravity, 1e-9))
            yield (
                LargeSwingWarning,
                f"{what}: {lower_end[0]!r} swings {np.degrees(angle):.3g} deg from vertical at t = "
                f"{time[at]:.6g} s, beyond {np.degrees(LARGEST_SWING):.0f} deg: a pendulum of {period:.3g} s "
                "gathers what waves and drives put in. Move slower, keep its period away from the sea's, "
                "hold it by taglines, or give it the damping that it has (add_spring, add_wind)",
            )


def _hanging(scene: Description) -> Iterator[tuple[str, _Place, _Place]]:
    """The last straight parts of what alone holds something, or hangs on a crane."""
    on_cranes = {one.suspension.name for one in hung_loads(scene) if one.crane is not None}
    alone = weights_on(scene)
    for one in suspensions(scene):
        rod = one.name in scene.joints  # by itself it may be any mechanism's
        if one.rung != WITH_MASS and (one.name in on_cranes or (one.channel in alone and not rod)):
            yield f"{'link' if rod else 'line'} {one.name!r}", one.upper, one.lower


def _overloads(scene: Description, time: Array, position: Array, quaternion: Array) -> Iterator[Finding]:
    carried = {one.name: bodies for one, bodies in bodies_below(scene)}
    for one in hung_loads(scene):
        roles = one.crane
        if roles is None or not roles.capacity or roles.slew is None or roles.slew[0] not in scene.joints:
            continue  # no table, or no radius to look it up at
        if roles.tip is None or roles.tip[0] not in scene.bodies:
            continue
        weight = scene.bodies[one.load].mass * scene.gravity if one.weight is None else one.weight
        mass = weight / scene.gravity if scene.gravity else scene.bodies[one.load].mass
        poses = {"position": position, "quaternion": quaternion}
        water = carried_by_water(scene, poses, carried.get(one.suspension.name, (one.load,)))
        left = mass - water / (scene.gravity or 1.0)
        radius = np.atleast_1d(tip_radius(scene, roles, position, quaternion))
        allowed = allowed_at(roles.capacity, radius)
        for most, at in peak(left, above=allowed):
            lighter = f", of which water carries {(mass - most) / 1e3:.4g} t," if most < mass else ","
            yield (
                OverloadWarning,
                f"crane {roles.prefix!r}: its load {one.load!r} of {mass / 1e3:.4g} t, with what holds it"
                f"{lighter} is above the {allowed[at] / 1e3:.4g} t of the crane's table at a radius of "
                f"{radius[at]:.4g} m, where it is at t = {time[at]:.6g} s. Lift less, keep the tip nearer "
                "(seacrane.load_chart tells how near), or correct the table",
            )


@once_in_any_sea
def warn_of_loads_in_hulls(scene: Description) -> None:
    """Warn of loads that overlap, as described, what is surely hull: below the deck, above the keel.

    And of those that stand on a deck where there is none: beside the hull, or beside a body of known size.
    """
    seats = _seats(scene)
    standing = [*((joint.second, joint.first) for joint in seats), *_on_planes(scene)]
    joints = [joint for joint in scene.joints.values() if joint not in seats]
    ends = [(joint.first, joint.first_frame) for joint in joints]
    ends += [(joint.second, joint.second_frame) for joint in joints]
    for body, support in standing:
        _warn_of_no_deck(scene, body, support)
    for one in hung_loads(scene):
        load = scene.bodies[one.load]
        for vessel in scene.vessels.values():
            hull = scene.bodies[vessel.body]
            if load is hull:
                continue
            centre, half = _inside(hull, load)
            length, breadth = size_of_ship(scene, vessel.body)
            clear = PEDESTAL if (one.load, vessel.body) in standing else CLEAR
            heights = (float(frame.point[2]) for body, frame in ends if body == vessel.body)
            deck = max(0.0, min(heights, default=0.0))  # the lowest joint, or the waterline
            keel = -hull.mass / (WATER * BLOCK * length * breadth)
            across = abs(centre[0]) < 0.5 * length and abs(centre[1]) < 0.5 * breadth
            if across and centre[2] - half < deck - clear and centre[2] + half > keel:
                warn_caller(
                    f"body {one.load!r}: starts inside vessel {vessel.name!r}: its lower edge is at "
                    f"{centre[2] - half:.4g} m, {centre[0]:.4g} m forward and {centre[1]:.4g} m to port of "
                    f"its origin, below the deck at {deck:.4g} m, where the lowest joint on the hull is: "
                    "shorten what it hangs on, or turn the crane out before the load is lowered",
                    LoadInHullWarning,
                )


def _seats(scene: Description) -> list[_core.Joint]:
    """Welds that hold only what stands on a body."""
    seats = [load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "seat"]
    return [scene.joints[name] for name in seats if scene.joints[name].first in scene.bodies]


def _on_planes(scene: Description) -> Iterator[tuple[str, str]]:
    """Bodies whose lowest points stand, as described, on a level plane of another, and that one."""
    for contact in scene.loads.values():
        if not isinstance(contact, _core.Contact) or contact.surface != "plane":
            continue
        if not {contact.body, contact.on} <= scene.bodies.keys() or contact.axes[2, 2] < LEVEL:
            continue
        points = np.array([place_of(scene, body=contact.body, point=one) for one in contact.points])
        deck = place_of(scene, body=contact.on, point=contact.place)
        normal = rotation_matrix(scene.bodies[contact.on].quaternion) @ contact.axes[:, 2]
        if float(((points - deck) @ normal).min()) < STANDS:
            yield contact.body, contact.on


def _warn_of_no_deck(scene: Description, load: str, support: str) -> None:
    ship = support in {vessel.body for vessel in scene.vessels.values()}
    deck = scene.bodies[support]
    size = np.array(size_of_ship(scene, support) if ship else deck.size[:2])
    if not np.all(size):
        return
    (x, y, _), _ = _inside(deck, scene.bodies[load])
    if abs(x) > 0.5 * ASIDE * size[0] or abs(y) > 0.5 * ASIDE * size[1]:
        warn_caller(
            f"body {load!r}: stands on {support!r}, {x:.4g} m forward and {y:.4g} m to port of its origin, "
            f"where there is no deck: {support!r} is {size[0]:.4g} m long and {size[1]:.4g} m broad. Put "
            "it over the deck, with the crane turned so, or let it hang",
            LoadOffDeckWarning,
        )


def _inside(hull: _core.Body, load: _core.Body) -> tuple[Array, float]:
    """The load's centre in the hull's axes from its origin, m, and half its height there."""
    to_hull, turn = rotation_matrix(hull.quaternion).T, rotation_matrix(load.quaternion)
    centre = to_hull @ (load.position + turn @ load.center_of_mass - hull.position)
    edges = np.array(box_edges(load))
    return centre, float(0.5 * np.abs(to_hull @ turn)[2] @ edges)
