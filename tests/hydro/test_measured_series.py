"""Measured series and hindcasts: what is read of a file, what is refused by line, clocks, masked values."""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import MotionHistory
from seacrane.errors import FileFormatError, SceneError
from seacrane.operability import WaveHindcast
from seacrane.sea import MeasuredWaves
from seacrane.sea.series_file import heading_of, unit_of_words
from seacrane.statistics import MeasuredSeries, interpolated
from seacrane.warnings import ClockDriftWarning, FilledGapWarning, NoisyMotionWarning, OutlierWarning

TIME = np.arange(0.0, 120.0, 0.1)
HEAVE, ROLL, PITCH = 1.2 * np.sin(0.7 * TIME), 3.0 * np.sin(0.6 * TIME + 1.0), 1.5 * np.sin(0.65 * TIME)
HEAD = ("time [s]", "heave [m]", "roll [deg]", "pitch [deg]")
STILL = ("surge", "sway", "yaw")
FIRST = 2  # line of the first row
Change = Callable[[list[list[str]]], Any]


def written(
    folder: Path, *, head: Any = HEAD, change: Change = lambda rows: None,
    columns: tuple[np.ndarray, ...] = (TIME, HEAVE, ROLL, PITCH),
) -> Path:  # fmt: skip
    rows = [[f"{value:.6f}" for value in row] for row in zip(*columns, strict=True)]
    change(rows)
    path = folder / "mru.csv"
    path.write_text("\n".join([",".join(head), *map(",".join, rows)]) + "\n", encoding="utf-8")
    return path


def put(*cells: tuple[int, int, str]) -> Change:
    def change(rows: list[list[str]]) -> None:
        for line, column, text in cells:
            rows[line - FIRST][column] = text

    return change


def test_headings_are_names_and_units_and_units_become_si() -> None:
    for cell, name, unit in (
        ("Roll (°)", "roll", "°"), ("heave_m", "heave", "m"), ("Time[s]", "time", "s"),
        ("yaw_rate_rad_per_s", "yaw rate", "rad_per_s"), ("wave_1", "wave 1", None), ("[deg]", "[deg]", None),
    ):  # fmt: skip
        found = heading_of(0, cell)
        assert (found.name, found.unit) == (name, unit)
    turn = np.pi / 180.0
    for words, factor, si in (
        ("Degrees", turn, "rad"), ("°", turn, "rad"), ("deg/s", turn, "rad/s"), ("rad_per_s", 1.0, "rad/s"),
        ("mm", 1e-3, "m"), ("ft", 0.3048, "m"), ("t", 9806.65, "N"), ("KN", 1e3, "N"), ("MN", 1e6, "N"),
        ("m/s²", 1.0, "m/s2"), ("kNm", 1e3, "N m"), ("bar", 1e5, "Pa"),
    ):  # fmt: skip
        assert unit_of_words(words) == (pytest.approx(factor, rel=1e-12), si)
    assert not any(map(unit_of_words, ("mN", "mPa", "furlong", "", "m m", "rad/m")))


def test_decimal_commas_time_stamps_and_names_that_are_given(tmp_path: Path) -> None:
    path = tmp_path / "mru.txt"
    rows = "\r\n".join(f"{t:.1f};{h:.5f}".replace(".", ",") for t, h in zip(TIME, HEAVE, strict=True))
    above = "Logger 7\r\nserial;12\r\nTime;Heave\r\ns;cm\r\n# begins\r\n"
    path.write_text(f"{above}{rows}\r\n\r\n", encoding="utf-16")
    read = MeasuredSeries.load(path)
    np.testing.assert_allclose(read["heave"], 0.01 * HEAVE, atol=1e-7)
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    base = np.datetime64("2026-03-01T23:59:30.000", "ms")
    stamps = [(i + FIRST, 0, f"{base + np.timedelta64(100 * i, 'ms')}Z") for i in range(TIME.size)]
    read = MeasuredSeries.load(written(tmp_path, head=("UTC", *HEAD[1:]), change=put(*stamps)))
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    assert read.done == ("times from 2026-03-01 23:59:30+00:00 on",)
    path = written(tmp_path, head=("My clock", "MRU Heave [m]", "A [deg]", "Status"))
    read = MeasuredSeries.load(path, columns={"time": "My clock", "heave": "heave", "list": "A [deg]"})
    assert read.headers == {"heave": "MRU Heave [m]", "list": "A [deg]"} and list(read.columns) == list(
        read.headers
    )


