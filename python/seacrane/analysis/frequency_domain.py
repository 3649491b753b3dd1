"""Motions of a scene in waves from its linear model: transfer functions, sums over components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.arrays import Array, Complex
from seacrane.description.databases import database_of
from seacrane.description.description import Description
from seacrane.description.given import given_vessels, group_of
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.hydro.data.motion import encounter_frequency_at
from seacrane.inputs.checked import number_of
from seacrane.inputs.frames import heading_of
from seacrane.inputs.keywords import named
from seacrane.one_thread import one_thread

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase


@named
@one_thread
def motion_rao(
    scene: Description | LinearModel,
    *,
    omega: ArrayLike,
    direction: ArrayLike,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    state: _core.State | None = None,
    memory: str = "scene",
    database: HydroDatabase | None = None,
) -> Complex:
    """Complex motion of a point of any body per metre of wave amplitude.

    Waves load the vessel, all vessels of its group, and what parts of other bodies are under water at rest;
    their drag only where `drag_in_sea` made it linear. Without a vessel, parts alone: directions and phase
    are then inertial.

    Parameters
    ----------
    scene : Scene or LinearModel
    omega, direction : array_like, broadcast against each other
        rad/s, of the waves; rad, direction of travel from the vessel's x (following) towards its y (port).
    point : array_like, shape (3,)
        Body coordinates, from the body origin, m.
    state : State, optional
        At rest; default ``equilibrium(scene)``. Not with a LinearModel.
    memory : str
        "scene" (default), or "database": A and B of the vessel's database by frequency, see `linear_model`.
        Not with a LinearModel.
    database : HydroDatabase, optional
        Whose wave excitation acts on the vessel. Default: that of the LinearModel, or the vessel's own.
        Another one is the same ship at a forward speed, which needs ``memory="database"``.

    Returns
    -------
    ndarray of complex, shape (..., 6)
        Translation (m/m) and rotation vector (rad/m), inertial axes, time factor exp(+i omega t); the wave
        has zero phase at the mean position of the vessel's origin. At forward speed the axes travel with the
        ship, and the time factor has the frequency of encounter, omega - k U cos(direction).

    Raises
    ------
    SceneError
        As `linear_model`, for a vessel without a database or given another one, for frequencies outside it,
        with a ship whose motion is given, or where the model's memory is not of the database's speed.
    """
    linear = linear_of(scene, state, memory, database)
    parts = PartsInWaves(linear)
    w, b = np.broadcast_arrays(np.asarray(omega, dtype=float), np.asarray(direction, dtype=float))
    along, to = w.ravel(), b.ravel()
    met, rates, depth = along, np.zeros((along.size, len(linear.a)), dtype=complex), parts.water_depth
    if linear.vessel is not None or not parts:
        database = excitation_of(linear, database)
        met, depth = encounter_frequency_at(database, along, to), database.depth
        rates = rates + rates_in_waves(linear, database, along, to)
    if parts:
        rates = rates + parts.rates(along, parts.flow(parts.waves(along, to, depth)))
    x = linear.response_to_rates(met, rates)
    return np.asarray((x @ linear.output(body=body, point=point).T).reshape(*w.shape, 6))


def excitation_of(linear: LinearModel, given: HydroDatabase | None) -> HydroDatabase:
    """The database whose waves load a linear model's vessel: by default that of its matrices."""
    if linear.vessel is None:
        raise SceneError(f"scene {linear.scene.name!r}: has no vessel on which waves act; add one")
    held = next((one.database for one in linear.memories if one.body == linear.vessel), None)
    database = database_of(linear.scene, linear.vessel, "a motion in waves", given or held)
    if linear.speed != database.speed:
        raise SceneError(
            f"database {database.name!r}: is of {database.speed:g} m/s, the memory of the linear model of "
            f"{linear.speed:g} m/s; give memory='database', which takes the matrices of this database"
        )
    return database


def linear_of(
    scene: Description | LinearModel,
    state: _core.State | None,
    memory: str = "scene",
    database: HydroDatabase | None = None,
) -> LinearModel:
    """The linear model of a scene, or the one given; arguments as of `motion_rao`."""
    _require_afloat(scene.scene if isinstance(scene, LinearModel) else scene)
    if isinstance(scene, LinearModel):
        if state is not None:
            raise SceneError("state: a LinearModel has one already; give the Scene with a state")
        if memory != "scene":
            raise SceneError(f"memory {memory!r}: a LinearModel has its memory already; give the Scene")
        return scene
    return linear_model(scene, state=state, memory=memory, database=database)


