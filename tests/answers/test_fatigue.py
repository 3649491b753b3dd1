"""Rainflow by the printed example of ASTM E1049, and damage of Gaussian signals by their spectra."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, SceneError, simulate
from seacrane.answers import FatigueCurve, fatigue, rainflow
from seacrane.answers.fatigue import dirlik_rate, narrow_band_rate
from seacrane.statistics.record import SpectrumEstimate
from seacrane.warnings import UnitWarning

G = 9.80665


def counted(values: Any) -> dict[float, float]:
    cycles = rainflow(values)
    return {size: float(cycles[cycles[:, 0] == size, 2].sum()) for size in np.unique(cycles[:, 0]).tolist()}


def test_rainflow_is_the_printed_example_of_astm_e1049() -> None:
    peaks = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]
    assert counted(peaks) == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}
    between = np.interp(np.linspace(0.0, 8.0, 81), np.arange(9.0), peaks)  # points on the way count nothing
    assert counted(np.repeat(np.round(between, 12), 2)) == counted(peaks)
    assert rainflow([3.0, 3.0]).shape == rainflow([]).shape == (0, 3)


def gaussian(centre: float, width: float, seed: int) -> tuple[SpectrumEstimate, Any, float]:
    """A sum of cosines with random amplitudes and phases, its spectrum, and its length, s."""
    omega = np.arange(1, 3001) * 1e-3
    density = np.exp(-0.5 * ((omega - centre) / width) ** 2)
    spectrum = SpectrumEstimate(omega=omega, density=density, degrees_of_freedom=2.0, duration=1.0)
    random, size = np.random.default_rng(seed), 2**17
    duration = 2.0 * np.pi / 1e-3
    cosines = np.zeros(size // 2 + 1, dtype=complex)
    parts = random.normal(size=(2, omega.size)) * np.sqrt(density * 1e-3)
    cosines[1 : 1 + omega.size] = 0.5 * size * (parts[0] + 1j * parts[1])
    return spectrum, np.fft.irfft(cosines, size), duration


@pytest.mark.parametrize(("width", "within", "by_narrow"), [(0.08, 0.1, True), (0.6, 0.08, False)])
def test_damage_of_a_gaussian_signal_is_that_of_its_spectrum(
    width: float, within: float, by_narrow: bool
) -> None:
    """Narrow: both formulas; wide: Dirlik's, and the narrow band is too much."""
    curve = FatigueCurve(constant=1e6, slope=3.0)
    rates = []
    for seed in range(12):
        spectrum, values, duration = gaussian(1.2, width, seed)
        cycles = rainflow(values)
        rates.append(curve.damage(cycles[:, 0], cycles[:, 2]) / duration)
    rate = float(np.mean(rates))
    assert dirlik_rate(spectrum, curve) == pytest.approx(rate, rel=within)
    assert (narrow_band_rate(spectrum, curve) == pytest.approx(rate, rel=within)) is by_narrow
    assert narrow_band_rate(spectrum, curve) > 0.9 * rate


def test_a_sine_has_one_cycle_in_each_period() -> None:
    """Of a result: by range over a breaking load, and a source that nobody told."""
    scene = Scene(name="bouncing", gravity=G)
    mass, stiffness, amplitude = 20e3, 5e5, 0.2  # kg, N/m, m
    low = 10.0 + mass * G / stiffness - amplitude
    scene.add_body("load", mass=mass, inertia=(1e4,) * 3, position=(0.0, 0.0, -low))
    scene.add_line(
        "wire", bodies=["ground", "load"], points=[(0, 0, 0), (0, 0, 0)], EA=10.0 * stiffness, length=10.0,
        damping_ratio=0.0, rung="elastic",
    )  # fmt: skip
    result = simulate(scene, t_end=40.0, dt_out=0.02, channels=["line_tension"])
    found = fatigue(result, curves={"line_tension[wire]": FatigueCurve(constant=100.0, slope=2.0, scale=1e6)})
    row = found["line_tension[wire]"]
    assert row.largest == pytest.approx(2.0 * amplitude * stiffness, rel=1e-3) and row.unit == "N"
    period = 2.0 * np.pi * np.sqrt(mass / stiffness)
    hourly = 3600.0 / period * (row.largest / 1e6) ** 2 / 100.0
    assert row.rainflow == pytest.approx(hourly, rel=0.05) and row.life == pytest.approx(1.0 / row.rainflow)
    assert "unverified" in str(found) and not found.coarse
    for after in (45.0, np.nan):
        with pytest.raises(SceneError, match="fatigue: 0 outputs after"):
            fatigue(result, curves={"line_tension[wire]": FatigueCurve(constant=1.0, slope=3.0)}, after=after)
    section = {"slope": 3.0, "scale": 900e-6}  # m2: 222 MPa
    for constant, slips in ((1e12, True), (1e30, False), (1e48, True), (1e300, True)):  # MPa, Pa, far
        curves = {"line_tension[wire]": FatigueCurve(constant=constant, **section)}
        with pytest.warns(UnitWarning, match="1e6.slope") if slips else nullcontext():
            assert ("a constant over MPa" in str(fatigue(result, curves=curves))) is slips
    with pytest.raises(SceneError, match="FatigueCurve"):
        fatigue(result, curves={"line_tension[wire]": 3.0})  # type: ignore[dict-item]


def test_a_slack_wire_goes_down_to_zero_and_one_that_is_not_known_is_named() -> None:
    """A weight that hops: the wire is slack for a part of each cycle; another that carries nothing; a gap."""
    scene = Scene(name="hopping", gravity=G)
    scene.add_body("load", mass=2e4, inertia=(1e4,) * 3, position=(0.0, 0.0, -9.5))
    for name, length in (("wire", 10.0), ("spare", 99.0)):
        scene.add_line(
            name, bodies=["ground", "load"], points=[(0, 0, 0), (0, 0, 0)], EA=5e6, length=length,
            damping_ratio=0.0, rung="elastic",
        )  # fmt: skip
    result = simulate(scene, t_end=60.0, dt_out=0.02, channels=["line_tension"])
    curves = {f"line_tension[{name}]": FatigueCurve(constant=1e12, slope=2.0) for name in ("wire", "spare")}
    wire, spare = fatigue(result, curves=curves)
    peak = 2e4 * G * (1.0 + np.sqrt(1.0 + 2.0 * 0.5 * 5e5 / (2e4 * G)))  # k x^2 / 2 = m g (0.5 m + x)
    assert wire.largest == pytest.approx(peak, rel=1e-3) and wire.rainflow > 0.0
    assert (spare.rainflow, spare.life) == (0.0, np.inf) and np.isnan(spare.dirlik)
    told = str(fatigue(result, curves=curves))
    assert 0.3 < wire.zero < 0.7 and spare.zero == 1.0
    assert "as a slack wire is" in told and "spare] is 0 N throughout" in told
    gap = np.array(result["line_tension"])
    gap[40:50, 0] = np.nan
    torn = replace(result, channels={**result.channels, "line_tension": gap})
    first, second = fatigue(torn, curves=curves)
    assert np.isnan(first.rainflow) and second.rainflow == 0.0
    assert "line_tension[wire] is NOT JUDGED" in str(fatigue(torn, curves=curves))
    few = simulate(scene, t_end=60.0, dt_out=0.7, channels=["line_tension"])
    assert fatigue(few, curves=curves).coarse == ("line_tension[wire]",)
