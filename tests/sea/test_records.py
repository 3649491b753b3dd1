"""Records as they are found: made up after their public layouts, and read, or refused by what they need.

Layouts are cited in seacrane.sea.records; numbers here are by hand.
"""

from __future__ import annotations

from functools import reduce
from operator import xor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import MotionHistory
from seacrane.errors import FileFormatError, SceneError
from seacrane.operability import ScatterDiagram, WaveHindcast
from seacrane.sea.records.kind import MOTIONS, SCATTER, SEA_STATES
from seacrane.sea.records.kinds import KINDS
from seacrane.statistics import MeasuredSeries

ROOT = Path(__file__).resolve().parents[2]
NAN = float("nan")

NDBC_TODAY = """\
#YY  MM DD hh mm WDIR WSPD GST  WVHT   DPD   APD MWD   PRES  ATMP  WTMP  DEWP  VIS PTDY  TIDE
#yr  mo dy hr mn degT m/s  m/s     m   sec   sec degT   hPa  degC  degC  degC  nmi  hPa    ft
2026 03 01 02 40 240  7.0  9.0   1.5    11   6.1 265 1015.0  12.1  13.0    MM   MM   MM    MM
2026 03 01 02 30 240  7.0  9.0    MM    MM    MM  MM 1015.0  12.1  13.0    MM   MM   MM    MM
2026 03 01 01 40 230  6.0  8.0    MM    MM    MM  MM 1015.2  12.0  13.0    MM   MM   MM    MM
2026 03 01 00 40 230  6.0  8.0   1.3    10   6.0 260 1015.3  12.0  13.0    MM   MM   MM    MM
"""
NDBC_PAST = """\
YY MM DD hh WD   WSPD GST  WVHT  DPD   APD  MWD  BAR    ATMP  WTMP  DEWP  VIS
98 01 01 00 150  5.0  6.1  1.30 10.00  6.00 260 1015.0  12.0  13.0 999.0 99.0
98 01 01 01 150  5.0  6.1 99.00 99.00 99.00 999 1015.0  12.0  13.0 999.0 99.0
98 01 01 02 150  5.0  6.1  1.50 11.00  6.10 999 1015.0  12.0  13.0 999.0 99.0
"""
SWDEN = """\
#YY  MM DD hh mm  .0500  .0750  .1000  .1250  .1500
2025 01 01 00 40   0.00   2.00   4.00   1.00   0.00
2025 01 01 01 40 999.00 999.00 999.00 999.00 999.00
2025 01 01 02 40   0.00   0.00   1.00   2.00   0.00
"""
DATA_SPEC = """\
#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >
2025 01 01 01 40 0.200 0.000 (0.050) 2.000 (0.075) 4.000 (0.100) 1.000 (0.125) 0.000 (0.150)
2025 01 01 00 40 9.999 0.000 (0.050) 2.000 (0.075) 4.000 (0.100) 1.000 (0.125) 0.000 (0.150)
"""
SUMMARY = """\
#YY  MM DD hh mm WVHT  SwH  SwP  WWH  WWP SwD WWD  STEEPNESS  APD MWD
2025 01 01 00 40  1.3  1.0  9.0  0.8  5.0   W   W        N/A  5.0 265
"""
DASHBOARD = """\
Humidity (%rel),Epoch Time,Significant Wave Height (m),Peak Period (s),Peak Direction (deg)
20,1767225600,1.30,10.0,260
20,1767227412,1.40,10.5,261
20,1767229200,1.50,11.0,262
"""
BULK = """\
year, month, day, hour, min, sec, milisec, Significant Wave Height, Peak Period, Peak Direction
2026,1,1,0,0,0,0,1.30,10.0,260
2026,1,1,0,30,0,0,1.40,10.5,261
2026,1,1,1,0,0,0,1.50,11.0,262
"""
ERA5 = """\
valid_time,swh,pp1d,mwd,latitude,longitude
2026-01-01 00:00:00,1.3,10.0,260,55.0,3.0
2026-01-01 01:00:00,,,,55.0,3.0
2026-01-01 02:00:00,1.5,11.0,262,55.0,3.0
"""
GERMAN = """\
Datum;Uhrzeit [UTC];Hm0 [cm];Tp [s]
01.02.2026;00:00;130,0;10,0
01.02.2026;01:00;9999,0;99,0
01.02.2026;02:00;150,0;11,0
"""
SPOTTER = [1.3, 1.4, 1.5], [10, 10.5, 11], [260, 261, 262], "2026-01-01T00:00:00"
SEAS: dict[str, tuple[str, list[float], list[float], list[float] | None, str]] = {
    "NDBC of today, newest first": (NDBC_TODAY, [1.3, 1.5], [10, 11], [260, 265], "2026-03-01T00:40:00"),
    "NDBC of 1998": (NDBC_PAST, [1.3, 1.5], [10, 11], [260, NAN], "1998-01-01T00:00:00"),
    # m0 = 0.025 (2 + 4 + 1) = 0.175 m2; 0.025 (1 + 2) = 0.075 m2
    "NDBC swden": (SWDEN, [4 * 0.175**0.5, NAN, 4 * 0.075**0.5], [10, NAN, 8], None, "2025-01-01T00:40:00"),
    "NDBC data_spec": (DATA_SPEC, [4 * 0.175**0.5] * 2, [10, 10], None, "2025-01-01T00:40:00"),
    "Spotter's dashboard": (DASHBOARD, *SPOTTER),
    "Spotter's card": (BULK, *SPOTTER),
    "ERA5": (ERA5, [1.3, NAN, 1.5], [10, NAN, 11], [260, NAN, 262], "2026-01-01T00:00:00"),
    "decimal commas": (GERMAN, [1.3, NAN, 1.5], [10, NAN, 11], None, "2026-02-01T00:00:00"),
}  # fmt: skip


