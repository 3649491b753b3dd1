"""Spectra, realised seas and wave loads of the compiled core."""

from __future__ import annotations

from seacrane._core import (
    ExactWaveLoad,
    Spectrum,
    WaveComponents,
    WaveTable,
    jonswap,
    philox_uniform,
    pierson_moskowitz,
    realise_waves,
)

__all__ = [
    "ExactWaveLoad",
    "Spectrum",
    "WaveComponents",
    "WaveTable",
    "jonswap",
    "philox_uniform",
    "pierson_moskowitz",
    "realise_waves",
]
