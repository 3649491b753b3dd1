"""Statistics of a scene's linear motions in a sea: long-crested or short-crested, at rest or at speed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.drag_in_sea import band_of, drag_in_sea
from seacrane.analysis.frequency_domain import excitation_of, linear_of, rates_in_waves
from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.modal_analysis import (
    GRID,
    about_resonances,
    directions_of,
    quadrature_frequencies,
    weights_of,
)
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.arrays import Array, Complex
from seacrane.description.description import Description
from seacrane.description.given import group_of
from seacrane.errors import SceneError
from seacrane.hydro.data.data_warnings import warn_of_waves_below_band
from seacrane.hydro.data.excitation import force_on_grid
from seacrane.hydro.data.motion import encounter_frequency_at, inside_table
from seacrane.inputs.brief import brief
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import positive_of
from seacrane.inputs.keywords import named
from seacrane.one_thread import one_thread
from seacrane.sea.crossings import level_crossed
from seacrane.sea.spreading import Spreading
from seacrane.warnings import EncounterFrequencyWarning

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

NARROWEST = 1e-6  # bandwidth
FINE = 20_001  # frequencies at which the encounter is looked up
MOST_UNKNOWN = 0.1  # of the energy of the waves, met outside the table of a database at speed


@dataclass(frozen=True, kw_only=True, eq=False)
class ResponseStatistics:
    """Statistics of a linear, Gaussian response in a stationary sea.

    Every array has the six motions (three translations, m; rotation vector, rad) last.

    Attributes
    ----------
    omega : (k,) Frequencies of the quadrature, rad/s; of the waves.
    rao : (k, 6) Per metre of wave amplitude, of waves along the main direction; complex.
    spectrum : ndarray, shape (k, 6)
        |rao|^2 S, one-sided, integrated over the directions; m2 s/rad and rad2 s/rad. At forward speed too it
        is a density over the frequency of the waves.
    std : (6,) sqrt(m0).
    duration : s, of the extremes.
    wave_energy_share : Share of the sea's energy within the band of the database; the rest is left out.
    bandwidth : (6,) Vanmarcke's sqrt(1 - m1^2 / (m0 m2)); zero for what does not move.
    moments : (6, 3) m0, m2, m4; at forward speed by the frequency of encounter.
    directions, direction_share : (q,) Of the quadrature, rad; of the energy of the waves, they sum to one.
    """

    omega: Array
    rao: Complex
    spectrum: Array
    std: Array
    duration: float
    wave_energy_share: float
    bandwidth: Array
    moments: Array
    directions: Array
    direction_share: Array

    __repr__ = brief

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
        """Rayleigh's most probable largest amplitude in `duration`: sqrt(2 m0 ln N), N = duration / period.

        Every crest by itself; zero for less than one cycle. `most_probable_clumped` is the smaller one.
        """
        cycles = np.maximum(self.duration / self.mean_period, 1.0)
        return np.asarray(self.std * np.sqrt(2.0 * np.log(cycles)))

    @property
    def most_probable_clumped(self) -> Array:
        """The same with crests in Vanmarcke's clumps, by the bandwidth."""
        cycles = np.maximum(self.duration / self.mean_period, 1.0)
        levels = [
            level_crossed(1.0, cycles=float(count), bandwidth=max(float(width), NARROWEST))
            for count, width in zip(cycles, self.bandwidth, strict=True)
        ]
        return np.asarray(self.std * levels)


