"""A ship's six motions over time, from a measurement or from another program."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.curves import ramp_of, spline_curve
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import rows_of, text_of, texts_of, vector_of
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import listed
from seacrane.sea.measured_series import MeasuredSeries
from seacrane.sea.series_file import heading_of
from seacrane.warnings import AngleUnitWarning, NoisyMotionWarning, UnitWarning

COMPASS = ("heading", "hdg")
FEWEST = 6
BETWEEN = 8  # places looked at between two samples
LARGEST_SWING, SMALLEST_SWING = 0.5, 0.01  # beyond the samples, of their range; and m or rad
LARGEST_ANGLE = 0.6  # rad: a ship that rolls or pitches beyond is rather one in degrees
LARGEST_HEAVE = 30.0  # m: a ship that heaves beyond is rather one in centimetres
FASTEST = 2.0 * np.pi / 1.5  # rad/s: ships do not move faster
LARGEST_NOISE = 0.3  # m/s2 and, at an arm of 30 m, rad/s2: rms of what is faster
LEAST_SHARE = 0.1  # of the acceleration's energy, of what is faster
ARM = 30.0  # m


def _motions(what: str, names: Sequence[str]) -> list[str]:
    found = texts_of(what, names)
    unknown = [one for one in found if one not in MOTIONS]
    if unknown:
        raise SceneError.of(what, f"holds {listed(unknown)}; give some of {', '.join(MOTIONS)}")
    return found


def _require_units(path: str | PathLike[str], series: MeasuredSeries) -> None:
    for name, unit in series.units.items():
        due = "m" if MOTIONS.index(name) < 3 else "rad"
        if unit != due:
            raise FileFormatError(
                f"{fspath(path)}: column {series.headers[name]!r} is in {unit}, and {name} in {due} or a "
                f"unit of its kind; give the right column or unit: columns={{{name!r}: ...}}, "
                f"units={{{name!r}: ...}}"
            )


@named
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MotionHistory:
    """Six motions of a ship's reference point over time, as the channel `vessel_motion` records them.

    Parameters
    ----------
    time : array_like, shape (n,)
        s, increasing, from 0 or earlier on; at least 6.
    motion : array_like, shape (n, 6)
        Surge, sway, heave (m, from rest, along the ship's axes at rest) and roll, pitch, yaw (rad).
    record : str
        Where they come from and what was done to them, as `load` tells it; results hold it as `given_record`.

    Raises
    ------
    SceneError
        For another shape, too few samples, or times that do not increase or start later than 0.

    Warns
    -----
    AngleUnitWarning
        A roll or pitch beyond 0.6 rad (34 deg), which looks like degrees.
    UnitWarning
        A heave beyond 30 m, which looks like centimetres or millimetres.
    NoisyMotionWarning
        Accelerations of periods below 1.5 s that lines and cylinders would feel: noise of the measurement.
    """

    time: Any
    motion: Any
    record: str = ""

    def __repr__(self) -> str:
        most = np.abs(self.motion).max(axis=0)
        return (
            f"<MotionHistory: {self.time.size} samples, {self.time[0]:g} to {self.time[-1]:g} s, heave to "
            f"{most[2]:.3g} m, roll to {np.degrees(most[3]):.3g} deg, pitch to {np.degrees(most[4]):.3g} deg>"
        )

    def __post_init__(self) -> None:
        time = np.array(vector_of("motion history: time", self.time))
        motion = np.array(rows_of("motion history: motion", self.motion, 6))
        if time.size < FEWEST:
            raise SceneError.of("motion history: time", f"has {time.size} samples; give at least {FEWEST}")
        if motion.shape[0] != time.size:
            raise SceneError.of(
                "motion history: motion",
                f"has {motion.shape[0]} rows and time {time.size}; give one row for each time",
            )
        if not (np.isfinite(time).all() and np.isfinite(motion).all()):
            raise SceneError("motion history: holds a value that is not finite; leave such samples out")
        if np.any(np.diff(time) <= 0.0):
            at = int(np.argmax(np.diff(time) <= 0.0))
            raise SceneError.of(
                "motion history: time", f"is {time[at + 1]:.6g} s after {time[at]:.6g} s; times must increase"
            )
        if time[0] > 0.0:
            raise SceneError(
                f"motion history: time starts at {time[0]:.6g} s, and runs start at 0; subtract "
                f"{time[0]:.6g} s from it"
            )
        for key, array in (("time", time), ("motion", motion)):
            array.setflags(write=False)
            object.__setattr__(self, key, array)
        text_of("motion history: record", self.record)
        self._warn_of_units()
        self._warn_of_noise()

    @classmethod
    def load(
        cls, path: str | PathLike[str], *, zero: Sequence[str] = (), negated: Sequence[str] = (),
        columns: Mapping[str, str] | None = None, **reading: Any,
    ) -> MotionHistory:  # fmt: skip
        """Read the record of a motion sensor: a text file of columns with units, such as "roll [deg]".

        Its first sample is at 0. A column of heading is taken as yaw: from its mean, against the compass.

        Parameters
        ----------
        path : path
            CSV, TSV and the like (`docs/given-ships.md`).
        zero : sequence of str
            Motions that the file does not hold, which are zero: ("surge", "sway").
        negated : sequence of str
            Motions that the sensor counts with the other sign: positive here are heave up, roll that lifts
            the port side, pitch that lowers the bow, and yaw to port.
        columns : mapping of str to str, optional
            What the file calls "time" and motions whose names it has not.
        **reading
            Other keywords of `MeasuredSeries.load`, such as ``filter_hz=0.5, interval=0.25``.

        Returns
        -------
        MotionHistory
            `record` says what was done.

        Raises
        ------
        FileFormatError
            For what cannot be read, with line and column.
        SceneError
            For a keyword that makes no sense, or what no history may hold.
        OSError
            If the file cannot be opened.

        Warns
        -----
        FilledGapWarning, OutlierWarning, ClockDriftWarning, and those of a history
        """
        still, turned = _motions("zero", zero), _motions("negated", negated)
        if columns is not None and not isinstance(columns, Mapping):
            raise SceneError.of(
                "columns", "is no mapping; give the names in the file by those of the motions"
            )
        unknown = sorted(set(columns or {}) - {*MOTIONS, "time"})
        if unknown:
            raise SceneError(
                f"columns names {listed(unknown)}; give names for time and for {', '.join(MOTIONS)}"
            )
        usual = {name: ("yaw", *COMPASS) if name == "yaw" else name for name in MOTIONS if name not in still}
        series = MeasuredSeries.load(path, columns={**usual, **(columns or {})}, **reading)
        _require_units(path, series)
        motion = np.zeros((series.time.size, 6))
        told = [series.told]
        for name, values in series.columns.items():
            column = MOTIONS.index(name)
            motion[:, column] = values
            if name == "yaw" and set(COMPASS) & set(heading_of(0, series.headers[name]).name.split()):
                motion[:, column] = values.mean() - values
                mean = np.degrees(values.mean()) % 360.0
                told.append(f"yaw against the compass heading, from its mean of {mean:.1f} deg")
        motion[:, [MOTIONS.index(name) for name in turned]] *= -1.0
        told += [f"{', '.join(turned)} with the other sign"] * bool(turned)
        told += [f"{', '.join(still)} zero"] * bool(still)
        return cls(time=series.time - series.time[0], motion=motion, record="; ".join(told))

    def _warn_of_units(self) -> None:
        largest = np.abs(self.motion).max(axis=0)
        worst = 3 + int(largest[3:5].argmax())
        if largest[worst] > LARGEST_ANGLE:
            warn_caller(
                f"motion history: {MOTIONS[worst]} reaches {largest[worst]:.4g} rad, "
                f"{np.degrees(largest[worst]):.4g} deg; angles are radians: if these are degrees, give "
                "numpy.radians of roll, pitch and yaw",
                AngleUnitWarning,
            )
        if largest[2] > LARGEST_HEAVE:
            warn_caller(
                f"motion history: heave reaches {largest[2]:.4g} m, and no ship heaves by more than "
                f"{LARGEST_HEAVE:g} m; surge, sway and heave are metres from rest: cm or mm for m, or a "
                "height above another place?",
                UnitWarning,
            )

    def _warn_of_noise(self) -> None:
        """Loads follow the acceleration, in which noise of millimetres weighs as much as a ship's motion."""
        step = float(np.median(np.diff(self.time)))
        even = np.arange(self.time[0], self.time[-1], step)
        omega = 2.0 * np.pi * np.fft.rfftfreq(even.size, step)
        window = np.hanning(even.size)[:, None]
        motion = np.stack([np.interp(even, self.time, column) for column in self.motion.T], axis=1)
        trend = np.linspace(0.0, 1.0, even.size)[:, None]
        motion = motion - motion[:1] - trend * (motion[-1:] - motion[:1])
        spectrum = np.abs(np.fft.rfft(motion * window, axis=0)) ** 2 * omega[:, None] ** 4
        energy = 2.0 * spectrum / (even.size * np.square(window).sum())
        fast = energy[omega > FASTEST].sum(axis=0)
        rms = np.sqrt(fast) * [1.0, 1.0, 1.0, ARM, ARM, ARM]
        noisy = (rms > LARGEST_NOISE) & (fast > LEAST_SHARE * energy.sum(axis=0))
        if noisy.any():
            worst = int(np.argmax(np.where(noisy, rms, 0.0)))
            unit = "m/s2" if worst < 3 else "rad/s2"
            warn_caller(
                f"motion history: {MOTIONS[worst]} is shaken by {np.sqrt(fast[worst]):.3g} {unit} (rms) at "
                "periods below 1.5 s, which no ship has: noise of the measurement, which lines and cylinders "
                "feel as loads, or a time in another unit. Filter the record below 0.5 Hz: "
                "MotionHistory.load(path, filter_hz=0.5) does",
                NoisyMotionWarning,
            )

    def curves(self, ramp: float) -> tuple[_core.Curve, ...]:
        """Splines through the samples, of each motion; from rest over `ramp` (s) where it is not zero.

        Raises SceneError for samples so far apart that the spline swings out between them.
        """
        values = self.motion * ramp_of(self.time, ramp)[:, None]
        curves = tuple(spline_curve(times=self.time, values=column) for column in values.T)
        for name, curve, column in zip(MOTIONS, curves, values.T, strict=True):
            self._refuse_swings(name, curve, column)
        return curves

    def _refuse_swings(self, name: str, curve: _core.Curve, samples: Array) -> None:
        places = np.linspace(0.0, 1.0, BETWEEN, endpoint=False)
        fine = (self.time[:-1, None] + np.diff(self.time)[:, None] * places).ravel()
        values = curve.evaluate(fine)[:, 0]
        beyond = np.maximum(values - samples.max(), samples.min() - values)
        worst = int(beyond.argmax())
        if beyond[worst] > max(LARGEST_SWING * float(np.ptp(samples)), SMALLEST_SWING):
            raise SceneError(
                f"motion history: {name} would reach {values[worst]:.4g} at {fine[worst]:.6g} s, between "
                f"samples of {samples.min():.4g} to {samples.max():.4g}: they are too few there for a smooth "
                "curve; give at least eight in each period of the motion"
            )
