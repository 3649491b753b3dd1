"""Statistics of motions in short-crested seas and at forward speed."""

from __future__ import annotations

import itertools
import warnings
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from veres_writer import VeresRun

from seacrane import Scene, SceneError, cases, linear_model, motion_rao, response_statistics, simulate
from seacrane.analysis import LinearModel, ResponseStatistics, response_summed
from seacrane.hydro import HydroDatabase, motion_response, read_veres, shipped_database
from seacrane.hydro.data.encounter import encounter_frequency
from seacrane.sea import Spreading, cos_2s, cos_n, jonswap
from seacrane.warnings import EncounterFrequencyWarning

Array = NDArray[np.float64]
SEA = jonswap(hs=2.0, tp=9.0)
TIP = (40.0, 10.0, 15.0)


@cache
def alone() -> LinearModel:
    """The shipped hull, linearised."""
    return linear_model(cases.vessel(hs=0.0))


def statistics(
    spreading: Spreading | None, *, heading: float = 2.2, point: object = TIP
) -> ResponseStatistics:
    return response_statistics(
        alone(), spectrum=SEA, direction=heading, body="vessel", point=TIP,
        spreading=spreading,
    )  # fmt: skip


@pytest.mark.parametrize("kind", [cos_2s, cos_n])
def test_narrow_spreading_is_a_long_crested_sea(kind: Any) -> None:
    """The difference falls with the variance of the angle, so as the inverse of the exponent."""
    along = statistics(None).std
    far, near = (statistics(kind(s)).std / along - 1.0 for s in (500.0, 5000.0))
    assert np.abs(near).max() < 2e-3
    np.testing.assert_allclose(far, 10.0 * near, rtol=0.1)


@pytest.mark.parametrize("spreading", [cos_2s(4.0), cos_n(2.0)])
def test_it_is_the_sum_over_a_realised_sea(spreading: Spreading) -> None:
    """One direction for each of many components: another quadrature of the same double integral."""
    scene = cases.vessel(hs=0.0)
    scene.add_sea(hs=2.0, tp=9.0, direction_deg=np.degrees(2.2), spreading=spreading, count=6000)
    summed = response_summed(alone(), body="vessel", point=TIP, waves=scene.waves)
    np.testing.assert_allclose(statistics(spreading).std[2:], summed.std[2:], rtol=0.004)


def test_the_quadrature_over_directions_has_converged(monkeypatch: pytest.MonkeyPatch) -> None:
    some = statistics(cos_2s(2.0))
    monkeypatch.setitem(response_statistics.__wrapped__.__globals__, "HEADINGS", 150)  # type: ignore[attr-defined]
    np.testing.assert_allclose(some.std, statistics(cos_2s(2.0)).std, rtol=1e-3)
    assert some.direction_share.sum() == pytest.approx(1.0)


