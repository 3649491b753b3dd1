"""Allowable Hs: closed forms, both domains against each other, and what each cell says of itself."""

from __future__ import annotations

import os
import pickle
import signal
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from operability_scenes import HEAVE, PITCH, SHORT, WEIGHT, soft_wire, vessel

from seacrane import (
    Criterion,
    HydroDatabase,
    Run,
    Scene,
    SceneError,
    allowable_hs,
    cases,
    equilibrium,
    linear_model,
    response_statistics,
    simulate,
)
from seacrane.analysis import response_summed
from seacrane.analysis.rest_state import held
from seacrane.hydro import shipped_database
from seacrane.operability import AllowableHs, AlphaFactor
from seacrane.operability.allowable import SteadyStart, steady_start
from seacrane.operability.allowable_table import over_circle
from seacrane.operability.alpha import alpha_of
from seacrane.operability.cells import Cells
from seacrane.operability.levels import gaussian_level, reached, record_numbers, seeds_level
from seacrane.operability.linear_channels import linear_channels
from seacrane.operability.linear_seas import LinearSeas
from seacrane.operability.time_domain import ByTime, first_crossing
from seacrane.pictures import plot_allowable_hs
from seacrane.sea import jonswap


@pytest.fixture(scope="module")
def database() -> HydroDatabase:
    return shipped_database()


@pytest.fixture(scope="module")
def tested(database: HydroDatabase) -> AllowableHs:
    return allowable_hs(
        vessel(), criteria=[HEAVE, PITCH], tp=[7.0, 9.0], direction_deg=[135.0, 180.0], hs=[1.0, 2.0, 3.0],
        **SHORT,
    )  # fmt: skip


@pytest.fixture(scope="module")
def slack(database: HydroDatabase) -> AllowableHs:
    tension = Criterion(channel="line_tension", maximum=4.0 * WEIGHT, exposure=900.0)
    return allowable_hs(
        soft_wire(), criteria=[tension], tp=8.0, direction_deg=120.0, hs=[2.0, 4.0, 6.0],
        **SHORT,
    )  # fmt: skip


def by_frequency(scene: Scene, criteria: Any, database: HydroDatabase, **given: Any) -> AllowableHs:
    asked = {"tp": 9.0, "direction_deg": 135.0, "hs": [50.0]} | given
    return allowable_hs(scene, criteria=criteria, domain="frequency", **asked)


def test_hs_is_what_the_linear_statistics_say(database: HydroDatabase) -> None:
    """2 sqrt(m0) per metre of Hs, from the other implementation of the response."""
    motion = response_statistics(
        linear_model(vessel()), spectrum=jonswap(hs=1.0, tp=9.0),
        direction=np.radians(135.0), body="vessel",
    )  # fmt: skip
    found = by_frequency(vessel(), [PITCH], database)
    assert float(found.dataset["allowable_hs"][0, 0]) == pytest.approx(
        PITCH.bound / motion.significant_amplitude[4], rel=1e-4
    )


def test_hs_is_proportional_to_the_allowance(database: HydroDatabase) -> None:
    wide, low = replace(HEAVE, maximum=1.6, name="wide"), replace(HEAVE, motion=False, name="above")
    found = by_frequency(vessel(), [HEAVE, wide, low], database).dataset["by_criterion"][:, 0, 0]
    assert float(found[1]) == pytest.approx(2.0 * float(found[0]), rel=1e-12)
    assert float(found[2]) > float(found[0])  # of one side there are fewer crests


