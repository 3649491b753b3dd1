"""Motions of a scene in waves from its linear model: transfer functions, statistics, sums over components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.modal_analysis import natural_modes
from seacrane.description.given import given_vessels
from seacrane.description.scene import Description
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.hydro.data.below_band import warn_of_waves_below_band
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
UNDAMPED = 1e-6  # damping ratio below which the variance of a resonance has no meaning
BROAD = 0.2  # damping ratio above which the even grid resolves a resonance
GRID = 1500  # frequencies over the band of the database
GRID_OF_MODE = 120  # more on either side of each resonance


def motion_rao(
    scene: Description | LinearModel,
    *,
    database: HydroDatabase,
    omega: ArrayLike,
    heading: ArrayLike,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    state: _core.State | None = None,
    memory: str = "scene",
) -> Complex:
    """Complex motion of a point of any body per metre of wave amplitude.

    Parameters
    ----------
    scene : Scene or LinearModel
    database : HydroDatabase
        Whose wave excitation acts on the vessel.
    omega, heading : array_like, broadcast against each other
        rad/s; rad, direction of travel from the vessel's x (following) towards its y (port).
    body : str
    point : array_like, shape (3,)
        Body coordinates, from the body origin, m.
    state : State, optional
        At rest; default ``equilibrium(scene)``. Not with a LinearModel.
    memory : str
        "scene" (default), or "database": A and B of `database` by frequency, see `linear_model`. Not with a
        LinearModel.

    Returns
    -------
    ndarray of complex, shape (..., 6)
        Translation (m/m) and rotation vector (rad/m), inertial axes, time factor exp(+i omega t); the wave
        has zero phase at the mean position of the vessel's origin.

    Raises
    ------
    SceneError
        As `linear_model`, for frequencies outside the database, or with a ship whose motion is given.
    """
    linear = _linear(scene, state, memory, database)
    w, b = np.broadcast_arrays(np.asarray(omega, dtype=float), np.asarray(heading, dtype=float))
    force = database.force_at(w.ravel(), b.ravel()).reshape(-1, 6)
    x = linear.response(omega=w.ravel(), force=force)
    return np.asarray((x @ linear.output(body=body, point=point).T).reshape(*w.shape, 6))


def _linear(
    scene: Description | LinearModel,
    state: _core.State | None,
    memory: str = "scene",
    database: HydroDatabase | None = None,
) -> LinearModel:
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
    omega : ndarray, shape (k,)
        rad/s.
    amplitude : ndarray of complex, shape (k, 6)
        Of the point's translation (m) and the body's rotation vector (rad): sum Re amplitude exp(i omega t).
    state_amplitude : ndarray of complex, shape (k, n)
        The same of x of the `LinearModel`.
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


def response_summed(
    scene: Description | LinearModel,
    *,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    waves: Waves | None = None,
    state: _core.State | None = None,
) -> SummedResponse:
    """Linear response to a realisation's own components: what a run in small waves must agree with.

    Parameters
    ----------
    scene : Scene or LinearModel
    body, point
        As `motion_rao`.
    waves : Waves, optional
        Default: those of the scene.
    state : State, optional
        At rest; default ``equilibrium(scene)``. Not with a LinearModel.

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
    linear = _linear(scene, state)
    omega, forces = component_forces(sea)
    x: Complex = np.zeros((omega.size, len(linear.a)), dtype=complex)
    for vessel, force in forces.items():
        x += linear.excited(vessel).response(omega=omega, force=force)
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


