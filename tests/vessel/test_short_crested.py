"""Statistics of motions in short-crested seas and at forward speed."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from veres_writer import VeresRun

from seacrane import Scene, SceneError, cases, linear_model, motion_rao, response_statistics
from seacrane.analysis import response_summed
from seacrane.arrays import Array
from seacrane.hydro import HydroDatabase, motion_response, read_veres, shipped_database
from seacrane.hydro.data.motion import encounter_frequency
from seacrane.sea import Spreading, cos_2s, cos_n, jonswap
from seacrane.warnings import EncounterFrequencyWarning

SEA = jonswap(hs=2.0, tp=9.0)


@pytest.mark.parametrize("spreading", [cos_2s(4.0), cos_n(2.0)])
def test_it_is_the_sum_over_a_realised_sea(spreading: Spreading) -> None:
    """One direction for each of many components: another quadrature of the same double integral."""
    scene = cases.vessel(hs=0.0)
    alone, asked = linear_model(scene), {"body": "vessel", "point": (40.0, 10.0, 15.0)}
    found = response_statistics(alone, spectrum=SEA, direction=2.2, spreading=spreading, **asked)
    scene.add_sea(hs=2.0, tp=9.0, direction_deg=np.degrees(2.2), spreading=spreading, count=6000)
    summed = response_summed(alone, waves=scene.waves, **asked)
    np.testing.assert_allclose(found.std[2:], summed.std[2:], rtol=0.004)


def axisymmetric() -> HydroDatabase:
    """A body of revolution without couplings: surge ~ cos, sway ~ sin, heave the same from everywhere."""
    base, eye = shipped_database(), np.eye(6)
    heading = np.radians(np.arange(0.0, 360.0, 5.0))
    pattern = np.zeros((len(heading), 6))
    pattern[:, 0], pattern[:, 1], pattern[:, 2] = np.cos(heading), np.sin(heading), 1.0
    force = pattern[:, None, :] * np.abs(base.force[18, :, 2])[None, :, None]
    matrices = {name: eye * getattr(base, name) for name in ("added_mass", "damping")}
    for table in matrices.values():
        table[:, 0, 0] = table[:, 1, 1]
    return replace(
        base, heading=heading, force=force, memory=None, drift=None, motion_rao=None,
        port_starboard_symmetric=False, mass_matrix=eye * base.mass_matrix, restoring=eye * base.restoring,
        linear_damping=eye * base.linear_damping + 1e5 * np.diag([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        infinite_frequency_added_mass=None, zero_frequency_added_mass=None, **matrices,
    )  # fmt: skip


@pytest.mark.parametrize("s", [1.0, 3.5])
def test_a_body_of_revolution_in_closed_form(s: float) -> None:
    """Heave knows no spreading. Surge and sway share theirs by E cos(2 a) = s (s - 1) / ((s + 1) (s + 2))."""
    database = axisymmetric()
    scene = free(database, 120.0)

    def variance(spreading: Spreading | None) -> Array:
        found = response_statistics(
            scene, database=database, spectrum=SEA, direction=0.0, body="vessel", memory="database",
            spreading=spreading,
        )  # fmt: skip
        return np.asarray(found.moments[:, 0])

    along, spread = variance(None), variance(cos_2s(s))
    double = s * (s - 1.0) / ((s + 1.0) * (s + 2.0))
    assert spread[2] == pytest.approx(along[2], rel=1e-12)
    assert spread[0] == pytest.approx(along[0] * 0.5 * (1.0 + double), rel=1e-6)
    assert spread[1] == pytest.approx(along[0] * 0.5 * (1.0 - double), rel=1e-6)


def ship_at(speed: float, folder: Path) -> tuple[HydroDatabase, HydroDatabase]:
    """A ship at rest and at speed, with the terms of strip theory."""
    stem = VeresRun(speeds=(0.0, speed), heading_deg=np.arange(0.0, 181.0, 15.0)).write(folder)
    return read_veres(stem, speed=0.0), read_veres(stem, speed=speed)


def free(database: HydroDatabase, mooring: float | None) -> Scene:
    with warnings.catch_warnings(action="ignore"):
        scene = Scene()
        scene.add_vessel(database, memory="convolution", mooring=mooring)
    return scene


@pytest.mark.parametrize("speed", [5.0, -3.0])
def test_motions_at_speed_are_those_of_the_databases_equations(speed: float, tmp_path: Path) -> None:
    """`motion_response`, which returns the motions that the files hold, at every heading and frequency."""
    nothing = {"linear_damping": np.zeros((6, 6)), "quadratic_damping": np.zeros(6), "roll_damping": None}
    still, moving = (replace(one, **nothing) for one in ship_at(speed, tmp_path))
    found = motion_rao(
        free(still, None), database=moving, omega=moving.omega, direction=moving.heading[:, None],
        body="vessel", memory="database",
    )  # fmt: skip
    expected = motion_response(moving)
    known = np.isfinite(expected[..., 2]) & (np.abs(encounter_frequency(moving)) > 0.3)
    assert known.sum() > 400
    scale = np.abs(expected[known]).max(axis=0)
    np.testing.assert_array_less(np.abs(found - expected)[known].max(axis=0), 1e-4 * scale)


@pytest.mark.parametrize("heading_deg", [180.0, 20.0])
def test_moments_are_those_of_the_spectrum_of_encounter(heading_deg: float, tmp_path: Path) -> None:
    """Sorted by the frequency of encounter w - U w^2 cos(b) / g in narrow bands; energy is neither lost nor
    made."""
    still, moving = ship_at(5.0, tmp_path)
    sea, heading = jonswap(hs=1.0, tp=7.0), np.radians(heading_deg)
    asked = {"database": moving, "direction": heading, "body": "vessel", "memory": "database"}
    with warnings.catch_warnings(action="ignore", category=EncounterFrequencyWarning):
        found = response_statistics(free(still, 60.0), spectrum=sea, **asked)
    omega = np.linspace(moving.omega[0], moving.omega[-1], 3001)
    rao = motion_rao(free(still, 60.0), omega=omega, **asked)
    energy = np.abs(rao[:, 2]) ** 2 * np.asarray(sea.density(omega)) * (omega[1] - omega[0])
    met = np.abs(omega - omega**2 * 5.0 * np.cos(heading) / moving.g)
    bands, edges = np.histogram(met, bins=2000, weights=energy)
    middle = 0.5 * (edges[1:] + edges[:-1])
    moments = [np.sum(bands * middle**n) for n in (0, 2)]
    np.testing.assert_allclose(moments, found.moments[2, :2], rtol=2e-3)


@pytest.mark.warns("UndampedModeWarning")
def test_waves_met_outside_the_table_and_speeds_that_do_not_belong_together_are_told(tmp_path: Path) -> None:
    still, fast = ship_at(10.0, tmp_path)
    asked: dict[str, Any] = {"direction": 0.0, "body": "vessel"}
    sea = {"spectrum": jonswap(hs=1.0, tp=6.0), "spreading": cos_2s(10.0)}
    scene = free(still, 60.0)
    with pytest.warns(EncounterFrequencyWarning, match="at 10 m/s"):
        found = response_statistics(scene, database=fast, memory="database", **sea, **asked)
    assert np.all(np.isfinite(found.moments))
    under_way = linear_model(scene, memory="database", database=fast)
    with pytest.raises(SceneError, match=r"10 m/s.* 0"):
        response_statistics(scene, database=fast, **sea, **asked)
    with pytest.raises(SceneError, match=r"0 m/s.* 10 m/s"):
        motion_rao(under_way, database=still, omega=0.6, **asked)
