"""What is welded to a body and moves as one with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seacrane.description.given import given_vessels

if TYPE_CHECKING:
    from seacrane.description.description import Description


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
