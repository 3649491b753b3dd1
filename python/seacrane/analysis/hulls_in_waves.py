"""What waves do to the vessel of a linear model, and to those that feel its motions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linear_system import LinearModel
from seacrane.description.databases import database_of
from seacrane.description.given import group_of
from seacrane.inputs.frames import heading_of

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def rates_in_waves(linear: LinearModel, database: HydroDatabase, omega: Array, direction: Array) -> Complex:
    """Rates of x (k, n) per metre of waves of frequencies (k,), rad/s, directions (k,) from the vessel's x.

    On the vessel and, where it is in a group, on all of that: the wave meets each at its place and heading at
    the start, and has zero phase at the vessel's.
    """
    assert linear.vessel is not None
    rates: Complex = database.force_at(omega, direction).reshape(-1, 6) @ linear.b.T
    scene, group = linear.scene, group_of(linear.scene, linear.vessel)
    here = scene.bodies[linear.vessel]
    travels = direction + heading_of(here.quaternion)
    for name in () if group is None else group.vessels:
        body = scene.vessels[name].body
        if body == linear.vessel:
            continue
        own, there = database_of(scene, body, "a motion in waves"), scene.bodies[body]
        east, north = np.asarray(there.position)[:2] - np.asarray(here.position)[:2]
        along = east * np.cos(travels) + north * np.sin(travels)
        waves = _core.WaveComponents(
            omega=omega, amplitude=np.ones(omega.size), phase=np.zeros(omega.size), direction=travels,
            depth=own.depth,
        )  # fmt: skip
        phase = np.exp(-1j * np.array(waves.wavenumber) * along)
        force = own.force_at(omega, travels - heading_of(there.quaternion)).reshape(-1, 6)
        rates = rates + (phase[:, None] * force) @ linear.excited(body).b.T
    return rates