def test_every_channel_of_the_linear_model_is_that_of_a_run(database: HydroDatabase) -> None:
    """From the same state in small waves: forces, velocities, angles. What differs is of second order."""
    criteria = (
        Criterion(channel="hook_load", maximum=2e5),
        Criterion(channel="position", names={"body": "payload", "axis": "y"}, maximum=1.0),
        Criterion(channel="tip_velocity", names={"axis": "z"}, maximum=1.0),
        Criterion(channel="cylinder_force", names={"cylinder": "main"}, maximum=1e7),
        Criterion(channel="sidelead", maximum=0.1),
        Criterion(channel="point_acceleration", names={"point": "deck", "axis": "z"}, maximum=1.0),
    )
    apart = np.array([_difference_of_run_and_model(hs, criteria, database) for hs in (0.005, 0.001)])
    assert np.all(apart[1] < 0.01)
    assert apart[0, 0] == pytest.approx(5.0 * apart[1, 0], rel=0.05)


def _difference_of_run_and_model(
    hs: float, criteria: tuple[Criterion, ...], database: HydroDatabase
) -> list[float]:
    """Standard deviation of the difference over that of the model, by criterion."""
    scene = cases.case2(hs=hs)
    scene.add_point(name="deck", body="vessel", point=(20.0, 5.0, 8.0))
    rest = equilibrium(scene, time=50.0)
    still = held(scene, time=50.0).copy(waves=scene.waves)
    linear = LinearSeas(still, rest, criteria)
    assert still.waves is not None
    start, told = linear.in_waves(still.waves, 50.0, 50.0 + 0.5 * np.arange(101))
    run = simulate(
        still, t_end=100.0, start=start, dt_out=0.5, rtol=1e-9, channels=[one.channel for one in criteria]
    )
    found = np.stack([run.curve(one.channel, **one.names) for one in criteria], axis=1)
    return list(np.std(found - told, axis=0) / np.std(told, axis=0))


def test_loads_on_the_vessel_go_straight_into_accelerations() -> None:
    """y = ... + D f: what a push does at once, against the mass of the vessel with its added mass."""
    model = linear_model(vessel())
    place = Criterion(channel="point_acceleration", names={"point": "bow", "axis": "z"}, maximum=1.0)
    scene = vessel()
    scene.add_point(name="bow", body="vessel", point=(50.0, 0.0, 0.0))
    d = linear_channels(linear_model(scene), [place]).d[0]
    dof = model.degrees_of_freedom
    pushed = model.output(body="vessel", point=(50.0, 0.0, 0.0))[2, :dof] @ model.b[dof : 2 * dof]
    assert d == pytest.approx(pushed, rel=1e-6, abs=1e-6 * np.abs(pushed).max())


def test_both_domains_agree_where_the_scene_is_linear(tested: AllowableHs, database: HydroDatabase) -> None:
    assert np.all(tested.dataset["domain"] == "frequency")
    assert np.nanmax(tested.dataset["difference"]) < 0.05
    cell = allowable_hs(
        vessel(), criteria=[HEAVE, PITCH], tp=9.0, direction_deg=135.0, hs=[1.0, 2.0],
        domain="time", **SHORT,
    ).dataset.isel(tp=0, direction_deg=0)  # fmt: skip
    linear = tested.dataset.sel(tp=9.0, direction_deg=135.0)
    assert cell["domain"] == "time"
    assert cell["governing"] == linear["governing"] == "heave"
    assert cell["low"] < linear["allowable_hs"] < cell["high"]
    assert cell["allowable_hs"] == pytest.approx(float(linear["allowable_hs"]), rel=0.1)


def test_runs_begin_without_the_transient_of_a_soft_mooring(database: HydroDatabase) -> None:
    """From rest a beam sea sets off a sway of minutes, and first waves count as motion."""
    sway = Criterion(channel="vessel_motion", names={"motion": "sway"}, maximum=0.5, motion=True,
                     statistic="significant", name="sway")  # fmt: skip
    asked: dict[str, Any] = {"tp": 9.0, "direction_deg": 90.0, "criteria": [sway]}
    runs = allowable_hs(vessel(), **asked, hs=[1.0, 2.0, 3.0], domain="time", **SHORT | {"start_up": 0.0})
    linear = allowable_hs(vessel(), **asked, hs=[3.0], domain="frequency")
    found = runs.dataset.isel(tp=0, direction_deg=0)
    assert found["low"] < linear.dataset["allowable_hs"].item() < found["high"]


