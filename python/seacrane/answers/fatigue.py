"""Fatigue of wires, slings and fastenings: rainflow with Miner's sum, and damage of a spectrum beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.pick import pick_of
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import numbers_of, positive_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.plotting.table import Rows, Table
from seacrane.result import Result
from seacrane.run.channel_names import unit_in
from seacrane.statistics.record import FEWEST_VALUES, ROUNDING, SpectrumEstimate, spectrum_estimate
from seacrane.warnings import UnitWarning

UNVERIFIED = "unverified"
FEW = 10.0  # outputs in a mean cycle, below which ranges are too small
HIDDEN = 0.05  # of the range of the steps, which the outputs may leave out
USUAL_CYCLES = (1.0, 1e20)  # that a curve bears of the largest range: one is there, more wear nothing
NAN = float("nan")


@named
@dataclass(frozen=True, kw_only=True)
class FatigueCurve:
    """Cycles to failure over the range: N = constant (range / scale)^-slope.

    Attributes
    ----------
    constant, slope : float
        K and m of the curve, ranges being counted over `scale`.
    scale : float
        In the unit of the channel: the breaking load of a rope, whose curve is over R = range / MBL, or the
        area of a section, N / (N/m2), whose curve is over stress in Pa. Default 1.
    source : str
        The standard, its edition and its curve. Without it the curve is told as unverified.

    Raises
    ------
    SceneError
        For numbers that are not above zero.
    """

    constant: float
    slope: float
    scale: float = 1.0
    source: str = UNVERIFIED

    def __post_init__(self) -> None:
        for name in ("constant", "slope", "scale"):
            positive_of(f"fatigue curve: {name}", getattr(self, name))
        object.__setattr__(self, "source", text_of("fatigue curve: source", self.source) or UNVERIFIED)

    def damage(self, ranges: Any, counts: Any = 1.0) -> float:
        """Miner's sum of so many cycles of ranges in the unit of the channel."""
        over = np.asarray(ranges, dtype=float) / self.scale
        return float(np.sum(counts * over**self.slope) / self.constant)


def rainflow(values: Any) -> Array:
    """Count cycles by rainflow, as ASTM E1049-85 (5.4.4) does.

    Parameters
    ----------
    values : array_like, shape (n,)
        A record, any unit.

    Returns
    -------
    ndarray, shape (k, 3)
        Range, mean and count, 0.5 or 1, of each cycle in the order in which it closes, then the half cycles
        that stay open.

    Raises
    ------
    SceneError
        For something else than a row of finite numbers.
    """
    found: list[tuple[float, float, float]] = []
    stack: list[float] = []
    for value in _turns(values).tolist():
        stack.append(value)
        while len(stack) > 2 and abs(stack[-1] - stack[-2]) >= abs(stack[-2] - stack[-3]):
            first, second = stack[-3], stack[-2]
            whole = len(stack) > 3  # else its range holds the start of the record
            found.append((abs(second - first), 0.5 * (first + second), 1.0 if whole else 0.5))
            del stack[-3 : -1 if whole else -2]
    found += [(abs(b - a), 0.5 * (a + b), 0.5) for a, b in pairwise(stack)]
    return np.array(found).reshape(-1, 3)


def _turns(values: Any) -> Array:
    """Peaks and valleys of a record, its ends too."""
    record = numbers_of("rainflow: values", values)
    if record.ndim != 1 or not np.all(np.isfinite(record)):
        raise SceneError(f"rainflow: values is {shown(values)}; give one row of finite numbers")
    least = ROUNDING * np.abs(record).max(initial=0.0)
    moved = record[np.concatenate([[True], np.abs(np.diff(record)) > least])] if record.size else record
    rising = np.diff(moved) > 0.0
    ends = np.full(min(moved.size, 1), True)
    inside = rising[1:] != rising[:-1]
    return np.asarray(moved[np.concatenate([ends, inside, ends[: moved.size - 1]])])


def narrow_band_rate(spectrum: SpectrumEstimate, curve: FatigueCurve) -> float:
    """Damage in a second of a Gaussian process whose ranges are Rayleigh's, one for each up-crossing."""
    from scipy.special import gamma

    mean = (2.0 * np.sqrt(2.0) * spectrum.std / curve.scale) ** curve.slope * gamma(1.0 + 0.5 * curve.slope)
    return float(spectrum.crossing_rate * mean / curve.constant)


