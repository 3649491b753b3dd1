"""Knots of a whole period of the sea by FFT: one transform per channel in place of a sum per knot."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.wave_grid import grid_of
from seacrane.description.waves import HullLoads, Waves

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def wave_table(waves: Waves, hull: HullLoads, load: _core.ExactWaveLoad) -> _core.WaveTable:
    """The first-order load's table over one period, within `waves.relative_bound`."""
    step, number = grid_of(np.asarray(waves.omega, dtype=float))
    count = _knot_count(step, number, _core.WaveTable.largest_step(load, relative_bound=waves.relative_bound))
    transfer = np.asarray(hull.transfer, dtype=complex)
    weight = np.column_stack([transfer, np.ones(len(number))]) * _phasors(hull, load)[:, None]
    knots = np.empty((count, 3, 7))
    for order in range(3):
        spectrum = np.zeros((count // 2 + 1, 7), dtype=complex)
        factor = (1j * step * number[:, None]) ** order
        np.add.at(spectrum, number, 0.5 * count * factor * weight)
        knots[:, order] = np.fft.irfft(spectrum, n=count, axis=0)
    return _core.WaveTable(load, relative_bound=waves.relative_bound, period=2.0 * np.pi / step, knots=knots)


def drift_table(waves: Waves, hull: HullLoads, load: _core.DriftLoad) -> _core.DriftTable:
    """The slow drift's table over one period: products of its envelopes' series and their derivatives."""
    step, number = grid_of(np.asarray(waves.omega, dtype=float))
    count = _knot_count(
        step, number, _core.DriftTable.largest_step(load, relative_bound=waves.relative_bound)
    )
    coefficient = np.asarray(hull.drift, dtype=float)
    weight = np.column_stack([coefficient, np.ones(len(number))]) * _phasors(hull, load)[:, None]
    series = []
    for order in range(3):
        spectrum = np.zeros((count, 7), dtype=complex)
        np.add.at(spectrum, number, count * (1j * step * number[:, None]) ** order * weight)
        series.append(np.fft.ifft(spectrum, axis=0))

    def product(a: int, b: int) -> Array:
        return np.asarray((series[a][:, 6:].conj() * series[b][:, :6]).real)

    knots = np.stack(
        [product(0, 0), product(1, 0) + product(0, 1), product(2, 0) + 2.0 * product(1, 1) + product(0, 2)],
        axis=1,
    )
    return _core.DriftTable(load, relative_bound=waves.relative_bound, period=2.0 * np.pi / step, knots=knots)


def _phasors(hull: HullLoads, load: _core.ExactWaveLoad | _core.DriftLoad) -> Complex:
    """a exp(i phase) where the loads are taken, shape (n,)."""
    sea, (x, y) = load.waves, hull.position
    along = x * np.cos(sea.direction) + y * np.sin(sea.direction)
    return np.asarray(sea.amplitude * np.exp(1j * (sea.phase - sea.wavenumber * along)))


def _knot_count(step: float, number: NDArray[np.int64], widest: float) -> int:
    """Knots of one period: enough for the bound and to tell all frequencies apart, of a fast length."""
    from scipy.fft import next_fast_len

    period = 2.0 * np.pi / step
    return int(next_fast_len(max(int(np.ceil(period / widest)), 2 * int(number.max()) + 2), real=True))
