"""Seas: spectra, spreading, several wave systems and the waves they are realised into; measured series."""

from seacrane.sea.systems import SeaState as SeaState
from seacrane.sea.systems import WaveSystem as WaveSystem
from seacrane.sea.measured import MeasuredWaves as MeasuredWaves
from seacrane.sea.current import Current as Current
from seacrane.sea.spectra import jonswap as jonswap
from seacrane._core import pierson_moskowitz as pierson_moskowitz
from seacrane.sea.spectra import bretschneider as bretschneider
from seacrane._core import torsethaugen as torsethaugen
from seacrane._core import ochi_hubble as ochi_hubble
from seacrane.sea.spectra import tabulated_spectrum as tabulated_spectrum
from seacrane._core import Spectrum as Spectrum
from seacrane._core import dnv_gamma as dnv_gamma
from seacrane.sea.spectra import steepness_limit as steepness_limit
from seacrane.sea.spreading import Spreading as Spreading
from seacrane.sea.spreading import cos_2s as cos_2s
from seacrane.sea.spreading import cos_n as cos_n
from seacrane._core import realise_waves as realise_waves
from seacrane.sea.systems import RealisedSea as RealisedSea
from seacrane.sea.systems import RealisedSystem as RealisedSystem
from seacrane._core import WaveComponents as WaveComponents
from seacrane._core import WaveKinematics as WaveKinematics
from seacrane._core import RepeatPeriod as RepeatPeriod
from seacrane._core import ExactWaveLoad as ExactWaveLoad
from seacrane._core import WaveTable as WaveTable
from seacrane._core import philox_uniform as philox_uniform
