"""Joints of a scene."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import GROUND, Description, insert
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, shaped_of, text_of
from seacrane.inputs.frames import axes_across, axes_along, rotation_matrix
from seacrane.inputs.keywords import nearest

Array = NDArray[np.float64]


def add_joint(
    scene: Description,
    name: str,
    *,
    kind: str,
    first: str,
    second: str,
    point: Any = None,
    axis: Any = None,
    second_axis: Any = None,
    second_point: Any = None,
    first_frame: _core.Frame | None = None,
    second_frame: _core.Frame | None = None,
    **parameters: float | None,
) -> _core.Joint:
    """Add a joint between two bodies; it may close a loop.

    Either `point` and `axis` in the inertial frame at the described pose, which also set the joint's
    zero, or a frame on each body.

    Parameters
    ----------
    kind : str
        weld, revolute, prismatic, cylindrical, universal, spherical, planar, distance or free: a key of
        `seacrane.scene.joint_kinds()`, which lists what each takes.
    name, first, second : str
        The joint and its bodies; "ground" is the inertial frame.
    point : array_like, shape (3,)
        Joint point, m. Default: the origin of the second body.
    axis : array_like, shape (3,)
        Joint axis (any length): of rotation, of sliding, or normal to the plane; of a universal joint
        the one fixed on the first body. Default z.
    second_axis : array_like, shape (3,)
        Universal joint: the axis fixed on the second body, perpendicular to `axis`.
    second_point : array_like, shape (3,)
        Distance joint: the point on the second body.
    first_frame, second_frame : Frame
        In body coordinates, instead of all the above.
    **parameters : float
        The kind's own, such as the `length` of a distance joint, m; by default the distance at the
        described pose.

    Raises
    ------
    SceneError
    """
    name_of("joint", name)
    text_of(f"joint {name!r}: kind", kind)
    about = _core.joint_kinds().get(kind)
    given = {key: value for key, value in parameters.items() if value is not None}
    for key, value in (*given.items(), ("second_point", second_point), ("second_axis", second_axis)):
        if value is not None and (about is None or key not in _own(about)):
            raise SceneError(f"joint {name!r}: {_misplaced(key, kind)}; leave it out")
    if (first_frame is None) != (second_frame is None):
        raise SceneError(f"joint {name!r}: has one frame only; give first_frame and second_frame, or neither")
    if first_frame is None or second_frame is None:
        at = _pose(scene, name, second)[0] if point is None else point
        along = axes_along(f"joint {name!r}: axis", (0.0, 0.0, 1.0) if axis is None else axis)
        across = along
        if second_axis is not None:
            across = axes_across(f"joint {name!r}: second_axis", along[:, 2], second_axis)
        elif about is not None and about.own_axis:
            raise SceneError(f"joint {name!r}: a {kind} joint needs second_axis, fixed on the second body")
        other = at if second_point is None else second_point
        first_frame = _frame(scene, name, first, at, along)
        second_frame = _frame(scene, name, second, other, across)
        for length in _lengths(about):
            if length in given:
                continue
            if second_point is None:
                raise SceneError(f"joint {name!r}: a {kind} joint needs second_point, or frames and {length}")
            apart = shaped_of(f"joint {name!r}: second_point", other, (3,)) - np.asarray(at, dtype=float)
            given[length] = float(np.linalg.norm(apart))
    for frame in (first_frame, second_frame):
        if not isinstance(frame, _core.Frame):
            raise SceneError(f"joint {name!r}: a frame is {frame!r}; give a seacrane.Frame")
    joint = _core.Joint(
        kind=kind,
        name=name,
        first=first,
        second=second,
        first_frame=first_frame,
        second_frame=second_frame,
        **given,
    )
    inserted: _core.Joint = insert("joint", scene.joints, joint)
    return inserted


def _pose(scene: Description, joint: str, body: str) -> tuple[Array, Array]:
    if text_of(f"joint {joint!r}: body", body) == GROUND:
        return np.zeros(3), np.eye(3)
    if body not in scene.bodies:
        raise SceneError(f"joint {joint!r}: there is no body {body!r}; add it first")
    described = scene.bodies[body]
    if not np.linalg.norm(described.quaternion) > 0.0:
        raise SceneError(f"body {body!r}: quaternion is {described.quaternion.tolist()}; normalise it")
    return described.position, rotation_matrix(described.quaternion)


def _frame(scene: Description, joint: str, body: str, point: Any, axes: Array) -> _core.Frame:
    position, rotation = _pose(scene, joint, body)
    where = shaped_of(f"joint {joint!r}: point", point, (3,))
    return _core.Frame(point=rotation.T @ (where - position), axes=rotation.T @ axes)


def _own(kind: _core.JointKind) -> list[str]:
    """Arguments of `add_joint` that only some kinds of joints take."""
    places = [("second_point", kind.own_point), ("second_axis", kind.own_axis)]
    return [*(field.name for field in kind.parameters), *(key for key, has in places if has)]


def _lengths(kind: _core.JointKind | None) -> list[str]:
    """Parameters that default to the distance of a joint's two points."""
    return [field.name for field in kind.parameters if field.role == "distance"] if kind else []


def _misplaced(key: str, kind: str) -> str:
    owners = [name for name, other in _core.joint_kinds().items() if key in _own(other)]
    if not owners:
        near = nearest(key, [one for other in _core.joint_kinds().values() for one in _own(other)])
        return f"no joint takes {key!r}" + (f" (did you mean {near!r}?)" if near else "")
    return f"{key} belongs to a {' or '.join(owners)} joint, this one is {kind}"
