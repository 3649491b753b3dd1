"""Measured series: what is read of a file, what is refused by line and column, and what is done to it."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import MotionHistory, Scene, simulate
from seacrane.errors import FileFormatError, SceneError
from seacrane.series.headings import heading_of, unit_of_words
from seacrane.statistics import MeasuredSeries
from seacrane.warnings import (
    ClockDriftWarning,
    FilledGapWarning,
    NoisyMotionWarning,
    OutlierWarning,
)

TIME = np.arange(0.0, 120.0, 0.1)
HEAVE, ROLL, PITCH = 1.2 * np.sin(0.7 * TIME), 3.0 * np.sin(0.6 * TIME + 1.0), 1.5 * np.sin(0.65 * TIME)
HEAD = ("time [s]", "heave [m]", "roll [deg]", "pitch [deg]")
STILL = ("surge", "sway", "yaw")
FIRST = 2  # line of the first row


def written(
    folder: Path,
    *,
    head: tuple[str, ...] = HEAD,
    delimiter: str = ",",
    change: Callable[[list[list[str]]], Any] = lambda rows: None,
    above: str = "",
    columns: tuple[np.ndarray, ...] = (TIME, HEAVE, ROLL, PITCH),
) -> Path:
    rows = [[f"{value:.6f}" for value in row] for row in zip(*columns, strict=True)]
    change(rows)
    path = folder / "mru.csv"
    lines = [delimiter.join(head), *(delimiter.join(row) for row in rows)]
    path.write_text(above + "\n".join(lines) + "\n", encoding="utf-8")
    return path


def put(line: int, column: int, text: str) -> Callable[[list[list[str]]], None]:
    """A change of one cell, by the line of the file."""

    def change(rows: list[list[str]]) -> None:
        rows[line - FIRST][column] = text

    return change


@pytest.mark.parametrize(
    ("cell", "name", "unit"),
    [
        ("roll [deg]", "roll", "deg"),
        ("Roll (°)", "roll", "°"),
        ("heave_m", "heave", "m"),
        ("time (s)", "time", "s"),
        ("Time[s]", "time", "s"),
        ("yaw_rate_rad_per_s", "yaw rate", "rad_per_s"),
        ("Hook_Load_kN", "hook load", "kN"),
        ("roll", "roll", None),
        ("wave_1", "wave", None),
        ("sensor_2", "sensor 2", None),
        ("[deg]", "[deg]", None),
    ],
)
def test_a_heading_is_a_name_and_a_unit(cell: str, name: str, unit: str | None) -> None:
    found = heading_of(0, cell)
    assert (found.name, found.unit) == (name if cell != "wave_1" else "wave 1", unit)


@pytest.mark.parametrize(
    ("words", "factor", "unit"),
    [
        ("deg", np.pi / 180.0, "rad"),
        ("Degrees", np.pi / 180.0, "rad"),
        ("°", np.pi / 180.0, "rad"),
        ("mm", 1e-3, "m"),
        ("t", 9806.65, "N"),
        ("kN", 1e3, "N"),
        ("KN", 1e3, "N"),
        ("m/s²", 1.0, "m/s2"),
        ("m/s^2", 1.0, "m/s2"),
        ("deg/s", np.pi / 180.0, "rad/s"),
        ("rad_per_s", 1.0, "rad/s"),
        ("kNm", 1e3, "N m"),
        ("kN·m", 1e3, "N m"),
        ("bar", 1e5, "Pa"),
        ("ms", 1e-3, "s"),
        ("MN", 1e6, "N"),
        ("ft", 0.3048, "m"),
    ],
)
def test_units_become_si(words: str, factor: float, unit: str) -> None:
    assert unit_of_words(words) == (pytest.approx(factor, rel=1e-12), unit)


@pytest.mark.parametrize("words", ["mN", "mPa", "furlong", "", "m m", "rad/m"])
def test_a_unit_that_is_unknown_is_not_guessed(words: str) -> None:
    assert unit_of_words(words) is None


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_the_delimiter_is_found(tmp_path: Path, delimiter: str) -> None:
    head = tuple(cell.replace(" ", "") if delimiter == " " else cell for cell in HEAD)
    read = MeasuredSeries.load(written(tmp_path, delimiter=delimiter, head=head))
    assert list(read.columns) == ["heave", "roll", "pitch"]
    assert read.units == {"heave": "m", "roll": "rad", "pitch": "rad"}
    np.testing.assert_allclose(read.time, TIME, atol=1e-6)
    np.testing.assert_allclose(read["roll"], np.radians(ROLL), atol=1e-7)


def test_decimal_commas_lines_above_and_a_line_of_units(tmp_path: Path) -> None:
    path = tmp_path / "mru.txt"
    rows = "\r\n".join(f"{t:.1f};{h:.5f}".replace(".", ",") for t, h in zip(TIME, HEAVE, strict=True))
    path.write_text(
        f"Logger 7\r\nserial;12\r\nTime;Heave\r\ns;cm\r\n# begins\r\n{rows}\r\n\r\n", encoding="utf-16"
    )
    read = MeasuredSeries.load(path)
    np.testing.assert_allclose(read["heave"], 0.01 * HEAVE, atol=1e-7)
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)


def test_time_stamps_are_seconds_from_the_first(tmp_path: Path) -> None:
    base = np.datetime64("2026-03-01T23:59:30.000", "ms")

    def stamp(rows: list[list[str]]) -> None:
        for i, row in enumerate(rows):
            row[0] = f"{base + np.timedelta64(100 * i, 'ms')}Z"

    read = MeasuredSeries.load(written(tmp_path, head=("UTC", *HEAD[1:]), change=stamp))
    np.testing.assert_allclose(read.time, TIME, atol=1e-9)
    assert read.done == ("times from 2026-03-01 23:59:30+00:00 on",)


def test_columns_are_taken_by_the_names_that_are_given(tmp_path: Path) -> None:
    path = written(tmp_path, head=("My clock", "MRU Heave [m]", "A [deg]", "Status"))
    read = MeasuredSeries.load(path, columns={"time": "My clock", "heave": "heave", "list": "A [deg]"})
    assert list(read.columns) == ["heave", "list"]
    assert read.headers == {"heave": "MRU Heave [m]", "list": "A [deg]"}


REFUSED = {
    "a value that is no number": (
        put(50, 2, "broken"),
        r"line 50, column 'roll \[deg\]': 'broken' is no number",
    ),
    "infinite": (put(50, 1, "inf"), r"line 50, column 'heave \[m\]': 'inf' is no number of up to"),
    "digits apart": (put(50, 1, "1_0"), r"line 50, column 'heave \[m\]': '1_0' is no number"),
    "NaN": (
        put(50, 3, "NaN"),
        r"line 50, column 'pitch \[deg\]': 1 values are missing.* gap of 0.2 s; maximum_gap",
    ),
    "empty at the start": (
        put(2, 1, ""),
        r"line 2, column 'heave \[m\]': .* at an end of the record.*after=0.1",
    ),
    "empty at the end": (
        lambda rows: put(FIRST + len(rows) - 1, 1, "-")(rows),
        r"line 1201.* by before=119.8",
    ),
    "no time": (put(50, 0, ""), r"line 50, column 'time \[s\]': has no time"),
    "time that is no time": (
        put(50, 0, "noon"),
        r"line 50, column 'time \[s\]': 'noon' is no number .* ISO 8601",
    ),
    "a time twice": (
        put(50, 0, "4.700000"),
        r"line 50, column 'time \[s\]': 4.7 s repeats the time of the line",
    ),
    "a time that goes back": (
        put(50, 0, "4.2"),
        r"line 50, column 'time \[s\]': 4.2 s is 0.5 s before the time",
    ),
    "a cell too few": (
        lambda rows: rows[48].pop(),
        r"line 50: has 3 cells, and the header 4 \(time \[s\], heave",
    ),
    "a cell too many": (lambda rows: rows[48].append("1"), r"line 50: has 5 cells, and the header 4"),
    "lines that are gone": (
        lambda rows: rows.__delitem__(slice(300, 312)),
        r"line 302, column 'time \[s\]': 1.3 s after the line above .*: samples are missing; maximum_gap=1.3",
    ),
    "a roll of 40 rad": (
        put(50, 2, f"{np.degrees(40.0):.6f}"),
        r"line 50, column 'roll \[deg\]': 40 rad, 2292 deg",
    ),
    "a heave of 150 m": (
        put(50, 1, "150"),
        r"line 50, column 'heave \[m\]': 150 m: no ship has a heave beyond 100 m",
    ),
    "few rows": (lambda rows: rows.__delitem__(slice(7, None)), r"holds 7 rows of numbers; at least 8"),
}


@pytest.mark.filterwarnings("ignore::seacrane.warnings.OutlierWarning")
@pytest.mark.parametrize("what", REFUSED)
def test_bad_rows_are_refused_by_line_and_column(tmp_path: Path, what: str) -> None:
    change, words = REFUSED[what]
    path = written(tmp_path, change=change)
    with pytest.raises(FileFormatError, match=words) as caught:
        MotionHistory.load(path, zero=STILL)
    assert str(caught.value).startswith(str(path))


HEADS = {
    "no time": (("sample", *HEAD[1:]), r"no line names columns, with one of time"),
    "no unit": (
        ("time", "heave [m]", "roll", "pitch"),
        r"line 1, column 'roll': has no unit .*units=\{'roll': 'deg'\}",
    ),
    "an unknown unit": (
        ("time", "heave [furlong]", *HEAD[2:]),
        r"line 1, column 'heave \[furlong\]': .*is unknown",
    ),
    "a time in metres": (
        ("time [m]", *HEAD[1:]),
        r"line 1, column 'time \[m\]': has the unit 'm'; a time is in s",
    ),
    "a heave in degrees": (("time", "heave [deg]", *HEAD[2:]), r"'heave \[deg\]' is in rad, and heave in m"),
    "a column that is missing": (
        ("time", "heave [m]", "trim [deg]", HEAD[3]),
        r"line 1: names no column.* 'roll'",
    ),
    "a column twice": (
        ("time", "a roll [deg]", "b roll [deg]", HEAD[3]),
        r"or several, for 'heave', 'roll'; there",
    ),
    "a rate only": (("time", "heave [m]", "roll rate [deg/s]", HEAD[3]), r"line 1: names no column.* 'roll'"),
}


@pytest.mark.parametrize("what", HEADS)
def test_bad_headers_are_refused_by_name(tmp_path: Path, what: str) -> None:
    head, words = HEADS[what]
    with pytest.raises(FileFormatError, match=words):
        MotionHistory.load(written(tmp_path, head=head), zero=STILL)


def test_another_kind_of_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_bytes(b"\x89HDF\r\n\x1a\n\0\0\0")
    with pytest.raises(FileFormatError, match="is a NetCDF file"):
        MotionHistory.load(tmp_path / "run.csv")
    with pytest.raises(FileNotFoundError):
        MotionHistory.load(tmp_path / "none.csv")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"zero": "surge"}, "zero"),
        ({"zero": ["trim"]}, "zero holds trim"),
        ({"negated": ["x"]}, "negated holds x"),
        ({"columns": ["roll"]}, "columns is no mapping"),
        ({"columns": {"list": "roll"}}, "columns names list"),
        ({"filter_hz": 5.0}, "hold up to 5 Hz"),
        ({"filter_hz": -1.0}, "filter_hz"),
        ({"interval": 0.0}, "interval"),
        ({"interval": 8.0}, "would turn into slow motion; give filter_hz=0.05"),
        ({"maximum_gap": -1.0}, "maximum_gap"),
        ({"after": 500.0}, r"0 rows of .* are left, of times from 0 to 119.9 s"),
        ({"rate_hz": 20.0}, "0.1 s apart"),
        ({"interval": 1e-9}, "samples of 119.9 s; 2 to 10000000"),
    ],
)
def test_keywords_that_make_no_sense_are_refused(tmp_path: Path, given: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        MotionHistory.load(written(tmp_path), **{"zero": STILL, **given})


def test_a_clock_that_jumps_is_told_from_a_gap(tmp_path: Path) -> None:
    late = written(tmp_path, columns=(TIME + 3.0 * (TIME > 60.05), HEAVE, ROLL, PITCH))
    with pytest.raises(
        FileFormatError, match=r"line 603, column 'time \[s\]': 3.1 s .*the clock jumps: the values"
    ):
        MotionHistory.load(late, zero=STILL)


@pytest.mark.parametrize("gain", [+4e-3, -4e-3])
def test_a_clock_that_drifts_is_told(tmp_path: Path, gain: float) -> None:
    """By the nominal rate, and by a second clock: 4 ms in a second make 0.48 s, more than a sample."""
    drifting = written(tmp_path, columns=((1.0 + gain) * TIME, HEAVE, ROLL, PITCH))
    words = rf"gains \{'+' if gain > 0 else '-'}[34]\d\d\d us in a second on samples at 10 Hz"
    with pytest.warns(ClockDriftWarning, match=words):
        MotionHistory.load(drifting, zero=STILL, rate_hz=10.0)
    two = written(
        tmp_path, head=(*HEAD, "GPS time"), columns=((1.0 + gain) * TIME, HEAVE, ROLL, PITCH, 7e4 + TIME)
    )
    with pytest.warns(ClockDriftWarning, match="on column 'GPS time'"):
        MotionHistory.load(two, zero=STILL)
    with pytest.warns(ClockDriftWarning, match="column 'GPS time', gains"):
        history = MotionHistory.load(two, zero=STILL, columns={"time": "GPS time"})
    np.testing.assert_allclose(history.time, TIME, atol=1e-5)


def test_a_clock_that_is_right_is_not_told(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        MotionHistory.load(written(tmp_path), zero=STILL, rate_hz=10.0)


def test_gaps_are_filled_where_that_is_asked(tmp_path: Path) -> None:
    def change(rows: list[list[str]]) -> None:
        for line in range(100, 106):
            put(line, 1, "")(rows)
        del rows[700:706]

    path = written(tmp_path, change=change)
    with pytest.warns(
        FilledGapWarning, match=r"2 gaps filled by cubic splines, the longest 0.7 s before line"
    ):
        history = MotionHistory.load(path, zero=STILL, maximum_gap=0.8)
    assert "2 gaps filled by cubic splines, the longest 0.7 s" in history.record
    np.testing.assert_allclose(history.motion[:, 2], 1.2 * np.sin(0.7 * history.time), atol=3e-4)
    assert np.ptp(np.diff(history.time)) < 1e-6
    with pytest.raises(FileFormatError, match="line 100"):
        MotionHistory.load(path, zero=STILL, maximum_gap=0.6)


def test_outliers_are_named_and_dropped_where_that_is_asked(tmp_path: Path) -> None:
    def change(rows: list[list[str]]) -> None:
        for line, column, text in ((100, 1, "-5"), (101, 1, "-5"), (400, 2, "12.5"), (800, 3, "-99.99")):
            put(line, column, text)(rows)

    path = written(tmp_path, change=change)
    named = (
        r"4 outliers .* line 100, column 'heave \[m\]': -5; line 101, .* line 400, .*drop_outliers=True drops"
    )
    with (
        pytest.warns(OutlierWarning, match=named),
        pytest.raises(FileFormatError, match="line 800, column 'pit"),
    ):
        MotionHistory.load(path, zero=STILL)
    with (
        pytest.warns(OutlierWarning),
        pytest.raises(FileFormatError, match=r"line 100, .* or dropped as outliers"),
    ):
        MotionHistory.load(path, zero=STILL, drop_outliers=True)
    with pytest.warns(OutlierWarning, match="4 outliers .*they are dropped"), pytest.warns(FilledGapWarning):
        history = MotionHistory.load(path, zero=STILL, drop_outliers=True, maximum_gap=0.3)
    np.testing.assert_allclose(history.motion[:, 2], HEAVE, atol=1e-4)
    np.testing.assert_allclose(history.motion[:, 3:5], np.radians([ROLL, PITCH]).T, atol=1e-4)


def test_sound_motions_have_no_outliers(tmp_path: Path) -> None:
    """A random sea of ship's periods, sampled at 10, 4 and 2 Hz, and a decay."""
    random = np.random.default_rng(5)
    omega, phase = np.linspace(0.3, 1.6, 80), random.uniform(0.0, 2.0 * np.pi, 80)
    for step in (0.1, 0.25, 0.5):
        time = np.arange(0.0, 600.0, step)
        sea = 0.2 * np.cos(np.outer(time, omega) + phase).sum(axis=1)
        decay = 0.2 * np.exp(-0.01 * time) * np.cos(0.5 * time)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            MeasuredSeries.load(written(tmp_path, head=("t", "a [m]", "b [m]"), columns=(time, sea, decay)))


