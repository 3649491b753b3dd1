"""The simple pendulum by elliptic functions; the double pendulum and the growth of its errors.

Simple pendulum: IFToMM Library of Computational Benchmark Problems, A01: 1 kg on 1 m, let go from the
horizontal, g = 9.81 m/s2. Double pendulum: Lagrange's equations by SciPy (`reference.classic`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from reference.classic import Link, double_pendulum

from seacrane import Scene

from .planar import add_body, add_pin

Array = NDArray[np.float64]
GRAVITY = 9.81
LINKS = (Link(1.0, 1.0 / 12.0, 1.0, 0.5), Link(1.0, 1.0 / 12.0, 1.0, 0.5))
ANGLES = np.array([2.0, 2.5])  # from hanging, let go
DOWN = -0.5 * np.pi


def scene(kind: str = "distance") -> Scene:
    """The point mass on a rod ("distance"), or a ball of next to no inertia on a hinge ("revolute")."""
    out = Scene(name="pendulum", gravity=GRAVITY)
    inertia = 0.1 if kind == "distance" else 1e-9
    out.add_body(name="bob", mass=1.0, inertia=[inertia] * 3, position=(-1.0, 0.0, 0.0))
    extra = {"second_point": (-1.0, 0.0, 0.0)} if kind == "distance" else {"axis": (0.0, -1.0, 0.0)}
    out.add_joint(kind=kind, name="rod", first="ground", second="bob", point=(0, 0, 0), **extra)
    return out


def place(times: ArrayLike) -> tuple[Array, Array]:
    """Place and velocity (x, z) of the mass (k, 2): sin(b / 2) = k sn(K - w t), k = sin(45 deg), w^2 = g /
    L."""
    from scipy.special import ellipj, ellipk

    omega, m = np.sqrt(GRAVITY), 0.5
    sn, cn, _, _ = ellipj(ellipk(m) - omega * np.asarray(times, dtype=float), m)
    half = np.sqrt(m) * sn
    angle = -2.0 * np.arcsin(half)  # from hanging, towards +x positive
    rate = 2.0 * np.sqrt(m) * omega * cn  # b' = 2 k w cn, as d sn = cn dn and cos(b / 2) = dn
    position = np.column_stack([np.sin(angle), -np.cos(angle)])
    return position, rate[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])


def double_scene() -> Scene:
    out = Scene(name="double pendulum", gravity=GRAVITY)
    elbow = LINKS[0].length * np.array([np.sin(ANGLES[0]), -np.cos(ANGLES[0])])
    for i, foot in enumerate((np.zeros(2), elbow)):
        link = LINKS[i]
        add_body(
            out, "xz", f"link {i}", mass=link.mass, inertia=link.inertia, origin=foot, angle=DOWN + ANGLES[i],
            center=(link.center, 0.0),
        )  # fmt: skip
    add_pin(out, "xz", "top", "ground", "link 0", (0.0, 0.0))
    add_pin(out, "xz", "elbow", "link 0", "link 1", elbow)
    return out


def double_angles(times: ArrayLike, offset: ArrayLike = (0.0, 0.0)) -> Array:
    """Angles from hanging (k, 2), started `offset` beside ANGLES."""
    return double_pendulum(times, LINKS, ANGLES + np.asarray(offset), np.zeros(2), GRAVITY)[0]


def growth(times: ArrayLike, size: float = 1e-6) -> Array:
    """How much a small error of the start has grown (k): the larger of one in either angle, central
    differences."""
    grown = [
        np.linalg.norm(double_angles(times, offset) - double_angles(times, -offset), axis=1)
        for offset in 0.5 * size * np.eye(2)
    ]
    return np.asarray(np.max(grown, axis=0) / size)
