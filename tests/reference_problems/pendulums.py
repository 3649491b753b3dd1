"""The simple pendulum by elliptic functions, and two rods that turn over.

Simple pendulum: IFToMM Library of Computational Benchmark Problems, A01: 1 kg on 1 m, let go from the
horizontal, g = 9.81 m/s2.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipj, ellipk

from seacrane import Scene
from seacrane.arrays import Array

from .planar import add_body, add_pin

GRAVITY = 9.81


def scene() -> Scene:
    out, rod = Scene(name="pendulum", gravity=GRAVITY), {"point": (0, 0, 0), "second_point": (-1.0, 0.0, 0.0)}
    out.add_body(name="bob", mass=1.0, inertia=[0.1] * 3, position=(-1.0, 0.0, 0.0))
    out.add_joint(kind="distance", name="rod", first="ground", second="bob", **rod)
    return out


def place(times: ArrayLike) -> Array:
    """Place (x, z) of the mass (k, 2): sin(b / 2) = k sn(K - w t), k = sin(45 deg), w^2 = g / L."""
    sn, _, _, _ = ellipj(ellipk(0.5) - np.sqrt(GRAVITY) * np.asarray(times, dtype=float), 0.5)
    angle = -2.0 * np.arcsin(np.sqrt(0.5) * sn)  # from hanging, towards +x positive
    return np.column_stack([np.sin(angle), -np.cos(angle)])


def double_scene() -> Scene:
    """Rods of 1 m and 1 kg, let go 2.0 and 2.5 rad from hanging."""
    out, rod = Scene(name="double pendulum", gravity=GRAVITY), {"mass": 1.0, "inertia": 1.0 / 12.0}
    elbow = np.array([np.sin(2.0), -np.cos(2.0)])
    for i, (foot, angle) in enumerate(((np.zeros(2), 2.0), (elbow, 2.5))):
        turned = angle - 0.5 * np.pi
        add_body(out, "xz", f"link {i}", origin=foot, angle=turned, center=(0.5, 0.0), **rod)
    add_pin(out, "xz", "top", "ground", "link 0", (0.0, 0.0))
    add_pin(out, "xz", "elbow", "link 0", "link 1", elbow)
    return out
