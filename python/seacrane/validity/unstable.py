"""Rest states at which a scene does not stay, and ships that the weights on them capsize, as described."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from seacrane.description.given import floating_bodies
from seacrane.description.loads import named
from seacrane.description.once import once_in_any_sea
from seacrane.description.suspension import bodies_below
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import UnstableRestWarning

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.description.description import Description
    from seacrane.description.suspension import Suspension


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
        hung = bodies_below(scene)
        lowered = sum(body.mass * scene.gravity * _height(scene, hung, body, hull) for body in weights)
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
                UnstableRestWarning,
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


def _height(
    scene: Description, hung: Sequence[tuple[Suspension, Sequence[str]]], body: _core.Body, hull: _core.Body
) -> float:
    """Above a hull's origin at which a body's weight acts, m: that of the point from which it hangs."""
    for one, below in hung:
        if body.name in below and one.held_at[0] in scene.bodies:
            return _above(scene.bodies[one.held_at[0]], one.held_at[1], hull)
    return _above(body, body.center_of_mass, hull)


def _above(body: _core.Body, point: object, hull: _core.Body) -> float:
    turned = rotation_matrix(body.quaternion) @ np.asarray(point, dtype=float)
    return float(body.position[2] + turned[2] - hull.position[2])