def axisymmetric() -> HydroDatabase:
    """A body of revolution without couplings: surge ~ cos, sway ~ sin, heave the same from everywhere."""
    base = shipped_database()
    eye = np.eye(6)
    heading = np.radians(np.arange(0.0, 360.0, 5.0))
    shape = np.abs(base.force[18, :, 2])
    pattern = np.zeros((len(heading), 6))
    pattern[:, 0], pattern[:, 1], pattern[:, 2] = np.cos(heading), np.sin(heading), 1.0
    round_ = np.diag([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
    matrices: dict[str, Any] = {}
    for name in ("added_mass", "damping"):
        table = eye * getattr(base, name)
        table[:, 0, 0] = table[:, 1, 1]
        matrices[name] = table
    return replace(
        base, heading=heading, force=pattern[:, None, :] * shape[None, :, None], memory=None, drift=None,
        motion_rao=None, port_starboard_symmetric=False, mass_matrix=eye * base.mass_matrix,
        restoring=eye * base.restoring, linear_damping=eye * base.linear_damping + 1e5 * round_,
        infinite_frequency_added_mass=None, zero_frequency_added_mass=None, **matrices,
    )  # fmt: skip


@pytest.mark.parametrize("s", [1.0, 3.5, 25.0])
def test_a_body_of_revolution_in_closed_form(s: float) -> None:
    """Heave knows no spreading. Surge and sway share theirs by E cos(2 a) = s (s - 1) / ((s + 1) (s + 2))."""
    database = axisymmetric()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = Scene()
        scene.add_vessel(database, memory="convolution")

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


@pytest.mark.slow("a long run")
def test_a_run_in_a_low_short_crested_sea_has_these_statistics() -> None:
    """Twenty minutes, within three standard deviations of what a record of that length scatters."""
    scene = cases.vessel(hs=0.0, memory="passive")
    scene.add_sea(hs=0.1, tp=9.0, direction_deg=126.0, spreading=cos_2s(4.0), count=400, seed=5)
    expected = response_statistics(
        cases.vessel(hs=0.0, memory="passive"), spectrum=jonswap(hs=0.1, tp=9.0),
        direction=np.radians(126.0), body="vessel", spreading=cos_2s(4.0),
    )  # fmt: skip
    length, ramp = 1200.0, 200.0
    result = simulate(scene, t_end=ramp + length, dt_out=0.5, rtol=1e-5, channels=["vessel_motion"])
    found = result["vessel_motion"][result.time >= ramp].std(axis=0)
    # Var(m0) = 2 pi / T integral S^2 domega of a Gaussian process.
    steps = np.gradient(expected.omega)
    scatter = np.sqrt(2.0 * np.pi / length * (steps @ expected.spectrum**2)) / (2.0 * expected.moments[:, 0])
    assert np.all(np.abs(found / expected.std - 1.0)[2:5] < 3.0 * scatter[2:5])
    assert scatter[2:5].max() < 0.1


def ship_at(speed: float, folder: Path) -> tuple[HydroDatabase, HydroDatabase]:
    """A ship at rest and at speed, with the terms of strip theory."""
    stem = VeresRun(speeds=(0.0, speed), heading_deg=np.arange(0.0, 181.0, 15.0)).write(folder)
    return read_veres(stem, speed=0.0), read_veres(stem, speed=speed)


def free(database: HydroDatabase, mooring_period: float | None) -> Scene:
    """The vessel alone."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = Scene()
        scene.add_vessel(database, memory="convolution", mooring_period=mooring_period)
    return scene


@pytest.mark.parametrize("speed", [5.0, -3.0])
def test_motions_at_speed_are_those_of_the_databases_equations(speed: float, tmp_path: Path) -> None:
    """`motion_response`, which returns the motions that the files hold, at every heading and frequency."""
    still, moving = ship_at(speed, tmp_path)
    nothing: dict[str, Any] = {
        "roll_damping": None,
        "linear_damping": np.zeros((6, 6)),
        "quadratic_damping": np.zeros(6),
    }
    still, moving = replace(still, **nothing), replace(moving, **nothing)
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
    """The density over the frequency of encounter, S / |d w_e / d w| summed over the waves met at w_e.

    Three branches in following seas, in closed form in deep water, with a singularity where they join. Its
    moments are those of the integral over the frequency of the waves: energy is neither lost nor made.
    """
    still, moving = ship_at(5.0, tmp_path)
    scene, heading = free(still, 60.0), np.radians(heading_deg)
    sea = jonswap(hs=1.0, tp=7.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", EncounterFrequencyWarning)
        found = response_statistics(
            scene, database=moving, spectrum=sea, direction=heading, body="vessel", memory="database"
        )
    omega = np.linspace(moving.omega[0], moving.omega[-1], 3001)
    options: dict[str, Any] = {
        "database": moving,
        "direction": heading,
        "body": "vessel",
        "memory": "database",
    }
    heave = np.abs(motion_rao(scene, omega=omega, **options)[:, 2]) ** 2 * np.asarray(sea.density(omega))
    slowness = 5.0 * np.cos(heading) / moving.g

    def met(w: Array | float) -> Array:
        return np.asarray(w - slowness * w**2)

    turn = 0.5 / slowness if slowness > 0.0 else np.inf
    ends = [omega[0], *([turn] if omega[0] < turn < omega[-1] else []), omega[-1]]
    moments = np.zeros(2)
    for low, high in itertools.pairwise(ends):
        # u = sqrt(distance from the turn) takes the singularity away: d w_e / |d w_e / d w| is what is left.
        nearest, farthest = sorted((low, high), key=lambda w: abs(w - turn) if slowness > 0.0 else w)
        sign = np.sign(met(farthest) - met(nearest))
        u = np.linspace(0.0, np.sqrt(abs(met(farthest) - met(nearest))), 20_001)[1:]
        u -= 0.5 * (u[1] - u[0])
        frequency = met(nearest) + sign * u**2
        side = 1.0 if low == turn or slowness < 0.0 else -1.0
        waves = (1.0 + side * np.sqrt(np.maximum(1.0 - 4.0 * slowness * frequency, 0.0))) / (2.0 * slowness)
        if slowness < 0.0:
            waves = (1.0 - np.sqrt(1.0 - 4.0 * slowness * frequency)) / (2.0 * slowness)
        jacobian = np.abs(1.0 - 2.0 * slowness * waves)
        density = np.interp(waves, omega, heave) / jacobian
        moments += [(density * frequency**n * 2.0 * u).sum() * (u[1] - u[0]) for n in (0, 2)]
    np.testing.assert_allclose(moments, found.moments[2, :2], rtol=2e-3)


@pytest.mark.warns("UndampedModeWarning")
def test_following_seas_that_are_met_outside_the_table_are_named(tmp_path: Path) -> None:
    still, moving = ship_at(10.0, tmp_path)
    with pytest.warns(EncounterFrequencyWarning, match=r"at 10 m/s \d+% .* no linear theory holds"):
        found = response_statistics(
            free(still, 60.0), database=moving, spectrum=jonswap(hs=1.0, tp=6.0), direction=0.0,
            body="vessel", memory="database", spreading=cos_2s(10.0),
        )  # fmt: skip
    assert np.all(np.isfinite(found.moments))


def test_speeds_that_do_not_belong_together_are_refused(tmp_path: Path) -> None:
    still, moving = ship_at(5.0, tmp_path)
    options: dict[str, Any] = {"spectrum": SEA, "direction": 0.0, "body": "vessel"}
    with pytest.raises(SceneError, match=r"is of 5 m/s, the memory of the linear model of 0 m/s; "):
        response_statistics(free(still, 60.0), database=moving, **options)
    under_way = linear_model(free(still, 60.0), memory="database", database=moving)
    with pytest.raises(SceneError, match="is of 0 m/s, the memory of the linear model of 5 m/s"):
        motion_rao(under_way, database=still, omega=0.6, direction=0.0, body="vessel")
    scene = free(still, 60.0)
    scene.add_sea(hs=1.0)
    with pytest.raises(SceneError, match="meets the waves of the scene at zero speed"):
        response_summed(under_way, body="vessel", waves=scene.waves)


def test_a_spreading_that_is_none_is_named() -> None:
    with pytest.raises(SceneError, match=r"spreading is 5\.0; give cos_2s"):
        statistics(5.0)  # type: ignore[arg-type]
