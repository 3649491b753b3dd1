"""Spectra against closed forms, published relations, and formulas written again from the papers."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.special import gamma as gamma_function

from seacrane.errors import SceneError
from seacrane.sea import (
    Spectrum,
    WaveSystem,
    bretschneider,
    dnv_gamma,
    jonswap,
    ochi_hubble,
    pierson_moskowitz,
    steepness_limit,
    tabulated_spectrum,
    torsethaugen,
)
from seacrane.warnings import SteepSeaWarning

G = 9.80665
OMEGA = np.linspace(0.15, 4.0, 400)

SPECTRA = {
    "jonswap": jonswap(hs=2.0, tp=8.0), "dnv": jonswap(hs=4.0, tp=9.0, gamma="dnv"),
    "bretschneider": bretschneider(hs=3.0, tz=7.0), "wind": torsethaugen(hs=4.0, tp=8.0),
    "long": torsethaugen(hs=1.0, tp=28.0),
    "ochi-hubble": ochi_hubble(hs=(3.0, 2.0), tp=(14.0, 6.0), shape=(3.0, 1.3)),
    "narrow": ochi_hubble(hs=(1.0, 2.0), tp=(18.0, 7.0), shape=(12.0, 0.8)),
}  # fmt: skip


def integral(spectrum: Spectrum, order: int, low: float, high: float) -> float:
    """Integral of omega^order S by SciPy, over ln omega in short pieces."""
    cuts = np.append(np.arange(np.log(low), np.log(high), 0.05), np.log(high))
    f = lambda s: float(spectrum.density(np.exp(s))) * np.exp((order + 1) * s)  # noqa: E731
    return sum(quad(f, a, b, epsabs=1e-14, epsrel=1e-9)[0] for a, b in itertools.pairwise(cuts))


@pytest.mark.parametrize("name", SPECTRA)
def test_energy_and_moments_are_those_of_the_density(name: str) -> None:
    spectrum = SPECTRA[name]
    assert spectrum.moment(0) == pytest.approx(spectrum.hs**2 / 16.0, rel=1e-13)
    assert spectrum.energy() == pytest.approx(spectrum.moment(0), rel=1e-12)
    for low, high in [(0.3, 0.9), (0.7, 0.72), (1.2, 9.0)]:
        energy = spectrum.energy(minimum_omega=low, maximum_omega=high)
        assert energy == pytest.approx(integral(spectrum, 0, low, high), rel=1e-7)
    # The energies of all bands add up, also where the tail is summed as a series.
    edges = np.append(np.linspace(0.0, 12.0, 301), np.inf)
    bands = [spectrum.energy(minimum_omega=a, maximum_omega=b) for a, b in itertools.pairwise(edges)]
    assert sum(bands) == pytest.approx(spectrum.moment(0), rel=1e-12)
    # The tail beyond 300 rad/s holds less than 1e-4 of m1 and 1 % of m2 of the flattest of these.
    for order, rel in ((-1, 1e-5), (1, 1e-3), (2, 2e-2)):
        assert spectrum.moment(order) == pytest.approx(integral(spectrum, order, 0.01, 300.0), rel=rel)
    assert spectrum.tp == pytest.approx(2.0 * np.pi / spectrum.peak_omega, rel=1e-14)


def test_gamma_by_dnv_and_mean_periods_of_the_published_fits() -> None:
    # DNV-RP-C205: 5 up to Tp / sqrt(Hs) = 3.6, 1 from 5; in between by hand at 4 and 4.5.
    middle = [(4.0, np.exp(1.15)), (4.5, np.exp(0.575))]
    for ratio, expected in [(3.0, 5.0), (3.6, 5.0), *middle, (5.0, 1.0), (9.0, 1.0)]:
        assert dnv_gamma(hs=4.0, tp=2.0 * ratio) == pytest.approx(expected, rel=1e-12)
    assert jonswap(hs=4.0, tp=9.0, gamma="dnv").gamma == pytest.approx(np.exp(5.75 - 1.15 * 4.5), rel=1e-14)
    # DNV-RP-C205: Tz / Tp = 0.6673 + 0.05037 g - 0.006230 g^2 + 0.0003341 g^3, T1 / Tp likewise.
    for gamma in (1.0, 2.0, 3.3, 5.0, 7.0):
        spectrum = jonswap(hs=2.0, tp=8.0, gamma=gamma)
        tz = 2.0 * np.pi * np.sqrt(spectrum.moment(0) / spectrum.moment(2))
        t1 = 2.0 * np.pi * spectrum.moment(0) / spectrum.moment(1)
        assert tz / 8.0 == pytest.approx(np.polyval([0.0003341, -0.006230, 0.05037, 0.6673], gamma), rel=5e-3)
        assert t1 / 8.0 == pytest.approx(np.polyval([0.0003610, -0.006556, 0.04936, 0.7303], gamma), rel=5e-3)


def test_bretschneider_by_any_period() -> None:
    for period in ("tz", "t1"):
        spectrum = bretschneider(hs=2.0, **{period: 6.5})
        order = {"tz": 2, "t1": 1}[period]
        mean = 2.0 * np.pi * (spectrum.moment(0) / spectrum.moment(order)) ** (1.0 / order)
        assert mean == pytest.approx(6.5, rel=1e-13)
    by_tp = bretschneider(hs=2.0, tp=8.0).density(OMEGA)
    np.testing.assert_array_equal(by_tp, pierson_moskowitz(hs=2.0, tp=8.0).density(OMEGA))
    # ITTC 1978: S = A omega^-5 exp(-B omega^-4), A = 173 Hs^2 / T1^4, B = 691 / T1^4.
    ittc = 173.0 * 4.0 / 6.5**4 * OMEGA**-5.0 * np.exp(-691.0 / 6.5**4 * OMEGA**-4.0)
    np.testing.assert_allclose(bretschneider(hs=2.0, t1=6.5).density(OMEGA), ittc, rtol=0.01, atol=1e-6)


def torsethaugen_by_paper(omega: NDArray, hs: float, tp: float) -> NDArray:
    """Table 1 of Torsethaugen and Haver (2004), with the fitted factor A_gamma."""

    def system(height: float, period: float, gamma: float) -> NDArray:
        f = omega / (2.0 * np.pi) * period
        sigma = np.where(f < 1.0, 0.07, 0.09)
        peak = gamma ** np.exp(-((f - 1.0) ** 2) / (2.0 * sigma**2))
        a_gamma = (1.0 + 1.1 * np.log(gamma) ** 1.19) / gamma
        return height**2 * period / (32.0 * np.pi) * 3.26 * a_gamma * f**-4.0 * np.exp(-(f**-4.0)) * peak

    tf = 6.6 * hs ** (1.0 / 3.0)
    if tp <= tf:
        el = (tf - tp) / (tf - 2.0 * np.sqrt(hs))
        r = 0.7 + 0.3 * np.exp(-((2.0 * el) ** 2))
        h1, h2, t2 = r * hs, np.sqrt(1.0 - r * r) * hs, tf + 2.0
        gamma = 35.0 * (2.0 * np.pi / G * h1 / tp**2) ** 0.857
    else:
        eu = (tp - tf) / (25.0 - tf)
        r = 0.6 + 0.4 * np.exp(-((eu / 0.3) ** 2))
        h1, h2 = r * hs, np.sqrt(1.0 - r * r) * hs
        t2 = 6.6 * h2 ** (1.0 / 3.0)
        gamma = 35.0 * (2.0 * np.pi / G * hs / tf**2) ** 0.857 * (1.0 + 6.0 * eu)
    return system(h1, tp, gamma) + system(h2, t2, 1.0)


def test_torsethaugen_is_that_of_the_paper() -> None:
    for hs, tp in ((4.0, 8.0), (6.0, 10.0), (2.0, 14.0), (5.0, 18.0), (9.0, 9.0)):
        spectrum, paper = torsethaugen(hs=hs, tp=tp), torsethaugen_by_paper(OMEGA, hs, tp)
        # The paper's factor A_gamma is a fit; ours integrates to hs^2 / 16 exactly.
        np.testing.assert_allclose(spectrum.density(OMEGA), paper, rtol=0.03, atol=1e-9)
        first, second = spectrum.parts()
        assert first.tp == tp and first.gamma is not None and first.gamma > 1.0 and second.gamma == 1.0
        assert np.hypot(first.hs, second.hs) == pytest.approx(hs, rel=1e-14)
        both = first.density(OMEGA) + second.density(OMEGA)
        np.testing.assert_allclose(both, spectrum.density(OMEGA), rtol=1e-14)
    fully = 6.6 * 3.0 ** (1.0 / 3.0)  # continuous there
    below, above = (torsethaugen(hs=3.0, tp=fully * (1 + s * 1e-6)).density(OMEGA) for s in (-1, 1))
    np.testing.assert_allclose(below, above, rtol=1e-4, atol=1e-7)
    # Beyond 25 s, and below 2 sqrt(hs), the shares of the two systems no longer change.
    for periods in [(26.0, 30.0), (2.0, 3.0)]:
        one, other = (torsethaugen(hs=3.0, tp=tp).parts()[0].hs for tp in periods)
        assert one == pytest.approx(other, rel=1e-14)


def test_ochi_hubble_is_that_of_the_paper() -> None:
    hs, tp, shape = (3.0, 2.0), (14.0, 6.0), (3.0, 1.3)
    expected = np.zeros_like(OMEGA)
    for h, t, lam in zip(hs, tp, shape, strict=True):
        m = 0.25 * (4.0 * lam + 1.0) * (2.0 * np.pi / t) ** 4
        size = 0.25 * m**lam / gamma_function(lam) * h**2
        expected += size / OMEGA ** (4.0 * lam + 1.0) * np.exp(-m / OMEGA**4)
    spectrum = ochi_hubble(hs=hs, tp=tp, shape=shape)
    np.testing.assert_allclose(spectrum.density(OMEGA), expected, rtol=1e-11, atol=1e-30)
    assert spectrum.tp == 14.0


def test_a_table_is_linear_and_its_energy_exact() -> None:
    omega, density = np.array([0.4, 0.6, 1.0, 1.5]), np.array([0.0, 2.0, 0.5, 0.1])
    table = tabulated_spectrum(omega=omega, density=density)
    at = np.linspace(0.0, 2.0, 81)
    expected = np.interp(at, omega, density, left=0.0, right=0.0)
    np.testing.assert_allclose(table.density(at), expected, rtol=1e-13)
    assert table.hs == pytest.approx(4.0 * np.sqrt(np.trapezoid(density, omega)), rel=1e-14)
    assert table.tp == pytest.approx(2.0 * np.pi / 0.6, rel=1e-14)

    def moment(order: int, edges: NDArray) -> float:
        def integrand(w: float) -> float:
            return float(np.interp(w, omega, density) * w**order)

        return sum(quad(integrand, a, b, epsrel=1e-12)[0] for a, b in itertools.pairwise(edges))

    for order in (-4, -1, 0, 1, 2, 4):
        assert table.moment(order) == pytest.approx(moment(order, omega), rel=1e-11)
    part = moment(0, np.array([0.5, 0.6, 1.0, 1.2]))
    assert table.energy(minimum_omega=0.5, maximum_omega=1.2) == pytest.approx(part, rel=1e-13)
    hertz = tabulated_spectrum(frequency=omega / (2.0 * np.pi), density=2.0 * np.pi * density)
    np.testing.assert_allclose(hertz.density(at), table.density(at), rtol=1e-9, atol=1e-12)


def test_breaking_seas_warn() -> None:
    assert [1.0 / steepness_limit(tp) for tp in (5.0, 8.0, 15.0, 20.0)] == pytest.approx(
        [15.0, 15.0, 25.0, 25.0]
    )
    limit = G * 64.0 / (2.0 * np.pi) / 15.0
    WaveSystem(spectrum=jonswap(hs=0.99 * limit, tp=8.0), direction_deg=0.0)
    with pytest.warns(SteepSeaWarning, match="overstate crests and loads"):
        WaveSystem(spectrum=jonswap(hs=1.01 * limit, tp=8.0), direction_deg=0.0)


def test_bad_spectra_are_named() -> None:
    for make, given, message in (
        (jonswap, {"hs": 1e200, "tp": 8.0}, "1000 m"), (jonswap, {"hs": 2.0, "tp": 0.0}, "tp is 0"),
        (jonswap, {"hs": 2.0, "tp": 8.0, "gamma": 7.5}, "gamma is 7.5"),
        (ochi_hubble, {"hs": (1.0, 1.0), "tp": (9.0, 6.0), "shape": (0.5, 1.0)}, "lambda is 0.5"),
        (tabulated_spectrum, {"omega": [0.5, 0.5], "density": [1.0, 1.0]}, r"frequency\[1\] is 0.5"),
        (tabulated_spectrum, {"omega": [0.5, 0.6], "density": [1.0, -1.0]}, r"density\[1\] is -1"),
        (tabulated_spectrum, {"omega": [0.0, 1.0], "density": [2.0, 1.0]}, "above zero frequency"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            make(**given)
