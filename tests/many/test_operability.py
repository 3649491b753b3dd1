"""Allowable Hs: closed forms, both domains against each other, and what each cell says of itself."""

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

import seacrane as sc
from seacrane import cases
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


def test_loads_on_the_vessel_go_straight_into_accelerations() -> None:
    """y = ... + D f: what a push does at once, against the mass of the vessel with its added mass."""
    model = sc.linear_model(vessel())
    place = sc.Criterion(channel="point_acceleration", names={"point": "bow", "axis": "z"}, maximum=1.0)
    scene = vessel()
    scene.add_point(name="bow", body="vessel", point=(50.0, 0.0, 0.0))
    d = linear_channels(sc.linear_model(scene), [place]).d[0]
    dof = model.degrees_of_freedom
    pushed = model.output(body="vessel", point=(50.0, 0.0, 0.0))[2, :dof] @ model.b[dof : 2 * dof]
    assert d == pytest.approx(pushed, rel=1e-6, abs=1e-6 * np.abs(pushed).max())


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


def test_runs_begin_without_the_transient_of_a_soft_mooring() -> None:
    """From rest a beam sea sets off a sway of minutes, and first waves count as motion."""
    sway = sc.Criterion(channel="vessel_motion", names={"motion": "sway"}, maximum=0.5, motion=True,
                        statistic="significant", name="sway")  # fmt: skip
    asked = {"tp": 9.0, "direction_deg": 90.0, "criteria": [sway]}
    runs = sc.allowable_hs(vessel(), **asked, hs=[1.0, 2.0, 3.0], domain="time", **SHORT | {"start_up": 0.0})
    linear = sc.allowable_hs(vessel(), **asked, hs=[3.0], domain="frequency")
    found = runs.dataset.isel(tp=0, direction_deg=0)
    assert found["low"] < linear.dataset["allowable_hs"].item() < found["high"]


def test_a_steady_start_is_that_of_the_linear_model_wherever_it_is_made(monkeypatch: Any) -> None:
    """And turns no body by more than that model may."""
    scene = vessel(hs=0.5)
    rest = sc.equilibrium(scene)
    start = steady_start(scene, rest)
    assert isinstance(start, SteadyStart)
    there, here = pickle.loads(pickle.dumps(start))(scene), start(scene)
    assert np.array_equal(there.values, here.values)
    monkeypatch.setattr("seacrane.operability.allowable.LARGEST_TURN", 1e-4)
    limited = steady_start(scene, rest)
    assert isinstance(limited, SteadyStart)
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


def test_a_table_tells_what_it_rests_on_and_is_between_its_cells(tested: Any, slack: Any) -> None:
    text = str(tested)
    for told in ("linear model (4 cells)", "runs (0 cells)", "none", "in 900 s <= 0.8 m", ">3.00 f", "Af"):
        assert told in text
    assert "<table" in tested._repr_html_()
    capped, values = tested.dataset["capped"].to_numpy(), tested.dataset["allowable_hs"].to_numpy()
    assert capped.any() and not capped.all()
    assert np.all(values[capped] == 3.0)
    assert np.all(tested.dataset["governing"].to_numpy()[capped] == "")
    assert tested.at(8.0, 135.0) == pytest.approx(values[:, 0].mean())
    assert tested.at(7.0, 157.5) == pytest.approx(values[0].mean())
    assert tested.at([7.0, 9.0]) == pytest.approx(values.min(axis=1))
    assert np.isnan(tested.at([6.9, 9.1, 7.0], [135.0, 135.0, 0.0])).all()
    assert tested.at(7.0, 495.0) == pytest.approx(values[0, 0])
    assert pickle.loads(pickle.dumps(tested)).dataset.identical(tested.dataset)
    axes = plot_allowable_hs(tested).axes[0]
    assert len(axes.texts) == 4 and not axes.patches
    assert len(plot_allowable_hs(slack, forecast=True).axes[0].patches) == 1  # a frame: by runs
    rosette = plot_allowable_hs(tested, kind="rosette").axes[0]
    assert [len(line.get_xdata()) for line in rosette.lines] == [2, 2]


def test_short_crested_seas_move_a_vessel_less_from_ahead_and_more_from_the_side() -> None:
    roll = sc.Criterion(
        channel="vessel_motion", names={"motion": "roll"}, maximum=0.05, statistic="significant", name="roll"
    )
    long = by_frequency(vessel(), [roll], direction_deg=[90.0, 150.0])
    short = by_frequency(vessel(spreading=2.0), [roll], direction_deg=[90.0, 150.0])
    above, ahead = (short.dataset["allowable_hs"] - long.dataset["allowable_hs"]).to_numpy()[0]
    assert above > 0.0 > ahead


def test_what_the_linear_model_has_not_is_left_to_runs() -> None:
    scene = vessel(memory="convolution")
    with pytest.raises(sc.SceneError, match="convolution"):
        by_frequency(scene, [HEAVE])
    with pytest.raises(sc.SceneError, match="'torsethaugen' changes its shape with Hs"):
        by_frequency(vessel(spectrum="torsethaugen"), [HEAVE])
    found = sc.allowable_hs(
        scene, criteria=[HEAVE], tp=9.0, direction_deg=180.0, hs=[1.0, 3.0],
        duration=100.0, start_up=20.0, seeds=[1, 2, 3], rtol=1e-3,
    )  # fmt: skip
    assert found.dataset["domain"].item() == "time"
    assert "convolution" in found.dataset["reason"].item()


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
    assert "18 h by a table (source: a standard)" in str(told)
    assert told.at(9.0, 135.0, forecast=True) == told.dataset["forecast_hs"].item()
    with pytest.raises(sc.SceneError, match="80 h, the table ends at 24 h"):
        alpha.at(1.0, hours=80.0)


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


