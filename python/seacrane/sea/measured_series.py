"""A measured series: columns over time in SI units, and what was done to them since they were read."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.checked import positive_of, text_of, vector_of
from seacrane.inputs.shown import listed, shown
from seacrane.plotting.table import Answer, Column, Table
from seacrane.sea.mending import ALIASED, BROKEN, is_even, low_passed, on_grid, share_above, step_of
from seacrane.sea.reading import FEWEST, Columns, read_series

MOST_FILLED = 32  # times as many samples as there are, of which the rest would be in gaps


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MeasuredSeries(Answer):
    """Columns over time, from a logger or from arrays; immutable, SI units and radians.

    Attributes
    ----------
    time : (n,) s, increasing; at least 8.
    columns : mapping of each name to its values (n,).
    units : mapping of each name to its SI unit.
    source : where they come from, such as the name of a file.
    done : what was done to them since, in words, in its order.
    headers : mapping of names to what the columns are called in their file.

    Raises
    ------
    SceneError : columns of another length, values that are not finite, or times that do not increase.
    """

    time: Array
    columns: Mapping[str, Array]
    units: Mapping[str, str]
    source: str = "arrays"
    done: tuple[str, ...] = ()
    headers: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        time = _checked("measured series: time", self.time)
        if time.size < FEWEST:
            raise SceneError(f"measured series: time has {time.size} samples; give at least {FEWEST}")
        if np.any(np.diff(time) <= 0.0):
            at = int(np.argmax(np.diff(time) <= 0.0))
            raise SceneError(
                f"measured series: time is {time[at + 1]:.6g} s after {time[at]:.6g} s; times must increase"
            )
        if not isinstance(self.columns, Mapping) or not self.columns:
            raise SceneError("measured series: columns is empty, or no mapping; give {name: values}")
        columns = {name: _checked(f"measured series: {name}", one) for name, one in self.columns.items()}
        for name, values in columns.items():
            if values.size != time.size:
                raise SceneError(
                    f"measured series: {name} has {values.size} values and time {time.size}; give as many"
                )
        units = {name: text_of(f"measured series: unit of {name}", self.units.get(name)) for name in columns}
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "columns", MappingProxyType(columns))
        object.__setattr__(self, "units", MappingProxyType(units))

    @classmethod
    def load(
        cls,
        path: str | os.PathLike[str],
        *,
        columns: Columns | None = None,
        units: Mapping[str, str] | None = None,
        after: float | None = None,
        before: float | None = None,
        maximum_gap: float = 0.0,
        drop_outliers: bool = False,
        rate_hz: float | None = None,
        filter_hz: float | None = None,
        interval: float | None = None,
    ) -> MeasuredSeries:
        """Read a text file of columns (CSV, TSV); its delimiter, header and units are found.

        Parameters
        ----------
        path : path
        columns : which columns to take, by the names in the header, or a mapping of the names here to those
            there, "time" among them: ``{"time": "GPS clock", "hook load": "HL main [t]"}``; a tuple of names:
            the first that is there. Default: all.
        units : by name, of columns without a unit in the header, or of those whose unit there is wrong.
        after, before : s of the file's own clock, from its first stamp where it has time stamps: what is
            earlier or later is left out.
        maximum_gap : s, the longest gap that is filled by a cubic spline; default 0: any gap is refused.
        drop_outliers : whether outliers are missing values, which `maximum_gap` lets be filled.
        rate_hz : at which the logger says that it samples: the clock is then compared with it.
        filter_hz : Hz, of a low-pass filter as `filtered` does it.
        interval : s between two values, as `resampled` does it. Default: as in the file.

        Returns
        -------
        MeasuredSeries : `done` says what was filled, filtered and resampled.

        Raises
        ------
        FileFormatError : what cannot be read: it names the file, the line and the column.
        SceneError : a keyword that makes no sense, or a name that the file does not hold.
        OSError : the file cannot be opened.

        Warns
        -----
        FilledGapWarning, OutlierWarning, ClockDriftWarning
        """
        read = read_series(
            Path(path), columns=columns, units=units, after=after, before=before, maximum_gap=maximum_gap,
            drop_outliers=drop_outliers, rate_hz=rate_hz,
        )  # fmt: skip
        found = cls(**read)
        if np.diff(found.time).max() > BROKEN * found.interval:  # a gap that was accepted
            found = found._even()
        found = found if filter_hz is None else found.filtered(filter_hz)
        return found if interval is None else found.resampled(interval)

    def __getitem__(self, name: str) -> Array:
        """The column of a name; the error lists those that are there."""
        if name not in self.columns:
            raise SceneError(
                f"measured series: no column {shown(name)}; it holds {listed(list(self.columns))}"
            )
        return self.columns[name]

    @property
    def interval(self) -> float:
        """s between two samples; of an uneven series the mean of all steps that are no gap."""
        return step_of(self.time)

    def filtered(self, filter_hz: float) -> MeasuredSeries:
        """Without what is faster than a frequency, Hz, and without lag.

        A Butterworth filter of fourth order runs in both directions over an even grid. Amplitudes are taken
        times about 1 / (1 + (f / filter_hz)^8): half at `filter_hz`, 0.4 % less at half of it. Ends are
        continued by their mirror image, turned about the end point: the first and last period of `filter_hz`
        are less sure.

        Raises
        ------
        SceneError : a frequency that is not between zero and half the sampling rate.
        """
        highest = 0.5 / self.interval
        if not 0.0 < (frequency := positive_of("filter_hz", filter_hz, "Hz")) < highest:
            raise SceneError(
                f"filter_hz is {frequency:g}, and the series has a sample each {self.interval:.4g} s, which "
                f"hold up to {highest:.4g} Hz; give less, or leave it out"
            )
        even = self._even()
        values = low_passed(even._table(), even.interval, frequency)
        words = f"low-pass at {frequency:g} Hz, Butterworth of order 4 in both directions"
        return even._with(even.time, values, words)

    def resampled(self, interval: float) -> MeasuredSeries:
        """At even times, `interval` (s) apart from the first on, by cubic splines.

        Raises
        ------
        SceneError : more than 1 % of a column's variance is faster than the new times can hold: filter it.
        """
        step, even = positive_of("interval", interval, "s"), self._even()
        fast = share_above(even._table(), even.interval, 0.5 / step) if step > even.interval else 0.0
        if fast > ALIASED:
            raise SceneError(
                f"interval is {step:g} s, and {fast:.1%} of a column's variance is faster than "
                f"{0.5 / step:.4g} Hz, which would turn into slow motion; give filter_hz={0.4 / step:.3g} or "
                "less with it"
            )
        time, values = on_grid(self.source, self.time, self._table(), step)
        return self._with(time, values, f"resampled to {step:g} s by cubic splines")

    def _data(self) -> Table:
        columns = [Column(name=n, values=v, unit=self.units[n]) for n, v in self.columns.items()]
        return Table(axes=[Column(name="time", values=self.time, unit="s")], columns=columns)

    @property
    def told(self) -> str:
        """In one line, for the notes of what is made of it."""
        return "; ".join([self.source, *self.done, f"{self.time.size} samples of {self.interval:.4g} s"])

    __repr__ = Answer.__str__

    def _shown(self) -> Table:
        """The ranges of its columns, and what was done to it."""
        every = self.columns.values()
        return Table(
            axes=[Column(head="column", values=list(self.columns))],
            columns=[
                Column(head="smallest", values=[float(values.min()) for values in every], form=".5g"),
                Column(head="largest", values=[float(values.max()) for values in every], form=".5g"),
                Column(head="unit", values=[self.units[name] for name in self.columns]),
            ],
            title=f"{self.source}: {self.time.size} samples from {self.time[0]:.6g} to {self.time[-1]:.6g} s",
            remarks=self.done,
        )  # fmt: skip

    def _table(self) -> Array:
        """Shape (n, columns)."""
        return np.stack(list(self.columns.values()), axis=1)

    def _even(self) -> MeasuredSeries:
        if is_even(self.time):
            return self
        step = self.interval
        most = MOST_FILLED * self.time.size
        time, values = on_grid(self.source, self.time, self._table(), step, most=most)
        return self._with(time, values, f"put on even times of {step:.6g} s by cubic splines")

    def _with(self, time: Array, values: Array, words: str) -> MeasuredSeries:
        columns = dict(zip(self.columns, values.T, strict=True))
        return replace(self, time=time, columns=columns, done=(*self.done, words))


def _checked(what: str, values: Any) -> Array:
    array = np.array(vector_of(what, values))
    if not np.isfinite(array).all():
        at = int(np.argmin(np.isfinite(array)))
        raise SceneError(f"{what}[{at}] is {array[at]}; give finite numbers: leave such samples out")
    array.setflags(write=False)
    return array
