"""Records and tables that no ship has, with a value in another unit or of another sign."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from seacrane import MotionHistory, MotionRaos


def record(heave: float, noise: float = 0.0, roll: float = 0.0) -> MotionHistory:
    time, motion = np.linspace(0.0, 60.0, 601), np.zeros((601, 6))
    motion[:, 2] = heave * np.sin(0.7 * time) + noise * np.random.default_rng(0).normal(size=601)
    motion[:, 3] = roll * np.sin(0.7 * time)
    return MotionHistory(time=time, motion=motion)


def raos(turned: Callable[[Any], Any]) -> MotionRaos:
    """Of a hull that follows long waves, with its phases as a table would hold them."""
    omega, heading = np.array([0.3, 0.6, 1.0]), np.array([0.0, np.pi / 2, np.pi])
    values = np.zeros((3, 3, 6), dtype=complex)
    values[:, :, 2] = np.exp(-1j * np.radians(3.0))
    values[:, :, 4] = 1j * omega**2 / 9.81 * np.cos(heading)[:, None]
    return MotionRaos(omega=omega, heading=heading, values=turned(values))