def test_a_steady_start_is_that_of_the_linear_model_wherever_it_is_made() -> None:
    scene = vessel(hs=0.5)
    start = steady_start(scene, equilibrium(scene))
    assert isinstance(start, SteadyStart)
    there, here = pickle.loads(pickle.dumps(start))(scene), start(scene)
    assert np.array_equal(there.values, here.values)
    told = response_summed(linear_model(scene), body="vessel")
    moved, rest = (
        simulate(scene, t_end=0.0, start=one, channels=["vessel_motion"])["vessel_motion"][0]
        for one in (here, equilibrium(scene))
    )
    assert moved - rest == pytest.approx(told.at(0.0), rel=2e-3, abs=1e-4)


def test_a_start_turns_no_body_by_more_than_the_linear_model_may(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seacrane.operability.allowable.LARGEST_TURN", 1e-4)
    scene = vessel(hs=2.0)
    rest = equilibrium(scene)
    start = steady_start(scene, rest)
    assert isinstance(start, SteadyStart)
    turned = simulate(scene, t_end=0.0, start=start(scene), channels=["vessel_motion"])["vessel_motion"][
        0, 3:
    ]
    assert np.abs(turned).max() == pytest.approx(1e-4, rel=1e-3)


def test_a_wire_that_goes_slack_is_left_to_runs(slack: AllowableHs, database: HydroDatabase) -> None:
    cell = slack.dataset.isel(tp=0, direction_deg=0)
    assert cell["domain"] == "time"
    assert "line tension" in str(cell["reason"].item())
    assert "differ by" in str(cell["reason"].item())
    assert float(cell["difference"][0]) > slack.dataset.attrs["linear_within"]
    linear = by_frequency(soft_wire(), slack.criteria, database, tp=8.0, direction_deg=120.0).dataset[
        "allowable_hs"
    ][0, 0]
    assert not cell["low"] <= linear <= cell["high"]


def test_a_looser_demand_takes_the_linear_model(database: HydroDatabase) -> None:
    tension = Criterion(channel="line_tension", maximum=1.5 * WEIGHT, exposure=900.0)
    found = allowable_hs(soft_wire(), criteria=[tension], tp=8.0, direction_deg=120.0, hs=[4.0], **SHORT)
    assert found.dataset["domain"].item() == "frequency"  # the wire stays taut


def test_a_table_tells_what_it_rests_on(tested: AllowableHs, slack: AllowableHs) -> None:
    text = str(tested)
    assert "f: by the linear model (4 cells), t: by runs (0 cells)" in text
    assert "alpha factor 1 (source: none" in text
    assert (
        "A: heave: motion to either side, most probable maximum in 900 s <= 0.8 m; linear: clumped, Vanmarcke"
        in text
    )
    assert ">3.00 f" in text and "Af" in text
    assert "At" in str(slack) or ">" in str(slack)
    assert "<table" in tested._repr_html_()
    assert tested.dataset.attrs["linear_within"] == 0.1
    assert "within" in str(tested.dataset["reason"][0, 0].item())


def test_largest_hs_caps_both_domains(tested: AllowableHs) -> None:
    capped = tested.dataset["capped"].to_numpy()
    assert capped.any() and not capped.all()
    assert np.all(tested.dataset["allowable_hs"].to_numpy()[capped] == 3.0)
    assert np.all(tested.dataset["governing"].to_numpy()[capped] == "")


def test_a_bound_beyond_which_the_scene_rests_allows_nothing(database: HydroDatabase) -> None:
    low = Criterion(channel="line_tension", maximum=0.5 * WEIGHT)
    found = allowable_hs(soft_wire(), criteria=[low], tp=8.0, direction_deg=120.0, hs=[4.0], **SHORT)
    assert found.dataset["allowable_hs"].item() == 0.0
    assert found.dataset["reason"].item() == "a bound is exceeded at rest"


def test_short_crested_seas_move_a_vessel_less_from_ahead_and_more_from_the_side(
    database: HydroDatabase,
) -> None:
    roll = Criterion(
        channel="vessel_motion", names={"motion": "roll"}, maximum=0.05, statistic="significant", name="roll"
    )
    long = by_frequency(vessel(), [roll], database, direction_deg=[90.0, 150.0])
    short = by_frequency(vessel(spreading=2.0), [roll], database, direction_deg=[90.0, 150.0])
    above, ahead = (short.dataset["allowable_hs"] - long.dataset["allowable_hs"]).to_numpy()[0]
    assert above > 0.0 > ahead


def test_memory_without_states_is_left_to_runs(database: HydroDatabase) -> None:
    scene = vessel(memory="convolution")
    with pytest.raises(SceneError, match="convolution"):
        by_frequency(scene, [HEAVE], database)
    found = allowable_hs(
        scene, criteria=[HEAVE], tp=9.0, direction_deg=180.0, hs=[1.0, 3.0],
        duration=100.0, start_up=20.0, seeds=[1, 2, 3], rtol=1e-3,
    )  # fmt: skip
    assert found.dataset["domain"].item() == "time"
    assert "convolution" in found.dataset["reason"].item()


def test_a_spectrum_that_changes_its_shape_is_left_to_runs(database: HydroDatabase) -> None:
    with pytest.raises(SceneError, match="'torsethaugen' changes its shape with Hs"):
        by_frequency(vessel(spectrum="torsethaugen"), [HEAVE], database)


def test_threads_and_a_store_change_nothing(database: HydroDatabase, tmp_path: Path) -> None:
    asked: dict[str, Any] = {
        "criteria": [HEAVE], "tp": 9.0, "direction_deg": 135.0, "hs": [1.0, 2.0],
        "domain": "time", "duration": 200.0, "start_up": 50.0, "seeds": [1, 2, 3],
    }  # fmt: skip
    alone = allowable_hs(vessel(), **asked)
    with ThreadPoolExecutor(2) as executor:
        stored = allowable_hs(vessel(), **asked, executor=executor, store=tmp_path / "storms")
    again = allowable_hs(vessel(), **asked, store=tmp_path / "storms")
    assert alone.dataset.identical(stored.dataset)
    assert alone.dataset.identical(again.dataset)
    other = asked | {"criteria": [replace(HEAVE, names={"motion": "pitch"})]}
    with pytest.raises(SceneError, match="keep"):
        allowable_hs(vessel(), **other, store=tmp_path / "storms")


def test_ctrl_c_ends_it_and_the_store_goes_on(database: HydroDatabase, tmp_path: Path) -> None:
    asked: dict[str, Any] = {
        "criteria": [HEAVE], "tp": 9.0, "direction_deg": 135.0, "hs": [1.0, 2.0],
        "domain": "time", "duration": 2000.0, "seeds": [1, 2, 3], "store": tmp_path / "storms",
    }  # fmt: skip

    def press() -> None:
        while not list((tmp_path / "storms").glob("*.nc")):
            if stop.wait(0.01):
                return
        os.kill(os.getpid(), signal.SIGINT)

    stop = threading.Event()
    key = threading.Thread(target=press)
    key.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            allowable_hs(vessel(), **asked)
    finally:
        stop.set()
        key.join()
    kept = len(list((tmp_path / "storms").glob("*.nc")))
    assert 0 < kept < 6
    assert np.isfinite(allowable_hs(vessel(), **asked).dataset["allowable_hs"].item())


def test_a_table_between_its_cells(tested: AllowableHs) -> None:
    values = tested.dataset["allowable_hs"].to_numpy()
    assert tested.at(8.0, 135.0) == pytest.approx(values[:, 0].mean())
    assert tested.at(7.0, 157.5) == pytest.approx(values[0].mean())
    assert tested.at([7.0, 9.0]) == pytest.approx(values.min(axis=1))
    assert np.isnan(tested.at([6.9, 9.1, 7.0], [135.0, 135.0, 0.0])).all()
    assert tested.at(7.0, 495.0) == pytest.approx(values[0, 0])


def test_alpha_lowers_the_forecast_and_nothing_else(database: HydroDatabase) -> None:
    alpha = AlphaFactor(values=[[0.6, 0.8], [0.5, 0.7]], hours=[12, 24], hs=[1.0, 3.0], source="a standard")
    plain, told = (
        by_frequency(vessel(), [HEAVE], database, hs=[3.0], **given)
        for given in ({}, {"alpha": alpha, "hours": 18.0})
    )
    height = float(plain.dataset["allowable_hs"].item())
    assert told.dataset["allowable_hs"].item() == height
    assert told.dataset["forecast_hs"].item() == pytest.approx(height * (0.5 + 0.1 * (height - 1.0)))
    assert "alpha factor of 18 h by a table (source: a standard)" in str(told)
    assert told.at(9.0, 135.0, forecast=True) == told.dataset["forecast_hs"].item()


def test_pictures_show_numbers_letters_and_frames(tested: AllowableHs, slack: AllowableHs) -> None:
    axes = plot_allowable_hs(tested).axes[0]
    said = [text.get_text() for text in axes.texts]
    assert len(said) == 4 and any(text.endswith(" A") for text in said)
    assert not axes.patches
    assert len(plot_allowable_hs(slack, forecast=True).axes[0].patches) == 1
    rosette = plot_allowable_hs(tested, kind="rosette").axes[0]
    assert [len(line.get_xdata()) for line in rosette.lines] == [2, 2]


def test_results_travel(tested: AllowableHs) -> None:
    assert pickle.loads(pickle.dumps(tested)).dataset.identical(tested.dataset)


@pytest.mark.parametrize(
    ("levels", "allowance", "hs"),
    [
        ([1.0, 2.0, 4.0], 0.5, 0.5),
        ([1.0, 2.0, 4.0], 3.0, 2.5),
        ([1.0, 2.0, 4.0], 5.0, np.inf),
        ([1.0, 0.5, 4.0], 0.9, 0.9),  # the first crossing counts
        ([1.0, np.inf, 4.0], 3.0, 1.0),  # runs that failed allow no more than the Hs below
        ([np.inf, 1.0, 4.0], 3.0, np.nan),  # not known, which is not zero
        ([1.0, 2.0, 4.0], 0.0, 0.0),
    ],
)
def test_the_first_crossing(levels: list[float], allowance: float, hs: float) -> None:
    assert first_crossing([1.0, 2.0, 3.0], levels, allowance) == pytest.approx(hs, nan_ok=True)


def test_seeds_that_failed_are_no_evidence() -> None:
    assert seeds_level(HEAVE, np.array([1.0, 2.0, np.nan]), 900.0).value == np.inf
    with_one_failed = seeds_level(HEAVE, np.array([1.0, 1.2, 1.1, np.nan]), 900.0)
    assert with_one_failed.low < with_one_failed.value < with_one_failed.high


def test_the_gaussian_level_of_either_side_is_that_of_many_records() -> None:
    """A band of frequencies by sums of cosines: the mode of the largest |x| of 600 s."""
    omega = np.linspace(0.5, 1.1, 120)
    density = np.exp(-(((omega - 0.8) / 0.08) ** 2))
    amplitude = np.sqrt(density / density.sum())
    random = np.random.default_rng(3)
    times = np.arange(0.0, 600.0, 0.4)
    turns = np.exp(1j * times[:, None] * omega)
    phases = np.exp(2j * np.pi * random.random((omega.size, 400)))
    records = np.sqrt(2.0) * (turns @ (amplitude[:, None] * phases)).real
    largest = np.quantile(np.abs(records).max(axis=0), np.exp(-1.0))
    moments = np.array([(density / density.sum()) @ omega**order for order in (0, 1, 2)])
    level = gaussian_level(replace(HEAVE, exposure=600.0), moments)
    assert level == pytest.approx(largest, rel=0.03)
    assert gaussian_level(PITCH, moments) == 2.0
    rayleigh = gaussian_level(replace(HEAVE, exposure=600.0, maxima="rayleigh"), moments)
    crests = 2.0 * 600.0 * np.sqrt(moments[2] / moments[0]) / (2.0 * np.pi)
    assert rayleigh == pytest.approx(np.sqrt(2.0 * np.log(crests)), rel=1e-12) and rayleigh > level


def test_a_minimum_is_a_maximum_upside_down(database: HydroDatabase) -> None:
    """The least tension of a taut wire, the closed form for Gaussian troughs."""
    least = Criterion(channel="line_tension", minimum=0.7 * WEIGHT, exposure=900.0, name="least")
    most = replace(least, minimum=None, maximum=1.3 * WEIGHT, name="most")
    found = by_frequency(soft_wire(), [least, most], database, tp=8.0, direction_deg=120.0)
    low, high = found.dataset["by_criterion"].to_numpy().ravel()
    assert low == pytest.approx(high, rel=0.01)  # the ship trims under the load: rest is not quite the weight
    assert "least: value, most probable minimum in 900 s >=" in least.told()


def test_how_far_a_record_went() -> None:
    """From rest at 3: up, down, and to the farther side, by extremes and by significant values."""
    numbers = np.array([[5.0, 2.0, 4.5, 2.5], [4.0, 0.0, 3.5, 1.0]])
    upper = Criterion(channel="line_tension", maximum=6.0)
    lower = Criterion(channel="line_tension", minimum=1.0)
    either = Criterion(channel="line_tension", maximum=2.0, motion=True)
    assert reached(upper, numbers, 3.0).tolist() == [2.0, 1.0]
    assert reached(lower, numbers, 3.0).tolist() == [1.0, 3.0]
    assert reached(either, numbers, 3.0).tolist() == [2.0, 3.0]
    assert reached(replace(either, statistic="significant"), numbers, 3.0).tolist() == [1.5, 2.0]
    assert [one.allowance(3.0) for one in (upper, lower, either)] == [3.0, 2.0, 2.0]


def test_numbers_of_a_record() -> None:
    times = np.arange(0.0, 100.0, 0.1)
    largest, smallest, high, low = record_numbers(3.0 + 2.0 * np.sin(times))
    assert [largest, high] == pytest.approx([5.0, 5.0], abs=1e-3)
    assert [smallest, low] == pytest.approx([1.0, 1.0], abs=1e-3)
    assert record_numbers(np.full(9, 4.0)) == pytest.approx([4.0] * 4)


def test_between_directions_of_a_circle() -> None:
    directions = np.array([0.0, 90.0, 180.0, 270.0])
    values = np.array([1.0, 2.0, 3.0, 4.0])[:, None]
    for asked, found in ((45.0, 1.5), (315.0, 2.5), (-90.0, 4.0), (360.0, 1.0), (180.0, 3.0)):
        assert over_circle(directions, values, np.array([asked]))[0] == pytest.approx(found)
    assert np.isnan(over_circle(directions[:2], values[:2], np.array([91.0]))[0])
    assert over_circle(directions[:1], values[:1], np.array([0.0]))[0] == 1.0


ASKED: dict[str, Any] = {"criteria": [HEAVE], "tp": 9.0, "direction_deg": 135.0, "hs": [1.0]}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"criteria": []}, "criteria is .*give a list of Criterion"),
        ({"criteria": [HEAVE, HEAVE]}, "'heave' is there twice"),
        ({"criteria": [replace(HEAVE, channel="hook_load", names={})]}, "hook_load"),
        ({"criteria": [replace(HEAVE, channel="position[lod, z]", names={})]}, "no body 'lod'.*choose from"),
        ({"criteria": [replace(HEAVE, names={})]}, "holds several curves; give motion: one of surge"),
        ({"tp": [9.0, 8.0]}, "tp is .*give ascending"),
        ({"tp": -1.0}, "tp begins with -1; give numbers above zero"),
        ({"direction_deg": [0.0, 360.0]}, "direction_deg goes from 0 to 360; name each"),
        ({"hs": [np.nan]}, "hs is .*give ascending finite"),
        ({"seeds": [1, 2]}, "seeds is .*at least 3 different"),
        ({"seeds": [1, 2, 2]}, "seeds is .*at least 3 different"),
        ({"duration": 0.0}, "duration is 0.0; give a finite number above zero"),
        ({"duration": 80.0}, "duration is 80 s; give at least 10 of the longest peak period, 90 s"),
        ({"channels": ["position"]}, "channels: runs record those of the criteria"),
        ({"integrator": "euler"}, "euler"),
        ({"dt_out": -1.0}, "dt_out.*-1"),
        ({"start_up": -1.0}, "start_up is -1.0 s"),
        ({"linear_within": 0.0}, "linear_within is 0.0"),
        ({"domain": "both"}, "domain is 'both'; choose"),
        ({"alpha": 0.8}, "alpha is 0.8; give AlphaFactor"),
        ({"hours": 0.0}, "hours is 0.0"),
    ],
)
def test_what_makes_no_sense_is_refused(given: dict[str, Any], message: str, database: HydroDatabase) -> None:
    with pytest.raises(SceneError, match=message):
        allowable_hs(vessel(), **{**ASKED, **given})