@named
@one_thread
def response_statistics(
    scene: Description | LinearModel,
    *,
    spectrum: _core.Spectrum,
    direction: float,
    body: str,
    point: ArrayLike = (0.0, 0.0, 0.0),
    duration: float = 10800.0,
    state: _core.State | None = None,
    memory: str = "scene",
    database: HydroDatabase | None = None,
    spreading: Spreading | None = None,
) -> ResponseStatistics:
    """Response spectrum, significant and most probable largest motion of a point of any body.

    The quadrature covers the band of the database and is refined about every resonance. With a database of a
    forward speed (``memory="database"``) all is integrated over the frequency of the waves, so that nothing
    is singular where following waves are met at the same frequency.

    Parts of loads under water are loaded by waves too. Their drag is made linear for this sea
    (`drag_in_sea`), but not of a LinearModel, which has it already or not.

    Parameters
    ----------
    scene, body, point, state, memory, database
        As `motion_rao`.
    direction : float
        rad, main direction of travel from the vessel's x towards its y.
    duration : float
        s, of the extremes.
    spreading : Spreading, optional
        Of the energy about `direction`: `cos_2s` or `cos_n`. Default: long-crested.

    Raises
    ------
    SceneError
        For a duration that is not positive, a spreading that is none, or as `motion_rao`.

    Warns
    -----
    UndampedModeWarning
        For a mode in the band without damping: its variance has no finite value.
    BelowBandWarning
        More than 10 % of the energy of the waves is below the database's trusted band.
    EncounterFrequencyWarning
        At forward speed more than 10 % of the energy is met outside the table of the matrices.
    """
    span = positive_of("duration", duration, "s")
    if spreading is not None and not isinstance(spreading, Spreading):
        raise SceneError(f"spreading is {spreading!r}; give cos_2s(...), cos_n(...) or None")
    main = float(direction)
    linear, database = _in_sea(scene, state, memory, database, spectrum, main, spreading)
    low, high = band_of(database, spectrum)
    if database is not None and database.trusted_band is not None and database.trusted_band[0] > low:
        below = spectrum.energy(minimum_omega=low, maximum_omega=database.trusted_band[0])
        warn_of_waves_below_band(database, below / spectrum.moment(0), "waves of a spectrum")
    directions, shares = directions_of(spreading, main)
    headings, output = np.append(main, directions), linear.output(body=body, point=point)
    along, *parts = _responses(linear, database, headings, output, (low, high))
    moments, density, unknown = np.zeros((6, 4)), np.zeros(along.rao.shape), 0.0
    for share, part in zip(shares, parts, strict=True):
        each = np.abs(part.rao) ** 2 * np.asarray(spectrum.density(part.omega))[:, None]
        moments += share * part.moments(each)
        density += share * part.at(along.omega, each)
        unknown += 0.0 if database is None else share * part.unknown(database, spectrum)
    _warn_of_unknown(database, unknown)
    m0, m1, m2 = moments[:, :3].T
    moving = m0 * m2 > 0.0
    ratio = np.where(moving, m1**2 / np.where(moving, m0 * m2, 1.0), 1.0)
    return ResponseStatistics(
        omega=along.omega, rao=along.rao, spectrum=density, std=np.sqrt(moments[:, 0]), duration=span,
        wave_energy_share=spectrum.energy(minimum_omega=low, maximum_omega=high) / spectrum.moment(0),
        bandwidth=np.sqrt(np.maximum(1.0 - ratio, 0.0)), moments=moments[:, [0, 2, 3]],
        directions=directions, direction_share=shares,
    )  # fmt: skip


def _in_sea(
    scene: Description | LinearModel, state: _core.State | None, memory: str, database: HydroDatabase | None,
    spectrum: _core.Spectrum, main: float, spreading: Spreading | None,
) -> tuple[LinearModel, HydroDatabase | None]:  # fmt: skip
    """The linear model, with drag of its parts for this sea, and the database of waves on its vessel."""
    linear = linear_of(scene, state, memory, database)
    if not isinstance(scene, LinearModel):
        linear = drag_in_sea(
            linear, spectrum=spectrum, direction=main, spreading=spreading, database=database
        )
    if linear.vessel is None and PartsInWaves(linear):
        return linear, None
    return linear, excitation_of(linear, database)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Response:
    """Motions (k, 6) per metre of waves of one direction, by their frequency and that of encounter (k,)."""

    omega: Array
    encounter: Array
    rao: Complex

    def moments(self, density: Array) -> Array:
        """m0, m1, m2, m4 (6, 4) of a density (k, 6) over the frequency of the waves."""
        weights, met = weights_of(self.omega), np.abs(self.encounter)
        return np.stack([(weights * met**order) @ density for order in (0, 1, 2, 4)], axis=1)

    def at(self, omega: Array, density: Array) -> Array:
        """The density (k, 6) at other frequencies of the waves."""
        if omega is self.omega or np.array_equal(omega, self.omega):
            return density
        return np.stack([np.interp(omega, self.omega, column) for column in density.T], axis=1)

    def unknown(self, database: HydroDatabase, spectrum: _core.Spectrum) -> float:
        """Share of the energy of the waves that is met outside the frequencies of the database."""
        outside = ~inside_table(database.omega, self.encounter)
        energy = weights_of(self.omega) * np.asarray(spectrum.density(self.omega))
        return float(energy[outside].sum() / spectrum.moment(0))


