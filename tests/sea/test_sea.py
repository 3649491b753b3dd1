"""The sea seen from Python: spectra, realisations, wave loads and their table."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad

from seacrane import _core

G = 9.80665
DIRECTION = np.deg2rad(135.0)


def paper_sea(seed: int = 1, **options: object) -> _core.WaveComponents:
    return _core.realise_waves(_core.jonswap(hs=2.0, tp=8.0), seed=seed, direction=DIRECTION, **options)


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


def philox4x32(counter: list[int], key: list[int]) -> list[int]:
    """Philox4x32-10 from the paper, in Python's integers."""
    mask = 0xFFFFFFFF
    c, k = list(counter), list(key)
    for _ in range(10):
        a, b = 0xD2511F53 * c[0], 0xCD9E8D57 * c[2]
        c = [(b >> 32) ^ c[1] ^ k[0], b & mask, (a >> 32) ^ c[3] ^ k[1], a & mask]
        k = [(k[0] + 0x9E3779B9) & mask, (k[1] + 0xBB67AE85) & mask]
    return c


@pytest.mark.parametrize(("hs", "tp", "gamma"), [(2.0, 8.0, 3.3), (5.0, 12.0, 1.0), (1.0, 4.0, 6.0)])
def test_density_and_moments_against_scipy(hs: float, tp: float, gamma: float) -> None:
    spectrum = _core.jonswap(hs=hs, tp=tp, gamma=gamma)
    peak = 2.0 * np.pi / tp
    cuts = [0.3 * peak, 0.8 * peak, peak, 1.3 * peak, 3.0 * peak]

    def moment(order: int) -> float:
        pieces = zip([0.05 * peak, *cuts], [*cuts, np.inf], strict=True)
        return sum(
            quad(lambda w: w**order * jonswap_by_formula(w, hs, tp, gamma), a, b, epsabs=0.0, epsrel=1e-12)[0]
            for a, b in pieces
        )

    scale = hs**2 / 16.0 / moment(0)
    for order in (-1, 0, 1, 2):
        assert spectrum.moment(order) == pytest.approx(scale * moment(order), rel=1e-10)
    omega = np.linspace(0.2, 4.0, 77)
    expected = [scale * jonswap_by_formula(w, hs, tp, gamma) for w in omega]
    np.testing.assert_allclose(spectrum.density(omega), expected, rtol=1e-10)


def test_pierson_moskowitz_is_jonswap_without_enhancement() -> None:
    omega = np.linspace(0.0, 3.0, 50)
    pm = _core.pierson_moskowitz(hs=2.0, tp=8.0)
    np.testing.assert_array_equal(pm.density(omega), _core.jonswap(hs=2.0, tp=8.0, gamma=1.0).density(omega))
    assert pm.steepness() == pytest.approx(2.0 / (G * 64.0 / (2.0 * np.pi)), rel=1e-14)
    assert pm.energy() == pytest.approx(0.25, rel=1e-13)


def test_philox_uniform_is_what_its_specification_says() -> None:
    seed, stream, index = 0x123456789ABCDEF0, 0xFEDCBA9876543210, 0x0F1E2D3C4B5A6978
    mask = 0xFFFFFFFF
    words = philox4x32([index & mask, index >> 32, stream & mask, stream >> 32], [seed & mask, seed >> 32])
    expected = ((((words[1] << 32) | words[0]) >> 11) | 1) * 2.0**-53
    assert _core.philox_uniform(seed=seed, stream=stream, index=index) == expected


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


@pytest.mark.parametrize("seed", range(5))
def test_realised_hs_is_within_one_percent(seed: int) -> None:
    waves = paper_sea(seed=seed)
    assert len(waves) == 200
    assert waves.realised_hs == pytest.approx(2.0, rel=0.01)
    assert waves.realised_hs == pytest.approx(4.0 * np.sqrt(np.sum(waves.amplitude**2) / 2.0), rel=1e-14)


def test_same_seed_same_waves_other_seed_other_waves() -> None:
    a, b, c = paper_sea(5), paper_sea(5), paper_sea(6)
    times = np.linspace(0.0, 100.0, 1001)
    np.testing.assert_array_equal(a.elevation(times), b.elevation(times))
    assert np.abs(a.elevation(times) - c.elevation(times)).max() > 0.5


@pytest.mark.parametrize("seed", range(5))
def test_no_repeat_within_and_far_beyond_a_run(seed: int) -> None:
    waves = paper_sea(seed)
    lags = np.arange(20.0, 1000.0, 0.05)
    assert waves.autocorrelation(lags).max() < 0.8
    repeat = waves.repeat_period()
    assert (repeat.found, repeat.time) == (False, 10800.0)


def test_equally_spaced_components_are_reported_to_repeat() -> None:
    # Twenty equal steps as in codes without jitter: the sea is back after 2 pi / (omega step).
    omega = 0.12 * np.arange(1, 21)
    waves = _core.WaveComponents(omega=omega, amplitude=0.2)
    repeat = waves.repeat_period()
    assert repeat.found
    assert repeat.time == pytest.approx(2.0 * np.pi / 0.12, abs=0.3)


