"""What a picture and a report of a result need to know of its scene: points of bodies, links, bounds."""

from __future__ import annotations

from itertools import chain, pairwise
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.crane_parts import tips
from seacrane.description.description import GROUND, Description, all_loads
from seacrane.description.given import floating_bodies, given_vessels, shown_size
from seacrane.description.limit_state import Range
from seacrane.description.loads import drawn_springs, joint_ends, lines_of, path_of
from seacrane.description.suspension import hung_loads
from seacrane.hydro.data.hydro_group_data import USUAL_RADII

NO_BOUND = 1e7  # m or rad: a bound here or beyond is none


def outline_of(scene: Description) -> dict[str, Any]:
    """Points that bodies are drawn through, as plain data.

    "bodies": by name "points" (joints, m from the centre of mass, body axes) and "box" (edges of the box of
    its mass and inertia, m); a vessel has "ship" instead of a box: length, breadth, m, and its origin from
    the centre of mass. "links": bodies and points of both ends, ground points in inertial axes.
    """
    ships = floating_bodies(scene)
    bodies = {name: _about(scene, body, ship=name in ships) for name, body in scene.bodies.items()}
    joined = {name: joint_ends(one) for name, one in scene.joints.items()}
    for name, end in [*chain.from_iterable(joined.values()), *tips(scene).values()]:
        point = _relative(scene, name, end)
        if name in bodies and point not in bodies[name]["points"]:
            bodies[name]["points"].append(point)
    spans = [ends for name, ends in joined.items() if scene.joints[name].kind == "distance"]
    for spring in drawn_springs(all_loads(scene)):
        spans.append(((spring.first, spring.first_point), (spring.second, spring.second_point)))
    for line in lines_of(scene.loads).values():
        spans += pairwise(path_of(line))
    links = [[name for body, end in ends for name in (body, _relative(scene, body, end))] for ends in spans]
    return {"bodies": bodies, "links": links}


def hung_notes(scene: Description) -> list[dict[str, Any]]:
    """What hangs, cranes first, as plain data.

    "crane" is a prefix, or None; "suspension", "top" and "parts" are names in the channels over `suspension`
    of its lower end, its upper end and all of it; "from" and "to" are body and point, m from its centre of
    mass, of the tip or what else it hangs from, and of the load.
    """
    return [
        {
            "label": one.label, "crane": None if one.crane is None else one.crane.prefix,
            "suspension": held.channel, "top": held.top,
            "parts": sorted(held.parts | {held.channel, held.top}), "rung": held.rung, "load": one.load,
            "from": [body, _relative(scene, body, point)],
            "to": [one.load, _relative(scene, one.load, one.point)],
        }
        for one in hung_loads(scene)
        for held, (body, point) in [(one.suspension, one.hangs_from)]
    ]  # fmt: skip


def _about(scene: Description, body: _core.Body, *, ship: bool) -> dict[str, Any]:
    """A body without its points."""
    if not ship:
        return {"points": [], "box": box_edges(body)}
    length, breadth = size_of_ship(scene, body.name)
    origin = (-np.asarray(body.center_of_mass)).tolist()
    return {"points": [], "ship": {"length": length, "breadth": breadth, "origin": origin}}


def _relative(scene: Description, body: str, point: Any) -> list[float]:
    """From the centre of mass; of the ground as it is."""
    place = np.asarray(point, dtype=float)
    if body != GROUND and body in scene.bodies:
        place = place - np.asarray(scene.bodies[body].center_of_mass)
    return [float(value) for value in place]


def box_edges(body: _core.Body) -> list[float]:
    """Edges of a body's size, or of the even box of its mass and moments of inertia, m."""
    if np.any(body.size):
        return [float(edge) for edge in body.size]
    inertia = np.diag(np.asarray(body.inertia))
    squares = 6.0 * (inertia.sum() - 2.0 * inertia) / body.mass
    return [float(edge) for edge in np.sqrt(np.maximum(squares, 0.0))]


def size_of_ship(scene: Description, body: str) -> tuple[float, float]:
    """Length and breadth of a vessel, m: those given, or what its radii of gyration suggest."""
    return shown_size(scene, body)[:2] if body in given_vessels(scene) else ship_size(scene.bodies[body])


def ship_size(body: _core.Body) -> tuple[float, float]:
    """Length and breadth that a ship's radii of gyration suggest, m."""
    roll, pitch, _ = USUAL_RADII
    about_x, about_y = np.sqrt(np.diag(np.asarray(body.inertia))[:2] / body.mass)
    return float(about_y) / pitch, float(about_x) / roll


def bounds_of(scene: Description) -> list[dict[str, Any]]:
    """What the scene keeps within bounds (m or rad; None where there is none), as plain data.

    "kind" is wire, stop, seat, soft stop or range; "recorded" the name under which the coordinate is
    recorded.
    """
    loads = scene.loads.values()
    found: list[tuple[_core.Limit | _core.SoftStop | Range, str]] = [
        *((load, load.kind) for load in loads if isinstance(load, _core.Limit)),
        *((load, "soft stop") for load in loads if isinstance(load, _core.SoftStop)),
        *((limit, "range") for limit in scene.ranges.values()),
    ]
    names = {place: name for name, place in scene.recorded.items()}
    return [
        {
            "name": one.name, "kind": kind, "joint": one.joint, "coordinate": one.coordinate,
            "minimum": _bound(kind, one.minimum), "maximum": _bound(kind, one.maximum),
            "recorded": names.get((one.joint, one.coordinate)),
        }
        for one, kind in found
    ]  # fmt: skip


def _bound(kind: str, value: float) -> float | None:
    return None if kind in ("wire", "seat") or abs(value) >= NO_BOUND else value