def test_a_scene_without_a_sea_is_refused(database: HydroDatabase) -> None:
    scene = vessel()
    with pytest.raises(SceneError, match="has no sea"):
        allowable_hs(scene.copy(waves=None), **ASKED)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"channel": "hook_lod"}, "channel 'hook_lod' does not exist; did you mean 'hook_load'"),
        ({"channel": "weather"}, "channel 'weather' does not exist; docs/channels.md lists them"),
        ({"maximum": None}, "give maximum or minimum, and not both"),
        ({"minimum": 0.0}, "give maximum or minimum, and not both"),
        ({"maximum": np.inf}, "bound is inf; give a finite number"),
        ({"maximum": -1.0}, "motion=True bounds a distance"),
        ({"statistic": "P95"}, "statistic is 'P95'; choose from significant, mpm, mean, p90"),
        ({"exposure": 0.0}, "exposure is 0.0 s"),
        ({"maxima": "rice"}, "maxima is 'rice'; choose from clumped, rayleigh"),
        ({"names": "heave"}, "names is 'heave'"),
        ({"motion": 1}, "motion is 1; give True or False"),
    ],
)
def test_criteria_that_make_no_sense_are_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        replace(HEAVE, **given)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"values": 0.8}, "has no source"),
        ({"values": 1.2, "source": "x"}, "give numbers above 0, up to 1"),
        ({"values": [0.8], "source": "x"}, "values have shape"),
        ({"values": [[0.8]], "hours": [12], "hs": [2, 1], "source": "x"}, "hs are .*give ascending"),
    ],
)
def test_alpha_factors_that_make_no_sense_are_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        AlphaFactor(**given)


