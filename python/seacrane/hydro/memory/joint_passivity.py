"""The fitted damping matrix of all blocks together, which no pair's own fit keeps positive."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro.data.memory_model import RADIATION, MemoryBlock, Passivity

FloatArray = NDArray[np.float64]


def joint_passivity(blocks: list[MemoryBlock], damping: FloatArray, band: tuple[float, float]) -> Passivity:
    """Smallest scaled eigenvalue of the radiation blocks' damping, 1e-3 to 1e3 rad/s, and over ``band``."""
    radiation = [block for block in blocks if block.cause == RADIATION]

    def smallest(omega: FloatArray) -> tuple[float, float]:
        total = np.zeros((len(omega), *damping.shape[1:]))
        for block in radiation:
            total[:, block.outputs[:, None], block.inputs] += block.transfer(omega).real
        lowest = scaled_damping(total, damping)
        where = int(lowest.argmin())
        return float(lowest[where]), float(omega[where])

    minimum, at = smallest(np.geomspace(1e-3, 1e3, 4001))
    in_band, in_band_at = smallest(np.linspace(*band, 1001))
    return Passivity(minimum=minimum, omega=at, in_band=in_band, in_band_omega=in_band_at)


def scaled_damping(damping: FloatArray, data: FloatArray) -> FloatArray:
    """Smallest eigenvalues (n,) of ``damping`` (n, m, m), scaled by the largest diagonals of ``data``."""
    peak = np.sqrt(np.maximum(np.diagonal(data, axis1=1, axis2=2).max(axis=0), 1e-300))
    active = peak > 1e-6 * peak.max()
    scaled = (0.5 * (damping + damping.swapaxes(1, 2)) / np.outer(peak, peak))[:, active][:, :, active]
    return np.asarray(np.linalg.eigvalsh(scaled)[:, 0])
