"""Drag of parts and lines under water made linear for a sea: its mean slope over a Gaussian response."""

from __future__ import annotations

from dataclasses import dataclass
from math import gamma
from typing import TYPE_CHECKING

import numpy as np

from seacrane import _core
from seacrane.analysis.frequency_domain import component_forces, excitation_of, rates_in_waves
from seacrane.analysis.linear_system import LinearModel
from seacrane.analysis.modal_analysis import directions_of, quadrature_frequencies, weights_of
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.arrays import Array, Complex
from seacrane.description.given import group_of
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.hydro.data.excitation import force_on_grid
from seacrane.inputs.caller import silently
from seacrane.one_thread import one_thread
from seacrane.sea.spreading import Spreading

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

TOGETHER = {"cylinder": ((0,), (1, 2)), "sphere": ((0, 1, 2),)}  # axes whose drag is by their common speed
ALONE = ((0,), (1,), (2,))
ANGLES, HEIGHTS = 32, 16  # of the mean over directions of a velocity
MOST_STEPS = 200
SETTLED = 1e-9  # relative change of the damping
RELAXED = 0.6  # of a step to the next: the more damping, the less speed
ROUGH = 400  # frequencies over which the water alone is summed


@one_thread
def drag_in_sea(
    linear: LinearModel,
    *,
    spectrum: _core.Spectrum,
    direction: float,
    spreading: Spreading | None = None,
    database: HydroDatabase | None = None,
) -> LinearModel:
    """A linear model with the drag of what is in water as damping, and as a load of the waves, in a sea.

    Drag along an axis, b |v| v with v over the water, becomes sqrt(8 / pi) sigma b v, which errs least in the
    mean square where v is Gaussian with the standard deviation sigma. sigma is that of the response itself,
    found by iteration. Where drag goes by a common speed (cylinders across, spheres), the matrix is the mean
    of its slope over all directions.

    Parameters
    ----------
    spectrum : Spectrum
        Of `seacrane.sea`.
    direction : float
        rad, main direction of travel from the vessel's x towards its y; without a vessel, inertial.
    spreading : Spreading, optional
        Of the energy about `direction`. Default: long-crested.
    database : HydroDatabase, optional
        As `motion_rao`.

    Returns
    -------
    LinearModel
        `drag_damping` holds the matrices. The model itself where no part is under water.

    Raises
    ------
    SceneError
        For parts that cross the surface at rest, entrapped water, a current, a vessel without a database, or
        damping that does not settle.

    Notes
    -----
    T. S. Atalik, S. Utku, "Stochastic linearization of multi-degree-of-freedom non-linear systems",
    Earthquake Eng. Struct. Dyn. 4 (1976) 411; along one axis L. E. Borgman, "The spectral density for ocean
    wave forces", 1965 (both unverified: the equation was derived anew).
    """
    parts = PartsInWaves(linear)
    if not parts:
        return linear
    base = excitation_of(linear, database) if linear.vessel is not None else None
    first, last = band_of(base, spectrum)
    angles, shares = directions_of(spreading, direction)
    still = parts.damped([np.zeros((3, 3))] * len(parts.parts))

    def sea_at(omega: Array) -> _Sea:
        return _Sea.of_spectrum(still, omega, base, spectrum, angles, shares)

    moving = sea_at(np.linspace(first, last, ROUGH)).as_if_still(still)
    with silently():  # of modes that drag does not damp: whoever sums a response tells them
        omega = quadrature_frequencies(moving.linear, first, last)
    return sea_at(omega).settled(moving)


@one_thread
def drag_in_components(linear: LinearModel, sea: Waves) -> LinearModel:
    """As `drag_in_sea`, in a sea of the components of a realisation, and its loads on all vessels."""
    parts = PartsInWaves(linear)
    if not parts:
        return linear
    still = parts.damped([np.zeros((3, 3))] * len(parts.parts))
    components = _Sea.of_components(still, sea)
    return components.settled(components.as_if_still(still))