def dirlik_rate(spectrum: SpectrumEstimate, curve: FatigueCurve) -> float:
    """Damage in a second of a Gaussian process of any bandwidth by Dirlik's distribution of rainflow ranges.

    Dirlik (1985), as quoted by others: an exponential and two Rayleigh densities over range / (2 std), their
    weights and scales by the moments m0, m1, m2 and m4.
    """
    from scipy.special import gamma

    m0, m1, m2, m4 = (spectrum.moment(order) for order in (0, 1, 2, 4))
    peaks, irregular = np.sqrt(m4 / m2) / (2.0 * np.pi), m2 / np.sqrt(m0 * m4)
    middle = m1 / m0 * np.sqrt(m2 / m4)
    d1 = 2.0 * (middle - irregular**2) / (1.0 + irregular**2)
    r = (irregular - middle - d1**2) / (1.0 - irregular - d1 + d1**2)
    d2 = (1.0 - irregular - d1 + d1**2) / (1.0 - r)
    d3 = 1.0 - d1 - d2
    q = 1.25 * (irregular - d3 - d2 * r) / d1
    m = curve.slope
    rayleigh = np.sqrt(2.0) ** m * gamma(1.0 + 0.5 * m) * (d2 * abs(r) ** m + d3)
    moment = (2.0 * np.sqrt(m0) / curve.scale) ** m * (d1 * q**m * gamma(1.0 + m) + rayleigh)
    return float(peaks * moment / curve.constant)


@dataclass(frozen=True, kw_only=True)
class FatigueRow:
    """Fatigue of one channel.

    Attributes
    ----------
    name : The channel with its names.
    cycles, largest : Counted in the record, and the largest range, in the unit of the channel.
    rainflow, narrow_band, dirlik : Damage in an hour; by the spectrum as of a Gaussian process.
    life : Hours until Miner's sum of the rainflow is 1.
    zero : Share of the outputs at which it is zero, as a slack wire is.
    source : Of the curve.

    Numbers that are not known are NaN.
    """

    name: str = ""
    cycles: float = NAN
    largest: float = NAN
    unit: str = ""
    rainflow: float = NAN
    narrow_band: float = NAN
    dirlik: float = NAN
    life: float = NAN
    zero: float = NAN
    source: str = ""


@dataclass(frozen=True, kw_only=True, repr=False)
class Fatigue(Rows[FatigueRow]):
    """Damage by channel. Made by `fatigue`; prints as a table.

    Attributes
    ----------
    rows : tuple of FatigueRow
    duration : float
        Of the record, s.
    coarse : tuple of str
        Channels with fewer than 10 outputs in a mean cycle, or with peaks between outputs: their ranges are
        too small.
    told : tuple of str
        What cannot be judged, is slack, or does not vary.
    """

    duration: float
    coarse: tuple[str, ...]
    told: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Fatigue: {len(self)} channels, {self.duration:g} s>"

    def _shown(self) -> Table:
        remarks = [*self.told, "No safety factor, and no mean: a range counts alike at any mean tension."]
        if any(row.zero > 0.0 for row in self.rows):
            remarks.append("At zero, as a slack wire is: cycles go down to it, and spectra do not know it.")
        if self.coarse:
            remarks.append(f"Too few outputs for their cycles: {', '.join(self.coarse)}; shorten dt_out.")
        return Table(
            axes=[self.names("channel")],
            columns=[
                self.column("cycles", form=".1f"),
                self.column("largest", head="largest range"), self.column("unit", head=""),
                self.column("rainflow", head="damage in 1 h", unit="1/h", form=".3g"),
                self.column("narrow_band", head="narrow band", unit="1/h", form=".3g"),
                self.column("dirlik", head="Dirlik", unit="1/h", form=".3g"),
                self.column("life", unit="h", form=".3g"), self.column("zero", head="at zero", form=".0%"),
                self.column("source", head="curve"),
            ],
            title=f"Fatigue by {self.duration:g} s", remarks=remarks,
        )  # fmt: skip


