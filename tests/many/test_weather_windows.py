"""Weather windows, waiting times and availability: by brute force, by closed forms, from files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from operability_scenes import HEAVE, PITCH, vessel

from seacrane import FileFormatError, SceneError, allowable_hs, availability, weather_windows
from seacrane.operability import AllowableHs, AlphaFactor, ScatterDiagram, WaveHindcast

HOUR = np.timedelta64(1, "h")
START = np.datetime64("2019-01-01T00:00")


@pytest.fixture(scope="module")
def table() -> AllowableHs:
    return allowable_hs(
        vessel(), criteria=[HEAVE, PITCH], tp=[6.0, 9.0, 14.0], direction_deg=np.arange(0.0, 360.0, 45.0),
        hs=[4.0], domain="frequency",
        alpha=AlphaFactor(values=0.8, source="made up"), hours=6.0,
    )  # fmt: skip


def series(hs: Any, *, step: float = 1.0, **given: Any) -> WaveHindcast:
    heights = np.asarray(hs, dtype=float)
    times = START + (np.arange(heights.size) * step * 60.0).astype("timedelta64[m]")
    return WaveHindcast(**{"time": times, "hs": heights, "tp": np.full(heights.size, 9.0), **given})


def brute_force(workable: Any, *, step: float, hours: float) -> tuple[list[Any], ...]:
    """Whether one may start, the wait and the lengths by looking at every time, one by one."""
    may_start = []
    for first in range(len(workable)):
        covered, place = 0.0, first
        while covered < hours - 1e-9 and place < len(workable) and workable[place]:
            covered, place = covered + step, place + 1
        may_start.append(covered >= hours - 1e-9)
    waiting = []
    for first in range(len(workable)):
        later = [place for place in range(first, len(workable)) if may_start[place]]
        waiting.append((later[0] - first) * step if later else float("nan"))
    lengths, length = [], 0.0
    for flag in [*workable, False]:
        if not flag and length >= hours - 1e-9:
            lengths.append(length)
        length = length + step if flag else 0.0
    return may_start, waiting, lengths


@pytest.mark.parametrize(
    ("hours", "step"), [(0.5, 1.0), (1.0, 1.0), (5.0, 0.5), (6.5, 1.0), (6.5, 3.0), (24.0, 3.0), (300.0, 1.0)]
)
def test_windows_are_those_of_brute_force(hours: float, step: float) -> None:
    random = np.random.default_rng(int(10 * hours + step))
    smooth = np.convolve(random.normal(size=900), np.ones(12) / 12.0**0.5, mode="same")
    hs = np.exp(0.5 * smooth)
    hs[random.integers(0, 900, 5)] = np.nan
    found = weather_windows(series(hs, step=step), 1.2, hours=hours)
    workable = [value <= 1.2 for value in hs.tolist()]
    may_start, waiting, lengths = brute_force(workable, step=step, hours=hours)
    assert found.dataset["may_start"].to_numpy().tolist() == may_start
    assert np.array_equal(found.dataset["waiting"], waiting, equal_nan=True)
    assert found.dataset["length"].to_numpy().tolist() == lengths
    known = [wait for wait in waiting if wait == wait]
    if known:
        assert found.waiting_mean == pytest.approx(sum(known) / len(known))
        told = (found.waiting_p50, found.waiting_p90)
        assert told == pytest.approx(np.percentile(known, [50, 90]))
    assert found.unknown_percent == pytest.approx(100.0 * np.isnan(hs).mean())
    assert found.censored_percent == pytest.approx(100.0 * np.isnan(waiting).mean())


def test_waiting_is_that_of_alternating_renewal() -> None:
    """Calm and storm of exponential length, means 30 and 20 h, an operation of 12 h: closed forms.

    From the begin of a calm W0 = E + (1 - p) (storm + W0), where p = exp(-d / calm) is the chance that it
    lasts and E the part of d that is lost where it does not; in a storm one waits for its rest first.
    """
    calm, storm, hours, step = 30.0, 20.0, 12.0, 0.25
    random = np.random.default_rng(5)
    lengths = np.stack([random.exponential(calm, 8000), random.exponential(storm, 8000)], axis=1).ravel()
    ends = np.cumsum(lengths)
    middles = (np.arange(int(ends[-1] / step)) + 0.5) * step
    stormy = np.searchsorted(ends, middles) % 2 == 1
    found = weather_windows(series(np.where(stormy, 3.0, 1.0), step=step), 2.0, hours=hours)
    lasts = np.exp(-hours / calm)
    lost = calm * (1.0 - lasts * (1.0 + hours / calm))
    from_calm = (lost + (1.0 - lasts) * storm) / lasts
    share = calm / (calm + storm)
    assert found.workable_percent == pytest.approx(100.0 * share, rel=0.03)
    assert found.may_start_percent == pytest.approx(100.0 * share * lasts, rel=0.05)
    assert found.waiting_mean == pytest.approx(from_calm + (1.0 - share) * storm, rel=0.05)
    later = found.dataset["waiting"].to_numpy()
    in_storm = later[stormy & np.isfinite(later)]
    assert in_storm.mean() == pytest.approx(from_calm + storm, rel=0.05)


def test_months_are_those_of_the_calendar() -> None:
    times = START + np.arange(365 * 24) * HOUR
    month = times.astype("datetime64[M]").astype(int) % 12
    hs = np.where(month == 6, 1.0, 3.0)
    found = weather_windows(series(hs), 2.0, hours=24.0)
    workable = found.dataset["workable_percent"]
    assert workable.sel(month=7) == 100.0 and float(workable.sum()) == 100.0
    assert found.dataset["waiting_mean"].sel(month=6) == pytest.approx((720.0 + 1.0) / 2.0)
    assert np.isnan(found.dataset["waiting_mean"].sel(month=8))  # no July comes any more


def test_the_limit_is_that_of_the_table_with_alpha(table: AllowableHs) -> None:
    hs = np.full(48, 1.0)
    from_deg = np.linspace(0.0, 350.0, 48)
    hindcast = series(hs, tp=np.full(48, 9.0), direction_from_deg=from_deg)
    found = weather_windows(hindcast, table, heading_deg=30.0)
    travel = (30.0 - from_deg - 180.0) % 360.0
    assert found.hours == 6.0
    assert found.dataset["hs_limit"].to_numpy() == pytest.approx(0.8 * table.at(np.full(48, 9.0), travel))
    worst = weather_windows(hindcast, table)
    assert worst.dataset["hs_limit"].to_numpy() == pytest.approx(0.8 * table.at(9.0))
    certain = weather_windows(hindcast, table, alpha=1.0)
    assert certain.dataset["hs_limit"].to_numpy() == pytest.approx(worst.dataset["hs_limit"] / 0.8)


def test_directions_seen_from_the_vessel() -> None:
    """Waves from the east push a vessel that heads north to port: 90."""
    for from_deg, heading, travel in ((0, 0, 180), (90, 0, 90), (180, 0, 0), (270, 270, 180), (0, 90, 270)):
        assert series([1.0, 1.0], direction_from_deg=[from_deg] * 2).travel_deg(heading)[0] == travel


def test_seas_beyond_the_table_are_not_workable_and_told(table: AllowableHs) -> None:
    hindcast = series(np.full(100, 0.1), tp=np.where(np.arange(100) < 25, 20.0, 9.0))
    found = weather_windows(hindcast, table, hours=1.0)
    assert found.outside_percent == 25.0
    assert found.workable_percent == 75.0
    assert "25.0 % beyond the table count as not workable" in str(found)


def test_missing_times_are_not_known() -> None:
    times = START + np.array([0, 1, 2, 5, 6]) * HOUR
    hindcast = WaveHindcast(time=times, hs=[1.0] * 5, tp=[8.0] * 5)
    assert hindcast.time.size == 7
    assert hindcast.known.tolist() == [True, True, True, False, False, True, True]
    assert weather_windows(hindcast, 2.0, hours=3.0).dataset.sizes["window"] == 1


def test_a_file_of_wavespectra_is_read(tmp_path: Path) -> None:
    times = (START + np.arange(5) * HOUR).astype("datetime64[ns]")
    numbers = {"hs": [1.0, 2.0, np.nan, 1.5, 1.0], "tp": [8.0, 9.0, 9.0, 9.0, 8.0], "dpm": [10.0] * 5}
    columns = {name: (("time", "site"), np.array(values)[:, None]) for name, values in numbers.items()}
    dataset = xarray.Dataset(columns, {"time": times, "site": [0]})
    packed = {name: {"dtype": "int16", "scale_factor": 0.01, "_FillValue": -32768} for name in ("hs", "tp")}
    dataset.to_netcdf(tmp_path / "site.nc", encoding=packed)
    hindcast = WaveHindcast.load(tmp_path / "site.nc")
    with pytest.raises(SceneError, match=r"site\.nc are UTC; leave it out"):
        WaveHindcast.load(tmp_path / "site.nc", utc_offset=2.0)
    assert hindcast.hs == pytest.approx([1.0, 2.0, np.nan, 1.5, 1.0], nan_ok=True)
    assert hindcast.time[1] - hindcast.time[0] == HOUR
    assert hindcast.direction_from_deg == pytest.approx([10.0] * 5)
    era = dataset.rename({"hs": "swh", "tp": "pp1d", "dpm": "mwd"})
    own = dataset.rename({"hs": "height"})
    for other, names in ((era, None), (own, {"hs": "height"})):
        other.to_netcdf(tmp_path / "other.nc")
        found = WaveHindcast.load(tmp_path / "other.nc", names=names)
        np.testing.assert_allclose(found.tp, hindcast.tp, rtol=1e-3)
    era.swh.attrs["units"], era.pp1d.attrs["units"] = "cm", "s"
    era.to_netcdf(tmp_path / "download")  # whatever its name is
    np.testing.assert_allclose(WaveHindcast.load(tmp_path / "download").hs, 0.01 * hindcast.hs)
    with pytest.raises(FileFormatError, match="hs is in 'furlong'; give units="):
        WaveHindcast.load(tmp_path / "download", units={"hs": "furlong"})
    xarray.concat([dataset, dataset.assign_coords(site=[1])], dim="site").to_netcdf(tmp_path / "two.nc")
    with pytest.raises(FileFormatError, match=r"hs lies over site \(2\)"):
        WaveHindcast.load(tmp_path / "two.nc")


def test_a_csv_is_read(tmp_path: Path) -> None:
    path = tmp_path / "site.csv"
    path.write_text("time, hs, tp, dpm\n2019-01-01T00:00Z,1.0,8.0,10\n2019-01-01T03:00Z,,9.0,\n\n")
    hindcast = WaveHindcast.load(path)
    assert hindcast.step_hours == 3.0
    assert hindcast.known.tolist() == [True, False]
    path.write_text("time [UTC],hs,tp\n2019-01-01,1,\n2019-01-02,1,8\n2019-01-02,1,8\n")
    with pytest.raises(SceneError, match="comes after"):
        WaveHindcast.load(path)


def test_availability_is_the_sum_over_ranges(table: AllowableHs) -> None:
    """By hand: of every range the part below the limit at its middle period, for the worst direction."""
    hs, tp = np.array([0.0, 1.0, 2.0, 6.0]), np.array([6.0, 8.0, 10.0, 20.0])
    counts = np.array([[5.0, 3.0, 2.0], [4.0, 6.0, 1.0], [1.0, 2.0, 3.0]])
    found = availability(table, ScatterDiagram(hs=hs, tp=tp, counts=counts), forecast=False)
    total = 0.0
    for k, period in enumerate((7.0, 9.0, 15.0)):
        limit = float(table.at(period))
        for i in range(3):
            share = (limit - hs[i]) / (hs[i + 1] - hs[i])
            total += counts[i, k] * min(max(share, 0.0), 1.0) if limit == limit else 0.0
    assert found.percent == pytest.approx(100.0 * total / counts.sum())
    assert found.outside_percent == pytest.approx(100.0 * 6.0 / counts.sum())  # 15 s is beyond 14 s
    assert availability(table, ScatterDiagram(hs=hs, tp=tp, counts=counts)).percent < found.percent


def test_availability_by_ranges_tends_to_that_of_the_series(table: AllowableHs) -> None:
    random = np.random.default_rng(2)
    hs = 1.6 * random.weibull(1.5, 20_000)
    tp = np.clip(6.0 + 2.0 * np.sqrt(hs) + random.random(hs.size), 6.0, 14.0)
    hindcast = series(hs, tp=tp, direction_from_deg=random.random(hs.size) * 360.0)
    directions = np.arange(0.0, 360.0, 5.0)
    scatter = ScatterDiagram.of(
        hindcast, hs=np.arange(0.0, 16.0, 0.1), tp=np.arange(6.0, 14.1, 0.2), direction_deg=directions,
        heading_deg=40.0,
    )  # fmt: skip
    assert scatter.counts.sum() == hs.size
    windows = weather_windows(hindcast, table, hours=1.0, heading_deg=40.0)
    assert availability(table, scatter).percent == pytest.approx(windows.workable_percent, abs=0.5)


def test_what_makes_no_sense_is_refused() -> None:
    for call, message in (
        (lambda: series([1.0] * 3, time=START + np.array([0, 60, 150], dtype="m8[m]")), "no multiple"),
        (lambda: weather_windows(series([1.0] * 9), -1.0, hours=6.0), "allowable is -1.0 m"),
        (lambda: ScatterDiagram(hs=[0, 1, 2], tp=[4, 8, 12], counts=[[1.0, 2.0]]), r"counts have shape"),
        (lambda: ScatterDiagram.of(series([1.0, 9.0]), hs=[0, 5], tp=[4, 12]), "1 to 9.* 0 to 5"),
    ):
        with pytest.raises(SceneError, match=message):
            call()
