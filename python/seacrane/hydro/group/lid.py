"""A damping lid on the water between hulls, put into results that were computed without one.

A lid adds a damping ``e w`` to the free surface: ``(w^2 - i e w^2) phi = g d(phi)/dz`` (Chen 2005, quoted),
so that a mode of the gap of frequency w0 and damping r, which moves as an oscillator, has ``r + e w0``
instead. In matrices and forces each mode is one pole::

    -w^2 A + i w B = smooth - w^2 S q(w),   F = smooth + f q(w),   q(w) = 1 / (w0^2 - w^2 + i w r)

with S real and positive. The poles are found in the data, and q is replaced by that with the lid: exact for
what is such a pole.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array, Complex
from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.hydro.group.gap import spikes
from seacrane.inputs.checked import positive_of
from seacrane.one_thread import one_thread

Group = TypeVar("Group", bound=HydroGroupData)

WINDOW = 0.2  # of the outermost frequencies, to each side
DEGREE = 3  # of what is smooth, and one more for each pole
START = 0.03  # damping of a pole by its frequency, at which the search begins
WORST = 0.15  # of what varies in the window, that poles and smooth part may leave


@one_thread
def group_with_lid(group: Group, damping: float) -> Group:
    """The group with a damping lid on the water between its hulls, put in where the source had none.

    Potential theory makes the water in a gap rise two to five times too high. How much a lid should damp
    it no theory tells: compare answers of two values.

    Parameters
    ----------
    damping : of the lid, as a share of the frequency: ``(1 - i damping) w^2 phi = g d(phi)/dz``. Values
        of 0.01 to 0.03 are in use.

    Returns
    -------
    HydroGroup : the poles of the gap's modes, found in matrices and forces, have ``damping`` times their
        frequency more; without a memory, as that is of the data before.

    Raises
    ------
    ValueError : no peak is one of a gap, the source has a lid already, or the frequencies are too far
        apart to show the resonance.
    SceneError : ``damping`` is not positive.
    """
    damping = positive_of(f"group {group.name!r}: lid damping", damping, "")
    if group.lid_damping:
        raise ValueError(
            f"group {group.name!r}: its source has a lid of damping {group.lid_damping:g} already; compute "
            "it without one"
        )
    places = [spike.omega for spike in spikes(group) if spike.cause == "gap"]
    if not places:
        raise ValueError(
            f"group {group.name!r}: no narrow peak of the damping is one of a gap, so that a lid has nothing "
            "to damp; see group.gaps() and group.check()"
        )
    low, high = (1.0 - WINDOW) * min(places), (1.0 + WINDOW) * max(places)
    inside = np.flatnonzero((group.omega >= low) & (group.omega <= high))
    needed = 3 * (DEGREE + 2 * len(places))
    if len(inside) < needed:
        raise ValueError(
            f"group {group.name!r}: {len(inside)} frequencies lie about the resonances of the gap, {low:.3g} "
            f"to {high:.3g} rad/s, and {needed} are needed to tell their poles; compute with a finer step"
        )
    w = group.omega[inside]
    omega, rate, residues, left = _poles_of_matrices(group, inside, np.array(places))
    if left > WORST:
        raise ValueError(
            f"group {group.name!r}: the resonance of the gap at {places[0]:.4g} rad/s is no sum of poles in "
            f"these data: {left:.2g} of it is left over; compute with a finer step of frequencies and "
            "finer panels there"
        )
    waves = group.force[:, inside].transpose(1, 0, 2).reshape(len(inside), -1)
    poles = [_pole(w, o, r) for o, r in zip(omega, rate, strict=True)]
    columns = np.concatenate([_smooth(w, len(omega)), poles]).T
    of_waves = np.linalg.lstsq(columns, waves, rcond=None)[0][-len(omega) :]
    of_waves = of_waves.reshape(len(omega), *group.force.shape[::2])
    w = group.omega
    dynamic = -(w[:, None, None] ** 2) * group.added_mass + 1j * w[:, None, None] * group.damping
    force = group.force.copy()
    for o, r, matrix, wave in zip(omega, rate, residues, of_waves, strict=True):
        change = _pole(w, o, r + damping * o) - _pole(w, o, r)
        dynamic = dynamic - (w**2 * change)[:, None, None] * matrix
        force = force + change[None, :, None] * wave[:, None, :]
    return replace(
        group, added_mass=-dynamic.real / w[:, None, None] ** 2, damping=dynamic.imag / w[:, None, None],
        force=force, lid_damping=damping, memory=None,
        source=f"{group.source}; gap with a lid of damping {damping:g}",
    )  # fmt: skip


def _pole(w: Array, omega: float, rate: float) -> Complex:
    return np.asarray(1.0 / (omega**2 - w**2 + 1j * w * rate))


def _poles_of_matrices(
    group: HydroGroupData, inside: NDArray[np.intp], places: Array
) -> tuple[Array, Array, Array, float]:
    """Poles near the peaks, by least squares of the symmetric matrices at some frequencies.

    Frequencies and dampings (p,), rad/s and 1/s; residues (p, 6 k, 6 k); the share that is left over.
    """
    w = group.omega[inside]
    rows, columns = np.triu_indices(6 * len(group.bodies))
    a, b = (0.5 * (x + x.swapaxes(1, 2))[inside] for x in (group.added_mass, group.damping))
    scale = np.sqrt(np.maximum(np.diagonal(b, axis1=1, axis2=2).max(axis=0), 1e-300))
    product = np.outer(scale, scale)
    dynamic = (-(w[:, None, None] ** 2) * a + 1j * w[:, None, None] * b) / product
    data: Complex = np.asarray(dynamic[:, rows, columns], dtype=complex)
    omega, rate = _searched(w, data, places)
    fitted, residues = _of_real_poles(w, omega, rate, data)
    matrices = np.zeros((len(places), len(scale), len(scale)))
    matrices[:, rows, columns] = matrices[:, columns, rows] = residues
    values, vectors = np.linalg.eigh(matrices)
    positive = np.einsum("pij,pj,pkj->pik", vectors, np.maximum(values, 0.0), vectors)
    varies = np.linalg.norm(data - data.mean(axis=0))
    return omega, rate, np.asarray(positive * product), float(np.linalg.norm(data - fitted) / varies)


def _searched(w: Array, data: Complex, places: Array) -> tuple[Array, Array]:
    """Frequencies and dampings (p,) of the poles that fit best, the former within 5 % of the peaks."""
    from scipy.optimize import least_squares

    count, size = len(places), np.abs(data - data.mean(axis=0)).max()

    def told(parameters: Array) -> tuple[Array, Array]:
        return parameters[:count] * places, np.exp(parameters[count:]) * places

    def misfit(parameters: Array) -> Array:
        left = (data - _of_real_poles(w, *told(parameters), data)[0]).ravel() / size
        return np.concatenate([left.real, left.imag])

    start = np.concatenate([np.ones(count), np.full(count, np.log(START))])
    margin = np.concatenate([np.full(count, 0.05), np.full(count, 4.0)])
    found = least_squares(misfit, start, bounds=(start - margin, start + margin), xtol=1e-12, ftol=1e-12)
    return told(np.asarray(found.x))


def _smooth(w: Array, count: int) -> Complex:
    """Powers (DEGREE + count + 1, n) of the frequency within its window."""
    x = 2.0 * (w - w[0]) / (w[-1] - w[0]) - 1.0
    return np.asarray(x ** np.arange(DEGREE + count + 1)[:, None], dtype=complex)


def _of_real_poles(w: Array, omega: Array, rate: Array, data: Complex) -> tuple[Complex, Array]:
    """Best fit (n, entries) by a smooth part and by poles with real coefficients (p, entries)."""
    smooth = _smooth(w, len(omega)).real
    poles = np.array([-(w**2) * _pole(w, o, r) for o, r in zip(omega, rate, strict=True)])
    nothing = np.zeros_like(smooth)
    real = np.concatenate([smooth, nothing, poles.real])
    imaginary = np.concatenate([nothing, smooth, poles.imag])
    columns = np.concatenate([real, imaginary], axis=1).T
    target = np.concatenate([data.real, data.imag])
    values = np.linalg.lstsq(columns, target, rcond=None)[0]
    fitted = columns @ values
    return np.asarray(fitted[: len(w)] + 1j * fitted[len(w) :]), values[-len(omega) :]
