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
from seacrane.hydro.data.drift_coefficients import DriftCoefficients
from seacrane.run.stats import origin_settings
from seacrane.sea import MeasuredWaves, SeaState, WaveSystem, cos_2s, jonswap, realise_waves, torsethaugen
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import WavesWithoutLoadWarning

WIND = WaveSystem(
    spectrum=jonswap(hs=1.5, tp=6.5, gamma="dnv"), direction_deg=150.0, spreading=cos_2s(8.0), name="wind sea"
)
SWELL = WaveSystem(spectrum=jonswap(hs=1.0, tp=14.0, gamma=5.0), direction_deg=240.0, count=80, name="swell")


def arrays(waves: _core.WaveComponents) -> NDArray:
    return np.stack([waves.omega, waves.amplitude, waves.phase, waves.direction])


def test_one_long_crested_system_is_the_plain_realisation_to_the_bit() -> None:
    system = WaveSystem(spectrum=jonswap(hs=2.0, tp=8.0), direction_deg=135.0)
    sea = SeaState(systems=[system], seed=9).realise()
    plain = realise_waves(jonswap(hs=2.0, tp=8.0), seed=9, direction=float(np.radians(135.0)))
    np.testing.assert_array_equal(arrays(sea.waves), arrays(plain))
    assert sea.hs == plain.realised_hs and sea.tz == plain.mean_period and sea.m0 == plain.m0


def test_systems_add_up_and_leave_each_other_alone() -> None:
    both = SeaState(systems=[WIND, SWELL], seed=3).realise()
    wind = SeaState(systems=[WIND], seed=3).realise()
    np.testing.assert_array_equal(arrays(both.waves)[:, both.systems[0].components], arrays(wind.waves))
    assert [s.name for s in both.systems] == ["wind sea", "swell"]
    assert [s.count for s in both.systems] == [200, 80]
    assert both.m0 == pytest.approx(sum(s.m0 for s in both.systems), rel=1e-13)
    assert both.systems[1].hs == pytest.approx(1.0, rel=0.01)
    assert not both.repeat.found
    # The swell's random numbers are its own, not those of the wind sea.
    twins = SeaState(systems=[SWELL, SWELL], seed=3).realise()
    first, second = (arrays(twins.waves)[:, s.components] for s in twins.systems)
    assert not np.any(first[[0, 2]] == second[[0, 2]])
    np.testing.assert_array_equal(first[1], second[1])
    # Uncorrelated: the correlation of 80 pairs of phases is about 0.11.
    assert abs(np.corrcoef(first[2], second[2])[0, 1]) < 0.4


def test_streams_are_the_documented_ones() -> None:
    sea = SeaState(systems=[SWELL, WIND], seed=77).realise()
    waves, wind = sea.waves, sea.systems[1].components
    phase = [2.0 * np.pi * _core.philox_uniform(seed=77, stream=4, index=i) for i in range(200)]
    np.testing.assert_array_equal(np.array(waves.phase)[wind], phase)
    start = _core.philox_uniform(seed=77, stream=5, index=0)
    share = np.mod(start + 0.5 * (np.sqrt(5.0) - 1.0) * np.arange(200), 1.0)
    expected = np.radians(150.0) + cos_2s(8.0).quantile(share)
    np.testing.assert_allclose(np.array(waves.direction)[wind], expected, rtol=1e-14)


def test_uniform_placement_is_a_grid_that_repeats() -> None:
    spectrum = jonswap(hs=2.0, tp=8.0)
    waves = realise_waves(spectrum, seed=1, direction=0.0, count=200, placement="uniform")
    step = 2.2 / 200
    np.testing.assert_allclose(np.array(waves.omega) / step, np.arange(28, 228), rtol=1e-13)
    bands = [
        spectrum.energy(minimum_omega=(i - 0.5) * step, maximum_omega=(i + 0.5) * step)
        for i in range(28, 228)
    ]
    np.testing.assert_allclose(0.5 * np.array(waves.amplitude) ** 2, bands, rtol=1e-9)
    t, period = np.linspace(0.0, 100.0, 77), 2.0 * np.pi / step
    np.testing.assert_allclose(waves.elevation(t + period), waves.elevation(t), atol=1e-9)
    repeat = waves.repeat_period()
    assert repeat.found and repeat.time == pytest.approx(period, rel=1e-3)