# What is written, and what the message names: the line and the column, beside the matter.
REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "digits apart": ({"change": put((50, 1, "1_0"))}, r"line 50, column 'heave \[m\]'.*'1_0'"),
    "NaN": ({"change": put((50, 3, "NaN"))}, r"line 50, column 'pitch \[deg\]'.*missing.*0.2 s; maximum_gap"),
    "empty at the start": ({"change": put((2, 1, ""))}, r"line 2, column 'heave \[m\]'.*after=0.1"),
    "empty at the end": ({"change": put((1201, 1, "-"))}, r"line 1201.*before=119.8"),
    "a time twice": ({"change": put((50, 0, "4.700000"))}, r"line 50, column 'time \[s\]'.*4.7 s repeats"),
    "a time that goes back": ({"change": put((50, 0, "4.2"))}, r"line 50, column 'time \[s\]'.*0.5 s before"),
    "a cell too few": ({"change": lambda rows: rows[48].pop()}, r"line 50: has 3 cells.* 4"),
    "a clock that jumps": ({"columns": (TIME + 3.0 * (TIME > 60.05), HEAVE, ROLL, PITCH)},
                           r"line 603, column 'time \[s\]'.*3.1 s .*clock jumps"),
    "no unit": ({"head": ("time", "heave [m]", "roll", "pitch")}, r"line 1, column 'roll'.*units="),
    "a heave in degrees": ({"head": ("time", "heave [deg]", *HEAD[2:])}, r"'heave \[deg\]' is in rad"),
    "a rate only": ({"head": ("time", "heave [m]", "roll rate [deg/s]", HEAD[3])}, r"line 1.*no col.*'roll'"),
}  # fmt: skip


@pytest.mark.filterwarnings("ignore::seacrane.warnings.OutlierWarning")
@pytest.mark.parametrize("what", REFUSED)
def test_bad_files_are_refused_by_line_and_column(tmp_path: Path, what: str) -> None:
    given, words = REFUSED[what]
    with pytest.raises(FileFormatError, match=words):
        MotionHistory.load(written(tmp_path, **given), zero=STILL)


