"""Which vessels of a scene float, which have a motion that is given, and what is welded to a body."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description, Some
from seacrane.description.loads import changed
from seacrane.description.waves import calm_water
from seacrane.errors import SceneError

USUAL_SIZE = (100.0, 20.0, 5.0)  # m, of a ship whose size nobody gave
Pose = tuple[Array, Array]  # position (m), rotation


def floating_bodies(scene: Description) -> set[str]:
    """Bodies whose weight their restoring carries; others with hydrodynamics weigh as any body."""
    return {vessel.body for vessel in scene.vessels.values() if vessel.floats}


def given_vessels(scene: Description) -> dict[str, str]:
    """Kind of motion by the body: "raos", "history" or "rest"."""
    known = {vessel.body: scene.provenance.get(vessel.name) for vessel in scene.vessels.values()}
    return {body: one.motion for body, one in known.items() if one is not None and one.motion is not None}


def given_drivers(scene: Description) -> list[str]:
    """Names of the drivers that move given vessels."""
    led = tuple(f"{body}.motion." for body in given_vessels(scene))
    return [name for name in scene.drivers if name.startswith(led)]


def led_by(scene: Some, curves: Mapping[str, _core.Curve]) -> Some:
    """The scene with other curves of some drivers, by their names."""
    out = scene.copy()
    for name, curve in curves.items():
        out.drivers[name] = changed(scene.drivers[name], curve=curve)
    return out


def given_at_rest(scene: Some) -> Some:
    """The scene with its given vessels where they are described."""
    return led_by(scene, dict.fromkeys(given_drivers(scene), _core.Curve.constant(value=0.0)))


def in_calm_water(scene: Some) -> Some:
    """The scene without waves, and so without the motion of given vessels; a current flows on."""
    return given_at_rest(scene).copy(waves=calm_water(scene.waves))


def shown_size(scene: Description, body: str) -> tuple[float, float, float]:
    """Length, breadth and draught, m, of the ship that the light body of a given vessel stands for."""
    known = next(scene.provenance[v.name] for v in scene.vessels.values() if v.body == body)
    return known.size or USUAL_SIZE


def require_described(scene: Description, end: float) -> None:
    """SceneError for a run to `end` (s) that is longer than the given motion of a ship."""
    for vessel in scene.vessels.values():
        known = scene.provenance.get(vessel.name)
        if known is None or known.duration is None or end <= known.duration:
            continue
        way_out = (
            "give a longer history" if known.motion == "history"
            else f"give duration={end:g} to add_vessel"
        )  # fmt: skip
        raise SceneError(
            f"vessel {vessel.name!r}: its given motion ends at {known.duration:.6g} s, and the run at "
            f"{end:.6g} s; {way_out}, or end the run earlier"
        )


def group_of(scene: Description, body: str | None) -> _core.GroupHydrodynamics | None:
    """The group in which the vessel of a body is; None where it is in none."""
    vessel = next((one.name for one in scene.vessels.values() if one.body == body), None)
    return next((one for one in scene.groups.values() if vessel in one.vessels), None)


def welded_mass(scene: Description, body: str) -> float:
    """Mass of a body and of all that is welded to it, kg."""
    return float(sum(scene.bodies[one].mass for one in welded_to(scene, body)))


def welded_to(scene: Description, body: str) -> list[str]:
    """A body and all that is welded to it; without vessels, and what only stands on a seat."""
    seats = {load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "seat"}
    vessels = {vessel.body for vessel in scene.vessels.values()}
    welds = [one for name, one in scene.joints.items() if one.kind == "weld" and name not in seats]
    found = [body]
    for one in found:
        if one in vessels:
            continue
        ends = [(weld.first, weld.second) for weld in welds if one in (weld.first, weld.second)]
        beside = {other for pair in ends for other in pair} & (scene.bodies.keys() - vessels)
        found += sorted(beside - set(found))
    return found


def with_mass(scene: Description, *bodies: str) -> list[str]:
    """Those whose mass counts: not the ground, nor one that stands for a ship whose motion is given."""
    led = given_vessels(scene)
    return [one for one in bodies if one in scene.bodies and one not in led]


def borne_mass(scene: Description, body: str, on: str) -> float:
    """Mass of a body and what is welded to it, kg; of what it stands on where its own does not count."""
    known = [one for one in (body, on) if one in scene.bodies]
    return welded_mass(scene, [*with_mass(scene, *known), *known][0])


def beside_surface(contact: _core.Contact, point: int, pose: Callable[[str], Pose]) -> tuple[float, Array]:
    """How far a point is outside the surface (m; negative: inside), and the way out, inertial axes."""
    (at, turned), (base, tilted) = pose(contact.body), pose(contact.on)
    axes = tilted @ np.asarray(contact.axes)
    place = base + tilted @ np.asarray(contact.place)
    local = axes.T @ (at + turned @ np.asarray(contact.points[point]) - place)
    distance, way = contact.distance(local)
    return float(distance), axes @ np.asarray(way)


def elastic_force(contact: _core.Contact, depth: float) -> float:
    """N, of a point that is inside by `depth` (m); beyond a table its last slope goes on."""
    if depth <= 0.0:
        return 0.0
    if not len(contact.forces):
        return float(contact.stiffness) * depth
    x, f = np.asarray(contact.compressions), np.asarray(contact.forces)
    beyond = max(depth - float(x[-1]), 0.0)
    return float(np.interp(depth, x, f) + beyond * (f[-1] - f[-2]) / (x[-1] - x[-2]))
