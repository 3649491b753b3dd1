"""WaveHindcast: a series of sea states over months or years, from a file or arrays."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
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
from seacrane.inputs.whole_file import size_of
from seacrane.operability.sea_states import MOST, NAMES, SI, UNITS, Times, read_sea_states
from seacrane.sea.mending import dates_of_numbers
from seacrane.sea.series_file import unit_of_words

if TYPE_CHECKING:
    import xarray

Flags = NDArray[np.bool_]
HOUR = np.timedelta64(1, "h")
MOST_STEPS, FEWEST_STEPS = 10_000_000, 500_000  # of any series, and of one with hardly any sea state
MOST_FILLED = 32  # times as many steps as sea states
STARTS = (b"CDF", b"\x89HDF")  # of NetCDF files


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
        for name, largest, unit in (("hs", MOST["hs"], "m"), ("tp", MOST["tp"], "s")):
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
    def load(
        cls, path: str | os.PathLike[str], *, names: Mapping[str, str] | None = None,
        units: Mapping[str, str] | None = None, utc_offset: float | None = None,
    ) -> WaveHindcast:  # fmt: skip
        """Read sea states: NetCDF of wavespectra, ERA5 or Copernicus, NDBC, Spotter, or any columns.

        Parameters
        ----------
        path : path
            A file of columns has a line of names with units, then a line for each time, which is a stamp, or
            counts from 1970, or is of digits such as 2020013112; date and time may stand in several columns.
            Cells end with a comma, a semicolon or a tab; with one of the latter, numbers may have a decimal
            comma. docs/operability.md lists the kinds that are told by what they look like.
        names : mapping of str to str, optional
            Names in the file of "time", "hs", "tp" and "direction", where they are others.
        units : mapping of str to str, optional
            Of "hs", "tp" and "direction" where the file does not say them, and of "date" "dd/mm/yyyy" or
            "mm/dd/yyyy".
        utc_offset : float, optional
            Hours that the file's clock is ahead of UTC, where the file does not say its zone.

        Returns
        -------
        WaveHindcast
            In UTC; `source` says what is not known, and whether times were moved onto even ones.

        Raises
        ------
        FileFormatError
            For a file that is damaged, has none of the names, or does not say a unit or a time zone.
        SceneError
            As for arrays, and for a keyword that makes no sense.
        """
        file = Path(path)
        for word, given, known in (("names", names, NAMES), ("units", units, {**UNITS, "date": ""})):
            if not isinstance(given or {}, Mapping):
                raise SceneError(f"hindcast: {word} is {shown(given)}; give texts by name, as of 'hs'")
            for name, one in (given or {}).items():
                text_of(f"hindcast: {word} of {name}", one)
                if name not in known:
                    raise SceneError(f"hindcast: {word} has {shown(name)}; choose from {', '.join(known)}")
        if not _is_netcdf(file):
            return cls(**read_sea_states(file, names or {}, units or {}, utc_offset))
        if utc_offset:
            raise SceneError(f"utc_offset is {shown(utc_offset)}, and times of {path} are UTC; leave it out")
        others = {name: (other,) for name, other in (names or {}).items()}
        asked = {name: others.get(name, usual) for name, usual in NAMES.items()}
        return _of_netcdf(file, asked, units or {})


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
    most = min(max(MOST_FILLED * time.size, FEWEST_STEPS), MOST_STEPS)
    if places[-1] >= most:
        raise SceneError(
            f"hindcast: {places[-1] + 1} steps of {step}, with {time.size} sea states, are more than {most}; "
            "give fewer"
        )
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


def _is_netcdf(path: Path) -> bool:
    size_of(path)  # raises for a device or a pipe
    with path.open("rb") as file:
        return file.read(4).startswith(STARTS)


def _of_netcdf(path: Path, names: Mapping[str, tuple[str, ...]], units: Mapping[str, str]) -> WaveHindcast:
    import xarray

    try:
        with (
            open_netcdf(path, fix="cut out the place and the years asked for"),
            xarray.open_dataset(path, decode_timedelta=False) as data,
        ):
            return WaveHindcast(**_of_dataset(data, names, units), source=path.name)
    except FileNotFoundError:
        raise
    except (FileFormatError, *NETCDF_ERRORS) as error:
        if isinstance(error, SceneError):
            raise
        raise FileFormatError(f"{path}: {error}") from error


def _of_dataset(
    data: xarray.Dataset, names: Mapping[str, tuple[str, ...]], units: Mapping[str, str]
) -> dict[str, Any]:
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
        factor = 1.0 if what == "direction" else _factor(what, units.get(what, variable.attrs.get("units")))
        out[key] = factor * np.asarray(variable.to_numpy(), dtype=float).reshape(-1)
    return out


def _factor(what: str, words: Any) -> float:
    """To m or s; a file that says no unit has that of its layout."""
    factor, unit = (1.0, UNITS[what]) if words is None else unit_of_words(str(words)) or (1.0, "")
    if unit != SI[UNITS[what]]:
        raise FileFormatError(f"{what} is in {shown(words)}; give units={{{what!r}: {UNITS[what]!r}}}")
    return factor
