"""Sea states of a record in text: which columns they are, their units, their clock, and what is not known."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import listed
from seacrane.sea.mending import dates_of_numbers, unit_since_1970
from seacrane.sea.reading import unit_of
from seacrane.sea.records.kind import SEA_STATES
from seacrane.sea.series_file import Heading, SeriesFile, plain_words

Times = NDArray[np.datetime64]
# Of wavespectra, ERA5 and Copernicus Marine, in this order: their layouts tell the units.
NAMES = {
    "time": ("time", "valid_time"),
    "hs": ("hs", "swh", "VHM0"),
    "tp": ("tp", "pp1d", "VTPK"),
    "direction": ("dpm", "dp", "dir", "dm", "mwd", "VMDR"),
}
SAID = {  # of buoys and spreadsheets, which have the unit beside them
    "hs": ("hm0", "significant wave height", "significant height"),
    "tp": ("peak period", "peak wave period", "dominant wave period"),
    "direction": ("peak direction", "mean direction", "direction"),
}
UNITS = {"hs": "m", "tp": "s", "direction": "deg"}
SI = {"m": "m", "s": "s", "deg": "rad"}
MOST = {"hs": 40.0, "tp": 60.0, "direction": 360.0}  # m, s and deg: beyond them a value is none
NINES = np.array(
    [n * 10.0**-d for n in (99.0, 999.0, 9999.0, 99999.0) for d in range(3) if n * 10.0**-d > 90.0]
)
OFF = 0.1  # of a step, by which a buoy's clock may be off even times
ZONES = {"utc", "gmt", "z"}
FARTHEST = 14.0  # h, of a time zone from UTC


def read_sea_states(
    path: Path, names: Mapping[str, str], units: Mapping[str, str], utc_offset: float | None
) -> dict[str, Any]:
    """What `WaveHindcast` is made of; FileFormatError, with the line, for what cannot be read."""
    file = SeriesFile(path, time=names.get("time"), dates=units.get("date"), reader=SEA_STATES)
    clock, wanted = file.clocks()[0], _wanted(file, names)
    numbers, lines, start = file.columns([clock, *wanted.values()], 1)
    if not lines.size:
        raise FileFormatError(f"{path}: holds no sea states{f': {file.fix}' if file.fix else ''}")
    missing = np.flatnonzero(np.isnan(numbers[:, 0]))
    if missing.size:
        raise file.refused(int(lines[missing[0]]), clock, "has no time; give it, or delete the line")
    time, told = _dates(file, clock, int(lines[0]), numbers[:, 0], start, utc_offset), []
    found: dict[str, Any] = {}
    for place, (what, one) in enumerate(wanted.items(), start=1):
        values = numbers[:, place] * _factor(file, what, one, units.get(what))
        nines = np.isclose(np.abs(numbers[:, place])[:, None], NINES).any(axis=1)
        nines &= (values < 0.0) | (values > MOST[what])
        if nines.any():
            told.append(f"{nines.sum()} times {numbers[nines, place][0]:g} for {what} is not known")
        found[what] = np.where(nines, np.nan, values)
    if time.size > 1 and np.all(np.diff(time) < np.timedelta64(0, "s")):  # the newest first
        time, found = time[::-1], {what: values[::-1] for what, values in found.items()}
    time, moved = _even(time)
    told += [f"times moved onto even ones, by {moved} s at most"] * (moved > 0)
    direction = found.pop("direction", None)
    return {"time": time, **found, "direction_from_deg": direction, "source": "; ".join([path.name, *told])}


def _wanted(file: SeriesFile, names: Mapping[str, str]) -> dict[str, Heading]:
    """The columns of height, period and, where there is one, direction."""
    found: dict[str, Heading] = {}
    for what in UNITS:
        usual = (names[what],) if what in names else (*NAMES[what], *SAID[what])
        held = {one.name: one for one in reversed(file.headings)}
        one = next((held[plain_words(name)] for name in usual if plain_words(name) in held), None)
        one = file.find(names[what]) if one is None and what in names else one
        if one is not None:
            found[what] = one
        elif what != "direction" or what in names:
            raise FileFormatError(
                f"{file.path}: holds {listed([each.text for each in file.headings])}, and no {what}; give "
                f"names={{{what!r}: ...}}"
            )
    return found


def _factor(file: SeriesFile, what: str, one: Heading, given: str | None) -> float:
    """To m, s or degrees."""
    told = {plain_words(name) for name in NAMES[what]}
    if given is None and one.unit is None and one.name in told:
        given = UNITS[what]
    factor, unit = unit_of(file, one, given)
    if unit != SI[UNITS[what]]:
        raise file.refused(
            file.header, one, f"is in {unit}, and {what} in {UNITS[what]} or a unit of its kind"
        )
    return float(np.degrees(factor)) if what == "direction" else factor


def _dates(
    file: SeriesFile, clock: Heading, line: int, times: Array, start: str, utc_offset: float | None
) -> Times:
    """UTC of the clock; refused where nothing says which zone it keeps."""
    known = file.kind is not None or clock.name == "valid time" or bool(
        {(clock.unit or "").lower(), *clock.name.split()} & ZONES
    )  # fmt: skip
    if start:
        first = datetime.fromisoformat(start)
        known |= first.tzinfo is not None
        begin = np.datetime64((first.astimezone(UTC) if first.tzinfo else first).replace(tzinfo=None), "s")
        dates = begin + np.round(times).astype("timedelta64[s]")
    else:
        known |= unit_since_1970(times) is not None
        try:
            dates = dates_of_numbers(f"{file.path}: time", times)
        except SceneError as error:
            raise FileFormatError(str(error)) from error
    if not known and utc_offset is None:
        raise file.refused(
            line, clock, "says no time zone; write it in the header, as 'time [UTC]', or give utc_offset=0, "
            "the hours that its clock is ahead of UTC",
        )  # fmt: skip
    if known and utc_offset:
        raise SceneError(f"utc_offset is {utc_offset:g}, and times of {file.path} are UTC; leave it out")
    ahead = 0.0 if utc_offset is None else number_of("utc_offset", utc_offset)
    if not abs(ahead) <= FARTHEST:
        raise SceneError(f"utc_offset is {ahead:g}; give hours, at most {FARTHEST:g} from UTC")
    return np.asarray(dates - np.timedelta64(round(3600.0 * ahead), "s"))


def _even(time: Times) -> tuple[Times, int]:
    """Times of a clock that is a little off its own step on even ones, and by how much it was off, s."""
    if time.size < 3:
        return time, 0
    seconds = (time - time[0]).astype(np.int64)
    step = int(np.median(np.diff(seconds)))
    if step <= 0:
        return time, 0
    even = np.round(seconds / step).astype(np.int64) * step
    off = int(np.abs(seconds - even).max())
    if off > OFF * step or np.any(np.diff(even) <= 0):
        return time, 0
    return time[0] + even.astype("timedelta64[s]"), off
