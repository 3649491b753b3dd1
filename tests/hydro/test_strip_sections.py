"""Strip theory: sections against multipoles, energy, closed forms; hulls against sums, Haskind, speed."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from ursell_multipoles import LewisSection, radiation

from seacrane import SceneError, _core
from seacrane.arrays import Array

RHO, G = 1025.0, 9.81
CIRCLE = LewisSection(a1=0.0, a3=0.0)
FULL = LewisSection(a1=0.2, a3=-0.1, scale=8.0)  # b / d = 1.57, area coefficient 0.94
DEEP = LewisSection(a1=-0.2, a3=0.02, scale=8.0)  # b / d = 0.67, area coefficient 0.76
RECTANGLE = np.array([[12.5, 0.0], [12.5, -6.4], [0.0, -6.4]])


def solved(points: Array, omega: Any, **options: Any) -> dict[str, Array]:
    return _core.section_radiation(points=points, omega=omega, rho=RHO, g=G, **options)


def diagonal(matrices: Array) -> Array:
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
def test_radiated_energy_and_reciprocity(points: Array) -> None:
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
        ([[5, -1], [5, -3], [0, -5]], "point 0"), ([[5, 0], [5, -3], [1, -5]], "point 2"),
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


LENGTH, HALF, DRAUGHT = 100.0, 10.0, 5.0
BOX = np.array([[HALF, 0.0], [HALF, -DRAUGHT], [0.0, -DRAUGHT]])
BEAM, HEAD = 0.5 * np.pi, np.pi


def strips(x: Any, sections: Any, **options: Any) -> dict[str, Any]:
    settings = {"omega": [0.6, 1.0], "heading": [HEAD], "rho": RHO, "g": G, **options}
    return _core.strip_theory(x=x, sections=sections, **settings)


def box(count: int = 5, centre: float = 0.0, **options: Any) -> dict[str, Any]:
    x = np.linspace(-0.5, 0.5, count) * LENGTH + centre
    return strips(x, [BOX] * count, **options)


def ship(mirrored: bool = False, shift: float = 0.0, **options: Any) -> dict[str, Any]:
    """A hull without symmetry fore and aft, with a transom or, mirrored, a blunt bow."""
    x = np.array([-40.0, -30.0, -15.0, 0.0, 20.0, 35.0, 45.0])
    size = np.array([0.5, 0.8, 1.0, 1.0, 0.9, 0.5, 0.0])
    depth = np.array([0.3, 0.7, 1.0, 1.0, 1.0, 0.8, 0.0])
    sections = [BOX * [b, d] for b, d in zip(size, depth, strict=True)]
    if mirrored:
        x, sections = -x[::-1], sections[::-1]
    return strips(x + shift, sections, **options)


def test_box_is_length_times_section() -> None:
    found = box()
    section = _core.section_radiation(points=BOX, omega=[0.6, 1.0], rho=RHO, g=G)
    for whole, part in (("added_mass", "added_mass"), ("damping", "damping")):
        a = 0.5 * (section[part] + section[part].transpose(0, 2, 1))
        expected = np.zeros((2, 6, 6))
        expected[:, 1:4, 1:4] = LENGTH * a
        expected[:, 4, 4] = LENGTH**3 / 12.0 * a[:, 1, 1]
        expected[:, 5, 5] = LENGTH**3 / 12.0 * a[:, 0, 0]
        assert found[whole] == pytest.approx(expected, rel=1e-12, abs=1e-9 * np.abs(expected).max())
    limit = found["infinite_frequency_added_mass"]
    assert limit[2, 2] == pytest.approx(LENGTH * section["infinite_added_mass"][1, 1])
    zero = found["zero_frequency_added_mass"]
    assert zero[5, 5] == pytest.approx(LENGTH**3 / 12.0 * section["zero_added_mass"][0, 0])
    assert np.isnan(zero[[2, 2, 4, 4], [2, 4, 2, 4]]).all()
    assert np.isfinite(zero[np.ix_([0, 1, 3, 5], [0, 1, 3, 5])]).all()


def test_froude_krylov_of_a_box() -> None:
    """Closed form of the pressure integrals over bottom, sides and ends, in an oblique sea."""
    omega, heading = 0.9, 2.2
    found = box(omega=[omega], heading=[heading])["froude_krylov"][0, 0]
    k = omega**2 / G
    c, s = k * np.cos(heading), k * np.sin(heading)
    along = 2.0 * np.sin(0.5 * c * LENGTH) / c  # integral of exp(-i c x)
    along_x = 2j * (0.5 * LENGTH * np.cos(0.5 * c * LENGTH) / c - np.sin(0.5 * c * LENGTH) / c**2)
    across = 2.0 * np.sin(s * HALF) / s
    across_y = 2j * (HALF * np.cos(s * HALF) / s - np.sin(s * HALF) / s**2)
    bottom = np.exp(-k * DRAUGHT)
    down = (1.0 - bottom) / k
    down_z = (DRAUGHT * bottom - down) / k
    ends, sides = 2j * np.sin(0.5 * c * LENGTH), 2j * np.sin(s * HALF)
    expected = np.array(
        [
            ends * across * down,
            along * sides * down,
            along * across * bottom,
            along * (across_y * bottom - sides * down_z),
            -along_x * across * bottom + ends * across * down_z,
            along_x * sides * down - ends * across_y * down,
        ]
    )
    assert found == pytest.approx(RHO * G * expected, rel=2e-4, abs=1e-7 * np.abs(expected).max() * RHO * G)


def test_haskind_in_beam_seas() -> None:
    """b = |X|^2 omega / (rho g^2) per metre, X with its diffraction part from near the hull."""
    omega = np.array([0.4, 0.7, 1.0, 1.3])
    found = box(omega=omega, heading=[BEAM], panels=80)
    force = found["force"][0, :, 1:4] / LENGTH
    damping = np.diagonal(found["sectional_damping"][:, 0], axis1=1, axis2=2)
    expected = np.abs(force) ** 2 * omega[:, None] / (RHO * G**2)
    assert damping == pytest.approx(expected, rel=0.01, abs=2e-3 * float(damping[:, :2].max()))
    assert damping[:, 2] == pytest.approx(expected[:, 2], rel=0.03)


def test_mirrored_fore_and_aft_and_from_the_other_side() -> None:
    for heading in (0.3, 1.2, 2.5):
        plain, mirror = ship(heading=[heading, -heading]), ship(mirrored=True, heading=[np.pi - heading])
        sign = np.array([-1.0, 1.0, 1.0, 1.0, -1.0, -1.0])
        for name in ("added_mass", "damping"):
            assert mirror[name] == pytest.approx(sign[:, None] * plain[name] * sign, rel=1e-9, abs=1e-3)
        for name in ("force", "froude_krylov"):
            assert mirror[name][0] == pytest.approx(sign * plain[name][0], rel=1e-9, abs=1e-3)
        parity = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
        assert plain["force"][1] == pytest.approx(parity * plain["force"][0], rel=1e-9)


def test_origin_shifted_along_the_ship_and_sums_over_stations() -> None:
    d, heading = 7.0, 2.2
    plain, shifted = ship(heading=[heading]), ship(shift=d, heading=[heading])
    h = np.eye(6)  # twist at the new origin to twist at the old one, d forward
    h[1, 5], h[2, 4] = d, -d
    assert shifted["added_mass"] == pytest.approx(h.T @ plain["added_mass"] @ h, rel=1e-9, abs=1e-3)
    k = np.array([0.6, 1.0]) ** 2 / G
    phase = np.exp(-1j * k * np.cos(heading) * d)
    assert shifted["force"][0] == pytest.approx(phase[:, None] * plain["force"][0] @ h, rel=1e-9)
    x = np.array([-40.0, -30.0, -15.0, 0.0, 20.0, 35.0, 45.0])
    fine = np.concatenate([a + (b - a) * (np.arange(2000) + 0.5) / 2000 for a, b in pairwise(x)])
    width = np.repeat(np.diff(x) / 2000, 2000)
    for whole in ("added_mass", "damping"):
        matrix, section = plain[whole][1], plain[f"sectional_{whole}"][1].reshape(len(x), 9)
        between = np.stack([np.interp(fine, x, column) for column in section.T], axis=1)
        zeroth, first, second = (((width * fine**p) @ between).reshape(3, 3) for p in (0, 1, 2))
        assert matrix[1:4, 1:4] == pytest.approx(zeroth, rel=1e-5)
        assert matrix[2, 4] == pytest.approx(-first[1, 1], rel=1e-5)
        assert matrix[5, [1, 3]] == pytest.approx(first[0, [0, 2]], rel=1e-5)
        assert matrix[[4, 5], [4, 5]] == pytest.approx(second[[1, 0], [1, 0]], rel=1e-5)
        assert matrix == pytest.approx(matrix.T)
        assert np.abs(matrix[0]).max() == 0.0


def test_forward_speed_matrices() -> None:
    """Salvesen, Tuck and Faltinsen's table of coefficients, with the end terms of the transom."""
    u, x_a, i = 6.0, -40.0, 1
    rest, found = ship(), ship(speed=u)
    w = 1.0
    a, b = rest["sectional_added_mass"][i, 0], rest["sectional_damping"][i, 0]
    a0, b0 = rest["added_mass"][i], rest["damping"][i]
    for n, sign, pair in ((1, -1.0, (2, 4)), (0, 1.0, (1, 5))):  # heave and pitch; sway and yaw
        t, r = pair
        expected_a = {
            (t, t): a0[t, t] - u / w**2 * b[n, n],
            (t, r): a0[t, r] + sign * (
                u / w**2 * b0[t, t] - u / w**2 * x_a * b[n, n] + u**2 / w**2 * a[n, n]),
            (r, t): a0[r, t] - sign * (u / w**2 * b0[t, t] + u / w**2 * x_a * b[n, n]),
            (r, r): a0[r, r] + u**2 / w**2 * a0[t, t] - u / w**2 * x_a**2 * b[n, n]
            + u**2 / w**2 * x_a * a[n, n],
        }  # fmt: skip
        expected_b = {
            (t, t): b0[t, t] + u * a[n, n],
            (t, r): b0[t, r] + sign * (
                -u * a0[t, t] + u * x_a * a[n, n] + u**2 / w**2 * b[n, n]),
            (r, t): b0[r, t] + sign * (u * a0[t, t] + u * x_a * a[n, n]),
            (r, r): b0[r, r] + u**2 / w**2 * b0[t, t] + u * x_a**2 * a[n, n]
            + u**2 / w**2 * x_a * b[n, n],
        }  # fmt: skip
        for name, expected in (("added_mass", expected_a), ("damping", expected_b)):
            for at, value in expected.items():
                assert found[name][i][at] == pytest.approx(value, rel=1e-9), (name, at)
    assert found["added_mass"][i, 1, 3] == pytest.approx(a0[1, 3] - u / w**2 * b[0, 2])
    assert found["damping"][i, 3, 5] == pytest.approx(
        b0[3, 5] - u * a0[1, 3] + u * x_a * a[0, 2] + u**2 / w**2 * b[0, 2]
    )


