"""Allowable Hs: closed forms, both domains against each other, given ships and lifts in stages."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from operability_scenes import HEAVE, PITCH, SHORT, WEIGHT, soft_wire, vessel
from stage_scenes import MASS, G, heaving

import seacrane as sc
from seacrane import Criterion, Stage, Until, allowable_hs, cases
from seacrane.analysis import response_summed
from seacrane.analysis.rest_state import held
from seacrane.operability import AllowableHs, AlphaFactor
from seacrane.operability.allowable import steady_start
from seacrane.operability.allowable_table import breaking_height, over_circle
from seacrane.operability.criterion import gaussian_level, reached, record_numbers, seeds_level
from seacrane.operability.linear_channels import LinearSeas
from seacrane.operability.time_domain import first_crossing
from seacrane.sea import jonswap


@pytest.fixture(scope="module")
def tested() -> AllowableHs:
    seas = {"tp": [7.0, 9.0], "direction_deg": [135.0, 180.0], "hs": [1.0, 2.0, 3.0]}
    return sc.allowable_hs(vessel(), criteria=[HEAVE, PITCH], **seas, **SHORT)


@pytest.fixture(scope="module")
def slack() -> AllowableHs:
    tension = sc.Criterion(channel="line_tension", maximum=4.0 * WEIGHT, exposure=900.0)
    seas = {"tp": 8.0, "direction_deg": 120.0, "hs": [2.0, 4.0, 6.0]}
    return sc.allowable_hs(soft_wire(), criteria=[tension], **seas, **SHORT)


def by_frequency(scene: sc.Scene, criteria: Any, **given: Any) -> AllowableHs:
    asked = {"tp": 9.0, "direction_deg": 135.0, "hs": [50.0]} | given
    return sc.allowable_hs(scene, criteria=criteria, domain="frequency", **asked)


def test_hs_is_what_the_linear_statistics_say() -> None:
    """2 sqrt(m0) per metre of Hs, from the other implementation of the response."""
    motion = sc.response_statistics(sc.linear_model(vessel()), spectrum=jonswap(hs=1.0, tp=9.0),
                                    direction=np.radians(135.0), body="vessel")  # fmt: skip
    wide, low = replace(HEAVE, maximum=1.6, name="wide"), replace(HEAVE, motion=False, name="above")
    found = by_frequency(vessel(), [PITCH, HEAVE, wide, low]).dataset["by_criterion"][:, 0, 0].to_numpy()
    assert found[0] == pytest.approx(PITCH.bound / motion.significant_amplitude[4], rel=1e-4)
    assert found[2] == pytest.approx(2.0 * found[1], rel=1e-12)
    assert found[3] > found[1]  # of one side there are fewer crests
    least = sc.Criterion(channel="line_tension", minimum=0.7 * WEIGHT, exposure=900.0, name="least")
    most = replace(least, minimum=None, maximum=1.3 * WEIGHT, name="most")
    wire = by_frequency(soft_wire(), [least, most], tp=8.0, direction_deg=120.0)
    down, up = wire.dataset["by_criterion"].to_numpy().ravel()
    assert down == pytest.approx(up, rel=0.01)  # the ship trims under the load: rest is not quite the weight


def test_a_turned_ship_in_turned_seas_is_the_same() -> None:
    def found(turned: float) -> Any:
        scene = sc.Scene()
        scene.add_vessel(sc.shipped_database(), heading_deg=turned)
        scene.add_sea(hs=1.0, tp=9.0, direction_deg=135.0 + turned, seed=1)
        return by_frequency(scene, [PITCH], direction_deg=135.0 + turned).dataset["by_criterion"].item()

    assert found(70.0) == pytest.approx(found(0.0), rel=1e-6)


@pytest.mark.parametrize(("tp", "steepness"), [(6.0, 1.0 / 15.0), (11.5, 4.0 / 75.0), (15.0, 1.0 / 25.0)])
def test_waves_break_at_the_steepness_of_dnv_rp_c205(tp: float, steepness: float) -> None:
    assert breaking_height(tp) == pytest.approx(steepness * 9.80665 * tp**2 / (2.0 * np.pi))
    assert jonswap(hs=breaking_height(tp), tp=tp).steepness() == pytest.approx(steepness)


def test_every_channel_of_the_linear_model_is_that_of_a_run() -> None:
    """From the same state in small waves: forces, velocities, angles. What differs is of second order."""
    criteria = (
        sc.Criterion(channel="hook_load", maximum=2e5),
        sc.Criterion(channel="position", names={"body": "payload", "axis": "y"}, maximum=1.0),
        sc.Criterion(channel="tip_velocity", names={"axis": "z"}, maximum=1.0),
        sc.Criterion(channel="cylinder_force", names={"cylinder": "main"}, maximum=1e7),
        sc.Criterion(channel="sidelead", maximum=0.1),
        sc.Criterion(channel="point_acceleration", names={"point": "deck", "axis": "z"}, maximum=1.0),
    )
    apart = np.array([_difference_of_run_and_model(hs, criteria) for hs in (0.005, 0.001)])
    assert np.all(apart[1] < 0.01)
    assert apart[0, 0] == pytest.approx(5.0 * apart[1, 0], rel=0.05)


def _difference_of_run_and_model(hs: float, criteria: tuple[sc.Criterion, ...]) -> list[float]:
    """Standard deviation of the difference over that of the model, by criterion."""
    scene = cases.case2(hs=hs)
    scene.add_point(name="deck", body="vessel", point=(20.0, 5.0, 8.0))
    rest = sc.equilibrium(scene, time=50.0)
    still = held(scene, time=50.0).copy(waves=scene.waves)
    linear = LinearSeas(still, rest, criteria)
    start, told = linear.in_waves(still.waves, 50.0, 50.0 + 0.5 * np.arange(101))
    run = sc.simulate(
        still, t_end=100.0, start=start, dt_out=0.5, rtol=1e-9, channels=[one.channel for one in criteria]
    )
    found = np.stack([run.curve(one.channel, **one.names) for one in criteria], axis=1)
    return list(np.std(found - told, axis=0) / np.std(told, axis=0))


def test_both_domains_agree_where_the_scene_is_linear(tested: AllowableHs) -> None:
    assert np.all(tested.dataset["domain"] == "frequency")
    assert np.nanmax(tested.dataset["difference"]) < 0.05
    sea = {"tp": 9.0, "direction_deg": 135.0, "hs": [1.0, 2.0], "domain": "time"}
    cell = sc.allowable_hs(vessel(), criteria=[HEAVE, PITCH], **sea, **SHORT).dataset.isel(
        tp=0, direction_deg=0
    )
    linear = tested.dataset.sel(tp=9.0, direction_deg=135.0)
    assert cell["domain"] == "time"
    assert cell["governing"] == linear["governing"] == "heave"
    assert cell["low"] < linear["allowable_hs"] < cell["high"]
    assert cell["allowable_hs"] == pytest.approx(float(linear["allowable_hs"]), rel=0.1)


def test_what_is_drawn_is_the_table(tested: AllowableHs, slack: AllowableHs) -> None:
    axes = sc.pictures.plot_allowable_hs(tested).axes[0]
    values = tested.dataset["allowable_hs"].to_numpy().ravel()
    told = sorted(float(text.get_text().split()[0].lstrip(">")) for text in axes.texts)
    assert told == pytest.approx(sorted(values), abs=0.06)
    assert len(sc.pictures.plot_allowable_hs(slack, forecast=True).axes[0].patches) == 1  # a frame: by runs
    rosette = sc.pictures.plot_allowable_hs(tested, kind="rosette").axes[0]
    assert [len(line.get_xdata()) for line in rosette.lines] == [2, 2]


def test_runs_begin_without_the_transient_of_a_soft_mooring() -> None:
    """From rest a beam sea sets off a sway of minutes, and first waves count as motion."""
    sway = sc.Criterion(channel="vessel_motion", names={"motion": "sway"}, maximum=0.5, motion=True,
                        statistic="significant", name="sway")  # fmt: skip
    asked = {"tp": 9.0, "direction_deg": 90.0, "criteria": [sway]}
    runs = sc.allowable_hs(vessel(), **asked, hs=[1.0, 2.0, 3.0], domain="time", **SHORT | {"start_up": 0.0})
    linear = sc.allowable_hs(vessel(), **asked, hs=[3.0], domain="frequency")
    found = runs.dataset.isel(tp=0, direction_deg=0)
    assert found["low"] < linear.dataset["allowable_hs"].item() < found["high"]


def test_a_steady_start_is_that_of_the_linear_model(monkeypatch: Any) -> None:
    """And turns no body by more than that model may."""
    scene = vessel(hs=0.5)
    rest = sc.equilibrium(scene)
    here = pickle.loads(pickle.dumps(steady_start(scene, rest)))(scene)
    monkeypatch.setattr("seacrane.operability.allowable.LARGEST_TURN", 1e-4)
    limited = steady_start(scene, rest)
    moved, turned, still = (
        sc.simulate(scene, t_end=0.0, start=one, channels=["vessel_motion"])["vessel_motion"][0]
        for one in (here, limited(scene), rest)
    )
    told = response_summed(sc.linear_model(scene), body="vessel")
    assert moved - still == pytest.approx(told.at(0.0), rel=2e-3, abs=1e-4)
    assert np.abs(turned[3:]).max() == pytest.approx(1e-4, rel=1e-3)


def test_a_wire_that_goes_slack_is_left_to_runs(slack: AllowableHs) -> None:
    cell = slack.dataset.isel(tp=0, direction_deg=0)
    assert cell["domain"] == "time"
    assert "line tension" in str(cell["reason"].item())
    assert float(cell["difference"][0]) > slack.dataset.attrs["linear_within"]
    asked = {"tp": 8.0, "direction_deg": 120.0}
    linear = by_frequency(soft_wire(), slack.criteria, **asked).dataset["allowable_hs"][0, 0]
    assert not cell["low"] <= linear <= cell["high"]
    tension = sc.Criterion(channel="line_tension", maximum=1.5 * WEIGHT, exposure=900.0)
    looser = sc.allowable_hs(soft_wire(), criteria=[tension], **asked, hs=[4.0], **SHORT).dataset
    assert looser["domain"].item() == "frequency"  # the wire stays taut
    low = sc.allowable_hs(
        soft_wire(), criteria=[replace(tension, maximum=0.5 * WEIGHT)], **asked, hs=[4.0], **SHORT
    )
    assert low.dataset["allowable_hs"].item() == 0.0
    assert "at rest" in low.dataset["reason"].item()


def test_a_table_is_between_its_cells(tested: AllowableHs) -> None:
    capped, values = tested.dataset["capped"].to_numpy(), tested.dataset["allowable_hs"].to_numpy()
    assert capped.any() and not capped.all() and ">3.00 f" in str(tested)
    assert np.all(values[capped] == 3.0)
    assert np.all(tested.dataset["governing"].to_numpy()[capped] == "")
    assert tested.at(8.0, 135.0) == pytest.approx(values[:, 0].mean())
    assert tested.at(7.0, 157.5) == pytest.approx(values[0].mean())
    assert tested.at([7.0, 9.0]) == pytest.approx(values.min(axis=1))
    assert np.isnan(tested.at([6.9, 9.1, 7.0], [135.0, 135.0, 0.0])).all()
    assert tested.at(7.0, 495.0) == pytest.approx(values[0, 0])


def test_short_crested_seas_move_a_vessel_less_from_ahead_and_more_from_the_side() -> None:
    roll = sc.Criterion(
        channel="vessel_motion", names={"motion": "roll"}, maximum=0.05, statistic="significant", name="roll"
    )
    long = by_frequency(vessel(), [roll], direction_deg=[90.0, 150.0])
    short = by_frequency(vessel(spreading=2.0), [roll], direction_deg=[90.0, 150.0])
    above, ahead = (short.dataset["allowable_hs"] - long.dataset["allowable_hs"]).to_numpy()[0]
    assert above > 0.0 > ahead


def test_what_the_linear_model_has_not_is_left_to_runs() -> None:
    with pytest.raises(sc.SceneError, match="'torsethaugen' changes its shape with Hs"):
        by_frequency(vessel(spectrum="torsethaugen"), [HEAVE])
    short = {"hs": [1.0, 3.0], "duration": 100.0, "start_up": 20.0, "seeds": [1, 2, 3], "rtol": 1e-3}
    found = sc.allowable_hs(
        vessel(memory="convolution"), criteria=[HEAVE], tp=9.0, direction_deg=180.0, **short
    )
    assert found.dataset["domain"].item() == "time"


def asked(**given: Any) -> AllowableHs:
    sea = {"criteria": [HEAVE], "tp": 9.0, "direction_deg": 135.0, "hs": [1.0]}
    return sc.allowable_hs(vessel(), **sea | given)


def test_threads_and_a_store_change_nothing(tmp_path: Path) -> None:
    short = {"hs": [1.0, 2.0], "domain": "time", "duration": 200.0, "start_up": 50.0, "seeds": [1, 2, 3]}
    alone, store = asked(**short), {"store": tmp_path / "storms"}
    with ThreadPoolExecutor(2) as executor:
        stored = asked(**short, executor=executor, **store)
    assert alone.dataset.identical(stored.dataset)
    assert alone.dataset.identical(asked(**short, **store).dataset)
    with pytest.raises(sc.SceneError, match="keep"):
        asked(**short, **store, criteria=[replace(HEAVE, names={"motion": "pitch"})])


def test_alpha_lowers_the_forecast_and_nothing_else() -> None:
    alpha = AlphaFactor(values=[[0.6, 0.8], [0.5, 0.7]], hours=[12, 24], hs=[1.0, 3.0], source="a standard")
    plain, told = (
        by_frequency(vessel(), [HEAVE], hs=[3.0], **given) for given in ({}, {"alpha": alpha, "hours": 18.0})
    )
    height = float(plain.dataset["allowable_hs"].item())
    assert told.dataset["allowable_hs"].item() == height
    assert told.dataset["forecast_hs"].item() == pytest.approx(height * (0.5 + 0.1 * (height - 1.0)))
    assert told.at(9.0, 135.0, forecast=True) == told.dataset["forecast_hs"].item()


def test_the_first_crossing() -> None:
    nan, inf = np.nan, np.inf
    for levels, allowance, hs in (
        ([1.0, 2.0, 4.0], 0.5, 0.5), ([1.0, 2.0, 4.0], 3.0, 2.5), ([1.0, 2.0, 4.0], 5.0, inf),
        ([1.0, 0.5, 4.0], 0.9, 0.9),  # the first crossing counts
        ([1.0, inf, 4.0], 3.0, 1.0),  # runs that failed allow no more than the Hs below
        ([inf, 1.0, 4.0], 3.0, nan), ([1.0, 2.0, 4.0], 0.0, 0.0),  # not known is not zero
    ):  # fmt: skip
        assert first_crossing([1.0, 2.0, 3.0], levels, allowance) == pytest.approx(hs, nan_ok=True)
    assert seeds_level(HEAVE, np.array([1.0, 2.0, nan]), 900.0).value == inf  # failed seeds are no evidence
    with_one_failed = seeds_level(HEAVE, np.array([1.0, 1.2, 1.1, nan]), 900.0)
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


def test_how_far_a_record_went() -> None:
    """From rest at 3: up, down, and to the farther side, by extremes and by significant values."""
    times = np.arange(0.0, 100.0, 0.1)
    assert record_numbers(3.0 + 2.0 * np.sin(times)) == pytest.approx([5.0, 1.0, 5.0, 1.0], abs=1e-3)
    assert record_numbers(np.full(9, 4.0)) == pytest.approx([4.0] * 4)
    numbers = np.array([[5.0, 2.0, 4.5, 2.5], [4.0, 0.0, 3.5, 1.0]])
    upper = sc.Criterion(channel="line_tension", maximum=6.0)
    lower = sc.Criterion(channel="line_tension", minimum=1.0)
    either = sc.Criterion(channel="line_tension", maximum=2.0, motion=True)
    assert reached(upper, numbers, 3.0).tolist() == [2.0, 1.0]
    assert reached(lower, numbers, 3.0).tolist() == [1.0, 3.0]
    assert reached(either, numbers, 3.0).tolist() == [2.0, 3.0]
    assert reached(replace(either, statistic="significant"), numbers, 3.0).tolist() == [1.5, 2.0]
    assert [one.allowance(3.0) for one in (upper, lower, either)] == [3.0, 2.0, 2.0]


def test_between_directions_of_a_circle() -> None:
    directions = np.array([0.0, 90.0, 180.0, 270.0])
    values = np.array([1.0, 2.0, 3.0, 4.0])[:, None]
    for asked, found in ((45.0, 1.5), (315.0, 2.5), (-90.0, 4.0), (360.0, 1.0), (180.0, 3.0)):
        assert over_circle(directions, values, np.array([asked]))[0] == pytest.approx(found)
    assert np.isnan(over_circle(directions[:2], values[:2], np.array([91.0]))[0])
    assert over_circle(directions[:1], values[:1], np.array([0.0]))[0] == 1.0


@pytest.mark.parametrize(
    ("make", "given", "message"),
    [
        (asked, {"criteria": [HEAVE, HEAVE]}, "'heave'.*twice"),
        (asked, {"direction_deg": [0.0, 360.0]}, "direction_deg"),
        (asked, {"seeds": [1, 2, 2]}, "seeds is"),
        (asked, {"duration": 80.0}, "duration is 80 s.*90 s"),
        (partial(replace, HEAVE), {"maximum": -1.0}, "motion=True"),
        (AlphaFactor(values=[[0.8]], hours=[12], hs=[2], source="x").at, {"hs": 1.0, "hours": 80.0}, "80 h"),
    ],
)
def test_what_makes_no_sense_is_refused(make: Any, given: dict[str, Any], message: str) -> None:
    with pytest.raises(sc.SceneError, match=message):
        make(**given)


def test_a_steady_start_strains_no_line_by_the_squares_of_its_motions() -> None:
    """Stretch and its rate are those of small motions, also where bodies move by half a metre."""
    scene = soft_wire()
    model = sc.linear_model(scene, state=sc.equilibrium(scene))
    motion = np.random.default_rng(1).normal(0.0, 0.3, 2 * model.degrees_of_freedom)
    found = []
    for size in (0.0, 1e-4, 1.0):
        x = np.zeros(len(model.a))
        x[: motion.size] = size * motion
        now = sc.Run(scene, 1.0, start=model.full_state(x)).measure()
        found.append(np.array([now["line_stretch"][0], now["line_tension"][0]]))
    slope, whole = (found[1] - found[0]) / 1e-4, found[2] - found[0]
    assert whole == pytest.approx(slope, rel=2e-2)


DOWN = {"until": Until.length("wire", minimum=20.0), "maximum_duration": 9.0, "commands": {"wire.rate": 0.4}}
STAGES = [Stage(name="hang", duration=8.0), Stage(name="down", **DOWN)]
PULL = Criterion(channel="line_tension[wire]", maximum=1.15 * MASS * G)
STAGED = {"criteria": [PULL], "tp": 8.0, "direction_deg": 0.0, "hs": [2.0, 4.0], "seeds": (1, 2, 3)}


@pytest.mark.parametrize("ramp", [pytest.param(0.0, marks=pytest.mark.warns("AssemblyWarning")), 5.0])
def test_what_a_given_ship_allows_does_not_depend_on_the_sea_it_is_described_in(ramp: float) -> None:
    found = [allowable_hs(heaving(hs, ramp), stages=STAGES, **STAGED) for hs in (0.5, 5.0)]
    heights = [table.dataset["allowable_hs"].item() for table in found]
    assert heights[0] == heights[1] and 0.0 < heights[0] < 4.0
    assert not found[0].failures and not found[1].failures


@pytest.mark.parametrize("domain", ["auto", "time"])
def test_a_given_ship_is_run_everywhere_for_as_long_as_it_takes(domain: str) -> None:
    """Its motion is described for 60 s, and the runs take 90 s."""
    table = allowable_hs(heaving(1.0), **STAGED, duration=80.0, start_up=10.0, domain=domain)
    assert not table.failures
    assert table.dataset["domain"].item() == "time"
    assert 0.0 < table.dataset["allowable_hs"].item() < 4.0


def test_what_a_lift_in_stages_allows_does_not_depend_on_its_outputs() -> None:
    """The load bounces on its hoist in 0.7 s: outputs 0.5 s apart see hardly any of its peaks."""
    near, far = (allowable_hs(heaving(1.0), stages=STAGES, dt_out=dt_out, **STAGED) for dt_out in (0.02, 0.5))
    assert far.dataset["allowable_hs"].item() == pytest.approx(near.dataset["allowable_hs"].item(), rel=2e-3)
