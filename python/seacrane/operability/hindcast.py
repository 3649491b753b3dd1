"""WaveHindcast: a series of sea states over months or years, from a file or arrays."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import number_of, numbers_of, require_unmasked, text_of
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import decoded, read_whole
from seacrane.sea.mending import dates_of_numbers
from seacrane.sea.series_file import DELIMITERS, plain_number

if TYPE_CHECKING:
    import xarray

Flags = NDArray[np.bool_]
Times = NDArray[np.datetime64]
# Of wavespectra, ERA5 and Copernicus Marine, in this order.
NAMES = {
    "time": ("time", "valid_time"),
    "hs": ("hs", "swh", "VHM0"),
    "tp": ("tp", "pp1d", "VTPK"),
    "direction": ("dpm", "dp", "dir", "dm", "mwd", "VMDR"),
}
HIGHEST, LONGEST = 40.0, 60.0  # m and s: beyond them a value is in another unit, or none at all
HOUR = np.timedelta64(1, "h")
MOST_STEPS = 10_000_000


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class WaveHindcast:
    """Sea states at even times.

    Attributes
    ----------
    time : array_like of datetime64, shape (n,)
        Ascending, multiples of one step apart; times that are missing are filled in with NaN. Numbers that
        count from 1970 (s, ms, us, ns), or of digits such as 2020013112, are taken for what they are.
    hs, tp : array_like, shape (n,)
        m and s; NaN, or masked, where they are not known.
    direction_from_deg : array_like, shape (n,), optional
        Where the waves come from, degrees clockwise from north.
    source : str
        Where the series is from.

    Raises
    ------
    SceneError
        For series of different length, times that do not ascend evenly or do not say what they count, or
        values out of range.
    """

    time: Any
    hs: Any
    tp: Any
    direction_from_deg: Any = None
    source: str = ""

    def __post_init__(self) -> None:
        time = _times(self.time)
        series = {"hs": self._series("hs", time.size), "tp": self._series("tp", time.size)}
        if self.direction_from_deg is not None:
            series["direction_from_deg"] = self._series("direction_from_deg", time.size)
        for name, largest, unit in (("hs", HIGHEST, "m"), ("tp", LONGEST, "s")):
            values = series[name]
            wrong = np.flatnonzero((values < 0.0) | (values > largest))
            if wrong.size:
                raise SceneError(
                    f"hindcast: {name} is {values[wrong[0]]:g} {unit} at {time[wrong[0]]}; give 0 to "
                    f"{largest:g} {unit}, and NaN where it is not known"
                )
        even, places = _even(time)
        object.__setattr__(self, "time", even)
        for name, values in series.items():
            placed = np.full(even.size, np.nan)
            placed[places] = values
            placed.flags.writeable = False
            object.__setattr__(self, name, placed)
        object.__setattr__(self, "source", text_of("hindcast: source", self.source or "not told"))

    def _series(self, name: str, size: int) -> Array:
        given = getattr(self, name)
        if isinstance(given, np.ma.MaskedArray):
            given = np.ma.filled(given.astype(float), np.nan)  # masked is not known
        values = numbers_of(f"hindcast: {name}", given)
        if values.shape != (size,):
            raise SceneError(f"hindcast: {name} has shape {values.shape}, time {(size,)}; give one for each")
        return values

    @property
    def step_hours(self) -> float:
        """Between two times, h."""
        return float((self.time[1] - self.time[0]) / HOUR)

    @property
    def known(self) -> Flags:
        """Whether height and period are known, by time."""
        return np.asarray(np.isfinite(self.hs) & np.isfinite(self.tp))

    def travel_deg(self, heading_deg: float) -> Array:
        """Direction in which the waves travel, seen from a vessel whose bow points to a compass heading.

        Returns
        -------
        ndarray, shape (n,)
            Degrees from the bow towards port: 0 following, 90 to port, 180 head waves.

        Raises
        ------
        SceneError
            Without directions.
        """
        if self.direction_from_deg is None:
            raise SceneError("hindcast: has no directions of waves; leave heading_deg out")
        return np.asarray((number_of("heading_deg", heading_deg) - self.direction_from_deg - 180.0) % 360.0)

    def __repr__(self) -> str:
        return (
            f"<WaveHindcast: {self.time.size} sea states of {self.step_hours:g} h from {self.time[0]} to "
            f"{self.time[-1]}, {int((~self.known).sum())} not known>"
        )

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, names: Mapping[str, str] | None = None) -> WaveHindcast:
        """Read a NetCDF file with the names of wavespectra (hs, tp, dpm), ERA5 or Copernicus, or a CSV.

        Parameters
        ----------
        path : path
            Ends with .csv: a line of names, then a line for each time, which is as ISO 8601 writes it, or
            counts from 1970, or is of digits such as 2020013112. Cells end with a comma, a semicolon or a
            tab; with one of the latter, numbers may have a decimal comma.
        names : mapping of str to str, optional
            Names in the file of "time", "hs", "tp" and "direction", where they are others.

        Raises
        ------
        FileFormatError
            For a file that is damaged, or has none of the names.
        SceneError
            As for arrays.
        """
        file = Path(path)
        given = dict(names or {})
        for name in given:
            if name not in NAMES:
                raise SceneError(f"hindcast: names has {shown(name)}; choose from {', '.join(NAMES)}")
        asked = {name: (given[name],) if name in given else usual for name, usual in NAMES.items()}
        if file.suffix.lower() == ".csv":
            return cls(**_of_csv(file, asked), source=file.name)
        return _of_netcdf(file, asked)


def _times(given: Any) -> Times:
    require_unmasked("hindcast: time", given)
    try:
        found = np.asarray(given)
        plain = found.dtype.kind == "O" and all(isinstance(one, (int, float)) for one in found.flat)
        numeric = found.dtype.kind in "iuf" or plain
        time = dates_of_numbers("hindcast: time", found) if numeric else found.astype("datetime64[s]")
    except SceneError:
        raise
    except (TypeError, ValueError) as error:
        raise SceneError(f"hindcast: time is {shown(given)}; give dates") from error
    if time.ndim != 1 or time.size < 2 or np.isnat(time).any():
        raise SceneError(f"hindcast: time has shape {time.shape}; give two dates or more, none missing")
    return time


def _even(time: Times) -> tuple[Times, NDArray[np.intp]]:
    """All times from first to last by the shortest step, and the places of those given."""
    steps = np.diff(time)
    if steps.min() <= np.timedelta64(0, "s"):
        place = int(np.argmin(steps))
        raise SceneError(f"hindcast: {time[place + 1]} comes after {time[place]}; give times that ascend")
    step = steps.min()
    uneven = np.flatnonzero((time - time[0]) % step != np.timedelta64(0, "s"))
    if uneven.size:
        raise SceneError(
            f"hindcast: {time[uneven[0]]} is no multiple of the step of {step} from {time[0]}; give even "
            "times, with NaN where nothing is known"
        )
    places = np.asarray((time - time[0]) // step, dtype=np.intp)
    if places[-1] >= MOST_STEPS:
        raise SceneError(f"hindcast: {places[-1] + 1} steps of {step} are more than {MOST_STEPS}; give fewer")
    return time[0] + np.arange(places[-1] + 1) * step, places


def _named(there: Iterable[str], names: Mapping[str, tuple[str, ...]]) -> dict[str, str]:
    held = list(there)
    found = {what: next((name for name in usual if name in held), "") for what, usual in names.items()}
    for what in ("time", "hs", "tp"):
        if not found[what]:
            raise FileFormatError(
                f"holds {', '.join(held) or 'nothing'}, and no {what}; give names={{{what!r}: ...}}"
            )
    return found


def _of_csv(path: Path, names: Mapping[str, tuple[str, ...]]) -> dict[str, Any]:
    text = decoded(read_whole(path)).splitlines()
    first = next((line for line in text if line.strip()), "")
    delimiter = next((one for one in DELIMITERS if one in first), ",")
    try:
        rows = list(csv.reader(text, delimiter=delimiter))
        head = [name.strip() for name in rows[0]] if rows else []
        found = _named(head, names)
    except csv.Error as error:
        raise FileFormatError(f"{path}: is no table of text ({error}); write it as UTF-8") from error
    except FileFormatError as error:
        raise FileFormatError(f"{path}: {error}") from error
    columns: dict[str, list[Any]] = {what: [] for what, name in found.items() if name}
    for number, row in enumerate(rows[1:], start=2):
        for what, column in columns.items() if row else ():
            place = head.index(found[what])
            cell = row[place].strip() if place < len(row) else ""
            value: Any = plain_number(cell, comma=delimiter != ",")
            if value is None and what == "time":
                with suppress(ValueError):
                    value = np.datetime64(cell.removesuffix("Z"), "s")
            if value is None:
                wanted = "a date such as 2020-01-31T12:00" if what == "time" else "a number, or nothing"
                raise FileFormatError(f"{path}, line {number}: {shown(cell)} is not {wanted}")
            column.append(value)
    numbers = [one for one in columns["time"] if isinstance(one, float)]
    if numbers and len(numbers) < len(columns["time"]):
        raise FileFormatError(f"{path}: time is {numbers[0]:.10g} beside dates; give dates in every line")
    if numbers:  # what they count is told by their size and step
        try:
            columns["time"] = list(dates_of_numbers(f"{path}: time", np.array(numbers)))
        except SceneError as error:
            raise FileFormatError(str(error)) from error
    direction = columns.pop("direction", None)
    return {**columns, "direction_from_deg": direction}


def _of_netcdf(path: Path, names: Mapping[str, tuple[str, ...]]) -> WaveHindcast:
    import xarray

    try:
        with (
            open_netcdf(path, fix="cut out the place and the years asked for"),
            xarray.open_dataset(path) as data,
        ):
            return WaveHindcast(**_of_dataset(data, names), source=path.name)
    except FileNotFoundError:
        raise
    except (FileFormatError, *NETCDF_ERRORS) as error:
        if isinstance(error, SceneError):
            raise
        raise FileFormatError(f"{path}: {error}") from error


def _of_dataset(data: xarray.Dataset, names: Mapping[str, tuple[str, ...]]) -> dict[str, Any]:
    found = _named(map(str, data.variables), names)
    out: dict[str, Any] = {"time": data[found["time"]].to_numpy()}
    for what in ("hs", "tp", "direction"):
        if not found[what]:
            continue
        variable = data[found[what]]
        other = {dim: size for dim, size in variable.sizes.items() if dim not in data[found["time"]].dims}
        if any(size != 1 for size in other.values()):
            told = ", ".join(f"{dim} ({size})" for dim, size in other.items())
            raise FileFormatError(f"{found[what]} lies over {told} beside time; select one place")
        key = "direction_from_deg" if what == "direction" else what
        out[key] = np.asarray(variable.to_numpy(), dtype=float).reshape(-1)
    return out