ASKED = {"criteria": [HEAVE], "tp": 9.0, "direction_deg": 135.0, "hs": [1.0]}


def asked(**given: Any) -> AllowableHs:
    scene = vessel() if given.pop("sea", True) else vessel().copy(waves=None)
    return sc.allowable_hs(scene, **{**ASKED, **given})


heave = partial(replace, HEAVE)


@pytest.mark.parametrize(
    ("make", "given", "message"),
    [
        (asked, {"criteria": []}, "criteria is"),
        (asked, {"criteria": [HEAVE, HEAVE]}, "'heave'.*twice"),
        (asked, {"criteria": [heave(channel="hook_load", names={})]}, "hook_load"),
        (asked, {"criteria": [heave(channel="position[lod, z]", names={})]}, "'lod'"),
        (asked, {"criteria": [heave(names={})]}, "give motion"),
        (asked, {"tp": [9.0, 8.0]}, "tp is .*ascending"),
        (asked, {"direction_deg": [0.0, 360.0]}, "direction_deg"),
        (asked, {"hs": [np.nan]}, "hs is"),
        (asked, {"seeds": [1, 2, 2]}, "seeds is"),
        (asked, {"duration": 80.0}, "duration is 80 s.*90 s"),
        (asked, {"channels": ["position"]}, "channels"),
        (asked, {"domain": "both"}, "domain is 'both'"),
        (asked, {"sea": False}, "has no sea"),
        (heave, {"channel": "hook_lod"}, "'hook_lod'.*'hook_load'"),
        (heave, {"maximum": None}, "maximum or minimum"),
        (heave, {"minimum": 0.0}, "maximum or minimum"),
        (heave, {"maximum": -1.0}, "motion=True"),
        (heave, {"statistic": "P95"}, "statistic is 'P95'"),
        (AlphaFactor, {"values": 0.8}, "source"),
        (AlphaFactor, {"values": 1.2, "source": "x"}, "up to 1"),
        (AlphaFactor, {"values": [[0.8]], "hours": [12], "hs": [2, 1], "source": "x"}, "hs are"),
    ],
)
def test_what_makes_no_sense_is_refused(make: Any, given: dict[str, Any], message: str) -> None:
    with pytest.raises(sc.SceneError, match=message):
        make(**given)


def test_progress_is_shown_of_every_step(monkeypatch: Any, capsys: Any) -> None:
    monkeypatch.setattr("seacrane.operability.allowable.DELAY", 0.0)
    asked(duration=100.0, start_up=0.0, seeds=[1, 2, 3], linear_within=1e-9, progress=True)
    said = capsys.readouterr().err
    for step in ("linear model", "test of the linear model", "ensemble"):
        assert f"{step}: 100%" in said


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_a_lift_on_a_quasi_static_line_is_allowed_what_its_elastic_twin_is() -> None:
    """Runs begin in the linear steady state, which keeps the lengths of lines."""
    found, weight = {}, 5e3 * 9.80665
    limit = sc.Criterion(channel="line_tension[hoist]", maximum=1.75 * weight, exposure=1800.0)
    how = {"seeds": range(1, 4), "duration": 150.0, "start_up": 50.0, "rtol": 1e-3}
    for rung in ("elastic", "quasi-static"):
        scene = sc.Scene(name=rung)
        scene.add_vessel(shipped_database())
        scene.add_sea(hs=1.0, tp=7.0, direction_deg=120.0, seed=1, count=60)
        scene.add_body(name="load", mass=5e3, inertia=(5e3, 5e3, 5e3), position=(10, 25, -5))
        line = {"tension_at_start": weight, "rung": rung, "damping_ratio": 0.05, "EA": 1e8}
        scene.add_line("hoist", bodies=["vessel", "load"], points=[(10, 25, 10), (0, 0, 0)], **line)
        sea = {"tp": [7.0], "direction_deg": [120.0], "hs": (1.0, 1.5, 2.0)}
        table = sc.allowable_hs(scene, criteria=[limit], domain="time", **sea, **how)
        assert not table.failures
        found[rung] = float(table.dataset["allowable_hs"].values[0, 0])
    assert found["quasi-static"] == pytest.approx(found["elastic"], rel=0.05)
    assert found["elastic"] > 1.0


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


def test_a_cell_whose_runs_fail_is_told_as_failed() -> None:
    cells = Cells.of([HEAVE], [7.0], [120.0, 150.0, 180.0], largest=3.0)
    cells.take_time((0, 0), [ByTime(allowable=np.nan, low=np.nan, high=np.nan, unknown=1.0, failed=6)])
    cells.take_time((0, 1), [ByTime(allowable=1.0, low=1.0, high=1.0, unknown=2.0, failed=4)])
    cells.take_time((0, 2), [ByTime(allowable=1.4, low=1.2, high=1.6, failed=1)])
    table = AllowableHs.of("lift", cells, alpha_of(1.0), 12.0, hs=[1.0, 2.0, 3.0], seeds=[1, 2, 3, 4, 5, 6],
                           duration=900.0, linear_within=0.1, failures={0: "slack"})  # fmt: skip
    assert np.isnan(table.dataset["allowable_hs"].values[0, 0])
    unknown, beyond, others = table.dataset["reason"].values[0].tolist()
    assert "6 runs failed" in unknown and "from Hs 1 m" in unknown
    assert "4 runs failed" in beyond and "from Hs 2 m" in beyond
    assert "1 runs failed" in others
    assert "failed t" in str(table)
    plot_allowable_hs(table)