def record(n: int = 4001, dt: float = 0.25, start: float = 12.5) -> tuple[NDArray, NDArray]:
    t = start + dt * np.arange(n)
    waves = realise_waves(jonswap(hs=2.0, tp=8.0), seed=6, direction=0.0, count=300)
    return t, 0.7 + waves.elevation(t) + 0.01 * np.random.default_rng(1).normal(size=n)


@pytest.mark.parametrize("n", [4000, 4001])
@pytest.mark.parametrize("spreading", [None, cos_2s(5.0)])
def test_a_record_is_reproduced_where_it_was_measured(n: int, spreading: object) -> None:
    t, eta = record(n)
    measured = MeasuredWaves(
        time=t, elevation=eta, direction_deg=70.0, position=(120.0, -45.0), spreading=spreading
    )
    waves = SeaState(systems=[measured], depth=40.0).realise().waves
    assert len(waves) == n // 2
    np.testing.assert_allclose(waves.elevation(t, x=120.0, y=-45.0), eta - eta.mean(), atol=1e-10)
    assert np.abs(waves.elevation(t, x=100.0, y=-45.0) - (eta - eta.mean())).max() > 0.5
    assert waves.m0 == pytest.approx(np.var(eta), rel=1e-3)
    np.testing.assert_allclose(
        waves.elevation(t + measured.duration, x=120.0, y=-45.0), eta - eta.mean(), atol=1e-9
    )


def test_cuts_and_taper_of_a_record() -> None:
    t, eta = record()
    measured = MeasuredWaves(
        time=t, elevation=eta, direction_deg=0.0, minimum_omega=0.4, maximum_omega=1.3, taper=0.2
    )
    waves = SeaState(systems=[measured]).realise().waves
    assert np.min(waves.omega) >= 0.4 and np.max(waves.omega) <= 1.3
    np.testing.assert_allclose(waves.elevation(t), measured.band_passed(), atol=1e-10)
    # The window: Tukey's, a raised cosine over a tenth of the record at each end.
    n = eta.size
    window = np.ones(n)
    edge = round(0.1 * (n - 1))
    window[: edge + 1] = 0.5 * (1.0 - np.cos(np.pi * np.arange(edge + 1) / edge))
    window[-edge - 1 :] = window[edge::-1]
    transform = np.fft.rfft((eta - eta.mean()) * window)
    omega = 2.0 * np.pi * np.fft.rfftfreq(n, 0.25)
    transform[(omega < 0.4) | (omega > 1.3)] = 0.0
    np.testing.assert_allclose(measured.band_passed(), np.fft.irfft(transform, n), atol=1e-10)


def test_the_components_of_a_periodic_record_come_back() -> None:
    truth = realise_waves(jonswap(hs=2.0, tp=8.0), seed=2, direction=0.5, count=220, placement="uniform")
    step = 0.01
    n = 2048
    t = np.arange(n) * 2.0 * np.pi / step / n
    measured = MeasuredWaves(
        time=t,
        elevation=truth.elevation(t),
        direction_deg=np.degrees(0.5),
        minimum_omega=0.295,
        maximum_omega=2.5,
    )
    waves = SeaState(systems=[measured]).realise().waves
    np.testing.assert_allclose(waves.omega, truth.omega, rtol=1e-12)
    np.testing.assert_allclose(waves.amplitude, truth.amplitude, atol=1e-12)
    np.testing.assert_allclose(
        waves.elevation(3.3, x=40.0, y=7.0), truth.elevation(3.3, x=40.0, y=7.0), atol=1e-8
    )


def test_the_spectrum_of_a_record_has_its_energy_and_peak() -> None:
    t, eta = record(40_000)
    spectrum = MeasuredWaves(time=t, elevation=eta, direction_deg=0.0).spectrum(segments=40)
    assert spectrum.hs == pytest.approx(4.0 * np.std(eta), rel=0.03)
    assert spectrum.tp == pytest.approx(8.0, rel=0.1)