@dataclass(frozen=True, kw_only=True, eq=False)
class ResponseStatistics:
    """Statistics of a linear, Gaussian response in a stationary long-crested sea.

    Every array has the six motions (three translations, m; rotation vector, rad) last.

    Attributes
    ----------
    omega : ndarray, shape (k,)
        Frequencies of the quadrature, rad/s.
    rao : ndarray of complex, shape (k, 6)
        Per metre of wave amplitude.
    spectrum : ndarray, shape (k, 6)
        |rao|^2 S, one-sided; m2 s/rad and rad2 s/rad.
    std : ndarray, shape (6,)
        sqrt(m0).
    duration : float
        s, of the extremes.
    wave_energy_share : float
        Share of the sea's energy within the band of the database; the rest is left out.
    moments : ndarray, shape (6, 3)
        m0, m2, m4.
    """

    omega: Array
    rao: Complex
    spectrum: Array
    std: Array
    duration: float
    wave_energy_share: float
    moments: Array

    @property
    def significant_amplitude(self) -> Array:
        """2 sqrt(m0): mean of the highest third of the amplitudes of a narrow-banded response."""
        return np.asarray(2.0 * self.std)

    @property
    def significant_double_amplitude(self) -> Array:
        """4 sqrt(m0): crest to trough, as Hs of the sea."""
        return np.asarray(4.0 * self.std)

    @property
    def mean_period(self) -> Array:
        """Mean zero-upcrossing period 2 pi sqrt(m0 / m2), s; infinite for what does not move."""
        m0, m2 = self.moments[:, 0], self.moments[:, 1]
        moving = m2 > 0.0
        return np.where(moving, 2.0 * np.pi * np.sqrt(m0 / np.where(moving, m2, 1.0)), np.inf)

    @property
    def most_probable_largest(self) -> Array:
        """Most probable largest amplitude in `duration`: sqrt(2 m0 ln N), N = duration / mean period.

        Rayleigh distributed amplitudes (narrow band); zero for less than one cycle.
        """
        cycles = np.maximum(self.duration / self.mean_period, 1.0)
        return np.asarray(self.std * np.sqrt(2.0 * np.log(cycles)))


def response_statistics(
    scene: Description | LinearModel,
    *,
    database: HydroDatabase,
    spectrum: _core.Spectrum,
    heading: float,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    duration: float = 10800.0,
    state: _core.State | None = None,
    memory: str = "scene",
) -> ResponseStatistics:
    """Response spectrum, significant and most probable largest motion of a point of any body.

    The quadrature covers the band of the database and is refined about every resonance.

    Parameters
    ----------
    scene, database, body, point, state, memory
        As `motion_rao`.
    spectrum : Spectrum
    heading : float
        rad, direction of travel from the vessel's x towards its y.
    duration : float
        s.

    Raises
    ------
    SceneError
        For a duration that is not positive, or as `motion_rao`.

    Warns
    -----
    UserWarning
        For a mode in the band without damping: its variance has no finite value.
    BelowBandWarning
        More than 10 % of the energy of the waves is below the database's trusted band.
    """
    span = number_of("duration", duration)
    if not (np.isfinite(span) and span > 0.0):
        raise SceneError(f"duration is {span} s; give a finite positive number")
    linear = _linear(scene, state, memory, database)
    low, high = float(database.omega[0]), float(database.omega[-1])
    if database.trusted_band is not None and database.trusted_band[0] > low:
        below = spectrum.energy(omega_min=low, omega_max=database.trusted_band[0]) / spectrum.moment(0)
        warn_of_waves_below_band(database, below, "waves of a spectrum")
    omega = _frequencies(linear, low, high)
    rao = motion_rao(linear, database=database, omega=omega, heading=heading, body=body, point=point)
    density = np.abs(rao) ** 2 * np.asarray(spectrum.density(omega))[:, None]
    steps = np.diff(omega)
    weights = 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))
    moments = np.stack([(weights * omega**order) @ density for order in (0, 2, 4)], axis=1)
    return ResponseStatistics(
        omega=omega,
        rao=rao,
        spectrum=density,
        std=np.sqrt(moments[:, 0]),
        duration=span,
        wave_energy_share=spectrum.energy(omega_min=low, omega_max=high) / spectrum.moment(0),
        moments=moments,
    )


def _frequencies(linear: LinearModel, low: float, high: float) -> Array:
    """Even over the band; about each resonance geometrically away from a tenth of its half width."""
    modes = natural_modes(linear)
    parts = [np.linspace(low, high, GRID)]
    for i, value in enumerate(modes.eigenvalues):
        if not low < value.imag < high or modes.damping_ratio[i] > BROAD:
            continue
        if modes.damping_ratio[i] < UNDAMPED:
            warn_caller(
                f"scene {linear.scene.name!r}: mode {modes.label(i)!r} at {value.imag:.4g} rad/s has a "
                f"damping ratio of {modes.damping_ratio[i]:.2g}: the variance of its resonance has no "
                "finite value; add damping",
                UserWarning,
            )
            continue
        width = abs(value.real)
        away = np.geomspace(0.1 * width, max(0.5 * value.imag, width), GRID_OF_MODE)
        parts.append(np.concatenate([value.imag - away, [value.imag], value.imag + away]))
    omega = np.unique(np.concatenate(parts))
    return omega[(omega >= low) & (omega <= high)]