def test_forward_speed_forces() -> None:
    """On a box the diffraction loads of all motions follow from one sectional load by hand integrals."""
    u, omega, heading = 5.0, 0.8, 2.5
    found = box(speed=u, omega=[omega], heading=[heading])
    c = omega**2 / G * np.cos(heading)
    encounter = omega - c * u
    assert found["encounter_frequency"][0, 0] == pytest.approx(encounter)
    s, aft = u / (1j * encounter), -0.5 * LENGTH
    along = 2.0 * np.sin(0.5 * c * LENGTH) / c
    along_x = 2j * (0.5 * LENGTH * np.cos(0.5 * c * LENGTH) / c - np.sin(0.5 * c * LENGTH) / c**2)
    end = s * np.exp(-1j * c * aft)
    diffraction = (found["force"] - found["froude_krylov"])[0, 0]
    for translation, rotation, sign in ((2, 4, -1.0), (1, 5, 1.0)):
        section = diffraction[translation] / (along + end)
        expected = sign * section * (along_x + s * along + aft * end)
        assert diffraction[rotation] == pytest.approx(expected, rel=1e-9)
    assert found["froude_krylov"] == pytest.approx(box(omega=[omega], heading=[heading])["froude_krylov"])


def test_sections_answer_at_the_encounter_frequency() -> None:
    """Beam seas: only the end term changes. Overtaken waves: time runs backwards, the load is -conj."""
    still, moving = (box(speed=u, heading=[BEAM], omega=[0.8]) for u in (0.0, 5.0))
    part = [(r["force"] - r["froude_krylov"])[0, 0, 1:4] for r in (still, moving)]
    assert part[1] == pytest.approx(part[0] * (1.0 + 5.0 / 0.8j / LENGTH), rel=1e-9)

    omega, met = 1.2, 0.4
    k = omega**2 / G
    loads = []
    for encounter in (met, -met):
        u = (omega - encounter) / k
        found = box(speed=u, heading=[0.0], omega=[omega])
        along, end = 2.0 * np.sin(0.5 * k * LENGTH) / k, np.exp(0.5j * k * LENGTH)
        heave = (found["force"] - found["froude_krylov"])[0, 0, 2]
        loads.append(heave / (along + u / (1j * encounter) * end))
    assert loads[1] == pytest.approx(-np.conj(loads[0]), rel=1e-9)