def _responses(
    linear: LinearModel, database: HydroDatabase | None, headings: Array, output: Array,
    band: tuple[float, float],
) -> Iterator[_Response]:  # fmt: skip
    """Responses to each direction; at rest all share their frequencies, and what the ship makes of a load."""
    parts = PartsInWaves(linear)
    if database is not None and database.speed != 0.0:
        about = about_resonances(linear, 0.0, float(np.inf))
        for heading in headings:
            omega = _met_frequencies(database, float(heading), about)
            encounter = encounter_frequency_at(database, omega, heading)
            force = force_on_grid(database, omega, heading[None])[0]
            rao = linear.response(omega=encounter, force=force) @ output.T
            yield _Response(omega=omega, encounter=encounter, rao=rao)
        return
    omega = quadrature_frequencies(linear, *band)
    raos: Complex = np.zeros((len(headings), len(omega), 6), dtype=complex)
    if database is not None and group_of(linear.scene, linear.vessel) is not None:
        for heading, rao in zip(headings, raos, strict=True):
            met = rates_in_waves(linear, database, omega, np.full(len(omega), heading))
            rao += linear.response_to_rates(omega, met) @ output.T
    elif database is not None:
        unit = np.repeat(np.eye(6), len(omega), axis=0)
        by_load = (linear.response(omega=np.tile(omega, 6), force=unit) @ output.T).reshape(6, -1, 6)
        raos += np.einsum("lkm,qkl->qkm", by_load, force_on_grid(database, omega, headings))
    depth = parts.water_depth if database is None else database.depth
    for heading, rao in zip(headings, raos, strict=True):
        if parts:
            flow = parts.flow(parts.waves(omega, heading, depth))
            rao = rao + linear.response_to_rates(omega, parts.rates(omega, flow)) @ output.T
        yield _Response(omega=omega, encounter=omega, rao=rao)


def _warn_of_unknown(database: HydroDatabase | None, share: float) -> None:
    if database is not None and share > MOST_UNKNOWN:
        warn_caller(
            f"database {database.name!r}: at {database.speed:g} m/s {share:.0%} of the energy of the waves "
            f"is met outside {database.omega[0]:.3g} to {database.omega[-1]:.3g} rad/s; the matrices there "
            "are those of the nearest frequency. Near zero, in following seas, surge, sway and yaw are those "
            "of the scene's springs, and no linear theory holds",
            EncounterFrequencyWarning,
        )


def _met_frequencies(database: HydroDatabase, heading: float, about: Array) -> Array:
    """Wave frequencies: even over the band, and those that are met at the frequencies ``about`` resonances.

    In following seas the frequency of encounter rises, turns and falls: a resonance is met up to three times.
    """
    low, high = float(database.omega[0]), float(database.omega[-1])
    fine = np.linspace(low, high, FINE)
    met = encounter_frequency_at(database, fine, np.array(heading))
    turn = int(np.argmax(met)) + 1
    parts = [np.linspace(low, high, GRID)]
    for branch in (slice(0, turn), slice(turn - 1, None)):
        rising = np.argsort(met[branch])
        for wanted in (about, -about):
            inside = wanted[(wanted > met[branch].min()) & (wanted < met[branch].max())]
            parts.append(np.interp(inside, met[branch][rising], fine[branch][rising]))
    return np.unique(np.concatenate(parts))