def put(folder: Path, text: str, name: str = "site.txt") -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


@pytest.mark.parametrize("what", SEAS)
def test_sea_states_as_they_are_found(what: str, tmp_path: Path) -> None:
    text, hs, tp, direction, first = SEAS[what]
    found = WaveHindcast.load(put(tmp_path, text))
    assert found.time[0] == np.datetime64(first)
    np.testing.assert_allclose(found.hs, hs, rtol=1e-12)
    np.testing.assert_allclose(found.tp, tp, rtol=1e-12)
    if direction is not None:
        np.testing.assert_allclose(found.direction_from_deg, direction, rtol=1e-12)
    assert ("9999 for hs is not known" in found.source) == (what == "decimal commas")
    assert ("by 12 s at most" in found.source) == (what == "Spotter's dashboard")


PLAIN = "time;hs;tp\n{};1;8\n{};1;8\n"
ZONE = PLAIN.format("2026-01-01 00:00", "2026-01-01 01:00")
SLASHES = "date;time [UTC];hs;tp\n{};00:00;1;8\n{};00:00;1;8\n"
REFUSED: dict[str, tuple[str, dict[str, Any], str]] = {
    "no zone": (ZONE, {}, r"line 2, column 'time': says no time zone; .*utc_offset=0"),
    "no unit": (ZONE.replace("hs", "Hm0"), {"utc_offset": 0}, r"'Hm0'.*has no unit.*units="),
    "a height in s": (ZONE.replace("hs", "hs [s]"), {"utc_offset": 0}, r"is in s, and hs in m"),
    "no period": (ZONE.replace("tp", "tz"), {"utc_offset": 0}, r"no tp; give names="),
    "a summary": (SUMMARY, {}, r"no dominant period; give .*\.data_spec"),
    "wind alone": ("".join(NDBC_TODAY.splitlines(keepends=True)[i] for i in (0, 1, 3, 4)), {},
                   "no row has waves"),
    "a spectrum cut off": (SWDEN.replace("   1.00   0.00\n", "\n"), {}, r"line 2, .*3 densities of 5"),
    "which is the day": (SLASHES.format("01/02/2026", "02/02/2026"), {}, r"line 2.*units=\{'date': 'dd/mm"),
    "a 13th month": (SLASHES.format("01/02/2026", "14/13/2026"), {}, r"which number is the day"),
    "motions": (":00FFCA -0003F-0325  0319\n", {}, r"of the kind TSS1, which MeasuredSeries\.load reads"),
    "a scatter table": ("Hs [m] \\ Tp [s];3-4;4-5\n0-1;1;2\n1-2;0;1\n", {}, r"ScatterDiagram\.load"),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_what_a_record_needs_is_asked_for(what: str, tmp_path: Path) -> None:
    text, given, words = REFUSED[what]
    with pytest.raises(FileFormatError, match=words):
        WaveHindcast.load(put(tmp_path, text), **given)


def test_what_is_asked_for_may_be_given(tmp_path: Path) -> None:
    path = put(tmp_path, ZONE.replace("hs", "Hm0"))
    found = WaveHindcast.load(path, utc_offset=2, units={"hs": "ft"})
    assert found.time[0] == np.datetime64("2025-12-31T22:00") and found.hs[0] == pytest.approx(0.3048)
    for ahead in (np.nan, np.inf, 7200.0):
        with pytest.raises(SceneError, match="give hours, at most 14 from UTC"):
            WaveHindcast.load(path, utc_offset=ahead, units={"hs": "ft"})
    for units, words in (({"hs": 3}, "units of hs is 3"), (3, "units is 3")):
        with pytest.raises(SceneError, match=words):
            WaveHindcast.load(path, utc_offset=2, units=units)  # type: ignore[arg-type]
    for first, second, given in (
        ("01/02/2026", "02/02/2026", "dd/mm/yyyy"), ("02/01/2026", "02/02/2026", "mm/dd/yyyy"),
        ("31/01/2026", "01/02/2026", None), ("01/31/2026", "02/01/2026", None),
    ):  # fmt: skip
        path = put(tmp_path, SLASHES.format(first, second))
        found = WaveHindcast.load(path, units={"date": given} if given else None)
        assert found.time[0] in (np.datetime64("2026-02-01"), np.datetime64("2026-01-31"))
    for given, words in (({"units": {"hm0": "m"}}, "units has 'hm0'"), ({"utc_offset": 1.0}, "leave it out"),
                         ({"units": {"date": "yyyy"}}, "units of date")):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            WaveHindcast.load(path, **given)


COUNTS = np.array([[20.0, 9.0, 1.0], [0.0, 25.0, 5.0]])
SI = {"units": {"hs": "m", "tp": "s"}}
TABLES: dict[str, tuple[str, dict[str, Any]]] = {
    "limits": ("Hs [m] \\ Tp [s];4-6;6-8;8-10;Sum\n0-1;20;9;1;30\n1-2;;25;5;30\nSum;20;34;6;60\n", {}),
    "transposed": ("Tp (s) / Hs (m),0-1,1-2\n4-6,20,-\n6-8,9,25\n8-10,1,5\n", {}),
    "percent, from the highest down": (
        "Site A\n;Tp [s]\nHs [m];4,0-6,0;6,0-8,0;8,0-10,0;>10\n1,0-2,0;0%;41,66667%;8,33333%;0\n"
        "0,0-1,0;33,33333%;15%;1,66667%;0\n", {}),
    "limits that do not overlap": (
        "Hs [m] \\ Tp [s]\t4.0-5.9\t6.0-7.9\t8.0-9.9\n0.0-0.9\t20\t9\t1\n1.0-1.9\t0\t25\t5\n", {}),
    "upper limits": ("Hs/Tp;6;8;10\n1;20;9;1\n2;0;25;5\n", {"classes": "upper", **SI}),
    "middles": ("Hs/Tp;5;7;9\n0.5;20;9;1\n1.5;0;25;5\n", {"classes": "middle", **SI}),
    "rows that are told": ("Hs [cm];0-100;100-200\n4-6;20;0\n6-8;9;25\n8-10;1;5\n",
                           {"rows": "tp", "units": {"tp": "s"}}),
}  # fmt: skip


@pytest.mark.parametrize("what", TABLES)
def test_scatter_tables_of_many_looks_are_one(what: str, tmp_path: Path) -> None:
    text, given = TABLES[what]
    found = ScatterDiagram.load(put(tmp_path, text), **given)
    np.testing.assert_allclose(found.hs, [0.0, 1.0, 2.0])
    np.testing.assert_allclose(found.tp, [4.0, 6.0, 8.0, 10.0])
    np.testing.assert_allclose(found.probability, COUNTS / COUNTS.sum(), atol=1e-7)
    assert found.source == "site.txt"


GOOD = TABLES["limits"][0]
NO_TABLES: dict[str, tuple[str, dict[str, Any], str]] = {
    "no classes": ("a;b\n1;2\n", {}, "no scatter table"),
    "no unit": (GOOD.replace(" [m]", ""), {}, r"line 1: hs has no unit; .*units="),
    "mean periods": (GOOD.replace("Tp", "Tz"), {}, r"peak periods are needed; .*1\.408"),
    "exchanged": (GOOD.replace("Hs [m] \\ Tp [s]", "Tp [s] \\ Hs [m]"), {}, "no water bears; .*exchanged"),
    "a hole": (GOOD.replace("\n1-2", "\n2-3"), {}, r"line 2: the class '0-1' of hs .* at 2; let all"),
    "one number each": (TABLES["middles"][0], {}, "classes='lower', 'middle' or 'upper'"),
    "an open class with seas": (GOOD.replace("8-10", ">8"), {}, r"'>8' has no end"),
    "no count": (GOOD.replace("25", "n/a"), {}, r"line 3: 'n/a' is no count"),
    "which axis": ("Hs [m], Tp [s]\nx;4-6;6-8;8-10\n0-1;20;9;1\n", {}, "does not say which axis is which"),
}  # fmt: skip


@pytest.mark.parametrize("what", NO_TABLES)
def test_a_scatter_table_that_does_not_say_it_is_refused(what: str, tmp_path: Path) -> None:
    text, given, words = NO_TABLES[what]
    with pytest.raises(FileFormatError, match=words):
        ScatterDiagram.load(put(tmp_path, text), **given)


TIME = np.arange(0.0, 60.0, 0.1)
HEAVE, ROLL, PITCH = 1.2 * np.sin(0.7 * TIME), 3.0 * np.sin(0.6 * TIME + 1.0), 1.5 * np.sin(0.65 * TIME)
STILL = ("surge", "sway", "yaw")


def nmea(body: str) -> str:
    return f"${body}*{reduce(xor, body.encode()):02X}"


def pashr(i: int) -> str:
    clock = (86390.0 + TIME[i]) % 86400.0  # midnight passes after 10 s
    hour, minute, second = int(clock // 3600), int(clock % 3600 // 60), round(clock % 60, 3)
    stamp = f"{hour:02d}{minute:02d}{second:06.3f}"
    return nmea(f"PASHR,{stamp},271.20,T,{ROLL[i]:+.4f},{PITCH[i]:+.4f},{HEAVE[i]:+.4f},0.01,0.01,0.02,2,1")


def prdid(i: int) -> str:
    return nmea(f"PRDID,{PITCH[i]:+.2f},{ROLL[i]:+.2f},271.20")


def tss1(i: int) -> str:
    h, r, p = (round(100.0 * one[i]) for one in (HEAVE, ROLL, PITCH))
    sign = [" " if one >= 0 else "-" for one in (h, r, p)]
    return f":00FFCA {sign[0]}{abs(h):04d}F{sign[1]}{abs(r):04d} {sign[2]}{abs(p):04d}"


def log(folder: Path, line: Any, *, stamped: bool = False) -> Path:
    begin = np.datetime64("2026-03-01T12:00:00.0", "ms")
    stamps = [f"{begin + np.timedelta64(100 * i, 'ms')} " if stamped else "" for i in range(TIME.size)]
    rows = [f"{stamps[i]}{line(i)}\n$GPGGA,123519,4807.038,N*47\n" for i in range(TIME.size)]
    return put(folder, "".join(rows), "mru.log")


def test_logs_of_motion_sensors(tmp_path: Path) -> None:
    found = MeasuredSeries.load(log(tmp_path, pashr))
    np.testing.assert_allclose(found.time - found.time[0], TIME, atol=1e-6)
    for name, values in (("heave", HEAVE), ("roll", np.radians(ROLL)), ("pitch", np.radians(PITCH))):
        np.testing.assert_allclose(found[name], values, atol=6e-5)
    history = MotionHistory.load(log(tmp_path, pashr), zero=("surge", "sway"), negated=("pitch",))
    np.testing.assert_allclose(history.motion[:, 4], -np.radians(PITCH), atol=2e-6)
    for line, unknown, names in ((prdid, "heave", ("roll", "pitch")), (tss1, "", ("heave", "roll", "pitch"))):
        with pytest.raises(FileFormatError, match=r"holds 0 rows .*rate_hz="):
            MeasuredSeries.load(log(tmp_path, line))
        for path, given in (
            (log(tmp_path, line), {"rate_hz": 10.0}),
            (log(tmp_path, line, stamped=True), {}),
        ):
            found = MeasuredSeries.load(path, **given)
            np.testing.assert_allclose(found.time, TIME, atol=1e-6)
            assert unknown not in found.columns and set(names) <= set(found.columns)
            assert np.abs(found["roll"] - np.radians(ROLL)).max() < np.radians(0.0051)
    assert np.abs(found["heave"] - HEAVE).max() < 0.0051


def test_a_sentence_that_is_damaged_is_a_missing_sample(tmp_path: Path) -> None:
    for line, words in ((pashr, "samples are missing"), (tss1, "1 values are missing")):

        def damaged(i: int, whole: Any = line) -> str:
            return whole(i)[:-4] + "9*00" if i == 50 else whole(i)

        with pytest.raises(FileFormatError, match=words):
            MeasuredSeries.load(log(tmp_path, damaged), rate_hz=10.0)


def test_date_and_time_of_a_motion_in_two_columns(tmp_path: Path) -> None:
    begin = np.datetime64("2026-03-01T23:59:30.0", "ms")
    stamps = [str(begin + np.timedelta64(100 * i, "ms")) for i in range(TIME.size)]
    parts = [(f"{one[8:10]}.{one[5:7]}.{one[:4]}", one[11:]) for one in stamps]
    rows = [f"{day};{clock};{h:.5f}".replace(".", ",") for (day, clock), h in zip(parts, HEAVE, strict=True)]
    rows = [row.replace(",", ".", 2) for row in rows]  # dots of the date
    found = MeasuredSeries.load(put(tmp_path, "Date;Time;Heave [m]\n" + "\n".join(rows)))
    np.testing.assert_allclose(found.time, TIME, atol=1e-9)
    np.testing.assert_allclose(found["heave"], HEAVE, atol=1e-5)
    displacement = "\n".join(
        f"2026,3,1,12,0,{int(t)},{round(1e3 * (t % 1.0))},0.0,0.0,{h:.4f}"
        for t, h in zip(TIME, HEAVE, strict=True)
    )
    found = MeasuredSeries.load(
        put(tmp_path, f"year,month,day,hour,min,sec,milisec,x(m),y(m),z(m)\n{displacement}")
    )
    np.testing.assert_allclose(found["z"], HEAVE, atol=1e-4)
    np.testing.assert_allclose(found.time, TIME, atol=1e-6)


def test_the_page_lists_every_kind() -> None:
    page = (ROOT / "docs" / "operability.md").read_text(encoding="utf-8")
    assert {kind.reader for kind in KINDS} == {MOTIONS, SEA_STATES, SCATTER}
    for kind in KINDS:
        assert f"| {kind.name} | {kind.looks} | `{kind.reader}` |" in page