@named
def fatigue(result: Result, *, curves: Mapping[str, FatigueCurve], after: float = 0.0) -> Fatigue:
    """Damage of wires, slings and fastenings in a run: rainflow with Miner's sum, and spectral beside it.

    A slack wire has the tension zero, to which cycles go down. A channel that is no number at some output, as
    in stages without what it is of, is not judged, and is told; the others are.

    Parameters
    ----------
    curves : mapping of str to FatigueCurve
        By a channel with its names, such as "line_tension[hoist]".
    after : float
        s: earlier outputs are left out.

    Raises
    ------
    SceneError
        For a channel that is not there, or a record that is too short for a spectrum.

    Warns
    -----
    UnitWarning
        For a curve that bears the largest range less than once, or more than 1e20 times.
    """
    if not isinstance(curves, Mapping) or not curves:
        raise SceneError(
            f"fatigue: curves is {shown(curves)}; give {{'line_tension[hoist]': FatigueCurve(...)}}"
        )
    part = result.part(after=after)
    count = part.stop - part.start
    if count < FEWEST_VALUES:
        raise SceneError(
            f"fatigue: {count} outputs after {after} s, and a spectrum takes {FEWEST_VALUES}; give an "
            "earlier after, a longer run, or a shorter dt_out"
        )
    time = np.asarray(result.time)[part]
    duration = float(time[-1] - time[0])
    rows: list[FatigueRow] = []
    coarse: list[str] = []
    told: list[str] = []
    for name, curve in curves.items():
        if not isinstance(curve, FatigueCurve):
            raise SceneError(f"fatigue: {name} is {shown(curve)}; give a FatigueCurve")
        pick = pick_of("fatigue", name)
        values = np.asarray(result.curve(name))[part]
        unit = unit_in(result.scene, pick)
        gaps = float(np.mean(~np.isfinite(values)))
        if gaps:
            told.append(f"{name} is NOT JUDGED: it is no number at {gaps:.0%} of the outputs; leave them out")
            rows.append(FatigueRow(name=name, unit=unit, source=curve.source))
            continue
        row, rate = _row_of(values, duration, curve)
        rows.append(replace(row, name=name, unit=unit, zero=float(np.mean(values == 0.0))))
        told += _slip(rows[-1], curve)
        least, largest = result.reached(name, part=part)
        if hides_peaks(values, least, largest) or time.size < FEW * rate * duration:
            coarse.append(name)
        elif not rate:
            told.append(f"{name} is {values[0]:g} {unit} throughout: it does not wear")
    return Fatigue(rows=tuple(rows), duration=duration, coarse=tuple(coarse), told=tuple(told))


def hides_peaks(values: Array, least: Array, largest: Array) -> bool:
    """Whether outputs leave out more of the range of the steps between them than they may."""
    return bool(np.ptp(values) < (1.0 - HIDDEN) * (largest.max() - least.min()))


def _inverse(damage: float) -> float:
    return 1.0 / damage if damage else float("inf")


def _slip(row: FatigueRow, curve: FatigueCurve) -> list[str]:
    """What a curve in another unit makes: told, and a warning."""
    least, most = USUAL_CYCLES
    borne = _inverse(curve.damage(row.largest))
    if not row.largest or least <= borne <= most:
        return []
    told = (
        f"{row.name}: the curve bears the largest range, {row.largest / curve.scale:.4g} over its scale, "
        f"{borne:.3g} times: a slip in a unit? A curve over stress is over Pa: give a constant over MPa "
        "times 1e6^slope"
    )
    warn_caller(f"fatigue: {told}", UnitWarning)
    return [told]


def _row_of(values: Array, duration: float, curve: FatigueCurve) -> tuple[FatigueRow, float]:
    """The numbers of a record, and how often its spectrum crosses the mean, 1/s; 0 where it does not vary."""
    if np.ptp(values) <= ROUNDING * np.abs(values).max():
        still = FatigueRow(cycles=0.0, largest=0.0, rainflow=0.0, life=float("inf"), source=curve.source)
        return still, 0.0
    cycles = rainflow(values)
    spectrum = spectrum_estimate(values, interval=duration / (values.size - 1))
    hourly = 3600.0 * curve.damage(cycles[:, 0], cycles[:, 2]) / duration
    row = FatigueRow(
        cycles=float(cycles[:, 2].sum()), largest=float(cycles[:, 0].max()), rainflow=hourly,
        narrow_band=3600.0 * narrow_band_rate(spectrum, curve), dirlik=3600.0 * dirlik_rate(spectrum, curve),
        life=_inverse(hourly), source=curve.source,
    )  # fmt: skip
    return row, spectrum.crossing_rate
