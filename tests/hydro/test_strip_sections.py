"""Sections of strip theory: against multipoles, closed forms, energy, causality and convergence."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from ursell_multipoles import LewisSection, radiation

from seacrane import SceneError, _core

FloatArray = NDArray[np.float64]
RHO, G = 1025.0, 9.81
CIRCLE = LewisSection(a1=0.0, a3=0.0)
FULL = LewisSection(a1=0.2, a3=-0.1, scale=8.0)  # b / d = 1.57, area coefficient 0.94
DEEP = LewisSection(a1=-0.2, a3=0.02, scale=8.0)  # b / d = 0.67, area coefficient 0.76
RECTANGLE = np.array([[12.5, 0.0], [12.5, -6.4], [0.0, -6.4]])


def solved(points: FloatArray, omega: Any, **options: Any) -> dict[str, FloatArray]:
    return _core.section_radiation(points=points, omega=omega, rho=RHO, g=G, **options)


def diagonal(matrices: FloatArray) -> FloatArray:
    return np.diagonal(matrices, axis1=1, axis2=2)


def multipole_error(section: LewisSection) -> float:
    """Largest difference of an entry of A or B over the peaks of its row and column."""
    half_breadth = section.points(2)[0, 0]
    nu = np.array([0.05, 0.3, 0.6, 1.0, 1.5, 2.0, 4.0]) / half_breadth
    omega = np.sqrt(G * nu)
    found = solved(section.points(200), omega)
    expected = np.array([RHO * radiation(section, float(k)) for k in nu])
    worst = 0.0
    for name, reference in (
        ("added_mass", expected.real),
        ("damping", -omega[:, None, None] * expected.imag),
    ):
        peak = np.abs(diagonal(reference)).max(axis=0)
        peak[2] = max(peak[2], 1e-4 * half_breadth**2 * peak[0])  # a circle has no roll of its own
        scale = np.sqrt(np.outer(peak, peak))
        worst = max(worst, float(np.abs((found[name] - reference) / scale).max()))
    return worst


@pytest.mark.parametrize("section", [CIRCLE, FULL, DEEP])
def test_agrees_with_multipoles_and_the_limits_of_its_mapping(section: LewisSection) -> None:
    """Closed forms of Lewis (1929): heave at infinite, sway at zero frequency, and approached there."""
    assert multipole_error(section) < 0.01
    found = solved(section.points(200), [1e-3, 12.0])
    zero, infinite = found["zero_added_mass"], found["infinite_added_mass"]
    unit = RHO * 0.5 * np.pi * section.scale**2
    heave = unit * ((1.0 + section.a1) ** 2 + 3.0 * section.a3**2)
    sway = unit * ((1.0 - section.a1) ** 2 + 3.0 * section.a3**2)
    assert infinite[1, 1] == pytest.approx(heave, rel=5e-3)
    assert zero[0, 0] == pytest.approx(sway, rel=5e-3)
    assert np.isnan(zero[1, 1])
    if section is FULL:
        lateral = np.ix_([0, 2], [0, 2])
        assert found["added_mass"][0][lateral] == pytest.approx(zero[lateral], rel=1e-3)
        assert diagonal(found["added_mass"])[1] == pytest.approx(np.diag(infinite), rel=0.03)


@pytest.mark.parametrize("points", [FULL.points(100), RECTANGLE], ids=["lewis", "rectangle"])
def test_radiated_energy_and_reciprocity(points: FloatArray) -> None:
    """Damping from pressure equals the power of the waves far away, coupling included."""
    omega = np.linspace(0.2, 2.5, 24)
    found = solved(points, omega, panels=80)
    amplitude = found["wave_amplitude"]
    carried = np.einsum("nj,nk->njk", amplitude, amplitude.conj()).real
    carried[:, 1, ::2] = carried[:, ::2, 1] = 0.0  # even and odd waves cancel between port and starboard
    carried *= (RHO * G**2 / omega**3)[:, None, None]
    peak = np.sqrt(diagonal(found["damping"]).max(axis=0))
    assert np.abs((found["damping"] - carried) / np.outer(peak, peak)).max() < 2e-3
    for name in ("added_mass", "damping"):
        scale = np.sqrt(np.prod(np.abs(diagonal(found[name])[:, [0, 2]]).max(axis=0)))
        assert np.abs(found[name][:, 0, 2] - found[name][:, 2, 0]).max() < 2e-3 * scale
        assert np.abs(found[name][:, 1, [0, 2]]).max() == 0.0


def test_no_irregular_frequencies() -> None:
    """The rectangle's interior sloshes at omega^2 = g k coth(k d), k = n pi / B. Without the lid coefficients
    jump there; with it they are smooth on a fine grid through the first six, and carry their energy."""
    wavenumber = np.arange(1, 7) * np.pi / 25.0
    irregular = np.sqrt(G * wavenumber / np.tanh(wavenumber * 6.4))
    omega = np.unique(np.concatenate([w + np.linspace(-0.02, 0.02, 41) for w in irregular]))
    found = solved(RECTANGLE, omega)
    for name in ("added_mass", "damping"):
        values = diagonal(found[name])
        peak = np.abs(diagonal(solved(RECTANGLE, np.linspace(0.2, 3.0, 29))[name])).max(axis=0)
        for w in irregular:
            near = np.abs(omega - w) < 0.0201
            line = np.polynomial.Polynomial.fit
            for mode in range(3):
                x, y = omega[near] - w, values[near, mode]
                assert np.abs(y - line(x, y, 2)(x)).max() < 1e-4 * peak[mode]
    carried = (RHO * G**2 / omega**3)[:, None] * np.abs(found["wave_amplitude"]) ** 2
    assert np.abs(diagonal(found["damping"]) - carried).max() < 0.01 * carried.max()
    assert (diagonal(found["damping"]) > -1e-3 * peak).all()


def test_converges_with_panels() -> None:
    """Second order on a smooth section, above first order on one with a corner."""
    for points, order in ((FULL.points(2000), 1.7), (RECTANGLE, 1.3)):
        omega = [0.5, 1.0]
        found = [solved(points, omega, panels=n)["added_mass"] for n in (20, 40, 80, 320)]
        error = [np.abs(diagonal(a - found[-1])).max(axis=0) for a in found[:-1]]
        assert (np.log2(error[0] / error[2]) / 2.0 > order).all()


def test_a_stem_is_a_plate_in_sway_a_point_is_nothing_and_all_scales_with_size() -> None:
    """Zero-frequency sway of a plate of draught d: rho pi d^2 / 2; no heave to speak of."""
    for points in ([[0, 0], [0, -3], [0, -6]], [[0.01, 0], [0.01, -3], [0, -6]]):
        found = solved(np.array(points), [1.0])
        assert found["zero_added_mass"][0, 0] == pytest.approx(RHO * 0.5 * np.pi * 36.0, rel=0.03)
        assert found["infinite_added_mass"][1, 1] < 1e-3 * found["zero_added_mass"][0, 0]
    assert all(np.abs(values).max() == 0.0 for values in solved(np.zeros((3, 2)), [1.0]).values())
    small, large = solved(RECTANGLE, [0.8]), solved(4.0 * RECTANGLE, [0.4])
    power = np.array([[2, 2, 3], [2, 2, 3], [3, 3, 4]])
    for name, rate in (("added_mass", 1.0), ("damping", 0.5)):
        assert large[name][0] == pytest.approx(rate * 4.0**power * small[name][0], rel=1e-9)


def test_bad_sections() -> None:
    for points, message in (
        ([[5, 0], [5, np.nan], [0, -5]], "point 1 .* not finite"), ([[5, -1], [5, -3], [0, -5]], "point 0"),
        ([[5, 0], [5, -3], [1, -5]], "point 2"), ([[5, 0], [-1, -3], [0, -5]], "point 1 .* crossed"),
        ([[5, 0], [5, 0.2], [5, -3], [0, -5]], "point 1 .* above"),
        ([[5, 0], [1, -4], [5, -4], [1, -1], [0, -5]], "crosses the side"),
        ([[5, 0], [5, -4], [5, -2], [0, -5]], "turns back"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=f"section: .*{message}"):
            solved(np.array(points, dtype=float), [1.0])
    # A slot below the surface, 0.25 m high and 14 m deep, is too much for 20 panels, not for 300.
    slot = np.array([[1.0, 0.0], [1.0, -0.25], [15.0, -0.25], [15.0, -1.0], [0.0, -1.0]])
    with pytest.raises(SceneError, match=r"damping .* 20 panels are too few"):
        solved(slot, [1.0], panels=20)
    assert diagonal(solved(slot, [1.0], panels=300)["damping"]).min() > 0.0
