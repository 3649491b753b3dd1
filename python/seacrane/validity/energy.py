"""Runs whose energy balance does not close by far: what was computed is no motion of the scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.warnings import EnergyErrorWarning

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
Finding = tuple[type[Warning], str]
LARGEST_SHARE = 0.1  # of the work, or of the kinetic energy
LEAST_RISE = 1e-3  # m times the length scale, by which all bodies are lifted: what does not matter


def energy_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> list[Finding]:
    """The findings of a run; channels left out are not judged."""
    if not {"energy_balance", "absolute_work", "velocity"} <= channels.keys() or not time.size:
        return []
    mass = np.array([body.mass for body in scene.bodies.values()])
    with np.errstate(over="ignore", invalid="ignore"):
        kinetic = 0.5 * np.einsum("k,nki,nki->n", mass, channels["velocity"], channels["velocity"])
        work = np.asarray(channels["absolute_work"])
        error = np.abs(np.asarray(channels["energy_balance"]))
        least = LEAST_RISE * scene.length_scale * scene.gravity * float(mass.sum())
        size = max(float(work.max()), float(kinetic.max()), least)
        off = np.flatnonzero(error > LARGEST_SHARE * size)
    if not off.size or size == 0.0:
        return []
    worst = float(error.max())
    return [
        (
            EnergyErrorWarning,
            f"run: energy_balance reaches {worst:.3g} J, {worst / size:.2g} of work and kinetic energy, "
            f"from t = {time[off[0]]:.6g} s on: this is not the scene's motion. Give a shorter dt, a tighter "
            "rtol or an adaptive integrator; where it stays, a load tells a power that is not its force's",
        )
    ]
