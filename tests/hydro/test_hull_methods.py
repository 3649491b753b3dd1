"""Strip theory against the three-dimensional panel method."""

from __future__ import annotations

import re
import warnings
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hull_shapes import wigley_offsets

from seacrane.hydro import Hull, HydroDatabase, OffsetTable, ParametricHull, hydro_from_hull, shipped_database
from seacrane.hydro.hull import hull_database
from seacrane.hydro.hull.solution import HullSolution
from seacrane.warnings import MeshConvergenceWarning

SHIPPED = ParametricHull(  # tools/make_database.py, entrance and origin as its source text says
    length=115.0,
    breadth=25.0,
    draught=6.4,
    entrance_length=46.77395891238753,
    run_length=34.5,
    transom_breadth_fraction=0.75,
    transom_draught_fraction=0.2,
    section_exponent=6.0,
    origin_from_transom=55.298818409692544,
)
BAND = (0.8, 1.3)
SWAY_HEAVE = [1, 2]


@cache
def panel() -> HydroDatabase:
    return shipped_database()


@cache
def inside() -> np.ndarray:
    return np.flatnonzero((panel().omega > BAND[0] - 1e-9) & (panel().omega < BAND[1] + 1e-9))


@cache
def strip() -> HydroDatabase:
    """The shipped hull at the shipped frequencies of the band."""
    return hydro_from_hull(
        SHIPPED,
        center_of_gravity=[0.0, 0.0, 1.878390],
        mass=14.0e6,
        omega=panel().omega[inside()],
        heading=panel().heading[::9],
    )


