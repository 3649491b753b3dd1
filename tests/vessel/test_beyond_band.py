"""Loads beyond the frequencies of a database: long-wave limit, nothing above, what is left out, warnings."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Scene, SceneError, response_statistics
from seacrane.arrays import Array
from seacrane.hydro import HydroDatabase, hydro_from_hull, natural_frequency, shipped_database
from seacrane.hydro.hull.hull import shipped_hull
from seacrane.inputs.frames import MOTIONS
from seacrane.scene.sea_loads import without_load
from seacrane.sea import jonswap, realise_waves
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import BelowBandWarning

HEADINGS = np.radians([0.0, 30.0, 45.0, 75.0, 90.0, 135.0, 180.0])
LENGTH, BREADTH, DRAUGHT, DEPTH = 60.0, 14.0, 4.0, 20.0


def cut(low: float, high: float) -> HydroDatabase:
    """The shipped table with its ends taken away."""
    return shipped_database().select(omega=(low - 1e-9, high + 1e-9))


@pytest.mark.parametrize("depth", [np.inf, 15.0])
def test_the_longest_waves_lift_the_hull_by_its_restoring(depth: float) -> None:
    database = replace(cut(0.3, 2.5), depth=depth)
    found = database.force_at([0.0, 1e-6], HEADINGS[:, None], outside="limits")
    heave = np.broadcast_to(database.restoring[:, 2], found.shape)
    np.testing.assert_allclose(found, heave, atol=1e-4 * np.abs(heave).max())


def test_loads_meet_at_the_ends_of_the_band_and_stay_within_it() -> None:
    database = cut(0.3, 2.5)
    inside = np.linspace(0.3, 2.5, 50)
    np.testing.assert_array_equal(
        database.force_at(inside, 0.7), database.force_at(inside, 0.7, outside="limits")
    )
    end, just_below = (database.force_at(w, 0.7, outside="limits") for w in (0.3, 0.3 * (1.0 - 1e-6)))
    np.testing.assert_allclose(just_below, end, atol=1e-5 * np.abs(end).max())
    assert np.all(database.force_at([2.5001, 4.0], 0.7, outside="limits") == 0.0)
    with pytest.raises(SceneError, match=r"omega = 2.6 rad/s.*outside='limits'"):
        database.force_at([1.0, 2.6], 0.0, outside="error")


def below_band_error(low: float) -> float:
    """Largest error from 0.1 rad/s to the cut, over the largest force of its motion."""
    full = shipped_database()
    omega = np.arange(0.1, low - 1e-6, 0.05)[:, None]
    size = np.abs(full.force).max(axis=(0, 1))
    got = cut(low, 3.1).force_at(omega, HEADINGS, outside="limits")
    return float((np.abs(got - full.force_at(omega, HEADINGS)) / size).max())


def test_a_table_cut_from_below_gives_back_what_it_lost() -> None:
    """No load there would err by 1; the error falls at least with the square of the frequency."""
    errors = np.array([below_band_error(low) for low in (0.6, 0.45, 0.3)])
    assert errors[2] < 0.04 and errors[0] < 0.5
    orders = np.log(errors[:-1] / errors[1:]) / np.log([0.6 / 0.45, 0.45 / 0.3])
    assert np.all(orders > 2.0)


def froude_krylov_box(omega: Array) -> NDArray[np.complex128]:
    """Undisturbed pressure of a following wave on the bottom of a box, in closed form (heave, pitch)."""
    k = wavenumber(omega, g=9.81, depth=DEPTH)
    pressure = 1025.0 * 9.81 * np.cosh(k * (DEPTH - DRAUGHT)) / np.cosh(k * DEPTH)
    half = 0.5 * k * LENGTH
    force = np.zeros((omega.size, 6), dtype=complex)
    force[:, 2] = pressure * BREADTH * 2.0 * np.sin(half) / k
    force[:, 4] = 2.0j * pressure * BREADTH * (np.sin(half) - half * np.cos(half)) / k**2
    return force


def test_a_box_in_shallow_water_follows_its_closed_form_below_the_table() -> None:
    omega = np.linspace(0.2, 1.5, 27)
    base = shipped_database().select(omega=slice(0, omega.size))
    stiffness = 1025.0 * 9.81 * LENGTH * BREADTH
    box = replace(
        base, omega=omega, depth=DEPTH, rho=1025.0, g=9.81, memory=None, trusted_band=None,
        restoring=np.diag([0.0, 0.0, stiffness, 1e7, stiffness * LENGTH**2 / 12.0, 0.0]),
        force=np.broadcast_to(froude_krylov_box(omega), base.force.shape).copy(),
    )  # fmt: skip
    longer = np.linspace(0.01, 0.19, 10)
    error = np.abs(box.force_at(longer, 0.0, outside="limits") - froude_krylov_box(longer))
    size = np.abs(froude_krylov_box(omega)).max(axis=0)
    assert np.all(error[:, [2, 4]] < 0.02 * size[[2, 4]])


def sea_above(high: float, tp: float, heading: float) -> tuple[HydroDatabase, dict[str, Array]]:
    """A table that ends early, and the components of a sea that the shipped one holds in full."""
    waves = realise_waves(jonswap(hs=2.0, tp=tp), seed=1, direction=heading, count=200, maximum_omega=3.1)
    sea = {name: np.array(getattr(waves, name)) for name in ("omega", "amplitude", "direction")}
    part = cut(0.1, high)
    return part, sea | {"force": part.force_at(sea["omega"], sea["direction"], outside="limits")}


@pytest.mark.parametrize("high", [1.5, 2.0])
@pytest.mark.parametrize("heading", HEADINGS)
def test_what_carries_no_load_is_estimated_within_a_factor_of_three(high: float, heading: float) -> None:
    """Against the true forces that were cut away; loads that the heading does not excite are left out."""
    part, sea = sea_above(high, 4.5, heading)
    found = without_load(part, **sea)
    above = sea["omega"] > high
    energy = 0.5 * sea["amplitude"] ** 2
    assert found.energy == pytest.approx(energy[above].sum() / energy.sum(), rel=1e-12)
    each = energy[:, None] * np.abs(shipped_database().force_at(sea["omega"], sea["direction"])) ** 2
    whole = each.sum(axis=0)
    excited = whole > 1e-6 * np.array([1.0, 1.0, 1.0, 1e3, 1e3, 1e3]) * whole[:3].max()
    truth = float(np.max(each[above].sum(axis=0)[excited] / whole[excited]))
    assert truth / 3.0 < found.variance < 3.0 * truth
    assert found.load in MOTIONS


def test_a_sea_within_the_band_leaves_nothing_out() -> None:
    part, sea = sea_above(3.1, 6.0, 1.0)
    assert without_load(part, **sea).energy == without_load(part, **sea).variance == 0.0
    part, sea = sea_above(2.0, 6.0, np.pi)
    assert without_load(part, **sea).load in ("surge", "heave", "pitch")  # of a head sea, not roll


@cache
def strip() -> HydroDatabase:
    """Few stations of the shipped hull: its band begins where a wave is as long as the ship."""
    return hydro_from_hull(
        shipped_hull(), center_of_gravity=[0.0, 0.0, 1.878390], mass=14.0e6, omega=np.arange(0.3, 2.0, 0.1),
        heading=np.radians([0.0, 45.0, 90.0, 135.0, 180.0]), roll_damping_fraction=0.05, stations=11,
    )  # fmt: skip


@pytest.mark.warns("MemoryFitWarning")
def test_what_is_below_the_band_is_named() -> None:
    """Strip theory begins with waves as long as the ship; unless a band of its own is given."""
    assert strip().trusted_band[0] == pytest.approx(np.sqrt(2.0 * np.pi * 9.81 / 115.0), rel=1e-3)
    at, scene = natural_frequency(strip(), 3), Scene()
    with pytest.warns(BelowBandWarning, match=rf"roll at {at:.3g} rad/s.*capytaine"):
        scene.add_vessel(strip(), memory="none")
    with warnings.catch_warnings(action="error", category=BelowBandWarning):
        Scene().add_vessel(replace(strip(), trusted_band=(0.3, 1.8)), memory="none")
    for tp, count in ((6.0, 0), (12.0, 2)):
        with warnings.catch_warnings(record=True, action="always") as seen:
            scene.copy().add_sea(hs=2.0, tp=tp, direction_deg=90.0, seed=1)
            spectrum = jonswap(hs=2.0, tp=tp)
            response_statistics(scene, spectrum=spectrum, direction=0.5 * np.pi, body="vessel")
        told = [str(one.message) for one in seen if one.category is BelowBandWarning]
        assert len(told) == count and all("0.73" in one for one in told)
