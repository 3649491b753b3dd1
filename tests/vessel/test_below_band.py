"""Databases used below their trusted band say so, by their resonances and by their waves."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from seacrane import Scene, response_statistics
from seacrane.hydro import HydroDatabase, hydro_from_hull, natural_frequency, shipped_database
from seacrane.hydro.hull.shipped_hull import shipped_hull
from seacrane.sea import jonswap
from seacrane.warnings import BelowBandWarning


@cache
def strip() -> HydroDatabase:
    """Few stations of the shipped hull: its band begins where a wave is as long as the ship."""
    return hydro_from_hull(
        shipped_hull(),
        center_of_gravity=[0.0, 0.0, 1.878390],
        mass=14.0e6,
        omega=np.arange(0.3, 2.0, 0.1),
        heading=np.radians([0.0, 45.0, 90.0, 135.0, 180.0]),
        roll_damping_fraction=0.05,
        stations=11,
    )


def vessel(database: HydroDatabase) -> Scene:
    scene = Scene(name="below")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", BelowBandWarning)
        scene.add_vessel(database, memory="none")
    return scene


def test_the_band_of_strip_theory_begins_with_waves_as_long_as_the_ship() -> None:
    band = strip().trusted_band
    assert band is not None and band[0] == pytest.approx(np.sqrt(2.0 * np.pi * 9.81 / 115.0), rel=1e-3)


@pytest.mark.warns("MemoryFitWarning")
def test_a_resonance_below_the_band_is_named() -> None:
    at = natural_frequency(strip(), 3)
    assert at is not None and at < 0.73
    with pytest.warns(BelowBandWarning, match=rf"roll at {at:.3g} rad/s.*method='capytaine'"):
        Scene().add_vessel(strip(), memory="none")


def test_damping_below_the_band_is_what_the_warning_says() -> None:
    """Several times too large in roll, more in pitch and yaw; within the band it is not."""
    below, within = (int(np.argmin(np.abs(strip().omega - omega))) for omega in (0.4, 0.9))
    panels = shipped_database().select(omega=(0.3, 1.95), every=2)
    np.testing.assert_allclose(panels.omega, strip().omega, rtol=1e-9)
    ratio = (
        np.diagonal(strip().damping, axis1=1, axis2=2)[:, 3:]
        / np.diagonal(panels.damping, axis1=1, axis2=2)[:, 3:]
    )
    assert ratio[below, 0] > 2.5
    assert ratio[below, 1:].min() > 5.0
    assert ratio[within].max() < 1.6


def test_a_band_of_ones_own_is_believed() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error", BelowBandWarning)
        Scene().add_vessel(replace(strip(), trusted_band=(0.3, 1.8)), memory="none")
        Scene().add_vessel(shipped_database(), memory="none")


@pytest.mark.warns("MemoryFitWarning")
@pytest.mark.parametrize(("tp", "named"), [(6.0, False), (12.0, True)])
def test_waves_below_the_band_are_named(tp: float, named: bool) -> None:
    scene = vessel(strip())
    with warnings.catch_warnings(record=True) as seen:
        warnings.simplefilter("always")
        scene.add_sea(hs=2.0, tp=tp, direction_deg=90.0, seed=1)
        spectrum = jonswap(hs=2.0, tp=tp)
        response_statistics(scene, spectrum=spectrum, direction=0.5 * np.pi, body="vessel")
    told = [str(one.message) for one in seen if one.category is BelowBandWarning]
    assert len(told) == 2 * named
    assert all("0.73" in one and "method='capytaine'" in one for one in told)


@pytest.mark.warns("MemoryFitWarning")
def test_other_sources_are_not_sent_to_another_method() -> None:
    scene = vessel(replace(strip(), source="a table"))
    with pytest.warns(BelowBandWarning, match="covers these frequencies"):
        scene.add_sea(hs=2.0, tp=14.0, direction_deg=90.0)
