"""Realised seas as random processes: variance, Rice's crossings, crests, directions, cross-spectra."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from seacrane.sea import SeaState, Spreading, WaveComponents, WaveSystem, cos_2s, cos_n, jonswap

SPREADINGS = [cos_2s(1.0), cos_2s(60.0), cos_n(2.0)]
NAMES = [f"{s.kind}-{s.exponent:g}" for s in SPREADINGS]


@pytest.mark.parametrize("spreading", SPREADINGS, ids=NAMES)
def test_spreading_is_a_density_with_quantiles_that_directions_follow_in_every_band(
    spreading: Spreading,
) -> None:
    density = lambda b: float(spreading.density(b))  # noqa: E731
    whole = quad(density, -np.pi, 0.0)[0] + quad(density, 0.0, np.pi)[0]
    assert whole == pytest.approx(1.0, rel=1e-7)
    for p in (0.01, 0.2, 0.5, 0.77, 0.999):
        edge = float(spreading.quantile(p))
        share = quad(density, -np.pi, min(edge, 0.0))[0] + quad(density, 0.0, max(edge, 0.0))[0]
        assert share == pytest.approx(p, abs=1e-7)
    mean = 2.0 * quad(lambda b: np.cos(b) * density(b), 0.0, np.pi, limit=200)[0]
    assert spreading.std == pytest.approx(np.sqrt(2.0 * (1.0 - mean)), rel=1e-6)
    # Published forms: 2^(2s-1) Gamma(s+1)^2 / (pi Gamma(2s+1)) and Gamma(n/2+1) / (sqrt(pi) Gamma(n/2+1/2)).
    if spreading == cos_2s(1.0):
        assert spreading.density(0.0) == pytest.approx(2.0 / (2.0 * np.pi), rel=1e-13)
    if spreading == cos_n(2.0):
        assert spreading.density(0.6) == pytest.approx(2.0 / np.pi * np.cos(0.6) ** 2, rel=1e-13)
        assert spreading.density(1.7) == 0.0
    waves = short_crested(spreading, seed=11)
    off = np.array(waves.direction) - np.radians(140.0)
    for band in (slice(None), slice(100, 200), slice(500, 600)):
        angles = np.sort(off[band])
        n = angles.size
        # Golden-ratio steps: any n neighbours fill (0, 1) with gaps below 2.6 / n; random ones would not.
        shares = np.searchsorted(angles, spreading.quantile(np.linspace(0.02, 0.98, 49))) / n
        np.testing.assert_allclose(shares, np.linspace(0.02, 0.98, 49), atol=3.0 / n)
        ideal = spreading.quantile((np.arange(n) + 0.5) / n)
        assert np.abs(angles - ideal).mean() < 0.1 * spreading.std


def short_crested(spreading: Spreading, **options: object) -> WaveComponents:
    system = WaveSystem(
        spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=140.0, spreading=spreading,
        count=int(options.pop("count", 600)),
    )  # fmt: skip
    return SeaState(systems=[system], **options).realise().waves


def test_cross_spectrum_of_two_points_is_that_of_the_spreading() -> None:
    spreading, mean = cos_2s(6.0), np.radians(140.0)
    waves = short_crested(spreading, seed=2, placement="uniform", count=4000)
    step = float(np.min(np.diff(waves.omega)))
    n = 1 << 14
    t = np.arange(n) * 2.0 * np.pi / step / n
    x, y = 18.0, 9.0
    here, there = (np.fft.rfft(waves.elevation(t, x=px, y=py)) / n for px, py in ((0.0, 0.0), (x, y)))
    first = round(float(waves.omega[0]) / step)
    for band in (slice(600, 900), slice(900, 1200), slice(2000, 2400)):
        lines = np.arange(first, first + 4000)[band]
        product = there[lines] * np.conj(here[lines])
        k = np.array(waves.wavenumber)[band]
        angles = np.linspace(-np.pi, np.pi, 721)[:-1]
        turned = np.exp(-1j * k[:, None] * (x * np.cos(mean + angles) + y * np.sin(mean + angles)))
        kernel = turned @ spreading.density(angles) * (angles[1] - angles[0])
        energy = np.abs(here[lines]) ** 2
        expected = np.sum(energy * kernel) / np.sum(energy)
        assert np.sum(product) / np.sum(energy) == pytest.approx(expected, abs=0.01)
        assert 0.05 < abs(expected) < 0.97


def test_many_seeds_cross_levels_as_rice_says_and_have_rayleigh_crests() -> None:
    system, duration = WaveSystem(spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=0.0), 1200.0
    t, levels, seeds = np.arange(0.0, duration, 0.2), np.array([0.0, 1.0, 2.0]), 40
    counts, crests, variances = np.zeros(3), [], []
    for seed in range(seeds):
        waves = SeaState(systems=[system], seed=seed).realise().waves
        record = waves.elevation(t) / np.sqrt(waves.m0)
        counts += np.count_nonzero((record[:-1, None] < levels) & (record[1:, None] >= levels), axis=0)
        zero = np.flatnonzero((record[:-1] < 0.0) & (record[1:] >= 0.0))
        crests.append(np.maximum.reduceat(record, zero)[:-1])
        variances.append(np.mean(record**2))
    expected = seeds * duration / waves.mean_period * np.exp(-0.5 * levels**2)
    np.testing.assert_allclose(counts, expected, rtol=0.04)
    assert np.mean(variances) == pytest.approx(1.0, abs=0.02)
    for level in (1.0, 1.5, 2.0):
        # Rayleigh is the narrow-band limit; the JONSWAP band takes some small crests in, hence the margin.
        assert np.mean(np.concatenate(crests) > level) == pytest.approx(np.exp(-0.5 * level**2), rel=0.10)
