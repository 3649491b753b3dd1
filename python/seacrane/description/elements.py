"""The core's elements in a scene beside bodies: joints, what moves them, and loads."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from functools import partial
from inspect import Parameter, Signature
from typing import Any, Concatenate, ParamSpec

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.crane_parts import drive_named
from seacrane.description.description import (
    KINDS,
    LOADS,
    AnyNamed,
    Description,
    coordinate_of,
    insert,
    require,
)
from seacrane.description.loads import kind_of, make_load
from seacrane.description.places import described_pose
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, numbers_of, shaped_of, text_of
from seacrane.inputs.frames import axes_across, axes_along
from seacrane.inputs.keywords import nearest, taken
from seacrane.inputs.shown import shown

P = ParamSpec("P")
Force = _core.PointForce | _core.ForceTable | _core.FunctionForce
C_FUNCTION: type[Any] = ctypes.CFUNCTYPE(None).mro()[1]  # of ctypes, any
_FUNCTIONS: list[Any] = []  # that scenes call: they stay as long as Python runs


def add_joint(
    scene: Description, name: str, *, kind: str, first: str, second: str, point: Any = None,
    axis: Any = None, second_axis: Any = None, second_point: Any = None,
    first_frame: _core.Frame | None = None, second_frame: _core.Frame | None = None,
    **parameters: float | None,
) -> _core.Joint:  # fmt: skip
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
        parameters_of = about.parameters if about else ()
        for length in [one.name for one in parameters_of if one.role == "distance" and one.name not in given]:
            if second_point is None:
                raise SceneError(f"joint {name!r}: a {kind} joint needs second_point, or frames and {length}")
            apart = shaped_of(f"joint {name!r}: second_point", other, (3,)) - np.asarray(at, dtype=float)
            given[length] = float(np.linalg.norm(apart))
    for frame in (first_frame, second_frame):
        if not isinstance(frame, _core.Frame):
            raise SceneError(f"joint {name!r}: a frame is {frame!r}; give a seacrane.Frame")
    joint = _core.Joint(
        kind=kind, name=name, first=first, second=second, first_frame=first_frame,
        second_frame=second_frame, **given,
    )  # fmt: skip
    return insert("joint", scene.joints, joint)


def _pose(scene: Description, joint: str, body: str) -> tuple[Array, Array]:
    require(scene, f"joint {joint!r}", "body", body, ground=True)
    if body in scene.bodies and not np.linalg.norm(scene.bodies[body].quaternion) > 0.0:
        given = scene.bodies[body].quaternion.tolist()
        raise SceneError.of(f"body {body!r}: quaternion", f"is {given}; normalise it")
    return described_pose(scene, body)


def _frame(scene: Description, joint: str, body: str, point: Any, axes: Array) -> _core.Frame:
    position, rotation = _pose(scene, joint, body)
    where = shaped_of(f"joint {joint!r}: point", point, (3,))
    return _core.Frame(point=rotation.T @ (where - position), axes=rotation.T @ axes)


def _own(kind: _core.JointKind) -> list[str]:
    """Arguments of `add_joint` that only some kinds of joints take."""
    places = [("second_point", kind.own_point), ("second_axis", kind.own_axis)]
    return [*(field.name for field in kind.parameters), *(key for key, has in places if has)]


def _misplaced(key: str, kind: str) -> str:
    taken_by = {name: _own(other) for name, other in _core.joint_kinds().items()}
    owners = [name for name, own in taken_by.items() if key in own]
    if not owners:
        near = nearest(key, [one for own in taken_by.values() for one in own])
        return f"no joint takes {key!r}" + (f" (did you mean {near!r}?)" if near else "")
    return f"{key} belongs to a {' or '.join(owners)} joint, this one is {kind}"


def add_driver(
    scene: Description, joint: str, *, curve: _core.Curve | float, coordinate: str | None = None,
    name: str | None = None,
) -> _core.Driver:  # fmt: skip
    """Prescribe a joint coordinate (m or rad) as a function of time; a number holds it there.

    `joint` may be what a crane calls its drive, such as "slew" or "main"; the default name is that of the
    joint itself and of its coordinate, such as "main_cylinder.displacement".
    `coordinate`: "angle" of revolute, "displacement" of prismatic and cylindrical joints (their default),
    "x y z roll pitch yaw" of a free joint.
    """
    joint, coordinate = _place(scene, "driver", joint, coordinate)
    name = name_of("driver", name, f"{joint}.{coordinate}")
    driver = _core.Driver(name=name, joint=joint, coordinate=coordinate, curve=curve)
    return insert("driver", scene.drivers, driver)


def add_actuator(
    scene: Description, joint: str, *, name: str | None = None, coordinate: str | None = None,
    stiffness: float = 0.0, damping: float = 0.0, feed_forward: float | _core.Curve = 0.0,
    reference: float | _core.Curve = 0.0,
) -> _core.Actuator:  # fmt: skip
    """State feedback on a joint coordinate q, compiled into the loop.

    Load along q on both bodies: feed_forward + stiffness (reference - q) + damping (reference' - q'), N
    with N/m and N s/m, or N m with N m/rad and N m s/rad. `feed_forward` and `reference` are numbers or
    curves of time. Inputs "<name>.force" and "<name>.reference" add to them during a run. `joint` may be what
    a crane calls its drive, such as "slew" or "main"; as it is given, it is the default name.
    """
    name = name_of("actuator", name, joint)
    joint, coordinate = _place(scene, "actuator", joint, coordinate)
    actuator = _core.Actuator(
        name=name, joint=joint, coordinate=coordinate, stiffness=stiffness, damping=damping,
        feed_forward=feed_forward, reference=reference,
    )  # fmt: skip
    return insert("actuator", scene.actuators, actuator)


def _place(scene: Description, kind: str, joint: str, coordinate: str | None) -> tuple[str, str]:
    """Joint and coordinate, also where a crane's drive is called by its label."""
    known = text_of(f"{kind}: joint", joint) in scene.joints
    drive = None if known else drive_named(scene, joint)
    return drive or (joint, coordinate_of(scene, kind, joint, coordinate))