def test_finite_depth_wavenumbers() -> None:
    waves = paper_sea(depth=20.0)
    k = waves.wavenumber
    np.testing.assert_allclose(G * k * np.tanh(k * 20.0), waves.omega**2, rtol=1e-13)


def test_arrays_are_read_only_and_outlive_their_owner() -> None:
    waves = paper_sea()
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


@pytest.mark.parametrize("relative_bound", [1e-4, 1e-7, 1e-9])
def test_table_within_its_bound(relative_bound: float) -> None:
    waves = paper_sea()
    load = _core.ExactWaveLoad(waves, transfer=random_transfer(len(waves)))
    table = _core.WaveTable(load, relative_bound=relative_bound)
    times = np.random.default_rng(1).uniform(-50.0, 150.0, 20000)
    error = np.abs(table.evaluate(times) - load.evaluate(times)).max(axis=0)
    rounding = 1e-13 * load.magnitude()
    assert np.all(table.error_bound <= relative_bound * load.magnitude() * (1.0 + 1e-12))
    assert np.all(error <= table.error_bound + rounding)
    assert np.all(error >= 0.01 * table.error_bound)
    difference = np.abs(table.elevation(times) - load.elevation(times)).max()
    assert 0.01 * table.elevation_error_bound <= difference <= table.elevation_error_bound + 1e-13


def test_table_does_not_depend_on_the_order_of_times() -> None:
    waves = paper_sea()
    table = _core.WaveTable(_core.ExactWaveLoad(waves, transfer=random_transfer(len(waves))))
    times = np.linspace(-20.0, 400.0, 5000)
    order = np.random.default_rng(2).permutation(times.size)
    np.testing.assert_array_equal(table.evaluate(times)[order], table.evaluate(times[order]))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"hs": np.nan, "tp": 8.0}, "hs is nan; give a significant wave height"),
        ({"hs": -1.0, "tp": 8.0}, "hs is -1; give"),
        ({"hs": 2.0, "tp": -8.0}, "tp is -8; give a finite value above zero in s"),
        ({"hs": 2.0, "tp": np.inf}, "tp is inf"),
        ({"hs": 2.0, "tp": 8.0, "gamma": 0.9}, r"gamma is 0\.9; give a peak enhancement of 1"),
    ],
)
def test_bad_spectrum(options: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match="JONSWAP spectrum: " + message):
        _core.jonswap(**options)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"count": 0}, "count is 0; give a whole number from 1"),
        ({"count": 2.5}, r"count is 2\.5; give a whole number"),
        ({"count": -3}, "count is -3"),
        ({"seed": -1}, "seed is -1; give a whole number from 0 to 18446744073709551615"),
        ({"seed": 2**64}, "seed is 18446744073709551616"),
        ({"minimum_omega": 2.5, "maximum_omega": 0.3}, r"maximum_omega is 0\.3; give .* above minimum_omega"),
        ({"minimum_omega": np.nan}, "minimum_omega is nan"),
        ({"direction": np.nan}, "direction is nan; give a finite value in rad"),
        ({"depth": 0.0}, "depth is 0; give a depth above zero"),
        ({"gravity": -9.8}, r"gravity is -9\.8"),
    ],
)
def test_bad_realisation(options: dict[str, float], message: str) -> None:
    given = {"seed": 1, "direction": 0.0, **options}
    with pytest.raises(ValueError, match=message):
        _core.realise_waves(_core.jonswap(hs=2.0, tp=8.0), **given)


def test_bad_components_and_loads() -> None:
    with pytest.raises(ValueError, match=r"length of amplitude is 2; give one value per frequency \(3\)"):
        _core.WaveComponents(omega=[0.5, 0.6, 0.7], amplitude=[1.0, 1.0])
    with pytest.raises(ValueError, match="omega has 2 dimensions"):
        _core.WaveComponents(omega=[[0.5]], amplitude=1.0)
    with pytest.raises(ValueError, match=r"amplitude\[0\] is -1; give an amplitude of zero or more"):
        _core.WaveComponents(omega=[0.5], amplitude=-1.0)
    waves = _core.WaveComponents(omega=[0.5, 0.6], amplitude=1.0)
    with pytest.raises(ValueError, match=r"shape of transfer is \(3, 6\); .*\(2, 6\)"):
        _core.ExactWaveLoad(waves, transfer=np.zeros((3, 6)))
    with pytest.raises(ValueError, match="transfer has 1 dimensions"):
        _core.ExactWaveLoad(waves, transfer=np.zeros(6))
    with pytest.raises(ValueError, match=r"transfer\(1, 2\) is \(nan,0\)"):
        _core.ExactWaveLoad(waves, transfer=[[0.0] * 6, [0.0, 0.0, np.nan, 0.0, 0.0, 0.0]])
    load = _core.ExactWaveLoad(waves, transfer=np.ones((2, 6)))
    with pytest.raises(ValueError, match="relative_bound is 0; give"):
        _core.WaveTable(load, relative_bound=0.0)
    with pytest.raises(ValueError, match="derivative is 3; give 0, 1 or 2"):
        load.evaluate(0.0, derivative=3)
    with pytest.raises(ValueError, match="a time is not finite"):
        load.evaluate([0.0, np.nan])
