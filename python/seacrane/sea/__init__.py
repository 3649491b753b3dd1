"""Seas: spectra, spreading, measured records, several wave systems, and the waves they are realised into."""

from __future__ import annotations

from seacrane._core import (
    ExactWaveLoad,
    RepeatPeriod,
    Spectrum,
    WaveComponents,
    WaveKinematics,
    WaveTable,
    dnv_gamma,
    ochi_hubble,
    philox_uniform,
    pierson_moskowitz,
    realise_waves,
    torsethaugen,
)
from seacrane.sea.measured import MeasuredWaves
from seacrane.sea.spectra import (
    SteepSeaWarning,
    bretschneider,
    jonswap,
    steepness_limit,
    tabulated_spectrum,
)
from seacrane.sea.spreading import Spreading, cos_2s, cos_n
from seacrane.sea.systems import RealisedSea, RealisedSystem, SeaState, WaveSystem

__all__ = [
    "ExactWaveLoad",
    "MeasuredWaves",
    "RealisedSea",
    "RealisedSystem",
    "RepeatPeriod",
    "SeaState",
    "Spectrum",
    "Spreading",
    "SteepSeaWarning",
    "WaveComponents",
    "WaveKinematics",
    "WaveSystem",
    "WaveTable",
    "bretschneider",
    "cos_2s",
    "cos_n",
    "dnv_gamma",
    "jonswap",
    "ochi_hubble",
    "philox_uniform",
    "pierson_moskowitz",
    "realise_waves",
    "steepness_limit",
    "tabulated_spectrum",
    "torsethaugen",
]