def band_of(database: HydroDatabase | None, spectrum: _core.Spectrum) -> tuple[float, float]:
    """Frequencies (rad/s) over which a response is summed: those of a database, or all that a sea has."""
    first, last = spectrum.default_range if database is None else database.omega[[0, -1]]
    return float(first), float(last)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Sea:
    """Waves of several directions and frequencies (k,), rad/s, on a model, and their speeds over its parts.

    By direction, per metre of wave amplitude, or of all of a component: velocities of the water at the parts
    (k, 3 p), rates of x by the loads on vessels (k, n), and the density (k,) with which squares of amplitudes
    are summed to variances.
    """

    parts: PartsInWaves
    omega: Array
    flows: list[Complex]
    on_vessels: list[Complex]
    density: Array

    @classmethod
    def of_spectrum(
        cls, parts: PartsInWaves, omega: Array, base: HydroDatabase | None, spectrum: _core.Spectrum,
        angles: Array, shares: Array,
    ) -> _Sea:  # fmt: skip
        """Waves of a metre, at frequencies of a quadrature."""
        depth = parts.water_depth if base is None else base.depth
        none: Complex = np.zeros((omega.size, len(parts.linear.a)), dtype=complex)
        on_vessels = [none] * len(angles)
        linear = parts.linear
        if base is not None and group_of(linear.scene, linear.vessel) is not None:
            grid = [np.full(omega.size, angle) for angle in angles]
            on_vessels = [rates_in_waves(linear, base, omega, angle) for angle in grid]
        elif base is not None:
            on_vessels = [force @ linear.b.T for force in force_on_grid(base, omega, angles)]
        return cls(
            parts=parts, omega=omega, on_vessels=on_vessels,
            flows=[parts.flow(parts.waves(omega, angle, depth)) for angle in angles],
            density=np.outer(shares, weights_of(omega) * np.asarray(spectrum.density(omega))),
        )  # fmt: skip

    @classmethod
    def of_components(cls, parts: PartsInWaves, sea: Waves) -> _Sea:
        """Those of a realisation."""
        omega, forces = component_forces(sea)
        rates: Complex = np.zeros((omega.size, len(parts.linear.a)), dtype=complex)
        for vessel, force in forces.items():
            rates += force @ parts.linear.excited(vessel).b.T
        return cls(
            parts=parts, omega=omega, flows=[parts.flow_of(sea)], on_vessels=[rates],
            density=np.full((1, omega.size), 0.5),
        )  # fmt: skip

    def as_if_still(self, parts: PartsInWaves) -> PartsInWaves:
        """Parts with drag as if nothing moved but the water."""
        return parts.damped(self.slopes(self.flows))

    def settled(self, moving: PartsInWaves) -> LinearModel:
        """The model with the drag of its own response; SceneError where that does not settle."""
        for _ in range(MOST_STEPS):
            known = [moving.linear.drag_damping[part.name] for part in moving.parts]
            found = self.slopes(self.over(moving))
            apart = max(float(np.max(np.abs(a - b))) for a, b in zip(found, known, strict=True))
            if apart <= SETTLED * max(float(np.max(np.abs(each))) for each in found):
                return moving.linear
            moving = moving.damped([a + RELAXED * (b - a) for a, b in zip(known, found, strict=True)])
        raise SceneError(
            f"scene {moving.linear.scene.name!r}: the damping of what is in water did not settle in "
            f"{MOST_STEPS} steps; simulate the scene"
        )

    def over(self, parts: PartsInWaves) -> list[Complex]:
        """Velocities of all parts over the water, by direction, (k, 3 p), per metre of wave amplitude."""
        dof, found = parts.linear.degrees_of_freedom, []
        for flow, rates in zip(self.flows, self.on_vessels, strict=True):
            x = parts.linear.response_to_rates(self.omega, rates + parts.rates(self.omega, flow))
            found.append(np.asarray(x[:, dof : 2 * dof] @ parts.along.T - flow))
        return found

    def slopes(self, velocities: list[Complex]) -> list[Array]:
        """Of the drag of each part, (3, 3), inertial axes."""
        found = []
        for i, part in enumerate(self.parts.parts):
            local = [each[:, 3 * i : 3 * i + 3] @ part.axes for each in velocities]
            covariance = sum(
                np.real(np.einsum("ki,kj,k->ij", each, each.conj(), density))
                for each, density in zip(local, self.density, strict=True)
            )
            slope = mean_slope(part.drag, np.asarray(covariance), shape=part.shape)
            found.append(np.asarray(part.axes @ slope @ part.axes.T))
        return found


def mean_slope(drag: Array, covariance: Array, *, shape: str) -> Array:
    """E[d(drag |v| v) / dv] (3, 3), N s/m, of a Gaussian velocity along the axes of a part.

    It is the matrix C of least E[(drag |v| v - C v)^2]; sqrt(8 / pi) drag sigma along one axis.
    """
    out = np.zeros((3, 3))
    for axes in TOGETHER.get(shape, ALONE):
        out[np.ix_(axes, axes)] = drag[list(axes)][:, None] * _slope(covariance[np.ix_(axes, axes)])
    return out


def _slope(covariance: Array) -> Array:
    """E[|v| 1 + v v^T / |v|]: v is r, apart from all else, times a stretched direction on the sphere."""
    size = len(covariance)
    values, vectors = np.linalg.eigh(covariance)
    directions, shares = _sphere(size)
    along = directions * np.sqrt(np.maximum(values, 0.0)) @ vectors.T
    speed = np.linalg.norm(along, axis=1)
    outer = np.einsum("qi,qj,q->qij", along, along, 1.0 / np.where(speed > 0.0, speed, 1.0))
    radius = np.sqrt(2.0) * gamma(0.5 * (size + 1)) / gamma(0.5 * size)
    return np.asarray(radius * np.einsum("q,qij->ij", shares, outer + speed[:, None, None] * np.eye(size)))


def _sphere(size: int) -> tuple[Array, Array]:
    """Unit vectors (q, size) and their shares (q,)."""
    if size == 1:
        return np.ones((1, 1)), np.ones(1)
    angle = (np.arange(ANGLES) + 0.5) * 2.0 * np.pi / ANGLES
    ring, even = np.stack([np.cos(angle), np.sin(angle)], axis=1), np.full(ANGLES, 1.0 / ANGLES)
    if size == 2:
        return ring, even
    heights, weights = np.polynomial.legendre.leggauss(HEIGHTS)
    points = [np.column_stack([np.sqrt(1.0 - z * z) * ring, np.full(ANGLES, z)]) for z in heights]
    return np.concatenate(points), np.concatenate([0.5 * weight * even for weight in weights])