def test_signs_headings_and_motions_that_are_not_there(tmp_path: Path) -> None:
    heading = (358.0 + 4.0 * np.sin(0.3 * TIME)) % 360.0
    path = written(tmp_path, head=(*HEAD, "Heading (deg)"), columns=(TIME + 5.0, HEAVE, ROLL, PITCH, heading))
    history = MotionHistory.load(path, zero=("surge", "sway"), negated=("heave", "pitch"))
    mean = np.degrees(np.unwrap(np.radians(heading))).mean() % 360.0
    yaw = -np.radians(4.0) * (np.sin(0.3 * TIME) - np.sin(0.3 * TIME).mean())
    wanted = np.column_stack([0.0 * TIME, 0.0 * TIME, -HEAVE, np.radians(ROLL), -np.radians(PITCH), yaw])
    np.testing.assert_allclose(history.motion, wanted, atol=1e-6)
    np.testing.assert_allclose(history.time, TIME, atol=1e-9)
    for words in (f"its mean of {mean:.1f} deg", "heave, pitch with the other sign", "surge, sway zero"):
        assert words in history.record


@pytest.mark.parametrize("period", [3.0, 4.0, 8.0])
def test_the_filter_has_the_gain_that_is_stated_and_no_lag(period: float) -> None:
    """Of Butterworth's squared magnitude at 10 Hz, away from the ends; phase by the sine part."""
    time = np.arange(0.0, 240.0, 0.1)
    omega = 2.0 * np.pi / period
    series = MeasuredSeries(time=time, columns={"x": np.cos(omega * time)}, units={"x": "m"})
    inner = slice(200, -200)
    basis = np.column_stack([np.cos(omega * time), np.sin(omega * time)])[inner]
    (even, odd), *_ = np.linalg.lstsq(basis, series.filtered(0.5)["x"][inner], rcond=None)
    ratio = np.tan(np.pi * 0.1 / period) / np.tan(np.pi * 0.1 * 0.5)
    assert even == pytest.approx(1.0 / (1.0 + ratio**8), abs=1e-6)
    assert even == pytest.approx(1.0 / (1.0 + (2.0 / period) ** 8), abs=2e-3)
    assert odd == pytest.approx(0.0, abs=1e-6)


