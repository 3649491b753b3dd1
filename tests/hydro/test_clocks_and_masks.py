"""Clocks are recognised or asked for, masked values refused, texts read, and few extremes told."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

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
STAMPS = {unit: [f"{one.timestamp() * factor:.0f}" for one in HOURS]
          for unit, factor in (("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9))}  # fmt: skip
STAMPS |= {
    form: [f"{one:{form}}" for one in HOURS] for form in ("%Y%m%d%H", "%Y%m%d%H%M", "%Y-%m-%dT%H:%M:%S")
}


def hindcast(stamps: list[str], path: Path, *, delimiter: str = ",", comma: bool = False) -> Path:
    rows = [delimiter.join(["time", "hs", "tp"])]
    for i, stamp in enumerate(stamps):
        hs = f"{1.0 + 0.1 * (i % 7):.1f}"
        rows.append(delimiter.join([stamp, hs.replace(".", ",") if comma else hs, "8"]))
    path.write_text("\n".join(rows) + "\n", encoding="latin-1")
    return path


def test_a_hindcast_by_any_clock(tmp_path: Path) -> None:
    path = tmp_path / "site.csv"
    for kind, stamps in STAMPS.items():
        found = WaveHindcast.load(hindcast(stamps, path))
        assert found.time[0] == np.datetime64("2020-01-01T00:00:00") and found.step_hours == 1.0
        if "%" not in kind:
            again = WaveHindcast(time=np.array(stamps, dtype=np.int64), hs=found.hs, tp=found.tp)
            assert np.array_equal(again.time, found.time)
    # Numbers that count from nothing known are asked for.
    for stamps in ([f"{i}" for i in range(48)], [f"{43831 + i / 24:.5f}" for i in range(48)]):
        with pytest.raises(FileFormatError, match=r"site\.csv: time begins with .*give dates"):
            WaveHindcast.load(hindcast(stamps, path))
        with pytest.raises(SceneError, match="time begins with"):
            WaveHindcast(time=[float(one) for one in stamps], hs=np.ones(48), tp=np.ones(48))


def test_a_hindcast_of_any_spreadsheet(tmp_path: Path) -> None:
    dates = STAMPS["%Y-%m-%dT%H:%M:%S"]
    for delimiter, comma in ((";", True), (";", False), ("\t", True), (",", False)):
        path = hindcast(dates, tmp_path / "site.csv", delimiter=delimiter, comma=comma)
        assert WaveHindcast.load(path).hs[3] == pytest.approx(1.3)
        path.write_bytes(path.read_bytes().replace(b"time", "Zeit f\xfcr S\xfcd".encode("latin-1"), 1))
        assert WaveHindcast.load(path, names={"time": "Zeit für Süd"}).hs[3] == pytest.approx(1.3)
    hs = np.ma.masked_equal([1.0, -99.0, 1.2], -99.0)
    assert WaveHindcast(time=dates[:3], hs=hs, tp=np.full(3, 8.0)).known.tolist() == [True, False, True]


def test_the_clock_of_a_logger(tmp_path: Path) -> None:
    """That counts since 1970, or whole numbers far apart, which are asked for."""
    path = tmp_path / "log.csv"

    def load(times: np.ndarray, header: str = "time", **given: Any) -> float:
        rows = [f"{t:.1f},{0.1 * np.cos(0.05 * i):.6f}" for i, t in enumerate(times)]
        path.write_text("\n".join([f"{header},heave [m]", *rows]) + "\n")
        return MeasuredSeries.load(path, **given).interval

    for one in (1.0, 1e3, 1e6):
        times = np.round((START.timestamp() + 0.5 * np.arange(200)) * one, 1)
        assert load(times) == pytest.approx(0.5, rel=1e-6)
        if one == 1e3:
            with pytest.raises(FileFormatError, match=r"unit 's', .* are ms since 1970"):
                load(times, "time [s]")
    with pytest.raises(FileFormatError, match="50 apart: s, or ms"):
        load(50.0 * np.arange(100))
    assert load(50.0 * np.arange(100), units={"time": "ms"}) == pytest.approx(0.05)
    assert load(np.arange(100.0)) == 1.0
    assert load(50.0 * np.arange(100), "time [s]") == 50.0


def test_masked_values_are_refused_and_may_be_interpolated_and_few_extremes_told() -> None:
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
    draw, tension = np.random.default_rng(3), np.zeros(21_600)
    tension[draw.integers(0, tension.size, 12)] = 8e5
    with pytest.raises(SceneError, match="too few for a largest value"):
        record_extremes(tension, interval=0.5)
    tension[draw.integers(0, tension.size, 60)] = 8e5
    with pytest.warns(PoorFitWarning, match="too few for peaks over a threshold"):
        record_extremes(tension, interval=0.5)
