"""What depends on the frequency: a vessel's memory as matrices, the resolvent of a state matrix."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array, Complex
from seacrane.description.databases import database_of
from seacrane.description.description import Description
from seacrane.description.given import group_of
from seacrane.description.loads import changed
from seacrane.errors import SceneError
from seacrane.hydro.memory.retardation import transformer
from seacrane.hydro.vessel.parameters import following_yaw, rigid_part
from seacrane.one_thread import one_thread

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

SAME_MASS = 1e-6  # of the database's, by which a vessel is known as its own
KINDS = ("scene", "database")
RESONANCE = 1e-9  # relative distance of a frequency from an undamped mode


@dataclass(frozen=True, kw_only=True, eq=False)
class FrequencyMemory:
    """What a vessel's matrices hold by frequency beyond those that the scene has at all frequencies.

    ``matrices`` takes ``omega`` (k,) in rad/s, of encounter at its forward speed, of either sign, and gives
    added mass, damping and stiffness, each (k, 6, 6), in axes that follow the yaw, about the vessel's origin.
    ``database`` is where they are from, unless they are those of a convolution.
    """

    vessel: str
    body: str
    matrices: Callable[[Array], tuple[Array, Array, Array]]
    database: HydroDatabase | None = None

    @property
    def speed(self) -> float:
        return 0.0 if self.database is None else self.database.speed

    def impedance(self, omega: Array) -> Complex:
        """``-w^2 added_mass + i w damping + stiffness`` (k, 6, 6)."""
        added_mass, damping, stiffness = self.matrices(omega)
        w = omega[:, None, None]
        return np.asarray(-(w**2) * added_mass + 1j * w * damping + stiffness)


def frequency_memories(
    scene: Description, *, memory: str, database: HydroDatabase | None, vessel: str | None
) -> tuple[FrequencyMemory, ...]:
    """The vessels of a scene whose memory has no states, or is to be that of a database.

    Arguments and errors are as of `linear_model`; `vessel` is the body on which waves act.
    """
    if memory not in KINDS:
        raise SceneError(f"memory {memory!r} is unknown to a linear model; choose {' or '.join(KINDS)}")
    if memory == "database" and vessel is None:
        raise SceneError(f"scene {scene.name!r}: memory='database' needs a vessel; add one")
    if memory == "database" and (group := group_of(scene, vessel)) is not None:
        raise SceneError(
            f"vessel {vessel!r}: its memory is that of all motions of group {group.name!r}, which a database "
            "of one vessel does not hold; choose memory='scene'"
        )
    found = []
    for name, element in scene.vessels.items():
        if memory == "database" and element.body == vessel:
            own = database_of(scene, element.body, "memory='database'", database)
            found.append(_of_database(scene, name, element, own))
        elif isinstance(element.memory, _core.RetardationFunctions):
            found.append(_of_convolution(name, element))
    return tuple(found)


def without_memory(scene: Description, memories: tuple[FrequencyMemory, ...]) -> Description:
    """The scene with the memory of these vessels left out; itself where there are none."""
    if not memories:
        return scene
    out = scene.copy()
    for each in memories:
        out.vessels[each.vessel] = changed(out.vessels[each.vessel], memory=[])
    return out


def state_without_memory(
    scene: Description, state: _core.State, memories: tuple[FrequencyMemory, ...], *, first: int
) -> _core.State:
    """A state of the scene without the memory states of these vessels; `first` is the index of the first."""
    left_out = {each.vessel for each in memories}
    drop: list[int] = []
    for name, element in scene.vessels.items():
        blocks = [] if isinstance(element.memory, _core.RetardationFunctions) else element.memory
        count = sum(len(block.a) for block in blocks)
        if name in left_out:
            drop += range(first, first + count)
        first += count
    return _core.State(
        time=state.time, values=np.delete(np.array(state.values), drop), inputs=np.array(state.inputs)
    )


def _of_convolution(name: str, element: _core.VesselHydrodynamics) -> FrequencyMemory:
    functions = element.memory
    assert isinstance(functions, _core.RetardationFunctions)
    transform = transformer(np.asarray(functions.kernel), float(functions.step))

    def matrices(omega: Array) -> tuple[Array, Array, Array]:
        response = transform(omega)
        return response.imag / omega[:, None, None], response.real, np.zeros((len(omega), 6, 6))

    return FrequencyMemory(vessel=name, body=element.body, matrices=matrices)


def _of_database(
    scene: Description, name: str, element: _core.VesselHydrodynamics, database: HydroDatabase
) -> FrequencyMemory:
    """A, B and the additional matrices of a database less what the scene's vessel has at all frequencies.

    Between the frequencies by cubic splines, beyond them those of the nearest. At forward speed they are
    functions of the frequency of encounter, at its size.
    """
    from scipy.interpolate import CubicSpline

    mass, rest = rigid_part(database)
    if abs(scene.bodies[element.body].mass / mass - 1.0) > SAME_MASS:
        raise SceneError(
            f"vessel {element.body!r}: has a mass of {scene.bodies[element.body].mass:.6g} kg, database "
            f"{database.name!r} one of {mass:.6g} kg; give the database that the vessel was added from"
        )
    parts = database.additional
    still = np.broadcast_to(database.restoring, database.damping.shape)
    tables = (
        database.added_mass + sum(part.added_mass for part in parts),
        database.damping + sum(part.damping for part in parts),
        still + sum(part.restoring for part in parts),
    )
    splines = [CubicSpline(database.omega, table) for table in tables]
    low, high = database.omega[[0, -1]]
    inertia, restoring = np.array(element.added_mass) - rest, np.array(element.restoring)
    known = scene.provenance.get(name)
    if known is not None and known.slack_tanks:  # which are no part of the database, and stay
        restoring[[3, 4], [3, 4]] += known.slack_tanks

    def matrices(omega: Array) -> tuple[Array, Array, Array]:
        added_mass, damping, stiffness = (spline(np.clip(np.abs(omega), low, high)) for spline in splines)
        return added_mass - inertia, damping, following_yaw(stiffness) - restoring

    return FrequencyMemory(vessel=name, body=element.body, matrices=matrices, database=database)


class Resolvent:
    """(i omega - a)^-1 at any frequencies, without the memories of the model."""

    def __init__(self, a: Array, name: str) -> None:
        from scipy.linalg import matrix_balance, schur

        # Memory states may be 1e6 times larger than motions: unbalanced, the triangular form loses motions.
        with one_thread:
            balanced, (self.scale, _) = matrix_balance(a, permute=False, separate=True)
            self.triangle, self.unitary = schur(balanced, output="complex")
        self.name = name

    @one_thread
    def response(self, omega: Array, rates: Array | Complex) -> Complex:
        """x (k, n) at frequencies (k,) under rates of x (k, n).

        Raises SceneError at the frequency of an undamped mode.
        """
        w, triangle = omega, self.triangle
        load = (rates / self.scale) @ self.unitary.conj()
        x = np.zeros(load.shape, dtype=complex)
        for i in reversed(range(len(triangle))):
            pivot = 1j * w - triangle[i, i]
            near = np.abs(pivot) < RESONANCE * np.abs(w)
            if np.any(near):
                raise SceneError(
                    f"scene {self.name!r}: omega = {w[near][0]:.9g} rad/s is that of an undamped mode; "
                    "add damping, or leave the frequency out"
                )
            x[:, i] = (load[:, i] + x[:, i + 1 :] @ triangle[i, i + 1 :]) / pivot
        return np.asarray(x @ self.unitary.T * self.scale)


def block_diagonal(blocks: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """Matrices (..., n, n) along the diagonal of one."""
    each = np.array(blocks)
    count, size = len(each), each.shape[-1]
    out = np.zeros((*each.shape[1:-2], count * size, count * size), each.dtype)
    for i, block in enumerate(each):
        out[..., size * i : size * i + size, size * i : size * i + size] = block
    return out