T, ETA = record(200)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: MeasuredWaves(time=T, elevation=np.where(T[7] == T, np.nan, ETA), direction_deg=0.0),
         r"elevation\[7\] is nan; give finite numbers: fill gaps"),
        (lambda: MeasuredWaves(time=T + 0.01 * (T[50] < T), elevation=ETA, direction_deg=0.0),
         "off the uniform grid"),
        (lambda: MeasuredWaves(time=T[::-1], elevation=ETA, direction_deg=0.0), "let them rise"),
        (lambda: MeasuredWaves(time=T, elevation=ETA[:-1], direction_deg=0.0), "199 elevations"),
        (lambda: MeasuredWaves(time=T, elevation=0.0 * ETA, direction_deg=0.0), "leave the sea out"),
        (lambda: MeasuredWaves(time=T, elevation=ETA, direction_deg=0.0,
                               minimum_omega=2.0, maximum_omega=1.0),
         "no harmonic"),
        (lambda: MeasuredWaves(time=T, elevation=ETA, direction_deg=0.0, taper=1.5), "taper is 1.5"),
        (lambda: MeasuredWaves(time=T, elevation=ETA, direction_deg=np.inf), "direction_deg is inf"),
        (lambda: MeasuredWaves(time=T, elevation=ETA, direction_deg=0.0).spectrum(segments=99), "is 99"),
        (lambda: MeasuredWaves(time=T, elevation=ETA, direction_deg="W"), "is 'W'; give a number"),
        (lambda: MeasuredWaves(time=T, elevation=ETA, direction_deg=0.0, position=(1.0,)), "give \\(2,\\)"),
        (lambda: SeaState(systems=[]), "has no wave system"),
        (lambda: SeaState(systems=WIND), "give a list of WaveSystem"),
        (lambda: SeaState(systems=[jonswap(hs=1.0, tp=8.0)]), "is no wave system"),
        (lambda: SeaState(systems=[WIND], depth=-5.0), "depth is -5"),
        (lambda: SeaState(systems=[WIND], placement="random"), "placement is 'random'"),
        (lambda: SeaState(systems=[WIND], seed=-1), "seed is -1"),
        (lambda: WaveSystem(spectrum="jonswap", direction_deg=0.0), "give a Spectrum"),
        (lambda: WaveSystem(spectrum=WIND.spectrum, direction_deg=np.nan), "direction_deg is nan"),
        (lambda: WaveSystem(spectrum=WIND.spectrum, direction_deg=0.0, spreading=4.0), "is 4.0; give cos"),
    ],
)  # fmt: skip
def test_bad_seas_are_named(make: object, message: str) -> None:
    with pytest.raises(SceneError, match=message):
        make()  # type: ignore[operator]


def sea_of(scene: Scene) -> dict[str, Any]:
    """What its sea was made from."""
    assert scene.waves is not None
    return scene.waves.provenance.settings()


def afloat(**sea: object) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_sea(**({} if "sea" in sea else {"hs": 2.0}) | sea)
    return scene


def test_every_component_loads_the_vessel_from_its_own_direction(tmp_path: Path) -> None:
    database = shipped_database()
    scene = afloat(sea=SeaState(systems=[WIND, SWELL], seed=3))
    waves = scene.waves
    assert waves is not None and waves.hull().transfer.shape == (280, 6)
    for i in (0, 57, 199, 200, 279):
        one = database.force_at(waves.omega[i], waves.direction[i])
        np.testing.assert_allclose(waves.hull().transfer[i], one, rtol=1e-12)
    made_from = sea_of(scene)
    assert made_from["sea"]["systems"][0]["spreading"] == {"kind": "cos-2s", "exponent": 8.0}
    assert set(made_from["realised_hs_of_systems"]) == {"wind sea", "swell"}
    scene.save(tmp_path / "sea.json")
    again = Scene.load(tmp_path / "sea.json")
    assert again.waves is not None and again.waves.provenance == scene.waves.provenance
    np.testing.assert_array_equal(again.waves.direction, waves.direction)
    result = simulate(scene, t_end=5.0, dt_out=1.0)
    components = SeaState(systems=[WIND, SWELL], seed=3).realise().waves
    np.testing.assert_allclose(
        result.channels["wave_elevation"], components.elevation(result.time), atol=1e-7
    )


def test_a_symmetric_short_crested_head_sea_still_rolls_the_vessel() -> None:
    # Head seas that are long-crested leave sway, roll and yaw alone; spreading is what excites them.
    long, short = afloat(direction_deg=180.0), afloat(direction_deg=180.0, spreading=4.0)
    assert long.waves is not None and short.waves is not None
    roll = [
        float(np.sum(np.abs(w.amplitude * w.hull().transfer[:, 3]) ** 2)) for w in (long.waves, short.waves)
    ]
    heave = [
        float(np.sum(np.abs(w.amplitude * w.hull().transfer[:, 2]) ** 2)) for w in (long.waves, short.waves)
    ]
    assert roll[0] < 1e-12 * roll[1]
    assert 0.5 < heave[1] / heave[0] < 5.0


