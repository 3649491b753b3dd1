"""Loads on bodies of a scene: forces, springs, tables, C functions, and those of their own kinds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from seacrane import _core
from seacrane.description.description import KINDS, LOADS, Description, insert
from seacrane.description.loads import kind_of, make_load
from seacrane.errors import SceneError
from seacrane.inputs.checked import numbers_of


def add_point_force(
    scene: Description,
    name: str,
    *,
    body: str,
    force: Any,
    point: Any = (0.0, 0.0, 0.0),
    body_axes: bool = False,
) -> _core.PointForce:
    """A constant force (N) at a point of a body (m, body coordinates), in inertial axes or, with
    `body_axes`, turning with the body. Input "<name>.force" (3 values) adds to it during a run."""
    element = _core.PointForce(name=name, body=body, point=point, force=force, body_axes=body_axes)
    inserted: _core.PointForce = insert("point force", scene.point_forces, element)
    return inserted


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


def add_force_table(
    scene: Description, name: str, *, body: str, times: Any, loads: Any, point: Any = (0.0, 0.0, 0.0)
) -> _core.ForceTable:
    """Force and moment `loads` (n, 6) in N and N m, inertial axes, about a point of the body (m, body
    coordinates), over `times` (n,) in s: linear in between, held outside."""
    rows = numbers_of(f"force table {name!r}: loads", loads)
    if rows.ndim != 2 or rows.shape[1] != 6:
        raise SceneError(f"force table {name!r}: loads have shape {rows.shape}; give (n, 6)")
    element = _core.ForceTable(name=name, body=body, point=point, times=times, wrenches=rows)
    inserted: _core.ForceTable = insert("force table", scene.force_tables, element)
    return inserted


def add_function_force(
    scene: Description, name: str, *, body: str, address: int, parameters: Sequence[float] = ()
) -> _core.FunctionForce:
    """A C function called in every evaluation, by its address (`numba.cfunc(...).address` or a `ctypes`
    pointer): void f(double t, const double* state13, const double* parameters, double* wrench6). State:
    position, quaternion, velocity, angular velocity of the body origin; wrench about it; inertial axes.
    """
    element = _core.FunctionForce(name=name, body=body, address=address, parameters=parameters)
    inserted: _core.FunctionForce = insert("function force", scene.function_forces, element)
    return inserted


def add_load(scene: Description, element: Any = None, *, kind: str | None = None, **entries: Any) -> Any:
    """Add a load of any kind: one that is described already, such as a FlowForce, or by the name of its kind
    and its entries, as `FIELDS` of its class in `_core.LOAD_KINDS` lists them; returns it."""
    if kind is not None:
        element = make_load(kind, entries)
    found = kind_of(element)
    table = next((key for key in LOADS if KINDS[key] == found), "loads")
    return insert(found, getattr(scene, table), element)
