"""Andrews' squeezer in its seven angles: the equations of the Test Set for IVP Solvers, solved by SciPy.

M(q) q'' + G(q)^T lambda = f(q, q'), G(q) q'' = -(G q')' q'. Over 0.03 s the drift of the integrated
accelerations is below the rounding errors of the published solution.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from reference.classic import integrate

from . import andrews as a

Array = NDArray[np.float64]


def mass(q: Array) -> Array:
    _, theta, _, phi, _, omega, _ = q
    m, i = a.MASS, a.INERTIA
    out = np.zeros((7, 7))
    c2, s4, s6 = np.cos(theta), np.sin(phi), np.sin(omega)
    arm4, arm6 = a.E - a.EA, a.ZF - a.FA
    out[0, 0] = m[0] * a.RA**2 + m[1] * (a.RR**2 - 2.0 * a.DA * a.RR * c2 + a.DA**2) + i[0] + i[1]
    out[0, 1] = m[1] * (a.DA**2 - a.DA * a.RR * c2) + i[1]
    out[1, 1] = m[1] * a.DA**2 + i[1]
    out[2, 2] = m[2] * (a.SA**2 + a.SB**2) + i[2]
    out[3, 3] = m[3] * arm4**2 + i[3]
    out[3, 4] = m[3] * (arm4**2 + a.ZT * arm4 * s4) + i[3]
    out[4, 4] = m[3] * (a.ZT**2 + 2.0 * a.ZT * arm4 * s4 + arm4**2) + m[4] * (a.TA**2 + a.TB**2) + i[3] + i[4]
    out[5, 5] = m[5] * arm6**2 + i[5]
    out[5, 6] = m[5] * (arm6**2 - a.U * arm6 * s6) + i[5]
    out[6, 6] = m[5] * (arm6**2 - 2.0 * a.U * arm6 * s6 + a.U**2) + m[6] * (a.UA**2 + a.UB**2) + i[5] + i[6]
    return out + np.triu(out, 1).T


def force(q: Array, v: Array) -> Array:
    _, theta, gamma, phi, _, omega, _ = q
    c, s = np.cos(gamma), np.sin(gamma)
    reach = a.B + np.array([a.SD * c + a.SC * s, a.SD * s - a.SC * c]) - a.C
    length = float(np.hypot(*reach))
    pull = -a.STIFFNESS * (length - a.NATURAL_LENGTH) / length * reach
    turn = np.array([a.SC * c - a.SD * s, a.SD * c + a.SC * s])
    crank = a.MASS[1] * a.DA * a.RR * np.sin(theta)
    knee4 = a.MASS[3] * a.ZT * (a.E - a.EA) * np.cos(phi)
    knee6 = a.MASS[5] * a.U * (a.ZF - a.FA) * np.cos(omega)
    return np.array([
        a.TORQUE - crank * v[1] * (v[1] + 2.0 * v[0]), crank * v[0] ** 2, pull @ turn, knee4 * v[4] ** 2,
        -knee4 * v[3] * (v[3] + 2.0 * v[4]), -knee6 * v[6] ** 2, knee6 * v[5] * (v[5] + 2.0 * v[6]),
    ])  # fmt: skip


# Each loop: the pin's place by both ways, as sums of length * (cos, sin) of sums of angles (plus a quarter
# turn).
QUARTER = 0.5 * np.pi
_CRANK = [(a.RR, (0,), 0.0), (-a.D, (0, 1), 0.0)]
_LOOPS = (
    [*_CRANK, (-a.SS, (2,), -QUARTER)], [*_CRANK, (-a.ZT, (4,), 0.0), (-a.E, (3, 4), -QUARTER)],
    [*_CRANK, (-a.U, (6,), -QUARTER), (-a.ZF, (5, 6), 0.0)]
)  # fmt: skip


def rows(q: Array, v: Array) -> tuple[Array, Array]:
    """G (6, 7) and (G q')' q' (6)."""
    jacobian, rate = np.zeros((6, 7)), np.zeros(6)
    for k, loop in enumerate(_LOOPS):
        for length, turned, offset in loop:
            angle, spin = sum(q[i] for i in turned) + offset, sum(v[i] for i in turned)
            across = length * np.array([-np.sin(angle), np.cos(angle)])
            for i in turned:
                jacobian[2 * k : 2 * k + 2, i] += across
            rate[2 * k : 2 * k + 2] -= length * spin**2 * np.array([np.cos(angle), np.sin(angle)])
    return jacobian, rate


def acceleration(q: Array, v: Array) -> Array:
    jacobian, rate = rows(q, v)
    system = np.block([[mass(q), jacobian.T], [jacobian, np.zeros((6, 6))]])
    return np.asarray(np.linalg.solve(system, np.concatenate([force(q, v), -rate]))[:7])


def solution(times: ArrayLike) -> Array:
    """Angles (k, 7), DOP853 at 1e-12."""
    start = np.concatenate([a.START, np.zeros(7)])
    return integrate(lambda _, s: np.concatenate([s[7:], acceleration(s[:7], s[7:])]), start, times)[:, :7]