def test_plain_arguments_of_add_sea() -> None:
    scene = afloat(spectrum="torsethaugen", hs=3.0, tp=9.0, spreading=cos_2s(10.0))
    made_from = sea_of(scene)
    assert made_from["spectrum"] == "torsethaugen" and made_from["spreading"]["exponent"] == 10.0
    assert made_from["gamma"] == torsethaugen(hs=3.0, tp=9.0).gamma
    assert sea_of(cases.vessel(gamma="dnv", memory="none"))["gamma"] == 1.0
    assert afloat(hs=0.0).waves is None
    with pytest.raises(SceneError, match="sea: given beside hs, seed; put these into the SeaState"):
        afloat(sea=SeaState(systems=[WIND]), hs=2.0, seed=1)
    with pytest.raises(SceneError, match="sea is 'rough'; give a SeaState"):
        afloat(sea="rough")
    with pytest.raises(SceneError, match="hs is '2'; give a number"):
        afloat(hs="2")
    with pytest.raises(SceneError, match="spectrum 'torset' is unknown"):
        afloat(spectrum="torset")
    with pytest.raises(
        SceneError, match=r"it is 30 m deep.* differ by up to \d+%; take SeaState\(depth=inf\)"
    ):
        afloat(sea=SeaState(systems=[WIND], depth=30.0))
    deep = afloat(sea=SeaState(systems=[WIND], depth=500.0)).waves  # deep water for every wave of it
    assert deep is not None and deep.depth == 500.0


def test_a_sea_is_as_deep_as_its_database() -> None:
    """Crests of a swell over 20 m of water run as fast there as its dispersion says."""
    shallow = dataclasses.replace(shipped_database(), depth=20.0)
    scene = Scene(name="shallow")
    scene.add_vessel(shallow, memory="none")
    scene.add_sea(hs=2.0, tp=14.0)
    waves = scene.waves
    assert waves is not None and waves.depth == 20.0
    k = wavenumber(waves.omega, g=9.80665, depth=20.0)
    place, time = (150.0, -40.0), 7.0
    along = place[0] * np.cos(waves.direction) + place[1] * np.sin(waves.direction)
    by_hand = np.sum(waves.amplitude * np.cos(waves.omega * time - k * along + waves.phase))
    elevation = waves.components().elevation(np.array([time]), x=place[0], y=place[1])
    assert elevation[0] == pytest.approx(by_hand, abs=1e-9)
    plain = afloat(tp=14.0).waves
    assert plain is not None and np.array_equal(plain.amplitude, waves.amplitude)
    assert abs(plain.components().elevation(np.array([time]), x=place[0], y=place[1])[0] - by_hand) > 0.05


def test_vessels_in_one_sea_share_its_depth() -> None:
    shallow = dataclasses.replace(shipped_database(), depth=20.0)
    scene = Scene(name="two")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_vessel(shallow, name="barge", memory="none", position=(0.0, 60.0, 0.0))
    scene.add_sea(hs=2.0, tp=12.0)
    for arguments in ({}, {"hs": 2.0, "tp": 12.0}):
        with pytest.raises(SceneError, match=r"sea of vessel 'barge': it is inf m deep, .* for 20 m"):
            scene.add_sea(vessel="barge", **arguments)
    assert scene.waves is not None and list(scene.waves.hulls) == ["vessel"]


def test_short_seas_are_kept_whole_and_load_the_vessel_within_its_band() -> None:
    database = shipped_database()
    scene = afloat(tp=5.0, hs=1.5)
    waves = scene.waves
    assert waves is not None and waves.omega.max() > 3.7 > database.omega[-1] == 3.1
    inside = waves.omega <= 3.1
    assert np.all(waves.hull().transfer[~inside] == 0.0)
    expected = database.force_at(waves.omega[inside], waves.direction[inside])
    np.testing.assert_array_equal(waves.hull().transfer[inside], expected)
    realised = SeaState(systems=[WaveSystem(spectrum=jonswap(hs=1.5, tp=5.0), direction_deg=135.0)], seed=1)
    result = simulate(scene, t_end=5.0, dt_out=0.5)
    elevation = realised.realise().waves.elevation(result.time)
    np.testing.assert_allclose(result["wave_elevation"], elevation, atol=1e-7)
    assert 0.0 < result.stats["wave_energy_without_load"] < 0.02
    assert 0.0 < result.stats["load_variance_without_load"] < 0.02
    assert afloat(tp=8.0).waves.provenance.wave_energy_without_load == 0.0  # type: ignore[union-attr]


