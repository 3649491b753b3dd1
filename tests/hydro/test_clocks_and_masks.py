"""Clocks are recognised or asked for, masked values refused, texts read, and few extremes told."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from seacrane import MotionRaos
from seacrane.errors import FileFormatError, SceneError
from seacrane.operability import WaveHindcast
from seacrane.sea import MeasuredWaves
from seacrane.statistics import MeasuredSeries, interpolated, record_extremes
from seacrane.warnings import PoorFitWarning

START = datetime(2020, 1, 1, tzinfo=UTC)
HOURS = [START + timedelta(hours=i) for i in range(48)]
STAMPS = {
    "s": [f"{one.timestamp():.0f}" for one in HOURS],
    "ms": [f"{one.timestamp() * 1e3:.0f}" for one in HOURS],
    "us": [f"{one.timestamp() * 1e6:.0f}" for one in HOURS],
    "ns": [f"{one.timestamp() * 1e9:.0f}" for one in HOURS],
    "digits": [f"{one:%Y%m%d%H}" for one in HOURS],
    "more digits": [f"{one:%Y%m%d%H%M}" for one in HOURS],
    "dates": [f"{one:%Y-%m-%dT%H:%M:%S}" for one in HOURS],
}


def hindcast(stamps: list[str], path: Path, *, delimiter: str = ",", comma: bool = False) -> Path:
    rows = [delimiter.join(["time", "hs", "tp"])]
    for i, stamp in enumerate(stamps):
        hs = f"{1.0 + 0.1 * (i % 7):.1f}"
        rows.append(delimiter.join([stamp, hs.replace(".", ",") if comma else hs, "8"]))
    path.write_text("\n".join(rows) + "\n", encoding="latin-1")
    return path


@pytest.mark.parametrize("kind", STAMPS)
def test_a_hindcast_by_any_clock(kind: str, tmp_path: Path) -> None:
    found = WaveHindcast.load(hindcast(STAMPS[kind], tmp_path / "site.csv"))
    assert found.time[0] == np.datetime64("2020-01-01T00:00:00") and found.step_hours == 1.0
    if kind in ("s", "ms", "us", "ns"):
        again = WaveHindcast(time=np.array(STAMPS[kind], dtype=np.int64), hs=found.hs, tp=found.tp)
        assert np.array_equal(again.time, found.time)


@pytest.mark.parametrize(
    "stamps", [[f"{i}" for i in range(48)], [f"{43831 + i / 24:.5f}" for i in range(48)]]
)
def test_numbers_that_count_from_nothing_known_are_asked_for(stamps: list[str], tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"site\.csv: time begins with .*give dates"):
        WaveHindcast.load(hindcast(stamps, tmp_path / "site.csv"))
    with pytest.raises(SceneError, match="time begins with"):
        WaveHindcast(time=[float(one) for one in stamps], hs=np.ones(48), tp=np.ones(48))


@pytest.mark.parametrize(("delimiter", "comma"), [(";", True), (";", False), ("\t", True), (",", False)])
def test_a_hindcast_of_any_spreadsheet(delimiter: str, comma: bool, tmp_path: Path) -> None:
    path = hindcast(STAMPS["dates"], tmp_path / "site.csv", delimiter=delimiter, comma=comma)
    assert WaveHindcast.load(path).hs[3] == pytest.approx(1.3)
    path.write_bytes(path.read_bytes().replace(b"time", "Zeit f\xfcr S\xfcd".encode("latin-1"), 1))
    assert WaveHindcast.load(path, names={"time": "Zeit für Süd"}).hs[3] == pytest.approx(1.3)


def logger(times: np.ndarray, path: Path, header: str = "time") -> Path:
    rows = [f"{header},heave [m]"] + [f"{t:.10g},{0.1 * np.cos(0.05 * i):.6f}" for i, t in enumerate(times)]
    path.write_text("\n".join(rows) + "\n")
    return path


@pytest.mark.parametrize(("unit", "one"), [("s", 1.0), ("ms", 1e3), ("us", 1e6)])
def test_a_logger_that_counts_since_1970(unit: str, one: float, tmp_path: Path) -> None:
    times = np.round((START.timestamp() + 0.5 * np.arange(200)) * one, 1)
    path = tmp_path / "log.csv"
    rows = ["time,heave [m]"] + [f"{t:.1f},{0.1 * np.cos(0.05 * i):.6f}" for i, t in enumerate(times)]
    path.write_text("\n".join(rows) + "\n")
    assert MeasuredSeries.load(path).interval == pytest.approx(0.5, rel=1e-6)
    if unit == "ms":
        path.write_text("\n".join(["time [s],heave [m]", *rows[1:]]) + "\n")
        with pytest.raises(FileFormatError, match=r"has the unit 's', and its numbers, .* are ms since 1970"):
            MeasuredSeries.load(path)


def test_whole_numbers_far_apart_are_asked_for(tmp_path: Path) -> None:
    path = logger(50.0 * np.arange(100), tmp_path / "log.csv")
    with pytest.raises(FileFormatError, match="has no unit, and its whole numbers are 50 apart: s, or ms"):
        MeasuredSeries.load(path)
    assert MeasuredSeries.load(path, units={"time": "ms"}).interval == pytest.approx(0.05)
    assert MeasuredSeries.load(logger(np.arange(100.0), path)).interval == 1.0
    assert MeasuredSeries.load(logger(50.0 * np.arange(100), path, "time [s]")).interval == 50.0


def test_masked_values_are_refused_and_may_be_interpolated() -> None:
    time = np.arange(0.0, 600.0, 0.5)
    wave = np.cos(0.7 * time)
    hidden = np.where((time > 99.0) & (time < 101.0), -99.0, wave)
    masked = np.ma.masked_equal(hidden, -99.0)
    with pytest.raises(SceneError, match=r"3 masked values, the first at \[199\]; .*interpolated"):
        MeasuredWaves(time=time, elevation=masked, direction_deg=180.0)
    with pytest.raises(SceneError, match="masked values"):
        MeasuredSeries(time=time, columns={"wave": masked}, units={"wave": "m"})
    raos = np.ma.masked_invalid(np.full((1, 2, 6), np.nan))
    with pytest.raises(SceneError, match="values has 12 masked values"):
        MotionRaos(omega=[0.3, 0.4], heading=[0.0], values=raos)
    filled = interpolated(time, masked)
    assert np.abs(filled - wave).max() < 0.02
    assert MeasuredSeries(time=time, columns={"wave": filled}, units={"wave": "m"})["wave"].min() > -2.0
    with pytest.raises(SceneError, match="the first or the last is not"):
        interpolated(time, np.ma.masked_less(time, 10.0))


def test_masked_sea_states_are_not_known() -> None:
    hs = np.ma.masked_equal([1.0, -99.0, 1.2], -99.0)
    found = WaveHindcast(time=STAMPS["dates"][:3], hs=hs, tp=np.full(3, 8.0))
    assert found.known.tolist() == [True, False, True]


def test_a_dozen_snaps_are_too_few_and_some_dozens_are_told() -> None:
    draw = np.random.default_rng(3)
    tension = np.zeros(21_600)
    tension[draw.integers(0, tension.size, 12)] = 8e5
    with pytest.raises(SceneError, match="too few for a largest value"):
        record_extremes(tension, interval=0.5)
    tension[draw.integers(0, tension.size, 60)] = 8e5
    with pytest.warns(PoorFitWarning, match="too few for peaks over a threshold"):
        record_extremes(tension, interval=0.5)
