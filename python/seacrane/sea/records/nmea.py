"""Logs of motion sensors: the sentences $PASHR and $PRDID of NMEA 0183, and TSS1; others are passed over.

Layouts: $PASHR https://receiverhelp.trimble.com/oem-gnss/NMEA-0183messages_PASHR.html; $PRDID in table 21 of
the POS MV V5 Installation and Operation Guide; TSS1
https://docs.novatel.com/OEM7/Content/SPAN_Logs/TSS1.htm. A sentence whose checksum is wrong, or that is cut
off, is a missing sample.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import reduce
from operator import xor

from seacrane.sea.records.kind import MOTIONS, Columns, Kind, has

DAY, HALF = 86400.0, 43200.0  # s
BEFORE = 60  # characters in which a logger's stamp stands before a sentence
PASHR = re.compile(r"\$PASHR,(?=\d{6})")
PRDID = re.compile(r"\$PRDID,(?=[-+\d])")
TSS1 = re.compile(r":[0-9A-Fa-f]{6}(?=[ -])")
TSS1_WHOLE = re.compile(
    r":[0-9A-Fa-f]{6} {0,2}(-?)(\d{4})[A-Za-z] ?(-?)(\d\d)(\d\d) {0,2}(-?)(\d\d)(\d\d)\s*$"
)
STAMP = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:\.\d+)?Z?(?=[\s,;]*$)")
NO_CLOCK = "its sentences have no time; give rate_hz=, at which the sensor sends them, or a log with stamps"


def _fields(line: str, start: re.Match[str]) -> list[str]:
    """Fields behind a sentence's name; none where its checksum is wrong."""
    body, star, told = line[start.start() + 1 :].partition("*")
    if star and f"{reduce(xor, body.encode('utf-8'), 0) & 0xFF:02X}" != told.strip()[:2].upper():
        return []
    return body.split(",")[1:]


def pashr(lines: Sequence[str], _: float | None) -> Columns:
    """By its own clock, of the day; midnight is passed."""
    rows, before, days = [], 0.0, 0
    for line in lines:
        start = PASHR.search(line)
        fields = _fields(line, start) if start else []
        if len(fields) < 6 or not re.fullmatch(r"\d{6}(\.\d*)?", fields[0]):
            rows.append("")
            continue
        clock = fields[0]
        time = 3600.0 * int(clock[:2]) + 60.0 * int(clock[2:4]) + float(clock[4:])
        days += before - time > HALF
        before = time
        values = [fields[i] for i in (1, 3, 4, 5)]  # not the T of true north
        rows.append(";".join([repr(time + DAY * days), *values]))
    return Columns("time [s];heading [deg];roll [deg];pitch [deg];heave [m]", rows)


def _prdid(line: str, start: re.Match[str]) -> str:
    fields = _fields(line, start)
    pitch, roll, heading = fields[:3] if len(fields) >= 3 else ("", "", "")
    return f"{heading};{roll};{pitch}"


def _tss1(line: str, start: re.Match[str]) -> str:
    whole = TSS1_WHOLE.match(line, start.start())
    if whole is None:
        return ";;"
    roll, pitch = (f"{whole[i]}{whole[i + 1]}.{whole[i + 2]}" for i in (3, 6))
    return f"{whole[1]}{whole[2]};{roll};{pitch}"


def _by_rate(
    sentence: re.Pattern[str], header: str, row: Callable[[str, re.Match[str]], str]
) -> Callable[[Sequence[str], float | None], Columns]:
    """Columns of a sentence without a clock: by the log's stamps before it, or by the sensor's rate."""

    def columns(lines: Sequence[str], rate_hz: float | None) -> Columns:
        rows, count = [], 0
        for line in lines:
            start = sentence.search(line)
            if start is None:
                rows.append("")
                continue
            stamp = STAMP.search(line[max(start.start() - BEFORE, 0) : start.start()])
            time = stamp[0] if stamp else "" if not rate_hz else repr(count / rate_hz)
            rows.append(f"{time};{row(line, start)}" if time else "")
            count += 1
        return Columns(f"time{'' if not rate_hz else ' [s]'};{header}", rows, fix=NO_CLOCK)

    return columns


KINDS = (
    Kind(
        name="NMEA $PASHR", looks="`$PASHR,hhmmss.sss,heading,T,roll,pitch,heave,...`",
        layout="https://receiverhelp.trimble.com/oem-gnss/NMEA-0183messages_PASHR.html",
        reader=MOTIONS, is_it=has(PASHR), columns=pashr,
    ),
    Kind(
        name="NMEA $PRDID", looks="`$PRDID,pitch,roll,heading`, with time stamps before it or `rate_hz=`",
        layout="POS MV V5 Installation and Operation Guide, table 21",
        reader=MOTIONS, is_it=has(PRDID),
        columns=_by_rate(PRDID, "heading [deg];roll [deg];pitch [deg]", _prdid),
    ),
    Kind(
        name="TSS1", looks="`:XXAAAA MHHHHQMRRRR MPPPP`, with time stamps before it or `rate_hz=`",
        layout="https://docs.novatel.com/OEM7/Content/SPAN_Logs/TSS1.htm",
        reader=MOTIONS, is_it=has(TSS1_WHOLE),
        columns=_by_rate(TSS1, "heave [cm];roll [deg];pitch [deg]", _tss1),
    ),
)  # fmt: skip