def test_resampling_is_exact_to_its_order() -> None:
    """Cubic splines: half the step, a sixteenth of the error."""
    errors = []
    for step in (0.4, 0.2):
        time = np.arange(0.0, 60.0, step)
        fine = MeasuredSeries(time=time, columns={"x": np.sin(0.8 * time)}, units={"x": "m"}).resampled(0.07)
        inner = slice(100, -100)
        errors.append(np.abs(fine["x"] - np.sin(0.8 * fine.time))[inner].max())
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.15)


def test_noise_of_5_mm_shakes_the_load_and_the_filter_takes_it_away(tmp_path: Path) -> None:
    random = np.random.default_rng(1)
    path = written(tmp_path, columns=(TIME, HEAVE + random.normal(0.0, 5e-3, TIME.size), ROLL, PITCH))
    with pytest.warns(NoisyMotionWarning, match=r"MotionHistory.load\(path, filter_hz=0.5\) does"):
        raw = MotionHistory.load(path, zero=STILL)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        clean = MotionHistory.load(path, zero=STILL, filter_hz=0.5, interval=0.2)
    inner = (clean.time > 5.0) & (clean.time < 115.0)
    error = clean.motion[:, 2] - 1.2 * np.sin(0.7 * clean.time)
    assert error[inner].std() == pytest.approx(5e-3 * np.sqrt(2 * 0.5 / 10.0), rel=0.25)

    def loads(history: MotionHistory) -> np.ndarray:
        scene = Scene(name="hoist")
        scene.add_given_vessel(history, ramp=20.0)
        body: dict[str, Any] = {"mass": 5e4, "inertia": (1e5, 1e5, 1e5), "position": (0.0, 0.0, 20.0)}
        scene.add_body("load", **body)
        scene.add_joint(
            kind="distance",
            name="wire",
            first="vessel",
            second="load",
            point=(0, 0, 25),
            second_point=(0, 0, 20),
        )
        result = simulate(scene, t_end=110.0, dt_out=0.05)
        assert result.settings["given_record"] == history.record
        return result.curve("hook_load") / (5e4 * 9.80665)

    assert loads(raw).max() > 1.5
    assert loads(clean).max() == pytest.approx(1.0 + 1.2 * 0.49 / 9.80665, abs=0.02)