def test_waves_that_put_no_load_on_a_vessel_are_warned_of_by_name() -> None:
    scene = Scene(name="short table")
    scene.add_vessel(shipped_database().select(omega=(0.1, 1.5)), memory="none")
    with pytest.warns(WavesWithoutLoadWarning, match=r"waves on 'vessel': those above 1\.5 rad/s") as caught:
        scene.add_sea(hs=2.0, tp=6.0, direction_deg=90.0)
    assert caught[0].filename == __file__
    assert scene.waves is not None and (scene.waves.provenance.load_variance_without_load or 0.0) > 0.1


def test_loads_at_the_actual_position_and_drift_have_the_same_limits() -> None:
    database = dataclasses.replace(
        shipped_database().select(omega=(0.4, 2.0)),
        drift=DriftCoefficients(
            heading=np.radians(np.arange(0.0, 360.0, 30.0)), omega=np.linspace(0.4, 2.0, 9),
            coefficient=np.ones((12, 9, 6)),
        ),
        port_starboard_symmetric=False,
        heading=shipped_database().full_circle()[0],
        force=shipped_database().select(omega=(0.4, 2.0)).full_circle()[1],
    )  # fmt: skip
    scene = Scene(name="turning")
    scene.add_vessel(database, memory="none")
    scene.add_sea(hs=2.0, tp=7.0, direction_deg=60.0, phase="actual", drift=True)
    waves = scene.waves
    assert waves is not None and waves.omega.min() < 0.4 and waves.omega.max() > 2.0
    table = waves.hull().force_by_heading
    assert table is not None and waves.hull().drift is not None
    at_60 = int(np.argmin(np.abs(table.heading - np.radians(60.0))))
    size = np.abs(waves.hull().transfer).max()
    np.testing.assert_allclose(table.values[at_60], waves.hull().transfer, atol=1e-9 * size)
    assert np.all(table.values[:, waves.omega > 2.0] == 0.0)


def test_calm_water_takes_the_provenance_of_the_sea_before_with_it() -> None:
    scene = afloat(sea=SeaState(systems=[WIND, SWELL], seed=3), phase="actual")
    before = set(origin_settings(afloat(hs=0.0)))
    assert set(origin_settings(scene)) - before == {
        "sea",
        "realised_hs_of_systems",
        "wave_phase",
        "waves_relative_bound",
    }
    scene.add_sea(hs=0.0)
    assert scene.waves is None and set(origin_settings(scene)) == before
    scene.add_sea(hs=1.0)
    assert "sea" not in sea_of(scene) and sea_of(scene)["hs"] == 1.0
    scene.waves = None
    scene.add_sea(sea=SeaState(systems=[WIND], seed=3))
    assert "hs" not in sea_of(scene) and "wave_phase" not in origin_settings(scene)


def test_the_command_line_runs_short_seas(tmp_path: Path) -> None:
    from seacrane.cli import main
    from seacrane.result import Result

    options = "--tp 5 --hs 1.5 --t-end 1 --integrator rk4 --dt 0.1 --memory none"
    assert main(["run", "vessel", "--out", str(tmp_path), *options.split()]) == 0
    assert Result.load(tmp_path / "vessel.nc").stats["wave_energy_without_load"] > 0.0


def test_the_command_line_chooses_the_sea(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from seacrane.cli import main
    from seacrane.result import Result

    options = "--t-end 1 --integrator rk4 --dt 0.1 --memory none --spectrum torsethaugen --spreading 4"
    assert main(["run", "vessel", "--out", str(tmp_path), *options.split()]) == 0
    settings = Result.load(tmp_path / "vessel.nc").settings
    assert settings["spectrum"] == "torsethaugen"
    assert settings["spreading"] == {"kind": "cos-2s", "exponent": 4.0}
    assert main(["run", "vessel", "--out", str(tmp_path), "--spectrum", "torsethaugen", "--gamma", "2"]) == 1
    assert "gamma: 'torsethaugen' has no free peak enhancement" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["run", "vessel", "--out", str(tmp_path), "--gamma", "steep"])