def test_keywords_that_make_no_sense_are_refused(tmp_path: Path) -> None:
    path = written(tmp_path)
    for given, words in (
        ({"zero": ["trim"]}, "zero.*trim"), ({"negated": ["x"]}, "negated.*x"),
        ({"columns": {"list": "roll"}}, "columns names list"), ({"filter_hz": 5.0}, "5 Hz"),
        ({"interval": 8.0}, "slow motion.*filter_hz=0.05"), ({"maximum_gap": -1.0}, "maximum_gap"),
        ({"after": 500.0}, "0 rows .*0 to 119.9 s"), ({"rate_hz": 20.0}, "0.1 s apart"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            MotionHistory.load(path, **{"zero": STILL, **given})


def test_a_clock_that_drifts_is_told(tmp_path: Path) -> None:
    """By the nominal rate, and by a second clock: 4 ms in a second make 0.48 s, more than a sample."""
    for gain, words in ((4e-3, r"gains \+[34]\d{3} us in a second .* 10 Hz"), (-4e-3, r"gains -[34]\d{3}")):
        columns = ((1.0 + gain) * TIME, HEAVE, ROLL, PITCH)
        with pytest.warns(ClockDriftWarning, match=words):
            MotionHistory.load(written(tmp_path, columns=columns), zero=STILL, rate_hz=10.0)
    two = written(tmp_path, head=(*HEAD, "GPS time"), columns=(*columns, 7e4 + TIME))
    with pytest.warns(ClockDriftWarning, match="on column 'GPS time'"):
        MotionHistory.load(two, zero=STILL)
    with pytest.warns(ClockDriftWarning, match="column 'GPS time', gains"):
        history = MotionHistory.load(two, zero=STILL, columns={"time": "GPS time"})
    np.testing.assert_allclose(history.time, TIME, atol=1e-5)


def test_gaps_are_filled_where_that_is_asked(tmp_path: Path) -> None:
    def change(rows: list[list[str]]) -> None:
        put(*((line, 1, "") for line in range(100, 106)))(rows)
        del rows[700:706]

    path = written(tmp_path, change=change)
    with pytest.warns(FilledGapWarning, match="2 gaps .* longest 0.7 s before line"):
        history = MotionHistory.load(path, zero=STILL, maximum_gap=0.8)
    np.testing.assert_allclose(history.motion[:, 2], 1.2 * np.sin(0.7 * history.time), atol=3e-4)
    assert np.ptp(np.diff(history.time)) < 1e-6
    with pytest.raises(FileFormatError, match="line 100"):
        MotionHistory.load(path, zero=STILL, maximum_gap=0.6)


def test_outliers_are_named_and_dropped_where_that_is_asked(tmp_path: Path) -> None:
    path = written(tmp_path, change=put((100, 1, "-5"), (101, 1, "-5"), (400, 2, "12.5"), (800, 3, "-99.99")))
    named = r"4 outliers .* line 100, column 'heave \[m\]': -5; line 101, .* line 400, .*drop_outliers=True"
    with (
        pytest.warns(OutlierWarning, match=named),
        pytest.raises(FileFormatError, match="line 800, column 'pit"),
    ):
        MotionHistory.load(path, zero=STILL)
    with pytest.warns(OutlierWarning, match="4 outliers .*dropped"), pytest.warns(FilledGapWarning):
        history = MotionHistory.load(path, zero=STILL, drop_outliers=True, maximum_gap=0.3)
    np.testing.assert_allclose(history.motion[:, 2], HEAVE, atol=1e-4)
    np.testing.assert_allclose(history.motion[:, 3:5], np.radians([ROLL, PITCH]).T, atol=1e-4)


def test_signs_headings_and_motions_that_are_not_there(tmp_path: Path) -> None:
    heading = (358.0 + 4.0 * np.sin(0.3 * TIME)) % 360.0
    path = written(tmp_path, head=(*HEAD, "Heading (deg)"), columns=(TIME + 5.0, HEAVE, ROLL, PITCH, heading))
    history = MotionHistory.load(path, zero=("surge", "sway"), negated=("heave", "pitch"))
    yaw = -np.radians(4.0) * (np.sin(0.3 * TIME) - np.sin(0.3 * TIME).mean())
    wanted = np.column_stack([0.0 * TIME, 0.0 * TIME, -HEAVE, np.radians(ROLL), -np.radians(PITCH), yaw])
    np.testing.assert_allclose(history.motion, wanted, atol=1e-6)
    np.testing.assert_allclose(history.time, TIME, atol=1e-9)


def test_filter_and_resampling_have_the_gain_and_the_order_that_are_stated() -> None:
    """Butterworth's squared magnitude at 10 Hz, phase by the sine part, away from the ends; cubic splines."""
    time, inner = np.arange(0.0, 240.0, 0.1), slice(200, -200)
    for period in (3.0, 4.0, 8.0):
        omega = 2.0 * np.pi / period
        series = MeasuredSeries(time=time, columns={"x": np.cos(omega * time)}, units={"x": "m"})
        basis = np.column_stack([np.cos(omega * time), np.sin(omega * time)])[inner]
        (even, odd), *_ = np.linalg.lstsq(basis, series.filtered(0.5)["x"][inner], rcond=None)
        ratio = np.tan(np.pi * 0.1 / period) / np.tan(np.pi * 0.1 * 0.5)
        assert even == pytest.approx(1.0 / (1.0 + ratio**8), abs=1e-6)
        assert even == pytest.approx(1.0 / (1.0 + (2.0 / period) ** 8), abs=2e-3)
        assert odd == pytest.approx(0.0, abs=1e-6)
    errors = []
    for step in (0.4, 0.2):  # half the step, a sixteenth of the error
        time = np.arange(0.0, 60.0, step)
        fine = MeasuredSeries(time=time, columns={"x": np.sin(0.8 * time)}, units={"x": "m"}).resampled(0.07)
        errors.append(np.abs(fine["x"] - np.sin(0.8 * fine.time))[100:-100].max())
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.15)


def test_a_series_is_written_as_it_is_read(tmp_path: Path) -> None:
    read = MeasuredSeries.load(written(tmp_path))
    again = MeasuredSeries.load(read.to_csv(tmp_path / "again.csv"))
    assert again.units == read.units == read.to_dataframe().attrs["units"]
    for name, values in read.columns.items():
        np.testing.assert_array_equal(again[name], values)


def test_noise_of_5_mm_is_told_and_the_filter_takes_it_away(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    path = written(tmp_path, columns=(TIME, HEAVE + random.normal(0.0, 5e-3, TIME.size), ROLL, PITCH))
    with pytest.warns(NoisyMotionWarning, match="filter_hz=0.5"):
        MotionHistory.load(path, zero=STILL)
    clean = MotionHistory.load(path, zero=STILL, filter_hz=0.5, interval=0.2)
    inner = (clean.time > 5.0) & (clean.time < 115.0)
    error = clean.motion[:, 2] - 1.2 * np.sin(0.7 * clean.time)
    assert error[inner].std() == pytest.approx(5e-3 * np.sqrt(2 * 0.5 / 10.0), rel=0.25)


START = datetime(2020, 1, 1, tzinfo=UTC)
HOURS = [START + timedelta(hours=i) for i in range(48)]
STAMPS = {unit: [f"{one.timestamp() * factor:.0f}" for one in HOURS]
          for unit, factor in (("s", 1.0), ("ms", 1e3), ("us", 1e6), ("ns", 1e9))}  # fmt: skip
STAMPS |= {
    form: [f"{one:{form}}" for one in HOURS] for form in ("%Y%m%d%H", "%Y%m%d%H%M", "%Y-%m-%dT%H:%M:%S")
}


def hindcast(stamps: list[str], path: Path) -> Path:
    rows = [f"{stamp},{1.0 + 0.1 * (i % 7):.1f},8" for i, stamp in enumerate(stamps)]
    path.write_text("\n".join(["time,hs,tp", *rows]) + "\n")
    return path


def test_a_hindcast_by_any_clock(tmp_path: Path) -> None:
    path = tmp_path / "site.csv"
    for kind, stamps in STAMPS.items():
        found = WaveHindcast.load(hindcast(stamps, path), utc_offset=0 if "%" in kind else None)
        assert found.time[0] == np.datetime64("2020-01-01T00:00:00") and found.step_hours == 1.0
        if "%" not in kind:
            again = WaveHindcast(time=np.array(stamps, dtype=np.int64), hs=found.hs, tp=found.tp)
            assert np.array_equal(again.time, found.time)
    # Numbers that count from nothing known are asked for.
    for stamps in ([f"{i}" for i in range(48)], [f"{43831 + i / 24:.5f}" for i in range(48)]):
        with pytest.raises(FileFormatError, match=r"site\.csv: time begins with .*give dates"):
            WaveHindcast.load(hindcast(stamps, path))


def test_the_clock_of_a_logger(tmp_path: Path) -> None:
    path = tmp_path / "log.csv"

    def load(times: np.ndarray, header: str = "time", **given: Any) -> float:
        rows = [f"{t:.1f},{0.1 * np.cos(0.05 * i):.6f}" for i, t in enumerate(times)]
        path.write_text("\n".join([f"{header},heave [m]", *rows]) + "\n")
        return MeasuredSeries.load(path, **given).interval

    for one in (1.0, 1e3, 1e6):
        times = np.round((START.timestamp() + 0.5 * np.arange(200)) * one, 1)
        assert load(times) == pytest.approx(0.5, rel=1e-6)
    with pytest.raises(FileFormatError, match="50 apart: s, or ms"):
        load(50.0 * np.arange(100))
    assert load(50.0 * np.arange(100), units={"time": "ms"}) == pytest.approx(0.05)
    assert load(50.0 * np.arange(100), "time [s]") == 50.0


def test_masked_values_are_refused_and_may_be_interpolated() -> None:
    time = np.arange(0.0, 600.0, 0.5)
    wave = np.cos(0.7 * time)
    masked = np.ma.masked_equal(np.where((time > 99.0) & (time < 101.0), -99.0, wave), -99.0)
    with pytest.raises(SceneError, match=r"3 masked values, the first at \[199\]; .*interpolated"):
        MeasuredWaves(time=time, elevation=masked, direction_deg=180.0)
    with pytest.raises(SceneError, match="masked values"):
        MeasuredSeries(time=time, columns={"wave": masked}, units={"wave": "m"})
    assert np.abs(interpolated(time, masked) - wave).max() < 0.02
