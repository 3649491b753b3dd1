"""Retardation functions of a database: the radiation damping as memory in time, for direct convolution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_data import AdditionalMatrices
from seacrane.hydro.data.hydro_group_data import Hydrodynamics
from seacrane.hydro.memory.identification import judged_band, memory_entries, symmetric
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import positive_of
from seacrane.one_thread import one_thread

LONGEST_STEP = 0.1  # s
PHASE_PER_STEP = 0.4  # rad, of the database's highest frequency
DURATIONS = (30.0, 45.0, 60.0, 90.0, 120.0)  # s
DAMPING_ERROR = 2e-3  # of the damping's largest value in its pair, by which the duration is chosen
TAPER = 0.2  # of the duration
TAIL_EXPONENTS = (2.0, 6.0)
POINTS = 16  # Gauss points per interval of frequency: exact for a cubic times a cosine of some 20 rad


@dataclass(frozen=True, kw_only=True, eq=False)
class RetardationModel:
    """Memory as functions of time, ``mu(t) = integral_0^T K(tau) v(t - tau) dtau``; the load is ``-mu``.

    Attributes
    ----------
    step : s between samples.
    radiation, additional : (n, 6, 6) K of radiation and of additional causes (roll tanks) at 0, step, 2 step
        ...; N and N m per (m/s or rad/s) and s.
    added_mass : (6, 6) infinite-frequency added mass that belongs to ``radiation``.
    additional_added_mass, additional_stiffness : (6, 6) instantaneous parts of the additional causes.
    band : (low, high) rad/s over which A_inf and the errors below are taken.
    error_damping : (6, 6) root mean square over the band of what the samples return less what the database
        holds (radiation, made symmetric), over the standard deviation of the data; zero where there is no
        memory.
    """

    step: float
    radiation: Array
    additional: Array
    added_mass: Array
    additional_added_mass: Array
    additional_stiffness: Array
    band: tuple[float, float]
    error_damping: Array

    __repr__ = brief

    @property
    def duration(self) -> float:
        """Time after which the past is forgotten, s."""
        return self.step * (len(self.radiation) - 1)

    @property
    def kernel(self) -> Array:
        """K of all causes (n, 6, 6), a new array."""
        return np.asarray(self.radiation + self.additional)

    def frequency_response(self, omega: ArrayLike) -> tuple[Array, Array]:
        """Radiation added mass and damping (m, 6, 6) that the samples give at positive ``omega`` (m,)."""
        return _response(omega, self.radiation, self.step, self.added_mass, 0.0)

    def additional_response(self, omega: ArrayLike) -> tuple[Array, Array]:
        """The response of all other causes, stiffness counted as added mass."""
        return _response(
            omega, self.additional, self.step, self.additional_added_mass, self.additional_stiffness
        )


def _response(
    omega: ArrayLike, kernel: Array, step: float, mass: Array, stiffness: Array | float
) -> tuple[Array, Array]:
    w = np.atleast_1d(np.asarray(omega, dtype=float))
    transfer, by_frequency = transformer(kernel, step)(w), w[:, None, None]
    return mass + transfer.imag / by_frequency - stiffness / by_frequency**2, transfer.real


@one_thread
def retardation_functions(
    *, database: Hydrodynamics, step: float | None = None, duration: float | None = None
) -> RetardationModel:
    """Retardation functions ``K(tau) = 2 / pi integral_0^inf B(omega) cos(omega tau) domega`` of a database.

    Parameters
    ----------
    database : its damping (made symmetric) gives K, its added mass A_inf.
    step : s between samples; default: 0.1 s, or less where that exceeds 0.4 rad of the highest frequency.
    duration : s kept of K, its last fifth tapered to zero by half a cosine; default: the shortest of 30, 45,
        60, 90 and 120 s that returns the damping of every pair to 0.2 % of its largest value, or the best.

    Raises
    ------
    ValueError : a step or duration that is not positive, or that leaves fewer than 8 or more than 20 000
        samples; a step beyond half a period of the highest frequency; a band with fewer than 8 frequencies.

    Notes
    -----
    Below the first frequency and between the frequencies B is the cubic spline that is even in omega, with
    B(0) = 0; its transform is exact to rounding. Above the last frequency B falls as omega^-n, with n from
    2 to 6 such that the slope is that of the last points. What this assumption decides of the added mass
    within the band is nearly constant there and so becomes part of A_inf, which is the mean over the band of
    ``A(omega) - Im K(i omega) / omega`` (Ogilvie 1964). Additional matrices (roll tanks) get the same, with a
    static stiffness beside A_inf: both fitted to the force of the added mass, weighted by the damping.
    """
    if step is None:
        step = min(LONGEST_STEP, PHASE_PER_STEP / float(database.omega[-1]))
    step = positive_of("retardation functions: step", step, "s")
    if step * database.omega[-1] > np.pi:
        raise ValueError(
            f"retardation functions: step is {step} s, more than half a period of the database's highest "
            f"frequency, {database.omega[-1]:.4g} rad/s; make it shorter"
        )
    durations: tuple[float, ...] = DURATIONS
    if duration is not None:
        durations = (positive_of("retardation functions: duration", duration, "s"),)
    band, inside = judged_band(database)
    added_mass, damping = symmetric(database.added_mass), symmetric(database.damping)
    active = np.zeros(added_mass.shape[1:], dtype=bool)
    for j, k in memory_entries(added_mass, damping, database.omega):
        active[j, k] = active[k, j] = True
    damping = damping * active
    tau: Array = step * np.arange(_samples(durations[-1], step), dtype=float)
    whole = cosine_transform(database.omega, damping, tau)
    samples = _shortest(database.omega, damping, whole, step, [_samples(d, step) for d in durations])
    radiation = _tapered(whole[:samples])
    response = transformer(radiation, step)(database.omega)
    estimates = added_mass - response.imag / database.omega[:, None, None]
    infinite = np.where(active, estimates[inside].mean(axis=0), added_mass[-1])
    additional, mass, stiffness = np.zeros_like(radiation), np.zeros_like(infinite), np.zeros_like(infinite)
    for part in database.additional:
        more = _additional(database, part, tau[:samples], inside)
        additional, mass, stiffness = additional + more[0], mass + more[1], stiffness + more[2]
    lost, spread = (
        np.sqrt(np.mean((response.real - damping)[inside] ** 2, axis=0)),
        damping[inside].std(axis=0),
    )
    error = np.divide(lost, spread, out=np.zeros_like(lost), where=spread != 0.0)
    return RetardationModel(
        step=step, radiation=radiation, additional=additional, added_mass=infinite,
        additional_added_mass=mass, additional_stiffness=stiffness, band=band, error_damping=error * active,
    )  # fmt: skip


def cosine_transform(omega: Array, damping: Array, tau: Array) -> Array:
    """``2 / pi integral B cos(omega tau) domega`` (n, ...) at ``tau`` (n,).

    ``damping`` (m, ...) at ``omega`` (m,), positive; see `retardation_functions` for the rest of the axis.
    """
    from scipy.interpolate import CubicSpline

    end, last = float(omega[-1]), damping[-1]
    # The local exponent of decay at the last frequency, within bounds; 3 where there is no damping.
    slope = np.gradient(damping[-4:], omega[-4:], axis=0)[-1]
    local = np.where(last == 0.0, 3.0, -slope * end / np.where(last == 0.0, 1.0, last))
    exponent = np.clip(local, *TAIL_EXPONENTS)
    spline = CubicSpline(
        np.concatenate([[0.0], omega]),
        np.concatenate([np.zeros_like(damping[:1]), damping]),
        bc_type=((1, np.zeros_like(last)), (1, -exponent * last / end)),
    )
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    half, middle = 0.5 * np.diff(spline.x), 0.5 * (spline.x[1:] + spline.x[:-1])
    at = (middle[:, None] + half[:, None] * nodes).ravel()
    values = (half[:, None] * weights).ravel()[:, None] * spline(at).reshape(len(at), -1)
    inner = (np.cos(np.outer(tau, at)) @ values).reshape(-1, *last.shape)
    outer = last * _power_law_transform(exponent, end, tau)
    return np.asarray(2.0 / np.pi * (inner + outer))


def _power_law_transform(exponent: Array, end: float, tau: Array) -> Array:
    """``integral_end^inf (end / omega)^n cos(omega tau) domega`` (n, ...) for exponents (...) of 2 or more.

    Along omega = end (1 + i x) the cosine decays instead of turning (Cauchy's theorem): intervals of x that
    double serve all times.
    """
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    knots = np.concatenate([[0.0], 1e-4 * 2.0 ** np.arange(36)])
    half, middle = 0.5 * np.diff(knots), 0.5 * (knots[1:] + knots[:-1])
    x = (middle[:, None] + half[:, None] * nodes).ravel()
    weight = (half[:, None] * weights).ravel()
    falling = weight[:, None] * (1.0 + 1j * x)[:, None] ** -exponent.ravel()
    integral = np.exp(-end * np.outer(tau, x)) @ falling
    turned = 1j * np.exp(1j * end * tau)[:, None] * integral
    return np.asarray(end * turned.real).reshape(-1, *exponent.shape)


def transformer(kernel: Array, step: float) -> Callable[[Array], Complex]:
    """``integral_0^T K(tau) exp(-i omega tau) dtau`` (m, ...) of samples (n, ...), by a cubic spline.

    A function of ``omega`` (m,).
    """
    from scipy.interpolate import CubicSpline

    times = step * np.arange(len(kernel))
    nodes, weights = np.polynomial.legendre.leggauss(4)
    at = (times[:-1, None] + 0.5 * step * (1.0 + nodes)).ravel()
    weight = np.tile(0.5 * step * weights, len(kernel) - 1)
    values = CubicSpline(times, kernel)(at)

    def of(omega: Array) -> Complex:
        return np.asarray(np.tensordot(np.exp(-1j * np.outer(omega, at)) * weight, values, axes=1))

    return of


def _shortest(omega: Array, damping: Array, kernel: Array, step: float, candidates: list[int]) -> int:
    """Samples of the shortest kernel that returns the damping well, or of the one that does so best."""
    largest = np.maximum(np.abs(damping).max(axis=0), 1e-300)
    errors = []
    for samples in candidates:
        back = transformer(_tapered(kernel[:samples]), step)(omega).real
        errors.append(float(np.max(np.where(largest > 1e-300, np.abs(back - damping) / largest, 0.0))))
        if errors[-1] <= DAMPING_ERROR:
            return samples
    return candidates[int(np.argmin(errors))]


def _tapered(kernel: Array) -> Array:
    """The kernel with its last fifth taken to zero."""
    fraction = np.linspace(0.0, 1.0, len(kernel))
    fade = np.clip((fraction - (1.0 - TAPER)) / TAPER, 0.0, 1.0)
    return np.asarray(kernel * (0.5 * (1.0 + np.cos(np.pi * fade)))[:, None, None])


def _additional(
    database: Hydrodynamics, part: AdditionalMatrices, tau: Array, inside: NDArray[np.bool_]
) -> tuple[Array, Array, Array]:
    """Kernel (n, 6, 6), instantaneous added mass and static stiffness (6, 6) of one additional cause."""
    damping, added_mass = symmetric(part.damping), symmetric(part.added_mass)
    kernel = _tapered(cosine_transform(database.omega, damping, tau))
    omega = database.omega[inside]
    transfer = transformer(kernel, float(tau[1]))(omega)
    rest = (added_mass[inside] - transfer.imag / omega[:, None, None]) * omega[:, None, None] ** 2
    mass, stiffness = np.zeros(rest.shape[1:]), np.zeros(rest.shape[1:])
    columns = np.stack([omega**2, -np.ones_like(omega)], axis=1)
    for j, k in np.ndindex(*mass.shape):
        strength = np.abs(damping[inside, j, k])
        weight = strength / strength.max() if strength.any() else np.ones_like(omega)
        target = rest[:, j, k] * weight
        mass[j, k], stiffness[j, k] = np.linalg.lstsq(columns * weight[:, None], target, rcond=None)[0]
    return kernel, mass, stiffness


def _samples(duration: float, step: float) -> int:
    """Samples from 0 to the duration."""
    count = round(duration / step) + 1
    if not 8 <= count <= 20_000:
        raise ValueError(
            f"retardation functions: {duration} s at steps of {step} s are {count} samples; choose 8 to 20000"
        )
    return count