def test_an_operation_longer_than_the_table_of_alpha_is_refused() -> None:
    alpha = AlphaFactor(values=[[0.6]], hours=[72], hs=[1.0], source="a standard")
    with pytest.raises(SceneError, match="the operation takes 80 h, the table ends at 72 h"):
        alpha.at(1.0, hours=80.0)


def test_progress_is_shown_of_every_step(
    database: HydroDatabase, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: dict[str, Any] = ASKED | {
        "duration": 100.0,
        "start_up": 0.0,
        "seeds": [1, 2, 3],
    }
    allowable_hs(vessel(), **asked, domain="time")
    assert not capsys.readouterr().err
    monkeypatch.setattr("seacrane.operability.allowable.DELAY", 0.0)
    allowable_hs(vessel(), **asked, linear_within=1e-9, progress=True)
    said = capsys.readouterr().err
    for step in ("linear model", "test of the linear model", "ensemble"):
        assert f"{step}: 100%" in said


def test_nothing_is_warned_of(database: HydroDatabase) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        by_frequency(vessel(), [HEAVE], database)


def test_a_lift_on_a_quasi_static_line_is_allowed_what_its_elastic_twin_is(database: HydroDatabase) -> None:
    """Runs begin in the linear steady state, which keeps the lengths of lines."""
    found = {}
    for rung in ("elastic", "quasi-static"):
        scene = Scene(name=rung)
        scene.add_vessel(database)
        scene.add_sea(hs=1.0, tp=7.0, direction_deg=120.0, seed=1, count=60)
        scene.add_body(name="load", mass=5e3, inertia=(5e3, 5e3, 5e3), position=(10, 25, -5))
        scene.add_line(
            name="hoist", bodies=["vessel", "load"], points=[(10, 25, 10), (0, 0, 0)], EA=1e8,
            tension_at_start=5e3 * 9.80665, rung=rung, damping_ratio=0.05,
        )  # fmt: skip
        limit = Criterion(
            channel="line_tension", names={"line": "hoist"}, maximum=1.75 * 5e3 * 9.80665, exposure=1800.0
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            table = allowable_hs(
                scene, criteria=[limit], tp=[7.0], direction_deg=[120.0], domain="time",
                seeds=range(1, 4), duration=150.0, start_up=50.0, hs=(1.0, 1.5, 2.0), rtol=1e-3,
            )  # fmt: skip
        assert not table.failures
        found[rung] = float(table.dataset["allowable_hs"].values[0, 0])
    assert found["quasi-static"] == pytest.approx(found["elastic"], rel=0.05)
    assert found["elastic"] > 1.0


def test_a_steady_start_strains_no_line_by_the_squares_of_its_motions() -> None:
    """Stretch and its rate are those of small motions, also where bodies move by half a metre."""
    scene = soft_wire()
    model = linear_model(scene, state=equilibrium(scene))
    motion = np.random.default_rng(1).normal(0.0, 0.3, 2 * model.degrees_of_freedom)
    found = []
    for size in (0.0, 1e-4, 1.0):
        x = np.zeros(len(model.a))
        x[: motion.size] = size * motion
        now = Run(scene, 1.0, start=model.full_state(x)).measure()
        found.append(np.array([now["line_stretch"][0], now["line_tension"][0]]))
    slope, whole = (found[1] - found[0]) / 1e-4, found[2] - found[0]
    assert whole == pytest.approx(slope, rel=2e-2)


def test_a_cell_whose_runs_fail_is_told_as_failed() -> None:
    cells = Cells.of([HEAVE], [7.0], [120.0, 150.0, 180.0], largest=3.0)
    cells.take_time((0, 0), [ByTime(allowable=np.nan, low=np.nan, high=np.nan, unknown=1.0, failed=6)])
    cells.take_time((0, 1), [ByTime(allowable=1.0, low=1.0, high=1.0, unknown=2.0, failed=4)])
    cells.take_time((0, 2), [ByTime(allowable=1.4, low=1.2, high=1.6, failed=1)])
    table = AllowableHs.of(
        "lift", cells, alpha_of(1.0), 12.0,
        hs=[1.0, 2.0, 3.0], seeds=[1, 2, 3, 4, 5, 6], duration=900.0, linear_within=0.1,
        failures={0: "slack"},
    )  # fmt: skip
    assert np.isnan(table.dataset["allowable_hs"].values[0, 0])
    assert table.dataset["reason"].values[0].tolist() == [
        "6 runs failed: not known from Hs 1 m on", "4 runs failed: not known from Hs 2 m on",
        "1 runs failed, and the others count",
    ]  # fmt: skip
    assert "failed t" in str(table)
    plot_allowable_hs(table)
