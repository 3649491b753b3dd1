"""Andrews' squeezer: seven bodies in three planar loops, driven by a constant torque from rest.

Data, notation and solution: Test Set for IVP Solvers (Mazzia and Magherini, University of Bari, 2008),
problem "Andrews' squeezing mechanism", after Schiehlen (ed.), Multibody Systems Handbook (1990) and Hairer
and Wanner, Solving Ordinary Differential Equations II, section VI.9. There is no weight. Seven angles: beta,
Theta, gamma, Phi, delta, Omega, epsilon.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import Scene

from .planar import add_body, add_pin, angles

Array = NDArray[np.float64]
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
