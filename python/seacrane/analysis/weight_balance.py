"""A constant force that carries the weight of what a vessel has on it."""

from __future__ import annotations

from seacrane.analysis.inverse import Balance, balance
from seacrane.description.description import Description
from seacrane.description.forces import add_point_force
from seacrane.description.given import floating_bodies, given_vessels
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix


def balance_by_force(scene: Description, *, body: str = "vessel", name: str = "balance") -> Balance:
    """Add the force on the only vessel that carries the weight of all other bodies at the start.

    Parameters
    ----------
    scene : At rest as it is described; see `seacrane.balance`.
    body : Of the vessel.
    name : Of the point force.

    Returns
    -------
    Balance
        Of the scene without it.

    Raises SceneError if `body` is not the only vessel, or the scene is not at rest.
    """
    if body in given_vessels(scene):
        raise SceneError(f"balance: the motion of {body!r} is given: it needs no ballast, leave it out")
    floating = sorted(floating_bodies(scene))
    if floating != [body]:
        raise SceneError(
            f"balance: vessel is {body!r}, and the vessels are {', '.join(map(repr, floating)) or 'none'}; "
            "only the one vessel of a scene is balanced so, give several a point_force each"
        )
    found, vessel = balance(scene), scene.bodies[body]
    center = rotation_matrix(vessel.quaternion).T @ (found.weight_center - vessel.position)
    add_point_force(
        scene, name=name, body=body, point=(center[0], center[1], 0.0), force=(0.0, 0.0, found.weight)
    )
    return found
