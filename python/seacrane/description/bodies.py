"""Bodies of a scene."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description, insert
from seacrane.description.places import on_body, placed
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, numbers_of, shaped_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.plausible import warn_of_density

Array = NDArray[np.float64]


def add_body(
    scene: Description,
    name: str,
    *,
    mass: float,
    inertia: Any = None,
    center_of_mass: Any = (0.0, 0.0, 0.0),
    position: Any = (0.0, 0.0, 0.0),
    quaternion: Any = (1.0, 0.0, 0.0, 0.0),
    velocity: Any = (0.0, 0.0, 0.0),
    angular_velocity: Any = (0.0, 0.0, 0.0),
    gravity: bool = True,
    size: Any = None,
    below: str | None = None,
    drop: float = 0.0,
) -> _core.Body:
    """Add a rigid body.

    Parameters
    ----------
    mass : float
        kg.
    inertia : array_like, shape (3,) or (3, 3), optional
        About the centre of mass in body axes, kg m2; three values are the diagonal. Default: that of a solid
        box of `size`, ``mass / 12 * (y**2 + z**2, z**2 + x**2, x**2 + y**2)``.
    center_of_mass : array_like, shape (3,)
        From the body origin in body axes, m.
    position, quaternion : array_like
        Start pose of the body origin in the inertial frame; quaternion (w, x, y, z), body to inertial.
    velocity, angular_velocity : array_like, shape (3,)
        Of the body origin at the start, inertial axes, m/s and rad/s.
    gravity : bool
        Whether weight acts on it. The body of a vessel never gets weight: its restoring carries it.
    size : array_like, shape (3,), optional
        Edges (x, y, z) of the box that it is, m, about its centre of mass along body axes.
    below : str, optional
        In place of a position, a point such as "tip", as `place_of` takes it: the top of the box, or the
        origin of a body without a size, is straight below it.
    drop : float
        From there down, m.

    Raises
    ------
    SceneError
        For a duplicate name, a value that is not of that shape, neither inertia nor size, or a place given
        twice; other values are checked at compile().

    Warns
    -----
    MassUnitWarning
        A box lighter than foam, or heavier than any metal.
    """
    what = f"body {name_of('body', name)!r}"
    edges = np.zeros(3) if size is None else shaped_of(f"{what}: size", size, (3,))
    if below is not None:
        middle = shaped_of(f"{what}: center_of_mass", center_of_mass, (3,))
        top = np.add(middle, (0.0, 0.0, 0.5 * edges[2])) if edges.any() else edges
        position = _below(scene, what, below, drop, position, quaternion, top)
    elif drop:
        raise SceneError(f"{what}: drop is {drop:g} m, below nothing; give below=, or leave drop out")
    body = _core.Body(
        name=name,
        mass=mass,
        inertia=_box(what, mass, edges) if inertia is None else _tensor(what, inertia),
        size=edges,
        center_of_mass=center_of_mass,
        position=position,
        quaternion=quaternion,
        velocity=velocity,
        angular_velocity=angular_velocity,
        gravity=gravity,
    )
    inserted: _core.Body = insert("body", scene.bodies, body)
    if edges.any():
        warn_of_density(what, body.mass, float(np.prod(edges)))
    return inserted


def _below(
    scene: Description, what: str, point: str, drop: float, position: Any, quaternion: Any, top: Array
) -> Array:
    """The origin of a body whose `top`, in its coordinates, is straight below a named point, m."""
    if np.any(np.asarray(position)):
        raise SceneError(f"{what}: has a position and below; give one of them")
    turned = rotation_matrix(shaped_of(f"{what}: quaternion", quaternion, (4,)))
    under = placed(scene, *on_body(scene, f"{what}: below", point, (0.0, 0.0, 0.0)))
    return np.asarray(under - (0.0, 0.0, number_of(f"{what}: drop", drop)) - turned @ top)


def _tensor(what: str, inertia: Any) -> Array:
    """Shape (3, 3), of a tensor or of its diagonal."""
    tensor = numbers_of(f"{what}: inertia", inertia)
    if tensor.shape not in ((3,), (3, 3)):
        raise SceneError(
            f"{what}: inertia has shape {tensor.shape}; give its diagonal, shape (3,), or all of it, (3, 3)"
        )
    return np.diag(tensor) if tensor.shape == (3,) else tensor


def _box(what: str, mass: Any, edges: Array) -> Array:
    """The inertia of a solid box, about its centre."""
    if not edges.any():
        raise SceneError(
            f"{what}: has neither inertia nor size; give size=(x, y, z), m, of the solid box that it is, or "
            "inertia=(Ixx, Iyy, Izz), kg m2, about its centre of mass"
        )
    x, y, z = edges**2
    return np.diag([y + z, z + x, x + y]) * (number_of(f"{what}: mass", mass) / 12.0)