def _require_afloat(scene: Description) -> None:
    """Refuse a scene with a ship of given motion, which a linear model holds at rest."""
    for body, kind in given_vessels(scene).items():
        raise SceneError(
            f"vessel {body!r}: its motion is given ({kind}), and a linear model knows only what moves by "
            "itself; simulate the scene, or take a vessel from a database"
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class SummedResponse:
    """Steady response of the linear model to the components of one realised sea.

    Attributes
    ----------
    omega : (k,), rad/s.
    amplitude : ndarray of complex, shape (k, 6)
        Of the point's translation (m) and the body's rotation vector (rad): sum Re amplitude exp(i omega t).
    state_amplitude : (k, n), the same of x of the `LinearModel`.
    """

    omega: Array
    amplitude: Complex
    state_amplitude: Complex

    @property
    def std(self) -> Array:
        """Standard deviation (6,) over infinite time, m and rad: no sampling scatter."""
        return np.asarray(np.sqrt(0.5 * np.sum(np.abs(self.amplitude) ** 2, axis=0)))

    def at(self, times: ArrayLike) -> Array:
        """Translation (m) and rotation vector (rad) from rest at times (s), shape times.shape + (6,)."""
        t = np.asarray(times, dtype=float)
        return np.asarray((np.exp(1j * t[..., None] * self.omega) @ self.amplitude).real)

    def state_at(self, time: float) -> Array:
        """x (n,) at one time (s): ``linear.full_state`` of it starts a run without a transient."""
        return np.asarray((np.exp(1j * number_of("time", time) * self.omega) @ self.state_amplitude).real)


@one_thread
def response_summed(
    scene: Description | LinearModel,
    *,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    waves: Waves | None = None,
    state: _core.State | None = None,
) -> SummedResponse:
    """Linear response to a realisation's own components: what a run in small waves must agree with.

    Of the waves of the scene by default; other arguments are as of `motion_rao`.

    Raises
    ------
    SceneError
        Without waves, with a ship whose motion is given, or as `linear_model`.
    """
    described = scene.scene if isinstance(scene, LinearModel) else scene
    sea = described.waves if waves is None else waves
    if sea is None:
        raise SceneError(f"scene {described.name!r}: has no waves; add a sea or give waves")
    _require_afloat(described)
    if isinstance(scene, Description):
        scene, state = linear_model(scene, state=state, vessel=next(iter(sea.hulls), None)), None
    linear = linear_of(scene, state)
    if linear.speed != 0.0:
        raise SceneError(
            f"scene {described.name!r}: its linear model is of {linear.speed:g} m/s, but meets the waves of "
            "the scene at zero speed; use response_statistics(memory='database')"
        )
    omega, forces = component_forces(sea)
    x: Complex = np.zeros((omega.size, len(linear.a)), dtype=complex)
    for vessel, force in forces.items():
        x += linear.excited(vessel).response(omega=omega, force=force)
    parts = PartsInWaves(linear)
    if parts:
        x += linear.response_to_rates(omega, parts.rates(omega, parts.flow_of(sea)))
    amplitude = x @ linear.output(body=body, point=point).T
    return SummedResponse(omega=omega, amplitude=amplitude, state_amplitude=x)


def component_forces(sea: Waves) -> tuple[Array, dict[str, Complex]]:
    """Frequencies of a sea's components (k,), rad/s, and by vessel their loads (k, 6), N and N m."""
    components = sea.components()
    omega, direction = np.array(components.omega), np.array(components.direction)
    forces: dict[str, Complex] = {}
    for vessel, hull in sea.hulls.items():
        along = np.cos(direction) * hull.position[0] + np.sin(direction) * hull.position[1]
        phase = np.array(components.phase) - np.array(components.wavenumber) * along
        wave = np.array(components.amplitude) * np.exp(1j * phase)
        forces[vessel] = wave[:, None] * np.asarray(hull.transfer).reshape(-1, 6)
    return omega, forces


def rates_in_waves(linear: LinearModel, database: HydroDatabase, omega: Array, direction: Array) -> Complex:
    """Rates of x (k, n) per metre of waves of frequencies (k,), rad/s, directions (k,) from the vessel's x.

    On the vessel and, where it is in a group, on all of that: the wave meets each at its place and heading at
    the start, and has zero phase at the vessel's.
    """
    assert linear.vessel is not None
    rates: Complex = database.force_at(omega, direction).reshape(-1, 6) @ linear.b.T
    scene, group = linear.scene, group_of(linear.scene, linear.vessel)
    here = scene.bodies[linear.vessel]
    travels = direction + heading_of(here.quaternion)
    for name in () if group is None else group.vessels:
        body = scene.vessels[name].body
        if body == linear.vessel:
            continue
        own, there = database_of(scene, body, "a motion in waves"), scene.bodies[body]
        east, north = np.asarray(there.position)[:2] - np.asarray(here.position)[:2]
        along = east * np.cos(travels) + north * np.sin(travels)
        ones, zeros = np.ones(omega.size), np.zeros(omega.size)
        waves = _core.WaveComponents(
            omega=omega, amplitude=ones, phase=zeros, direction=travels, depth=own.depth
        )
        phase = np.exp(-1j * np.array(waves.wavenumber) * along)
        force = own.force_at(omega, travels - heading_of(there.quaternion)).reshape(-1, 6)
        rates = rates + (phase[:, None] * force) @ linear.excited(body).b.T
    return rates
