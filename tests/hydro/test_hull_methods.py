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

from seacrane.hydro import Hull, HydroDatabase, ParametricHull, hydro_from_hull, shipped_database
from seacrane.hydro.hull import hull_database
from seacrane.hydro.hull.solution import HullSolution
from seacrane.warnings import MeshConvergenceWarning

SHIPPED = ParametricHull(  # tools/make_database.py, entrance and origin as its source text says
    length=115.0, breadth=25.0, draught=6.4, entrance_length=46.77395891238753, run_length=34.5,
    transom_breadth_fraction=0.75, transom_draught_fraction=0.2, section_exponent=6.0,
    origin_from_transom=55.298818409692544,
)  # fmt: skip
OF_SHIPPED: dict[str, Any] = {"center_of_gravity": [0.0, 0.0, 1.878390], "mass": 14.0e6}
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
    grid = {"omega": panel().omega[inside()], "heading": panel().heading[::9]}
    return hydro_from_hull(SHIPPED, **OF_SHIPPED, **grid)


def test_sway_and_heave_agree_at_each_frequency() -> None:
    """A tenth of the panel method's value at the same frequency, but for two three-dimensional effects.

    A22 falls to a sixth over the band, and the absolute difference stays: 0.14 at its end. B33: 0.11.
    """
    assert str(SHIPPED) in panel().source
    np.testing.assert_allclose(strip().restoring, panel().restoring, rtol=1e-6, atol=1.0)
    np.testing.assert_allclose(strip().mass_matrix, panel().mass_matrix, rtol=1e-6, atol=1e-2)
    slow = panel().omega[inside()] < 1.12
    for name, bounds in (("added_mass", [0.14, 0.1]), ("damping", [0.1, 0.11])):
        one = np.asarray(getattr(panel(), name))[inside()][:, SWAY_HEAVE, SWAY_HEAVE]
        off = np.abs(np.asarray(getattr(strip(), name))[:, SWAY_HEAVE, SWAY_HEAVE] - one)
        assert np.all(off / one.max(axis=0) < 0.1)
        assert np.all(off / one < bounds) and (off / one)[slow, 0].max() < 0.1


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
    hull, statics = slender(), slender().hydrostatics
    given: dict[str, Any] = {"omega": [0.05, 0.9, 1.1], "heading": np.radians([0.0, 90.0, 120.0])}
    given["center_of_gravity"] = [float(statics.center_of_buoyancy[0]), 0.0, -1.5]
    one, other = (hydro_from_hull(hull, method=method, **given) for method in ("capytaine", "strip"))
    assert "Capytaine 3" in one.source and one.zero_frequency_added_mass is not None
    np.testing.assert_array_equal(one.restoring, other.restoring)
    np.testing.assert_array_equal(one.added_mass, one.added_mass.swapaxes(1, 2))
    assert np.all(one.force[0, :, 1::2] == 0.0)
    assert one.force[0, 0, 2].real == pytest.approx(1025.0 * 9.81 * statics.waterplane_area, rel=0.02)
    for name in ("added_mass", "damping"):
        a, b = (np.asarray(getattr(d, name))[1:, SWAY_HEAVE, SWAY_HEAVE] for d in (one, other))
        np.testing.assert_allclose(b, a, rtol=0.15)
    largest = np.abs(one.force[:, 1:]).max(axis=(0, 1))
    error = np.abs(other.force[:, 1:] - one.force[:, 1:]).max(axis=(0, 1)) / largest
    np.testing.assert_array_less(error[SWAY_HEAVE], 0.08)
    single = {**given, "omega": [1.0], "heading": [1.0], "method": "capytaine"}
    assert hydro_from_hull(hull, **single).force.shape == (1, 1, 6)
    with pytest.raises(ValueError, match="too many for Capytaine"):
        hydro_from_hull(hull.remeshed(stations=170, girth=24), **single)


@pytest.mark.slow("panels")
def test_capytaine_reproduces_the_shipped_database() -> None:
    pytest.importorskip("capytaine", reason="capytaine absent: pip install .[hydro]")
    hull = Hull.from_parametric(SHIPPED, stations=56, girth=20)
    i = int(np.abs(panel().omega - 1.0).argmin())
    grid = {"omega": panel().omega[[i]], "heading": panel().heading[[27]]}
    found = hydro_from_hull(hull, method="capytaine", **OF_SHIPPED, **grid)
    for name in ("added_mass", "damping"):
        one, other = getattr(panel(), name)[i], getattr(found, name)[0]
        scale = np.sqrt(np.outer(np.diag(one), np.diag(one)))
        np.testing.assert_array_less(np.abs(other - one) / scale, 0.01)  # the lid's panels differ
    np.testing.assert_allclose(found.force[0, 0], panel().force[27, i], rtol=0.01)


def test_a_mesh_is_checked_when_asked_for_and_named_when_it_has_not_converged(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Heave damping a tenth larger on the coarse mesh."""
    hull = Hull.from_offsets(wigley_offsets(100.0, 10.0, 5.0, 24))
    given: dict[str, Any] = {"center_of_gravity": (0, 0, -2), "omega": [0.5, 0.8], "heading": [0.0, 3.1]}
    with warnings.catch_warnings():
        warnings.simplefilter("error", MeshConvergenceWarning)
        plain, checked = (hydro_from_hull(hull, check=check, **given) for check in (False, True))
    found = re.search(r"with (\d+) in place of (\d+) panels ([AB]\d\d) changes by ([\d.]+)%", checked.source)
    assert found is not None and 0.3 < int(found[1]) / int(found[2]) < 0.9 and float(found[4]) < 5.0
    assert np.array_equal(plain.added_mass, checked.added_mass) and "in place of" not in plain.source
    solve = hull_database.strip_solution

    def off(hull: Hull, **given: Any) -> HullSolution:
        found = solve(hull, **given)
        factor = np.ones((6, 6))
        factor[2, 2] = 1.1 if "remeshed" in hull.source else 1.0
        return replace(found, damping=found.damping * factor)

    monkeypatch.setattr(hull_database, "strip_solution", off)
    with pytest.warns(MeshConvergenceWarning, match=r"B33 (9|10|11)\.\d%"):
        hydro_from_hull(hull, check=True, **given)