def differences(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Difference of sway and heave (n, 2), and the panel method's values."""
    one = np.asarray(getattr(panel(), name))[inside()][:, SWAY_HEAVE, SWAY_HEAVE]
    other = np.asarray(getattr(strip(), name))[:, SWAY_HEAVE, SWAY_HEAVE]
    return np.abs(other - one), one


def test_the_shipped_database_is_of_this_hull() -> None:
    assert str(SHIPPED) in panel().source
    np.testing.assert_allclose(strip().restoring, panel().restoring, rtol=1e-6, atol=1.0)
    np.testing.assert_allclose(strip().mass_matrix, panel().mass_matrix, rtol=1e-6, atol=1e-2)


def test_sway_and_heave_agree_to_a_tenth_of_the_largest_value_in_the_band() -> None:
    for name in ("added_mass", "damping"):
        difference, value = differences(name)
        np.testing.assert_array_less(difference / value.max(axis=0), 0.1)


def test_sway_and_heave_agree_at_each_frequency() -> None:
    """A tenth of the panel method's value at the same frequency, but for two three-dimensional effects.

    A22 falls to a sixth over the band, and the absolute difference stays: 0.14 at its end. B33: 0.11.
    """
    mass, of_mass = differences("added_mass")
    damping, of_damping = differences("damping")
    mass, damping = mass / of_mass, damping / of_damping
    slow = panel().omega[inside()] < 1.12
    assert mass[slow, 0].max() < 0.1
    assert mass[:, 0].max() < 0.14
    assert mass[:, 1].max() < 0.1
    assert damping[:, 0].max() < 0.1
    assert damping[:, 1].max() < 0.11


def test_wave_forces_agree_in_phase_and_size() -> None:
    """Complex, at 45, 90 and 135 deg, by the largest of the panel method over these headings."""
    one, other = panel().force[::9][1:4, inside()], strip().force[1:4]
    error = np.abs(other - one).max(axis=(0, 1)) / np.abs(one).max(axis=(0, 1))
    np.testing.assert_array_less(error[[1, 2, 3, 5]], [0.06, 0.12, 0.11, 0.18])
    # A wrong sign, heading or phase would give errors of one and more.
    conjugate = np.abs(other.conj() - one).max(axis=(0, 1)) / np.abs(one).max(axis=(0, 1))
    assert conjugate.min() > 0.5


def slender() -> Hull:
    return Hull.from_offsets(wigley_offsets(100.0, 10.0, 5.0, 8)).remeshed(stations=24, girth=5)


def test_capytaine_gives_the_same_kind_of_database() -> None:
    pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    grid = {"omega": [0.05, 0.9, 1.1], "heading": np.radians([0.0, 90.0, 120.0])}
    centre = [float(slender().hydrostatics.center_of_buoyancy[0]), 0.0, -1.5]
    one = hydro_from_hull(slender(), center_of_gravity=centre, method="capytaine", **grid)
    other = hydro_from_hull(slender(), center_of_gravity=centre, method="strip", **grid)
    assert "Capytaine 3" in one.source
    assert one.zero_frequency_added_mass is not None
    np.testing.assert_array_equal(one.restoring, other.restoring)
    np.testing.assert_array_equal(one.added_mass, one.added_mass.swapaxes(1, 2))
    assert np.all(one.force[0, :, 1::2] == 0.0)
    statics = slender().hydrostatics
    assert one.force[0, 0, 2].real == pytest.approx(1025.0 * 9.81 * statics.waterplane_area, rel=0.02)
    for name in ("added_mass", "damping"):
        a, b = (np.asarray(getattr(d, name))[1:, SWAY_HEAVE, SWAY_HEAVE] for d in (one, other))
        np.testing.assert_allclose(b, a, rtol=0.15)
    largest = np.abs(one.force[:, 1:]).max(axis=(0, 1))
    error = np.abs(other.force[:, 1:] - one.force[:, 1:]).max(axis=(0, 1)) / largest
    np.testing.assert_array_less(error[SWAY_HEAVE], 0.08)


def test_capytaine_one_heading_one_frequency_and_too_many_panels() -> None:
    pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    hull = slender().at_centre_of_buoyancy()
    single = hydro_from_hull(
        hull, center_of_gravity=[0.0, 0.0, -1.5], method="capytaine", omega=[1.0], heading=[1.0]
    )
    assert single.force.shape == (1, 1, 6)
    fine = hull.remeshed(stations=170, girth=24)
    with pytest.raises(ValueError, match="too many for Capytaine"):
        hydro_from_hull(
            fine, center_of_gravity=[0.0, 0.0, -1.5], method="capytaine", omega=[1.0], heading=[1.0]
        )


@pytest.mark.slow("panels")
def test_the_difference_to_strip_theory_is_that_of_the_ends() -> None:
    """With a parallel midbody of one more length, the ends and with them the errors weigh half as much."""
    pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    omega, heading = np.array([1.0, 1.2]), np.array([np.pi])
    errors = []
    for more in (0.0, 115.0):
        longer = replace(SHIPPED, length=115.0 + more, origin_from_transom=0.0)
        hull = Hull.from_parametric(longer, stations=round(34 * (1 + more / 115.0)), girth=12)
        hull = hull.at_centre_of_buoyancy()
        both = [
            hydro_from_hull(
                hull,
                center_of_gravity=[0.0, 0.0, 1.0],
                method=method,
                omega=omega,
                heading=heading,
                stations=61,
            )
            for method in ("capytaine", "strip")
        ]
        a22, b33 = (
            np.abs(getattr(both[1], name)[:, i, i] / getattr(both[0], name)[:, i, i] - 1.0)
            for name, i in (("added_mass", 1), ("damping", 2))
        )
        errors.append(np.concatenate([a22, b33]))
    assert np.all(errors[1] < 0.7 * errors[0])


@pytest.mark.slow("panels")
def test_capytaine_reproduces_the_shipped_database() -> None:
    pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    hull = Hull.from_parametric(SHIPPED, stations=56, girth=20)
    i = int(np.abs(panel().omega - 1.0).argmin())
    found = hydro_from_hull(
        hull,
        center_of_gravity=[0.0, 0.0, 1.878390],
        mass=14.0e6,
        method="capytaine",
        omega=panel().omega[[i]],
        heading=panel().heading[[27]],
    )
    for name in ("added_mass", "damping"):
        one, other = getattr(panel(), name)[i], getattr(found, name)[0]
        scale = np.sqrt(np.outer(np.diag(one), np.diag(one)))
        np.testing.assert_array_less(np.abs(other - one) / scale, 0.01)  # the lid's panels differ
    np.testing.assert_allclose(found.force[0, 0], panel().force[27, i], rtol=0.01)


def test_the_mesh_is_checked_when_asked_for() -> None:
    """A coarse box warns and names its entries; a fine Wigley hull tells how far it is from there."""
    box = OffsetTable(x=[-20.0, 20.0], sections=([[5.0, 0.0], [5.0, -4.0], [0.0, -4.0]],) * 2)
    coarse = Hull.from_offsets(box).remeshed(stations=14, girth=5)
    some: dict[str, Any] = {
        "center_of_gravity": (0.0, 0.0, -1.5),
        "omega": [0.5, 0.8, 1.1],
        "heading": [0.0, 1.5, 3.1],
    }
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        checked = hydro_from_hull(coarse, method="strip", stations=11, check=True, **some)
    found = re.search(r"with (\d+) in place of (\d+) panels ([AB]\d\d) changes by ([\d.]+)%", checked.source)
    assert found is not None
    assert 0.3 < int(found[1]) / int(found[2]) < 0.8
    warned = [each for each in told if issubclass(each.category, MeshConvergenceWarning)]
    assert bool(warned) == (float(found[4]) > 5.0)
    plain = hydro_from_hull(coarse, method="strip", stations=11, **some)
    assert np.array_equal(plain.added_mass, checked.added_mass)
    assert "in place of" not in plain.source


def test_a_mesh_that_has_not_converged_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Heave damping a tenth larger on the coarse mesh."""
    solve = hull_database.strip_solution

    def off(hull: Hull, **given: Any) -> HullSolution:
        found = solve(hull, **given)
        factor = np.ones((6, 6))
        factor[2, 2] = 1.1 if "remeshed" in hull.source else 1.0
        return replace(found, damping=found.damping * factor)

    monkeypatch.setattr(hull_database, "strip_solution", off)
    hull = Hull.from_offsets(wigley_offsets(100.0, 10.0, 5.0, 24))
    with pytest.warns(MeshConvergenceWarning, match=r"these change, by their largest: .*B33 (9|10|11)\.\d%"):
        hydro_from_hull(hull, center_of_gravity=(0, 0, -2), omega=[0.5, 0.8], heading=[0.0, 3.1], check=True)
