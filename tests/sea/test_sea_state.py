"""Wave systems, measured records, and both as a sea on a vessel."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Scene, _core, cases, simulate
from seacrane.errors import SceneError
from seacrane.hydro import shipped_database
from seacrane.hydro.data.hydro_data import DriftCoefficients
from seacrane.sea import MeasuredWaves, SeaState, WaveSystem, cos_2s, jonswap, realise_waves, torsethaugen
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import WavesWithoutLoadWarning

WIND = WaveSystem(
    spectrum=jonswap(hs=1.5, tp=6.5, gamma="dnv"), direction_deg=150.0, spreading=cos_2s(8.0), name="wind sea"
)
SWELL = WaveSystem(spectrum=jonswap(hs=1.0, tp=14.0, gamma=5.0), direction_deg=240.0, count=80, name="swell")


def arrays(waves: _core.WaveComponents) -> NDArray:
    return np.stack([waves.omega, waves.amplitude, waves.phase, waves.direction])


def test_systems_add_up_and_leave_each_other_alone() -> None:
    plain = realise_waves(jonswap(hs=2.0, tp=8.0), seed=9, direction=float(np.radians(135.0)))
    system = WaveSystem(spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=135.0)
    sea = SeaState(systems=[system], seed=9).realise()
    np.testing.assert_array_equal(arrays(sea.waves), arrays(plain))
    assert sea.hs == plain.realised_hs and sea.tz == plain.mean_period and sea.m0 == plain.m0
    both = SeaState(systems=[SWELL, WIND], seed=3).realise()
    swell = SeaState(systems=[SWELL], seed=3).realise()
    np.testing.assert_array_equal(arrays(both.waves)[:, both.systems[0].components], arrays(swell.waves))
    assert [(s.name, s.count) for s in both.systems] == [("swell", 80), ("wind sea", 200)]
    assert both.m0 == pytest.approx(sum(s.m0 for s in both.systems), rel=1e-13)
    assert both.systems[0].hs == pytest.approx(1.0, rel=0.01)
    # The wind sea's random numbers are its own, and those of the documented streams.
    wind = both.systems[1].components
    phase = [2.0 * np.pi * _core.philox_uniform(seed=3, stream=4, index=i) for i in range(200)]
    np.testing.assert_array_equal(np.array(both.waves.phase)[wind], phase)
    start = _core.philox_uniform(seed=3, stream=5, index=0)
    share = np.mod(start + 0.5 * (np.sqrt(5.0) - 1.0) * np.arange(200), 1.0)
    expected = np.radians(150.0) + cos_2s(8.0).quantile(share)
    np.testing.assert_allclose(np.array(both.waves.direction)[wind], expected, rtol=1e-14)


def record(n: int = 4001, dt: float = 0.25, start: float = 12.5) -> tuple[NDArray, NDArray]:
    t = start + dt * np.arange(n)
    waves = realise_waves(jonswap(hs=2.0, tp=8.0), seed=6, direction=0.0, count=300)
    return t, 0.7 + waves.elevation(t) + 0.01 * np.random.default_rng(1).normal(size=n)


@pytest.mark.parametrize(("n", "spreading"), [(4000, None), (4001, cos_2s(5.0))])
def test_a_record_is_reproduced_where_it_was_measured(n: int, spreading: object) -> None:
    t, eta = record(n)
    at: dict[str, Any] = {"direction_deg": 70.0, "position": (120.0, -45.0), "spreading": spreading}
    measured = MeasuredWaves(time=t, elevation=eta, **at)
    waves = SeaState(systems=[measured], depth=40.0).realise().waves
    still = eta - eta.mean()
    np.testing.assert_allclose(waves.elevation(t, x=120.0, y=-45.0), still, atol=1e-10)
    assert np.abs(waves.elevation(t, x=100.0, y=-45.0) - still).max() > 0.5
    assert waves.m0 == pytest.approx(np.var(eta), rel=1e-3)
    np.testing.assert_allclose(waves.elevation(t + measured.duration, x=120.0, y=-45.0), still, atol=1e-9)


def test_cuts_and_taper_of_a_record() -> None:
    t, eta = record()
    cut = {"minimum_omega": 0.4, "maximum_omega": 1.3, "taper": 0.2}
    measured = MeasuredWaves(time=t, elevation=eta, direction_deg=0.0, **cut)
    waves = SeaState(systems=[measured]).realise().waves
    assert np.min(waves.omega) >= 0.4 and np.max(waves.omega) <= 1.3
    # The window: Tukey's, a raised cosine over a tenth of the record at each end.
    n = eta.size
    window = np.ones(n)
    edge = round(0.1 * (n - 1))
    window[: edge + 1] = 0.5 * (1.0 - np.cos(np.pi * np.arange(edge + 1) / edge))
    window[-edge - 1 :] = window[edge::-1]
    transform = np.fft.rfft((eta - eta.mean()) * window)
    omega = 2.0 * np.pi * np.fft.rfftfreq(n, 0.25)
    transform[(omega < 0.4) | (omega > 1.3)] = 0.0
    np.testing.assert_allclose(waves.elevation(t), np.fft.irfft(transform, n), atol=1e-10)


def test_records_and_systems_that_make_no_sea_are_refused() -> None:
    t, eta = record(200)
    good = {"time": t, "elevation": eta, "direction_deg": 0.0}
    for given, message in (
        ({"elevation": np.where(t[7] == t, np.nan, eta)}, r"elevation\[7\] is nan"),
        ({"time": t + 0.01 * (t[50] < t)}, "off the uniform grid"), ({"elevation": eta[:-1]}, "199"),
        ({"minimum_omega": 2.0, "maximum_omega": 1.0}, "no harmonic"), ({"position": (1.0,)}, r"give \(2,\)"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            MeasuredWaves(**(good | given))
    for given, message in (({"systems": []}, "no wave system"), ({"depth": -5.0}, "depth is -5")):
        with pytest.raises(SceneError, match=message):
            SeaState(**({"systems": [WIND]} | given))


def afloat(**sea: object) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_sea(**({} if "sea" in sea else {"hs": 2.0}) | sea)
    return scene


def test_every_component_loads_the_vessel_from_its_own_direction(tmp_path: Path) -> None:
    database = shipped_database()
    scene = afloat(sea=SeaState(systems=[WIND, SWELL], seed=3))
    waves = scene.waves
    assert waves.hull().transfer.shape == (280, 6)
    for i in (0, 57, 199, 200, 279):
        one = database.force_at(waves.omega[i], waves.direction[i])
        np.testing.assert_allclose(waves.hull().transfer[i], one, rtol=1e-12)
    made_from = waves.provenance.settings()
    assert made_from["sea"]["systems"][0]["spreading"] == {"kind": "cos-2s", "exponent": 8.0}
    scene.save(tmp_path / "sea.json")
    again = Scene.load(tmp_path / "sea.json")
    assert again.waves.provenance == waves.provenance
    np.testing.assert_array_equal(again.waves.direction, waves.direction)
    result = simulate(scene, t_end=5.0, dt_out=1.0)
    components = SeaState(systems=[WIND, SWELL], seed=3).realise().waves
    np.testing.assert_allclose(result["wave_elevation"], components.elevation(result.time), atol=1e-7)


def test_a_symmetric_short_crested_head_sea_still_rolls_the_vessel() -> None:
    """Head seas that are long-crested leave sway, roll and yaw alone; spreading is what excites them."""
    seas = [afloat(direction_deg=180.0, **given).waves for given in ({}, {"spreading": 4.0})]
    heave, roll = ([np.sum(np.abs(w.amplitude * w.hull().transfer[:, i]) ** 2) for w in seas] for i in (2, 3))
    assert roll[0] < 1e-12 * roll[1]
    assert 0.5 < heave[1] / heave[0] < 5.0


def test_plain_arguments_of_add_sea() -> None:
    made_from = afloat(
        spectrum="torsethaugen", hs=3.0, tp=9.0, spreading=cos_2s(10.0)
    ).waves.provenance.settings()
    assert made_from["spectrum"] == "torsethaugen" and made_from["spreading"]["exponent"] == 10.0
    assert made_from["gamma"] == torsethaugen(hs=3.0, tp=9.0).gamma
    assert cases.vessel(gamma="dnv", memory="none").waves.provenance.settings()["gamma"] == 1.0
    assert afloat(hs=0.0).waves is None
    for given, message in (
        ({"sea": SeaState(systems=[WIND]), "hs": 2.0, "seed": 1}, "beside hs, seed"),
        ({"sea": SeaState(systems=[WIND], depth=30.0)}, r"30 m deep.* \d+%; take SeaState\(depth=inf\)"),
        ({"phase": "true"}, "phase is 'true'"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            afloat(**given)
    assert afloat(sea=SeaState(systems=[WIND], depth=500.0)).waves.depth == 500.0  # deep for every wave of it


def test_a_sea_is_as_deep_as_its_database() -> None:
    """Crests of a swell over 20 m of water run as its dispersion says; vessels share the depth."""
    shallow = dataclasses.replace(shipped_database(), depth=20.0)
    scene = Scene(name="shallow")
    scene.add_vessel(shallow, memory="none")
    scene.add_sea(hs=2.0, tp=14.0)
    waves, plain = scene.waves, afloat(tp=14.0).waves
    assert waves.depth == 20.0
    k = wavenumber(waves.omega, g=9.80665, depth=20.0)
    (x, y), time = (150.0, -40.0), 7.0
    along = x * np.cos(waves.direction) + y * np.sin(waves.direction)
    by_hand = np.sum(waves.amplitude * np.cos(waves.omega * time - k * along + waves.phase))
    elevation, deep = (w.components().elevation(np.array([time]), x=x, y=y)[0] for w in (waves, plain))
    assert elevation == pytest.approx(by_hand, abs=1e-9)
    assert np.array_equal(plain.amplitude, waves.amplitude)
    assert abs(deep - by_hand) > 0.05
    two = afloat(tp=12.0)
    two.add_vessel(shallow, name="barge", memory="none", position=(0.0, 60.0, 0.0))
    with pytest.raises(SceneError, match=r"vessel 'barge': it is inf m deep, .* 20 m"):
        two.add_sea(vessel="barge")
    assert list(two.waves.hulls) == ["vessel"]


def test_short_seas_are_kept_whole_and_load_the_vessel_within_its_band() -> None:
    database = shipped_database()
    scene = afloat(tp=5.0, hs=1.5)
    waves = scene.waves
    assert waves.omega.max() > 3.7 > database.omega[-1] == 3.1
    inside = waves.omega <= 3.1
    assert np.all(waves.hull().transfer[~inside] == 0.0)
    expected = database.force_at(waves.omega[inside], waves.direction[inside])
    np.testing.assert_array_equal(waves.hull().transfer[inside], expected)
    realised = SeaState(systems=[WaveSystem(spectrum=jonswap(hs=1.5, tp=5.0), direction_deg=135.0)], seed=1)
    result = simulate(scene, t_end=5.0, dt_out=0.5)
    elevation = realised.realise().waves.elevation(result.time)
    np.testing.assert_allclose(result["wave_elevation"], elevation, atol=1e-7)
    assert 0.0 < result.stats["wave_energy_without_load"] < 0.02
    assert afloat(tp=8.0).waves.provenance.wave_energy_without_load == 0.0
    short = Scene(name="short table")
    short.add_vessel(database.select(omega=(0.1, 1.5)), memory="none")
    with pytest.warns(WavesWithoutLoadWarning, match=r"'vessel'.* 1\.5 rad/s"):
        short.add_sea(hs=2.0, tp=6.0, direction_deg=90.0)
    assert short.waves.provenance.load_variance_without_load > 0.1


def test_loads_at_the_actual_position_and_drift_have_the_same_limits() -> None:
    part = shipped_database().select(omega=(0.4, 2.0))
    drift = DriftCoefficients(
        heading=np.radians(np.arange(0.0, 360.0, 30.0)), omega=np.linspace(0.4, 2.0, 9),
        coefficient=np.ones((12, 9, 6)),
    )  # fmt: skip
    heading, force = part.full_circle()
    circle = {"heading": heading, "force": force, "port_starboard_symmetric": False}
    scene = Scene(name="turning")
    scene.add_vessel(dataclasses.replace(part, drift=drift, **circle), memory="none")
    scene.add_sea(hs=2.0, tp=7.0, direction_deg=60.0, phase="actual", drift=True)
    waves = scene.waves
    assert waves.omega.min() < 0.4 and waves.omega.max() > 2.0
    table = waves.hull().force_by_heading
    assert waves.hull().drift is not None
    at_60 = int(np.argmin(np.abs(table.heading - np.radians(60.0))))
    size = np.abs(waves.hull().transfer).max()
    np.testing.assert_allclose(table.values[at_60], waves.hull().transfer, atol=1e-9 * size)
    assert np.all(table.values[:, waves.omega > 2.0] == 0.0)
