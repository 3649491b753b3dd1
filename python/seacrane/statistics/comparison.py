"""A run beside a record: what differs, in numbers, spectra and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.plotting.panel import Line, Panel, Sheet, draw
from seacrane.plotting.table import Answer, Column, Table, read_as
from seacrane.series.clock import step_of
from seacrane.statistics.spectrum import SpectrumEstimate, spectrum_estimate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
SEGMENTS = 7  # of the spectra: records are short
NAMES = ("mean (bias)", "standard deviation", "largest", "smallest", "RMS of the difference",
         "the same without bias")  # fmt: skip
HIGHEST = 0.999  # of the variance that a picture of spectra shows


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Comparison(Answer):
    """A run and a record at the same times. Made by `compare`; prints as a table, in kN and deg.

    Attributes
    ----------
    channel, column : str
        Of the run, and of the record.
    unit : str
        SI, of all values.
    source : str
        Where the record comes from and what was done to it.
    shift : float
        s by which the record is later than the run; it was moved back by that.
    correlation : float
        Of both, there.
    time : ndarray, shape (n,)
        Of the run, s; these are the record's samples.
    run, record : ndarray, shape (n,)
    """

    channel: str
    column: str
    unit: str
    source: str
    shift: float
    correlation: float
    time: Array
    run: Array
    record: Array

    def __post_init__(self) -> None:
        for values in (self.time, self.run, self.record):
            values.setflags(write=False)

    @property
    def difference(self) -> Array:
        """Run minus record, shape (n,)."""
        return np.asarray(self.run - self.record)

    @property
    def bias(self) -> float:
        """Mean of run minus record."""
        return float(self.difference.mean())

    @property
    def rms(self) -> float:
        """Root mean square of the difference, with the bias in it."""
        return float(np.sqrt(np.mean(self.difference**2)))

    @property
    def scatter(self) -> float:
        """Standard deviation of the difference: what is left of `rms` without the bias."""
        return float(self.difference.std())

    @property
    def gain(self) -> float:
        """Standard deviation of the run over that of the record."""
        return float(self.run.std() / self.record.std())

    def spectra(self) -> tuple[SpectrumEstimate, SpectrumEstimate]:
        """Of the run and of the record, by Welch's method.

        Raises
        ------
        SceneError
            For fewer than 64 samples, or a curve that does not vary.
        """
        step = step_of(self.time)
        grid = np.arange(self.time[0], self.time[-1] + 0.5 * step, step)
        even = [np.interp(grid, self.time, values) for values in (self.run, self.record)]
        first, second = (spectrum_estimate(values, interval=step, segments=SEGMENTS) for values in even)
        return first, second

    def plot(self) -> Figure:
        """Both curves over time, and their difference."""
        factor, unit = read_as(self.unit)
        both = (
            Line(label="run", values=factor * self.run),
            Line(label="record, moved", values=factor * self.record, colour=1),
        )
        left = (Line(label="", values=factor * self.difference, colour=6),)
        return draw(
            Sheet(
                title=self._caption(), caption=self.source, abscissa=self.time,
                panels=(
                    Panel(quantity=self.channel, unit=unit, lines=both),
                    Panel(quantity="run minus record", unit=unit, lines=left),
                ),
            ),
            note=self.source,
        )  # fmt: skip

    def plot_spectra(self) -> Figure:
        """Spectra of both, up to where 99.9 % of the variance is; raises as `spectra`."""
        factor, unit = read_as(self.unit)
        run, record = self.spectra()
        share = np.cumsum(run.density + record.density)
        shown = slice(0, int(np.searchsorted(share, HIGHEST * share[-1])) + 2)
        lines = tuple(
            Line(label=name, values=factor**2 * one.density[shown], colour=i)
            for i, (name, one) in enumerate((("run", run), ("record", record)))
        )
        return draw(
            Sheet(
                title=self._caption(), caption=self.source, abscissa=run.omega[shown],
                abscissa_name="omega", abscissa_unit="rad/s",
                panels=(Panel(quantity="spectrum", unit=f"({unit})2 s/rad", lines=lines),),
            ),
            note=self.source,
        )  # fmt: skip

    def _data(self) -> Table:
        names = ("run", "record", "difference")
        return Table(
            axes=[Column(name="time", values=self.time, unit="s")],
            columns=[Column(name=name, values=getattr(self, name), unit=self.unit) for name in names],
            attributes={"shift": self.shift, "source": self.source},
        )

    __repr__ = Answer.__str__

    def _shown(self) -> Table:
        run, record = (np.array(_figures(values)) for values in (self.run, self.record))
        apart = [*(run - record), self.rms, self.scatter]
        factor, unit = read_as(self.unit)
        extent = float(np.ptp(self.record))
        signs = ["+", "+", "+", "+", "", ""]

        def signed(values: Sequence[float], form: str) -> list[str]:
            return [f"{value:{sign}{form}}" for value, sign in zip(values, signs, strict=True)]

        share = signed([100.0 * one / extent for one in apart], ".2f") if extent > 0.0 else [""] * 6
        return Table(
            axes=[Column(values=NAMES)],
            columns=[
                Column(head="run", values=[*run, None, None], unit=self.unit, form=".5g"),
                Column(head="record", values=[*record, None, None], unit=self.unit, form=".5g"),
                Column(head="run - record", values=apart,
                       read=(unit, signed([factor * one for one in apart], ".4g"))),
                Column(head="% of the record's range", values=apart, read=("", share)),
            ],
            title=self._caption(), remarks=[self.source],
        )  # fmt: skip

    def _caption(self) -> str:
        later = "later" if self.shift >= 0.0 else "earlier"
        return (
            f"{self.channel} against {self.column}: {self.time.size} samples, the record "
            f"{abs(self.shift):.4g} s {later} than the run, correlation {self.correlation:.4f}"
        )


def _figures(values: Array) -> tuple[float, float, float, float]:
    return float(values.mean()), float(values.std()), float(values.max()), float(values.min())
