"""N four-bars in a row: 2N + 1 rods, singular twice a turn, where every loop could fold on its own.

Data: IFToMM Library of Computational Benchmark Problems, A02 (Gonzalez, Dopico, Lugris, Cuadrado, Multibody
System Dynamics 16, 2006): rods of 1 m and 1 kg, upright at the start with 1 m/s at their tops, g = 9.81 m/s2.
There N = 40. While no loop folds, the couplers do not turn and the whole is one pendulum that goes round:
elliptic functions.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipj, ellipk

from seacrane import Scene
from seacrane.arrays import Array

from .planar import add_body, add_pin

GRAVITY, SPEED = 9.81, 1.0


def scene(loops: int, *, planar: bool = True) -> Scene:
    """Hinges throughout (`planar`, three rows too many in each loop), or joints that hold a motion once."""
    out = Scene(name=f"{loops} four-bars", gravity=GRAVITY)
    rod = {"mass": 1.0, "inertia": 1.0 / 12.0, "center": (0.5, 0.0)}
    for i in range(loops + 1):
        add_body(out, "xz", f"post {i}", origin=(i, 0.0), angle=0.5 * np.pi, rate=-SPEED, **rod)
    for i in range(loops):
        add_body(out, "xz", f"coupler {i}", origin=(i, 1.0), angle=0.0, velocity=(SPEED, 0.0), **rod)
    for i in range(loops + 1):
        once = not planar and i > 0
        kind = "cylindrical" if once else "revolute"
        add_pin(out, "xz", f"foot {i}", "ground", f"post {i}", (i, 0.0), kind=kind)
        if i > 0:
            kind = "spherical" if once else "revolute"
            add_pin(out, "xz", f"right {i - 1}", f"coupler {i - 1}", f"post {i}", (i, 1.0), kind=kind)
        if i < loops:
            add_pin(out, "xz", f"left {i}", f"post {i}", f"coupler {i}", (i, 1.0))
    return out


def turned(loops: int, times: ArrayLike) -> tuple[Array, Array]:
    """Angle of the posts from upright, clockwise, and its rate (k), by Jacobi's elliptic functions.

    I a'' = G sin a with I = (N + 1) / 3 + N and G = g ((N + 1) / 2 + N): sin(b / 2) = sn(w t / 2, 4 G / (I
    w^2)) with b the angle from hanging and w its rate there.
    """
    inertia, weight = (loops + 1) / 3.0 + loops, GRAVITY * (0.5 * (loops + 1) + loops)
    fastest = np.sqrt(SPEED**2 + 4.0 * weight / inertia)
    m = 4.0 * weight / (inertia * fastest**2)
    _, _, dn, amplitude = ellipj(0.5 * fastest * np.asarray(times, dtype=float) - ellipk(m), m)
    return 2.0 * amplitude + np.pi, fastest * dn
