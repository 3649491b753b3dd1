"""The sea of a scene as the page sums it: the components that load its vessels, largest first."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import Description
from seacrane.description.wet_parts import wet_bodies

Array = NDArray[np.float64]


def sea_components(scene: Description) -> Array:
    """Amplitude (m), frequency (rad/s), phase (rad), wavenumber along x and along y (rad/m): (n, 5).

    Elevation = sum a cos(w t + phase - kx x - ky y) in the inertial frame; largest amplitude first.
    """
    if scene.waves is None:
        return np.zeros((0, 5))
    waves = scene.waves.components()
    k, b = np.asarray(waves.wavenumber), np.asarray(waves.direction)
    phase = np.remainder(np.asarray(waves.phase), 2.0 * np.pi)
    table = np.column_stack([waves.amplitude, waves.omega, phase, k * np.cos(b), k * np.sin(b)])
    return np.asarray(table[np.argsort(-np.asarray(waves.amplitude), kind="stable")])


def without_sea(scene: Description) -> bool:
    """Whether there is no water to draw."""
    return scene.waves is None and not scene.vessels and not wet_bodies(scene)


def sea_words(scene: Description) -> str:
    """The sea in words, for the caption."""
    if scene.waves is None:
        return "" if without_sea(scene) else "calm water"
    known = scene.waves.provenance
    parts = [f"{np.size(scene.waves.omega)} wave components"]
    parts += [text for value, text in _settings(known) if value is not None]
    return ", ".join(parts)


def _settings(known: Any) -> list[tuple[Any, str]]:
    return [
        (known.realised_hs, f"Hs {known.realised_hs or 0:.2f} m realised"),
        (known.tp, f"Tp {known.tp or 0:g} s"),
        (known.wave_direction_deg, f"towards {known.wave_direction_deg or 0:g} deg from x to y"),
    ]
