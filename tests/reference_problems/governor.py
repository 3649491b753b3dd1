"""The stiff flyball governor: rods hinged to a turning shaft, held to a slider by stiff springs and dampers.

Data: IFToMM Library of Computational Benchmark Problems, A05 (Gonzalez et al., Multibody System Dynamics 16,
2006): prisms, balls of 5 kg at the rods' ends, springs from the slider to the rods' middles. Solution:
Lagrange's equations in the angle of both rods and the slider's place, by SciPy.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from seacrane import Scene
from seacrane.arrays import Array

GRAVITY, DENSITY, BALL = 9.81, 3000.0, 5.0
LENGTH, WIDTH, BLOCK, OFFSET = 1.0, 0.01, 0.1, 0.05  # rods and shaft, slider, hinges and springs off the axis
STIFFNESS, DAMPING, NATURAL_LENGTH = 8.0e5, 4.0e4, 0.5
HANGING, SLIDER, SPIN = np.pi / 6.0, 0.5, 2.0 * np.pi  # rods below level, slider's height, at the start
ROD = DENSITY * LENGTH * WIDTH**2
RAISED = ROD + BALL
CENTER = (0.5 * ROD + BALL) * LENGTH / RAISED  # from the hinge, along the rod
AXIAL = ROD * WIDTH**2 / 6.0
SLIM = ROD * (LENGTH**2 + WIDTH**2) / 12.0
ACROSS = SLIM + ROD * (CENTER - 0.5 * LENGTH) ** 2 + BALL * (LENGTH - CENTER) ** 2
SLIDING = DENSITY * BLOCK**3
TURNING = AXIAL + SLIDING * BLOCK**2 / 6.0  # shaft and slider


def scene() -> Scene:
    out = Scene(name="flyball governor", gravity=GRAVITY)
    spin = (0.0, 0.0, SPIN)
    for name, mass, inertia, height in (
        ("shaft", ROD, (SLIM, SLIM, AXIAL), 0.5 * LENGTH),
        ("slider", SLIDING, [SLIDING * BLOCK**2 / 6.0] * 3, SLIDER),
    ):
        out.add_body(name, mass=mass, inertia=inertia, position=(0, 0, height), angular_velocity=spin)
    out.add_joint("bearing", kind="revolute", first="ground", second="shaft", point=(0, 0, 0), axis=(0, 0, 1))
    out.add_joint(kind="prismatic", name="sleeve", first="shaft", second="slider", axis=(0, 0, 1))
    for name, side in (("right", 1.0), ("left", -1.0)):
        hinge = np.array([side * OFFSET, 0.0, LENGTH])
        # Body x along the rod, away from the hinge.
        half = 0.5 * (HANGING if side > 0.0 else np.pi - HANGING)
        out.add_body(
            name=name, mass=RAISED, inertia=(AXIAL, ACROSS, ACROSS), position=hinge,
            center_of_mass=(CENTER, 0.0, 0.0), quaternion=(np.cos(half), 0.0, np.sin(half), 0.0),
            velocity=np.cross(spin, hinge), angular_velocity=spin,
        )  # fmt: skip
        pin = {"first": "shaft", "second": name, "point": hinge, "axis": (0, 1, 0)}
        out.add_joint(kind="revolute", name=f"{name} hinge", **pin)
        out.add_spring(
            name=f"{name} coupler", first="slider", second=name, first_point=(side * OFFSET, 0.0, 0.0),
            second_point=(0.5 * LENGTH, 0.0, 0.0), stiffness=STIFFNESS, damping=DAMPING,
            natural_length=NATURAL_LENGTH,
        )  # fmt: skip
    return out


def rod_turning(beta: float) -> tuple[float, float]:
    """Inertia of one rod about the shaft's axis with its ball, and its derivative by the rod's angle."""
    c, s = np.cos(beta), np.sin(beta)
    reach = OFFSET + CENTER * c
    value = RAISED * reach**2 + ACROSS * c * c + AXIAL * s * s
    return value, -2.0 * RAISED * reach * CENTER * s - 2.0 * (ACROSS - AXIAL) * c * s


def rate(_: float, y: Array, momentum: float) -> list[float]:
    """d/dt of the rods' angle, the slider's height and the rates of both."""
    beta, height, beta_rate, speed = y
    c, s = np.cos(beta), np.sin(beta)
    turning, slope = rod_turning(beta)
    spin = momentum / (TURNING + 2.0 * turning)
    across, drop = 0.5 * LENGTH * c, LENGTH - 0.5 * LENGTH * s - height
    length = np.hypot(across, drop)
    by_beta, by_height = (-across * s - drop * c) * 0.5 * LENGTH / length, -drop / length
    tension = STIFFNESS * (length - NATURAL_LENGTH) + DAMPING * (by_beta * beta_rate + by_height * speed)
    push = 0.5 * slope * spin**2 + RAISED * GRAVITY * CENTER * c - tension * by_beta
    fall = -GRAVITY - 2.0 * tension * by_height / SLIDING
    return [beta_rate, speed, push / (RAISED * CENTER**2 + ACROSS), fall]


def solution(times: ArrayLike) -> Array:
    """Rods' angle and slider's height (k, 2), Radau at 1e-10."""
    t = np.asarray(times, dtype=float)
    momentum = (TURNING + 2.0 * rod_turning(HANGING)[0]) * SPIN
    start = [HANGING, SLIDER, 0.0, 0.0]
    out = solve_ivp(rate, (0.0, t[-1]), start, "Radau", t, args=(momentum,), rtol=1e-10, atol=1e-11)
    if not out.success:
        raise RuntimeError(out.message)
    return np.asarray(out.y[:2].T)
