"""The sheet by phases: each phase alone, windows by brute force, go or no-go, what is told and refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from operability_scenes import HEAVE, PITCH, vessel
from stage_scenes import MASS, G, heaving

from seacrane import Criterion, SceneError, Stage, Until, allowable_hs, weather_windows
from seacrane.operability import (
    AllowableHs,
    AlphaFactor,
    Phase,
    PhaseSheet,
    WaveHindcast,
    go_or_no_go,
    phase_sheet,
)
from seacrane.operability.phase import legs_of
from seacrane.operability.phase_table import _turns
from seacrane.operability.time_domain import ByTime

HOUR = np.timedelta64(1, "h")
START = np.datetime64("2021-03-01T00:00")
ALPHA = AlphaFactor(
    values=[[0.9, 0.9], [0.7, 0.8], [0.5, 0.6]], hours=[4, 8, 24], hs=[1.0, 3.0], source="made up"
)
PHASES = [
    Phase(name="transfer", hours=2.0, contingency_hours=1.0),
    Phase(name="hold", hours=1.5, contingency_hours=0.5, safe=True),
    Phase(name="connect", hours=3.0),
]
CRITERIA = [replace(HEAVE, exposure=None), replace(PITCH, stage="hold", maximum=0.005, name="pitch")]
SEAS: dict[str, Any] = {"tp": [6.0, 9.0, 14.0], "direction_deg": [90.0, 135.0, 180.0], "hs": [4.0]}


def sheet_of(**given: Any) -> PhaseSheet:
    asked: dict[str, Any] = {"phases": PHASES, "criteria": CRITERIA, "domain": "frequency", "alpha": ALPHA,
                             "seeds": range(1, 11)}  # fmt: skip
    return phase_sheet(given.pop("scene", vessel()), **SEAS | asked | given)


@pytest.fixture(scope="module")
def sheet() -> PhaseSheet:
    return sheet_of()


def series(hs: Any, tp: Any = 9.0) -> WaveHindcast:
    heights = np.asarray(hs, dtype=float)
    times = START + np.arange(heights.size) * HOUR
    return WaveHindcast(time=times, hs=heights, tp=np.broadcast_to(tp, heights.shape), source="made up")


def test_each_phase_is_allowable_hs_of_it_alone(sheet: PhaseSheet) -> None:
    """Over its planned hours, with the alpha factor of the hours to its end; the least of them governs."""
    forecasts = []
    for phase, criteria, reference in zip(
        PHASES, (CRITERIA[:1], CRITERIA, CRITERIA[:1]), (3, 5, 3), strict=True
    ):
        own = [replace(one, stage="", exposure=3600.0 * phase.hours) for one in criteria]
        alone = allowable_hs(
            vessel(), criteria=own, domain="frequency", alpha=ALPHA, hours=float(reference), **SEAS
        )
        assert sheet.table(phase.name).dataset.identical(alone.dataset)
        forecasts.append(alone.dataset["forecast_hs"].to_numpy())
    data = sheet.to_xarray()
    assert data["reference_hours"].to_numpy().tolist() == [3.0, 5.0, 3.0]  # waits for another forecast
    assert np.array_equal(data["operation_hs"][0], np.min(forecasts, axis=0))
    governs = np.array([one.name for one in PHASES])[np.argmin(forecasts, axis=0)]
    assert np.array_equal(data["governing_phase"][0], governs) and "hold" in governs
    assert data["governing"].sel(phase="hold", tp=9.0, direction_deg=180.0).item() == "pitch"
    text = str(sheet)
    assert "'hold' governs" in text and "stationary" in text and "B: hold" in text
    assert "safe to wait for another forecast: after 'hold', the last phase" in text


def test_a_limit_that_turns_round_within_the_periods_is_told(sheet: PhaseSheet) -> None:
    table = sheet.table("hold")
    data = table.dataset.copy(deep=True)
    data["allowable_hs"][:, 2] = [1.5, 1.2, 1.3]
    told = replace(sheet, tables=dict(sheet.tables) | {("", "hold"): replace(table, dataset=data)})
    data["allowable_hs"][:, :2] = [[1.0, 3.5], [2.0, 3.2], [2.0, 3.4]]
    assert told.not_monotone("hold") == "in Tp, least at 9 s: at 135 deg, 180 deg", "alike: once"
    assert "hold: not monotone in Tp, least" in str(told)
    data["allowable_hs"][:, 2] = [1.0, 1.4, 1.3]  # forbidden, allowed, forbidden
    assert "in Tp, largest at 9 s: at 180 deg" in told.not_monotone("hold")
    data["allowable_hs"][:, 2] = [1.5, 1.3, 1.3]
    assert "180 deg" not in told.not_monotone("hold")
    heights = np.array([1.0, 2.0, np.nan, 2.0, 1.5, 3.0])
    assert _turns(np.arange(6.0), heights) == ["largest at 1 s", "least at 4 s"]


def by_loop(sheet: PhaseSheet, hindcast: WaveHindcast) -> tuple[list[bool], list[float]]:
    """Hour by hour: whether the first leg may start, and the waits of all legs together."""
    size = hindcast.time.size
    legs = [
        [("transfer", 0, 3, 3.0), ("hold", 3, 5, 5.0)],
        [("connect", 0, 3, 3.0)],
    ]

    def kept(leg: Any, start: int) -> bool:
        for name, first, last, reference in leg:
            for hour in range(start + first, start + last):
                if hour >= size:
                    return False
                bare = sheet.table(name).at(hindcast.tp[hour])
                if not hindcast.hs[hour] <= bare * ALPHA.at(bare, hours=reference):
                    return False
        return True

    may_start = [kept(legs[0], hour) for hour in range(size)]
    waits = []
    for call in range(size):
        hour, waited = call, 0.0
        for leg, length in zip(legs, (5, 3), strict=True):
            begin = next((at for at in range(hour, size) if kept(leg, at)), None)
            if begin is None:
                waited = float("nan")
                break
            waited, hour = waited + begin - hour, begin + length
        waits.append(waited)
    return may_start, waits


def test_windows_of_phases_in_series_are_those_of_a_loop(sheet: PhaseSheet) -> None:
    random = np.random.default_rng(8)
    smooth = np.convolve(random.normal(size=400), np.ones(8) / 8.0**0.5, mode="same")
    periods = np.clip(9.0 + np.roll(smooth, 50), 6.0, 14.0)
    hindcast = series(0.6 * float(sheet.table("hold").at(9.0)) * np.exp(0.4 * smooth), periods)
    found = weather_windows(hindcast, sheet)
    may_start, waits = by_loop(sheet, hindcast)
    assert 5 < sum(may_start) < 395
    assert found.dataset["may_start"].to_numpy().tolist() == may_start
    assert np.array_equal(found.dataset["waiting"], waits, equal_nan=True)
    assert found.hours == 8.0


def test_one_phase_has_the_windows_of_its_table() -> None:
    one = sheet_of(phases=PHASES[:1], criteria=CRITERIA[:1])
    hindcast = series(0.5 + 0.5 * np.sin(np.arange(300) / 9.0) ** 2)
    alone = weather_windows(hindcast, one.table("transfer"))
    for name in ("hs_limit", "may_start", "waiting", "start", "length"):
        assert np.array_equal(
            weather_windows(hindcast, one).dataset[name], alone.dataset[name], equal_nan=True
        )


def test_a_forecast_is_go_until_the_alpha_factor_falls(sheet: PhaseSheet) -> None:
    """Calm, but for one hour that the hold meets from one start, and the transfer from a later one."""
    limits = {name: float(sheet.table(name).at(9.0)) for name in ("transfer", "hold")}
    assert limits["hold"] < limits["transfer"]
    calm = 0.4 * limits["hold"]
    hs = np.full(20, calm)
    hs[4] = 0.99 * limits["hold"]  # above the hold with any alpha, below the transfer
    early = go_or_no_go(series(hs), sheet, start=START)
    assert not early.go and early.hs[1] == hs[4] and early.governing[1] == "pitch"
    assert early.limit[1] == pytest.approx(limits["hold"] * ALPHA.at(limits["hold"], hours=5.0))
    late = go_or_no_go(series(hs), sheet, start=START + 5 * HOUR, issued=START)
    assert late.go and late.limit[1] == pytest.approx(limits["hold"] * ALPHA.at(limits["hold"], hours=10.0))
    assert "GO at 2021-03-01T05" in str(late) and START not in late.starts
    past = go_or_no_go(series(hs), sheet, start=START + 17 * HOUR)
    assert not past.go and np.isnan(past.hs[1]) and past.governing[1] == "not known"
    assert "hold: the forecast ends at 2021-03-01T19" in str(past)
    assert "connect: by another forecast, after hold" in str(past)
    gap = hs.copy()
    gap[3] = np.nan
    assert "hold: the forecast has no sea state at 2021-03-01T03" in str(go_or_no_go(series(gap), sheet))
    beyond = replace(series(hs), tp=np.full(20, 20.0), direction_from_deg=np.full(20, 240.0))
    assert "transfer: no limit for the sea of 2021-03-01T00:00" in str(go_or_no_go(beyond, sheet))
    assert "Tp 20 s: the sheet has 6 to 14 s" in str(go_or_no_go(beyond, sheet))
    told = str(go_or_no_go(beyond, sheet, heading_deg=30.0))
    assert "waves to -30 deg from the bow to port: the sheet has 6 to 14 s, to 90 to 180 deg" in told
    assert go_or_no_go(series(hs), sheet, first="connect").phases == ("connect",)
    with pytest.raises(SceneError, match="issued is no time"):
        go_or_no_go(series(hs), sheet, issued="NaT")


@pytest.mark.slow("three sheets")
def test_load_cases_are_rows(tmp_path: Path) -> None:
    both = sheet_of(scene={"long seas": vessel(), "short seas": vessel(spectrum="pierson-moskowitz")})
    assert both.dataset.sizes["case"] == 2
    alone = sheet_of(scene=vessel(spectrum="pierson-moskowitz"))
    assert np.array_equal(both.dataset["forecast_hs"][1], alone.dataset["forecast_hs"][0])
    head, *rows = both.to_csv(tmp_path / "sheet.csv").read_text().splitlines()
    assert head.startswith("case,phase,tp [s],direction_deg") and len(rows) == 2 * 3 * 3 * 3
    assert "short seas" in both.html() and both.table("hold", case="long seas") is not None
    with pytest.raises(SceneError, match="long seas, short seas"):
        both.table("hold")


def test_of_phases_and_legs() -> None:
    found = [[(one.phase.name, one.begin, one.end) for one in leg] for leg in legs_of(PHASES)]
    assert found == [[("transfer", 0.0, 3.0), ("hold", 3.0, 5.0)], [("connect", 0.0, 3.0)]]


DOWN = {"until": Until.length("wire", minimum=20.0), "maximum_duration": 9.0, "commands": {"wire.rate": 0.4}}
STAGES = [Stage(name="hang", duration=8.0), Stage(name="down", **DOWN)]
PULL = Criterion(channel="line_tension[wire]", maximum=1.15 * MASS * G, name="pull")
PASSED: dict[str, Any] = {
    "phases": [
        Phase(name="hang", hours=0.1, passage=True),
        Phase(name="lower", hours=0.1, passage=True, stages=["down"]),
    ],
    "criteria": [PULL], "tp": 8.0, "direction_deg": 0.0, "hs": [2.0, 4.0, 6.0], "stages": STAGES,
}  # fmt: skip


@pytest.mark.slow("runs of 25 seeds")
def test_passages_are_the_p90_of_the_seeds_of_one_lift(tmp_path: Path) -> None:
    """Told by the same runs as `allowable_hs` of its stages; with `until` seeds end early, and it goes on."""
    sheet = phase_sheet(heaving(1.0), **PASSED, seeds=range(1, 6))
    alone = [
        allowable_hs(
            heaving(1.0), criteria=[replace(PULL, stage=stage, statistic="p90")], stages=STAGES,
            seeds=range(1, 6), **{key: PASSED[key] for key in ("tp", "direction_deg", "hs")},
        ).dataset for stage in ("hang", "down")
    ]  # fmt: skip
    for phase, told in zip(("hang", "lower"), alone, strict=True):
        found = sheet.table(phase).dataset
        for name in ("allowable_hs", "low", "high"):
            assert np.array_equal(found[name], told[name], equal_nan=True)
    assert "passage, P90 of 5 seeds" in str(sheet) and "pull in down" in str(sheet)
    asked = {"seeds": range(1, 31), "until": 0.9, "store": tmp_path / "runs"}
    few = phase_sheet(heaving(1.0), **PASSED, **asked)
    assert few.dataset["runs"].to_numpy().max() == 10
    assert few.dataset.identical(phase_sheet(heaving(1.0), **PASSED, **asked).dataset)


def test_a_limit_that_is_kept_again_at_a_higher_hs_is_told(sheet: PhaseSheet) -> None:
    from seacrane.operability.asked import asked_of
    from seacrane.operability.cells import Cells
    from seacrane.run.method import settled

    asked = asked_of(
        [HEAVE], 9.0, 180.0, [1.0, 2.0, 3.0], domain="time", stages=(), duration=None, start_up=None,
        seeds=[1, 2, 3], linear_within=0.1, method=settled(None, None, {})[0], dt_out=0.5, accuracy=None,
    )  # fmt: skip
    cells = Cells(asked)
    cells.take_time((0, 0), [ByTime(allowable=1.5, low=1.4, high=1.6, again=3.0)], 3)
    table: AllowableHs = cells.table("scene", AlphaFactor(), 1.0, {})
    assert table.dataset["again_hs"].item() == 3.0 and "1 cells are not monotone in Hs" in str(table)
    told = replace(sheet, tables={("", one.name): table for one in PHASES})
    assert told.not_monotone("hold") == "in Hs, kept again at 3 m: at 9 s and 180 deg"
    lost = table.dataset.assign(forecast_hs=np.nan * table.dataset["forecast_hs"])
    tables = {("", one.name): replace(table, dataset=lost) for one in PHASES}
    assert "'transfer' governs, forecast Hs not known" in str(replace(sheet, tables=tables))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"phases": [PHASES[0], PHASES[0]]}, "'transfer' is there twice"),
        (
            {"phases": [Phase(name="lift", hours=1.0, passage=True)], "criteria": [PULL]},
            "no stages; give stages",
        ),
        ({"criteria": [replace(HEAVE, stage="fly")]}, "no phase 'fly'"),
        ({"criteria": [replace(HEAVE, stage="hold")]}, "'transfer': no criterion"),
        ({"alpha": replace(ALPHA, hours=[1, 2, 4])}, "takes 5 h, the table ends at 4 h"),
        ({"scene": {}}, "scene is empty"),
        ({"scene": {"": vessel()}}, "scenes by the names of load cases"),
        ({"scene": {"../case": vessel()}, "store": "none"}, r"'\.\./case' is no name of a folder"),
        (
            {"phases": [Phase(name="passages", hours=1.0)], "store": "none"},
            "'passages' is no name of a folder",
        ),
        ({"store": "memory://bucket/sheet"}, "object stores are of `ensemble` alone"),
        ({"criteria": None}, "criteria has None"),
    ],
)
def test_what_makes_no_sense_is_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        sheet_of(**given)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"passage": True, "time": 3.0}, "time is of stationary phases"),
        ({"stages": ["a"]}, "passage=True"),
        ({"time": np.nan}, "time is nan s"),
    ],
)
def test_a_phase_that_makes_no_sense_is_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        Phase(name="one", hours=1.0, **given)
