"""What holds the joints of cranes, and the drivers that stand for the drives that nobody described."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from seacrane.description.description import Description, Some, all_loads
from seacrane.description.elements import add_driver
from seacrane.description.loads import holding_loads, named
from seacrane.description.once import once, once_in_any_sea, sharing, unchanged
from seacrane.description.roles import CraneRoles

Drive = tuple[str, str, str]  # label, joint and coordinate


def free_drives(scene: Description, roles: CraneRoles) -> list[Drive]:
    """Slew drive, luffs and cylinders of a crane on which nothing acts: no driver, actuator or other load on
    the joint, luffing rope, or load that holds between its two bodies; none where C functions may."""
    if scene.function_forces:
        return []
    return [drive for drive in _drives(scene, roles) if not _acted_on(scene, drive[1])]


def _drives(scene: Description, roles: CraneRoles) -> Iterator[Drive]:
    ropes = {label: rope.name for label, rope in roles.ropes.items()}
    if roles.slew is not None and roles.slew[0] in scene.joints:
        yield "slew drive", *roles.slew
    for label, (joint, coordinate) in roles.luffs.items():
        if joint in scene.joints and ropes.get(label) not in scene.loads:
            yield label, joint, coordinate
    for label, joint in roles.cylinders.items():
        if joint in scene.joints:
            yield label, joint, "displacement"


def _acted_on(scene: Description, joint: str) -> bool:
    ends = {scene.joints[joint].first, scene.joints[joint].second}
    return (
        any(driver.joint == joint for driver in scene.drivers.values())
        or any(joint in named(one, "joint") for one in all_loads(scene) if not type(one).PASSIVE)
        or any({one.first, one.second} == ends for one in holding_loads(all_loads(scene)))
    )


@once_in_any_sea
def held_drives(scene: Description) -> Mapping[str, list[Drive]]:
    """What is held because nothing acts on it, by the prefix of its crane."""
    found = {prefix: free_drives(scene, roles) for prefix, roles in scene.roles.items() if roles.held}
    return {prefix: drives for prefix, drives in found.items() if drives}


def with_holds(scene: Some) -> Some:
    """The scene as it is compiled: with a driver for each drive that is held; itself where there is none."""
    with unchanged(scene):
        if not held_drives(scene):
            return scene
        held = _decided_once(scene)
    return sharing(scene.copy(roles=held.roles, drivers=held.drivers), held)


def decided(scene: Some) -> Some:
    """As `with_holds`, and nothing more is held: what takes a drive out of it finds its joint free."""
    out = let_go(scene)
    for drives in held_drives(scene).values():
        for _, joint, coordinate in drives:
            add_driver(out, joint=joint, coordinate=coordinate, curve=0.0)
    return out


_decided_once = once(decided)


def let_go(scene: Some) -> Some:
    """The scene with nothing held but by what is described."""
    roles = {prefix: replace(one, held=False) for prefix, one in scene.roles.items()}
    return scene.copy(roles=roles)