def add_force(
    scene: Description, body: str, *, force: Any, times: Any = None, point: Any = None,
    body_axes: bool | None = None, parameters: Sequence[float] | None = None, name: str | None = None,
) -> Force:  # fmt: skip
    """Add a force on a body: constant, a table over time, or a C function called in every evaluation.

    Input "<name>.force" (3 values) adds to a constant one during a run.

    Parameters
    ----------
    force : array_like, shape (3,) or (n, 6), or C function
        N; of a table force (N) and moment (N m) about the point, inertial axes, at `times`, linear in between
        and held outside. A C function is one of numba.cfunc or ctypes, void f(double t, const double* state,
        const double* parameters, double* wrench): position, quaternion, velocity and angular velocity of the
        body origin; force and moment about it; inertial axes.
    times : array_like, shape (n,)
        Of a table, s.
    point : array_like, shape (3,)
        Of the body, m, body coordinates; default: its origin. Not for a function.
    body_axes : bool
        Whether a constant force turns with the body; default: it keeps its inertial axes.
    parameters : sequence of float
        Handed to the function.
    name : str, optional
        Default: "<body> force".

    Raises
    ------
    SceneError
        For a force that is none of these, and what another kind takes; the body is checked at compile().
    """
    name = name_of("force", name, f"{text_of('force: body', body)} force")
    made, takes = _force_of(f"force {name!r}: force", force)
    given = taken(
        f"force {name!r}", made.func.__name__, takes,
        times=times, point=point, body_axes=body_axes, parameters=parameters,
    )  # fmt: skip
    load: Force = made(name=name, body=body, **given)
    return put_load(scene, load)


def _force_of(what: str, force: Any) -> tuple[partial[Any], tuple[str, ...]]:
    """What makes the load, and the keywords that it takes."""
    function = getattr(force, "ctypes", force)  # of numba's
    if isinstance(function, C_FUNCTION):
        _FUNCTIONS.append(force)
        address = ctypes.cast(function, ctypes.c_void_p).value or 0
        return partial(_core.FunctionForce, address=address), ("parameters",)
    if callable(force):
        raise SceneError.of(what, f"is {shown(force)}; make a C function of it by numba.cfunc or ctypes")
    numbers = numbers_of(what, force)
    if numbers.ndim == 2 and numbers.shape[1] == 6:
        return partial(_core.ForceTable, wrenches=numbers, times=()), ("times", "point")
    if numbers.shape != (3,):
        raise SceneError.of(what, f"has shape {numbers.shape}; give (3,), or (n, 6) with times")
    return partial(_core.PointForce, force=numbers), ("point", "body_axes")


def adds(kind: Callable[P, AnyNamed]) -> Callable[Concatenate[Any, P], AnyNamed]:
    """The method of a scene that adds a load of a kind, whose keywords are the entries of its `FIELDS`."""
    known: Any = kind
    own = [
        Parameter(
            field.name,
            Parameter.POSITIONAL_OR_KEYWORD if field.role == "name" else Parameter.KEYWORD_ONLY,
            default=Parameter.empty if field.required else field.default,
            annotation=Any,
        )
        for field in known.FIELDS
    ]

    def add(scene: Description, /, *name: P.args, **entries: P.kwargs) -> AnyNamed:
        return put_load(scene, kind(*name, **entries))

    about = known.__doc__.partition("; see Scene.")[0].removesuffix(" Immutable.")
    rows = [f"{one.name} : {one.unit or one.type}\n    {one.text}".rstrip() for one in known.FIELDS]
    add.__doc__ = "\n".join((about, "", "Parameters", "----------", *rows))
    made: Any = add
    made.__signature__ = Signature([Parameter("scene", Parameter.POSITIONAL_ONLY), *own])
    return made  # type: ignore[no-any-return]


def add_load(scene: Description, element: Any = None, *, kind: str | None = None, **entries: Any) -> Any:
    """Add a load of any kind: one that is described already, such as a FlowForce, or by the name of its kind
    and its entries, as `FIELDS` of its class in `_core.LOAD_KINDS` lists them; returns it."""
    return put_load(scene, element if kind is None else make_load(kind, entries))


def put_load(scene: Description, element: AnyNamed) -> AnyNamed:
    """Add a load that is described to those of its kind, and return it."""
    found = kind_of(element)
    table = next((key for key in LOADS if KINDS[key] == found), "loads")
    return insert(found, getattr(scene, table), element)