def test_what_was_done_is_kept_in_the_scene_file(tmp_path: Path) -> None:
    scene = Scene(name="x")
    history = MotionHistory.load(written(tmp_path), zero=STILL, interval=0.5)
    scene.add_given_vessel(history)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json").provenance["vessel"].record == history.record
    assert history.record == (
        "mru.csv; resampled to 0.5 s by cubic splines; 240 samples of 0.5 s; surge, sway, yaw zero"
    )


def test_a_series_is_written_as_it_is_read(tmp_path: Path) -> None:
    read = MeasuredSeries.load(written(tmp_path))
    again = MeasuredSeries.load(read.to_csv(tmp_path / "again.csv"))
    assert again.units == read.units
    for name, values in read.columns.items():
        np.testing.assert_array_equal(again[name], values)
    assert read.to_dataframe().attrs["units"] == read.units
    assert "roll [rad]: -0.05236 to 0.05236" in repr(read)
    with pytest.raises(SceneError, match="no column 'hook'; it holds heave, roll, pitch"):
        read["hook"]
    with pytest.raises(ValueError, match="read-only"):
        read["roll"][0] = 1.0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"time": TIME[:5]}, "time has 5 samples"),
        ({"time": TIME[::-1]}, "times must increase"),
        ({"columns": {}}, "columns is empty"),
        ({"columns": {"x": TIME[1:]}}, "x has 1199 values and time 1200"),
        ({"columns": {"x": np.full(TIME.size, np.nan)}}, r"x\[0\] is nan"),
        ({"units": {}}, "unit of x"),
    ],
)
def test_arrays_that_are_no_series_are_refused(change: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        MeasuredSeries(**{"time": TIME, "columns": {"x": HEAVE}, "units": {"x": "m"}, **change})


def test_a_pattern_of_a_message_is_one_line(tmp_path: Path) -> None:
    """However long what the file holds."""
    path = written(tmp_path, change=put(50, 1, "x" * 5000))
    with pytest.raises(FileFormatError) as caught:
        MeasuredSeries.load(path)
    assert len(str(caught.value)) < 400 and not re.search(r"\n", str(caught.value))
