"""The sea's core from Python: spectrum, realisation and load written again; its own tests do the rest."""

from __future__ import annotations

import itertools
from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from seacrane import _core

G = 9.80665
DIRECTION = np.deg2rad(135.0)


def paper_sea(seed: int = 1) -> _core.WaveComponents:
    return _core.realise_waves(_core.jonswap(hs=2.0, tp=8.0), seed=seed, direction=DIRECTION)


def random_transfer(count: int) -> NDArray[np.complex128]:
    rng = np.random.default_rng(3)
    size = np.array([1e7, 1e7, 1e7, 1e8, 1e8, 1e8])
    return size * (rng.normal(size=(count, 6)) + 1j * rng.normal(size=(count, 6)))


def jonswap_by_formula(omega: float, hs: float, tp: float, gamma: float) -> float:
    """Unnormalised JONSWAP, written again from its definition."""
    peak = 2.0 * np.pi / tp
    sigma = 0.07 if omega <= peak else 0.09
    enhancement = gamma ** np.exp(-((omega - peak) ** 2) / (2.0 * sigma**2 * peak**2))
    return float(omega**-5 * np.exp(-1.25 * (peak / omega) ** 4) * enhancement)


@pytest.mark.parametrize(("hs", "tp", "gamma"), [(2.0, 8.0, 3.3), (5.0, 12.0, 1.0)])
def test_density_and_moments_against_scipy(hs: float, tp: float, gamma: float) -> None:
    spectrum = _core.jonswap(hs=hs, tp=tp, gamma=gamma)
    peak = 2.0 * np.pi / tp
    cuts = [0.05 * peak, 0.3 * peak, 0.8 * peak, peak, 1.3 * peak, 3.0 * peak, np.inf]
    by_formula = partial(jonswap_by_formula, hs=hs, tp=tp, gamma=gamma)
    moments = {
        order: sum(
            quad(lambda w: w**order * by_formula(w), a, b, epsabs=0.0, epsrel=1e-12)[0]  # noqa: B023
            for a, b in itertools.pairwise(cuts)
        )
        for order in (-1, 0, 1, 2)
    }
    scale = hs**2 / 16.0 / moments[0]
    for order, moment in moments.items():
        assert spectrum.moment(order) == pytest.approx(scale * moment, rel=1e-10)
    omega = np.linspace(0.2, 4.0, 77)
    expected = [scale * by_formula(w) for w in omega]
    np.testing.assert_allclose(spectrum.density(omega), expected, rtol=1e-10)


@pytest.mark.parametrize("placement", ["jittered", "uniform"])
def test_bins_make_the_waves_of_any_seed(placement: str) -> None:
    spectrum, given = _core.jonswap(hs=2.0, tp=8.0), {"count": 40, "placement": placement}
    bins = _core.WaveBins(spectrum, **given)
    for seed in (3, 4):
        known = {"seed": seed, "direction": 0.5, "system": 2, "depth": 30.0}
        made, alone = bins.realise(**known), _core.realise_waves(spectrum, **known, **given)
        for name in ("omega", "amplitude", "phase", "direction", "wavenumber"):
            assert np.array_equal(getattr(made, name), getattr(alone, name))


def test_realisation_is_what_its_specification_says() -> None:
    spectrum = _core.jonswap(hs=2.0, tp=8.0)
    waves = paper_sea(seed=77)
    edges = np.linspace(0.3, 2.5, 201)
    jitter = [_core.philox_uniform(seed=77, stream=0, index=i) for i in range(200)]
    phase = [2.0 * np.pi * _core.philox_uniform(seed=77, stream=1, index=i) for i in range(200)]
    # The second derivative jumps at the peak: a break point for the bin that holds it.
    cuts = np.clip(spectrum.peak_omega, edges[:-1], edges[1:])

    def integral(a: float, b: float) -> float:
        return float(quad(spectrum.density, a, b, epsabs=0.0, epsrel=1e-12)[0])

    energy = [integral(a, c) + integral(c, b) for a, c, b in zip(edges[:-1], cuts, edges[1:], strict=True)]
    np.testing.assert_allclose(waves.omega, edges[:-1] + np.multiply(jitter, np.diff(edges)), rtol=1e-14)
    np.testing.assert_allclose(waves.phase, phase, rtol=1e-15)
    np.testing.assert_allclose(waves.amplitude, np.sqrt(2.0 * np.array(energy)), rtol=1e-11)
    np.testing.assert_allclose(waves.wavenumber, waves.omega**2 / G, rtol=1e-15)
    assert np.all(waves.direction == DIRECTION)
    assert waves.realised_hs == pytest.approx(4.0 * np.sqrt(np.sum(waves.amplitude**2) / 2.0), rel=1e-14)
    assert waves.realised_hs == pytest.approx(2.0, rel=0.01)
    repeat = waves.repeat_period()
    assert (repeat.found, repeat.time) == (False, 10800.0)
    amplitude = waves.amplitude
    copy = amplitude.copy()
    with pytest.raises(ValueError, match="read-only"):
        amplitude[0] = 1.0
    del waves
    np.testing.assert_array_equal(amplitude, copy)


def test_exact_load_against_numpy() -> None:
    waves = paper_sea()
    transfer = random_transfer(len(waves))
    position, point = (3.0, -11.0), (20.0, 5.0)
    load = _core.ExactWaveLoad(waves, transfer=transfer, position=position, elevation_point=point)
    times = np.array([0.0, 0.013, 7.7, 50.0, 100.0])

    def phasors(x: float, y: float) -> NDArray[np.complex128]:
        travel = waves.wavenumber * (x * np.cos(waves.direction) + y * np.sin(waves.direction))
        out: NDArray[np.complex128] = waves.amplitude * np.exp(1j * (waves.phase - travel))
        return out

    turning = np.exp(1j * np.multiply.outer(times, waves.omega))
    scale = np.sum(waves.amplitude[:, None] * np.abs(transfer), axis=0)
    for order in range(3):
        factor = (1j * waves.omega) ** order
        expected = ((turning * phasors(*position) * factor) @ transfer).real
        error = np.abs(load.evaluate(times, derivative=order) - expected)
        assert np.all(error <= 1e-12 * scale * 2.5**order)
    elevation = (turning @ phasors(*point)).real
    np.testing.assert_allclose(load.elevation(times), elevation, atol=1e-12)
    np.testing.assert_allclose(waves.elevation(times, x=20.0, y=5.0), elevation, atol=1e-12)
    np.testing.assert_allclose(load.magnitude(), scale, rtol=1e-13)
    assert load.evaluate(times.reshape(5, 1)).shape == (5, 1, 6)
    assert load.evaluate(2.0).shape == (6,)
    table = _core.WaveTable(load, relative_bound=1e-7)
    times = np.random.default_rng(1).uniform(-50.0, 150.0, 20000)
    error = np.abs(table.evaluate(times) - load.evaluate(times)).max(axis=0)
    assert np.all(table.error_bound <= 1e-7 * load.magnitude() * (1.0 + 1e-12))
    assert np.all(error <= table.error_bound + 1e-13 * load.magnitude())
    assert np.all(error >= 0.01 * table.error_bound)
