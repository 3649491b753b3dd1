"""Loads on bodies of a scene: forces, springs, and those of their own kinds."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from functools import partial
from typing import Any

from seacrane import _core
from seacrane.description.description import KINDS, LOADS, Description, insert
from seacrane.description.loads import kind_of, make_load
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, numbers_of, text_of
from seacrane.inputs.keywords import taken
from seacrane.inputs.shown import shown

Force = _core.PointForce | _core.ForceTable | _core.FunctionForce
C_FUNCTION: type[Any] = ctypes.CFUNCTYPE(None).mro()[1]  # of ctypes, any
_FUNCTIONS: list[Any] = []  # that scenes call: they stay as long as Python runs


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
    added: Force = add_load(scene, made(name=name, body=body, **given))
    return added


def _force_of(what: str, force: Any) -> tuple[partial[Any], tuple[str, ...]]:
    """What makes the load, and the keywords that it takes."""
    function = getattr(force, "ctypes", force)  # of numba's
    if isinstance(function, C_FUNCTION):
        _FUNCTIONS.append(force)
        address = ctypes.cast(function, ctypes.c_void_p).value or 0
        return partial(_core.FunctionForce, address=address), ("parameters",)
    if callable(force):
        raise SceneError(f"{what} is {shown(force)}; make a C function of it by numba.cfunc or ctypes")
    numbers = numbers_of(what, force)
    if numbers.ndim == 2 and numbers.shape[1] == 6:
        return partial(_core.ForceTable, wrenches=numbers, times=()), ("times", "point")
    if numbers.shape != (3,):
        raise SceneError(f"{what} has shape {numbers.shape}; give (3,), or (n, 6) with times")
    return partial(_core.PointForce, force=numbers), ("point", "body_axes")


def add_spring(
    scene: Description,
    name: str,
    *,
    first: str,
    second: str,
    first_point: Any = (0.0, 0.0, 0.0),
    second_point: Any = (0.0, 0.0, 0.0),
    stiffness: float = 0.0,
    damping: float = 0.0,
    natural_length: float = 0.0,
    lengths: Sequence[float] = (),
    forces: Sequence[float] = (),
) -> _core.Spring:
    """A spring-damper between points of two bodies (m, body coordinates): linear (N/m, N s/m, m), or a
    table of tension `forces` (N) over `lengths` (m)."""
    element = _core.Spring(
        name=name,
        first=first,
        second=second,
        first_point=first_point,
        second_point=second_point,
        stiffness=stiffness,
        damping=damping,
        natural_length=natural_length,
        lengths=lengths,
        forces=forces,
    )
    inserted: _core.Spring = insert("spring", scene.springs, element)
    return inserted


def add_load(scene: Description, element: Any = None, *, kind: str | None = None, **entries: Any) -> Any:
    """Add a load of any kind: one that is described already, such as a FlowForce, or by the name of its kind
    and its entries, as `FIELDS` of its class in `_core.LOAD_KINDS` lists them; returns it."""
    if kind is not None:
        element = make_load(kind, entries)
    found = kind_of(element)
    table = next((key for key in LOADS if KINDS[key] == found), "loads")
    return insert(found, getattr(scene, table), element)
