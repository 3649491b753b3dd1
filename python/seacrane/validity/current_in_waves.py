"""Waves that meet a current: what the loads on a vessel leave out of both together."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.waves import Waves
from seacrane.validity.energy import Finding
from seacrane.validity.hull_range import LARGEST_SHIFT, peak_of
from seacrane.warnings import CurrentInWavesWarning

Array = NDArray[np.float64]
LIGHTEST_WATER = 500.0  # kg/m3: a denser medium is water


def current_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> list[Finding]:
    """Currents on vessels in waves, where k U along the waves is a tenth of the frequency or more."""
    waves = scene.waves
    if waves is None or not time.size:
        return []
    found: list[Finding] = []
    for name, load in scene.loads.items():
        in_water = isinstance(load, _core.FlowForce) and load.density > LIGHTEST_WATER
        if not in_water or load.body not in waves.hulls:
            continue
        speed = float(np.abs(load.speed.evaluate(time)[:, 0]).max())
        flow = speed * np.array([[np.cos(load.direction), np.sin(load.direction)]])
        peak = peak_of(scene)
        shift = float(peak.phase(flow)[0]) / peak.omega
        if shift > LARGEST_SHIFT:
            found.append((CurrentInWavesWarning, _told(name, load.body, speed, shift, waves)))
    return found


def _told(name: str, body: str, speed: float, shift: float, waves: Waves) -> str:
    lengths = (
        "with the wave lengths of still water, which are off by about twice that share; wave loads"
        if waves.current is None
        else "with its wave lengths on the current; wave loads"
    )
    return (
        f"current {name!r}: {speed:.3g} m/s on vessel {body!r} shift the frequency of waves at the peak by "
        f"{shift:.0%} between the water and a fixed place. The sea is taken as a fixed observer sees it, "
        f"{lengths}, added mass and damping are those without flow. Give the spectrum as measured at a fixed "
        "place, and take motions in this current as an estimate"
    )
