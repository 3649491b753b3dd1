"""Andrews' squeezer: seven bodies in three planar loops, driven by a constant torque from rest.

Data, notation and solution: Test Set for IVP Solvers (Mazzia and Magherini, University of Bari, 2008),
problem "Andrews' squeezing mechanism", after Schiehlen (ed.), Multibody Systems Handbook (1990) and Hairer
and Wanner, Solving Ordinary Differential Equations II, section VI.9. There is no weight. Seven angles: beta,
Theta, gamma, Phi, delta, Omega, epsilon.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from reference.classic import integrate

from seacrane import Scene
from seacrane.arrays import Array

from .planar import add_body, add_pin, angles

START = np.array([
    -0.0617138900142764496358948458001, 0.0, 0.455279819163070380255912382449,
    0.222668390165885884674473185609, 0.487364979543842550225598953530, -0.222668390165885884674473185609,
    1.23054744454982119249735015568,
])  # fmt: skip
END_TIME = 0.03
END = np.array([
    0.1581077119629904e2, -0.1575637105984298e2, 0.4082224013073101e-1, -0.5347301163226948,
    0.5244099658805304, 0.5347301163226948, 0.1048080741042263e1,
])  # fmt: skip
A, B, C = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273]), np.array([0.014, 0.072])
MASS = (0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498)
INERTIA = (2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5)
RR, RA, D, DA, SS, SA, SB, SC, SD = 0.007, 0.00092, 0.028, 0.0115, 0.035, 0.01874, 0.01043, 0.018, 0.02
E, EA, ZT, TA, TB = 0.02, 0.01421, 0.04, 0.02308, 0.00916
ZF, FA, U, UA, UB = 0.02, 0.01421, 0.04, 0.01228, 0.00449
STIFFNESS, NATURAL_LENGTH, TORQUE = 4530.0, 0.07785, 0.033


def along(angle: float) -> Array:
    return np.array([np.cos(angle), np.sin(angle)])


def scene(*, planar: bool = False) -> Scene:
    """Hinges throughout (`planar`, nine rows too many), or joints that hold each motion once."""
    beta, theta, gamma, phi, delta, omega, epsilon = START
    absolute = (beta, beta + theta, gamma, phi + delta, delta, omega + epsilon, epsilon)
    pin = RR * along(beta)
    middle = pin - D * along(beta + theta)
    elbow, knee = A + ZT * along(delta), A + U * along(epsilon - 0.5 * np.pi)
    # Where each body's origin is, and its centre in body axes. K3, K5 and K7 turn about fixed points: only
    # the distance of their centres from there matters.
    origins = (np.zeros(2), pin, B, elbow, A, knee, A)
    centers = ((RA, 0), (-DA, 0), (SA, SB), (0, -(E - EA)), (TA, TB), (ZF - FA, 0), (UA, UB))
    out = Scene(name="Andrews' squeezer", gravity=0.0)
    for i in range(7):
        place = {"origin": origins[i], "angle": absolute[i], "center": centers[i]}
        add_body(out, "xy", f"K{i + 1}", mass=MASS[i], inertia=INERTIA[i], **place)
    closing, sliding = ("revolute", "revolute") if planar else ("spherical", "cylindrical")
    pins: list[tuple[str, str, str, Any, str]] = [
        ("O", "ground", "K1", np.zeros(2), "revolute"), ("F", "K1", "K2", pin, "revolute"),
        ("E3", "K2", "K3", middle, closing), ("E4", "K2", "K4", middle, closing),
        ("E6", "K2", "K6", middle, closing), ("H", "K5", "K4", elbow, "revolute"),
        ("G", "K7", "K6", knee, "revolute"), ("B", "ground", "K3", B, sliding),
        ("A5", "ground", "K5", A, sliding), ("A7", "ground", "K7", A, sliding)
    ]  # fmt: skip
    for name, first, second, point, kind in pins:
        add_pin(out, "xy", name, first, second, point, kind=kind)
    out.add_spring(
        name="spring", first="ground", second="K3", first_point=(*C, 0.0), second_point=(SD, -SC, 0.0),
        stiffness=STIFFNESS, natural_length=NATURAL_LENGTH,
    )  # fmt: skip
    out.add_actuator(name="motor", joint="O", feed_forward=TORQUE)
    return out


def problem_angles(quaternions: Array) -> Array:
    """beta ... epsilon (k, 7) from the quaternions of a run (k, 7, 4) with outputs close enough to unwrap."""
    k1, k2, k3, k4, k5, k6, k7 = np.moveaxis(angles("xy", quaternions), -1, 0)
    return np.stack([k1, k2 - k1, k3, k4 - k5, k5, k6 - k7, k7], axis=-1)


# The test set's equations in the seven angles: M(q) q'' + G(q)^T lambda = f(q, q'), G(q) q'' = -(G q')' q'.
# Over 0.03 s the drift of the integrated accelerations is below the rounding of the published solution.


def mass(q: Array) -> Array:
    _, theta, _, phi, _, omega, _ = q
    m, i = MASS, INERTIA
    out = np.zeros((7, 7))
    c2, s4, s6 = np.cos(theta), np.sin(phi), np.sin(omega)
    arm4, arm6 = E - EA, ZF - FA
    out[0, 0] = m[0] * RA**2 + m[1] * (RR**2 - 2.0 * DA * RR * c2 + DA**2) + i[0] + i[1]
    out[0, 1] = m[1] * (DA**2 - DA * RR * c2) + i[1]
    out[1, 1] = m[1] * DA**2 + i[1]
    out[2, 2] = m[2] * (SA**2 + SB**2) + i[2]
    out[3, 3] = m[3] * arm4**2 + i[3]
    out[3, 4] = m[3] * (arm4**2 + ZT * arm4 * s4) + i[3]
    out[4, 4] = m[3] * (ZT**2 + 2.0 * ZT * arm4 * s4 + arm4**2) + m[4] * (TA**2 + TB**2) + i[3] + i[4]
    out[5, 5] = m[5] * arm6**2 + i[5]
    out[5, 6] = m[5] * (arm6**2 - U * arm6 * s6) + i[5]
    out[6, 6] = m[5] * (arm6**2 - 2.0 * U * arm6 * s6 + U**2) + m[6] * (UA**2 + UB**2) + i[5] + i[6]
    return out + np.triu(out, 1).T


def force(q: Array, v: Array) -> Array:
    _, theta, gamma, phi, _, omega, _ = q
    c, s = np.cos(gamma), np.sin(gamma)
    reach = B + np.array([SD * c + SC * s, SD * s - SC * c]) - C
    length = float(np.hypot(*reach))
    pull = -STIFFNESS * (length - NATURAL_LENGTH) / length * reach
    turn = np.array([SC * c - SD * s, SD * c + SC * s])
    crank = MASS[1] * DA * RR * np.sin(theta)
    knee4 = MASS[3] * ZT * (E - EA) * np.cos(phi)
    knee6 = MASS[5] * U * (ZF - FA) * np.cos(omega)
    return np.array([
        TORQUE - crank * v[1] * (v[1] + 2.0 * v[0]), crank * v[0] ** 2, pull @ turn, knee4 * v[4] ** 2,
        -knee4 * v[3] * (v[3] + 2.0 * v[4]), -knee6 * v[6] ** 2, knee6 * v[5] * (v[5] + 2.0 * v[6]),
    ])  # fmt: skip


# Each loop: the pin's place by both ways, as sums of length * (cos, sin) of sums of angles (plus a quarter
# turn).
QUARTER = 0.5 * np.pi
_CRANK = [(RR, (0,), 0.0), (-D, (0, 1), 0.0)]
_LOOPS = (
    [*_CRANK, (-SS, (2,), -QUARTER)], [*_CRANK, (-ZT, (4,), 0.0), (-E, (3, 4), -QUARTER)],
    [*_CRANK, (-U, (6,), -QUARTER), (-ZF, (5, 6), 0.0)]
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
    start = np.concatenate([START, np.zeros(7)])
    return integrate(lambda _, s: np.concatenate([s[7:], acceleration(s[:7], s[7:])]), start, times)[:, :7]
