"""Poses of all bodies at even times, such that cubic curves between them follow the run, packed as text."""

from __future__ import annotations

import base64
import gzip
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.result import Result

POSES = ("position", "quaternion", "velocity", "angular_velocity")
STEPS = {"position": 1e-4, "quaternion": 1e-6, "velocity": 1e-3, "angular_velocity": 1e-5}  # m, 1, m/s, rad/s
INTERVALS = (0.2, 0.1)  # s, coarse first
LARGEST_ERROR = (0.01, 2e-3)  # m, rad: beyond these the finer interval is taken
LARGEST_COUNT = 2**28  # steps that a rounded value may be from zero: second differences then fit 32 bits


@dataclass
class Blob:
    """Arrays one after another, and where each is; `text` is what the page holds.

    Of a series, rows are what changes and columns are times. Its values are whole numbers of `step`, stored
    as second differences along the times, which are small, byte by byte of equal weight, which gzip likes.
    """

    parts: list[bytes] = field(default_factory=list)
    size: int = 0

    def series(self, values: Any, step: float) -> dict[str, Any]:
        """Add values (rows, times); each comes back within half a step. A step too fine for 32 bits grows."""
        rows = np.asarray(values, dtype=float)
        step = usable_step(rows, step)
        counts = np.rint(rows / step).astype(np.int64)
        second = np.diff(counts, n=2, axis=1, prepend=np.zeros((len(rows), 2), np.int64))
        folded = np.where(second >= 0, 2 * second, -2 * second - 1).astype("<u4")
        data = folded.reshape(-1).view(np.uint8).reshape(-1, 4).T.tobytes()
        return {**self._add(data), "shape": list(rows.shape), "step": step}

    def plain(self, values: Any) -> dict[str, Any]:
        """Add values as they are, in single precision, or as indices if they are whole."""
        array = np.asarray(values)
        array = array.astype("<u4" if array.dtype.kind in "iu" else "<f4")
        return {**self._add(array.tobytes()), "shape": list(array.shape)}

    def _add(self, data: bytes) -> dict[str, Any]:
        at = self.size
        self.parts.append(data)
        self.size += len(data)
        return {"at": at}

    def text(self) -> str:
        """All of it; the same values make the same text."""
        return base64.b64encode(gzip.compress(b"".join(self.parts), compresslevel=6, mtime=0)).decode("ascii")


def usable_step(values: Array, step: float) -> float:
    """The step, or the finest with which the values fit."""
    largest = float(np.abs(values).max(initial=0.0))
    return max(step, largest / LARGEST_COUNT)


def rounded(values: Any, step: float) -> Array:
    """What the page reads of a series."""
    array = np.asarray(values, dtype=float)
    step = usable_step(array, step)
    return np.asarray(np.rint(array / step) * step)


@dataclass(frozen=True, kw_only=True, eq=False)
class Motion:
    """Poses and twists of bodies at even times.

    From `start` on every `interval` (s): of centres of mass, as in a result, (frames, bodies, 3 or 4),
    rounded to `STEPS`; `error` is the largest distance (m) and angle (rad) from the run's outputs.
    """

    start: float
    interval: float
    bodies: tuple[str, ...]
    position: Array
    quaternion: Array
    velocity: Array
    angular_velocity: Array
    error: tuple[float, float] = (0.0, 0.0)

    @property
    def times(self) -> Array:
        """s, of the frames."""
        return np.asarray(self.start + self.interval * np.arange(len(self.position)), dtype=np.float64)

    @property
    def end(self) -> float:
        """s."""
        return float(self.times[-1])

    def series(self, blob: Blob) -> dict[str, Any]:
        """For the page, by what they are."""
        return {
            name: blob.series(getattr(self, name).reshape(len(self.position), -1).T, step)
            for name, step in STEPS.items()
        }

    def at(self, times: Any) -> tuple[Array, Array]:
        """Positions (n, bodies, 3), m, and unit quaternions (n, bodies, 4) at times within the run, s."""
        at = np.asarray(times, dtype=float)
        return poses_between(at, self.times, *(getattr(self, name) for name in POSES))


def motion_of(result: Result) -> Motion:
    """The motion of a result, at 5 Hz where that keeps to `LARGEST_ERROR`, else at 10 Hz, or as recorded.

    Raises SceneError if the result holds no poses, or none that are finite.
    """
    missing = [name for name in POSES if name not in result.channels]
    if missing:
        raise SceneError(
            f"view: result of {result.stats['scene']!r} does not hold {', '.join(missing)}; to be seen it "
            f"needs {', '.join(POSES)}: leave channels= out of the run, or add these to it"
        )
    channels = {name: result[name] for name in POSES}
    good = np.all([np.isfinite(array).all(axis=(1, 2)) for array in channels.values()], axis=0)
    if not good.any():
        raise SceneError(f"view: result of {result.stats['scene']!r} holds no pose that is finite")
    time = result.time[good]
    channels = {name: array[good] for name, array in channels.items()}
    spacing = float(np.median(np.diff(time))) if len(time) > 1 else INTERVALS[0]
    for interval in INTERVALS:
        motion = _sampled(time, channels, result.coords["body"], max(interval, spacing))
        if all(np.less_equal(motion.error, LARGEST_ERROR)):
            break
    return motion


def _sampled(time: Array, channels: dict[str, Array], bodies: Sequence[str], interval: float) -> Motion:
    """Frames about so far apart, from the first output to the last."""
    span = float(time[-1] - time[0])
    frames = max(1, round(span / interval)) + 1
    step = span / (frames - 1) if span > 0.0 else interval
    at = np.minimum(time[0] + step * np.arange(frames), time[-1])
    position, quaternion = poses_between(at, time, *(channels[name] for name in POSES))
    speeds = (_linear(at, time, channels[name]) for name in POSES[2:])
    values = dict(zip(POSES, (position, quaternion, *speeds), strict=True))
    kept: dict[str, Any] = {name: rounded(value, STEPS[name]) for name, value in values.items()}
    motion = Motion(start=float(time[0]), interval=step, bodies=tuple(bodies), **kept)
    found, turned = motion.at(np.minimum(time, motion.end))
    distance = float(np.linalg.norm(found - channels["position"], axis=-1).max(initial=0.0))
    ways = (sign * channels["quaternion"] for sign in (1.0, -1.0))
    chord = np.minimum(*(np.linalg.norm(turned - way, axis=-1) for way in ways))
    angle = float(4.0 * np.arcsin(np.clip(chord.max(initial=0.0) / 2.0, 0.0, 1.0)))
    return replace(motion, error=(distance, angle))


def poses_between(
    times: Array, knots: Array, position: Array, quaternion: Array, velocity: Array, angular_velocity: Array
) -> tuple[Array, Array]:
    """Cubic Hermite curves through poses with their rates; quaternions component by component, made unit."""
    turn = hermite(times, knots, quaternion, quaternion_rate(quaternion, angular_velocity))
    return hermite(times, knots, position, velocity), turn / np.linalg.norm(turn, axis=-1, keepdims=True)


def quaternion_rate(quaternion: Array, angular_velocity: Array) -> Array:
    """(..., 4): half the product of (0, w) and q, with w in inertial axes."""
    w, v = quaternion[..., :1], quaternion[..., 1:]
    scalar = -np.sum(angular_velocity * v, axis=-1, keepdims=True)
    vector = w * angular_velocity + np.cross(angular_velocity, v)
    return np.asarray(0.5 * np.concatenate([scalar, vector], axis=-1))


def hermite(times: Array, knots: Array, values: Array, rates: Array) -> Array:
    """Values (n, ...) at times within the knots, from values and rates at the knots."""
    if len(knots) == 1:
        return np.repeat(values, len(times), axis=0)
    from scipy.interpolate import CubicHermiteSpline

    return np.asarray(CubicHermiteSpline(knots, values, rates)(times))


def _linear(times: Array, knots: Array, values: Array) -> Array:
    if len(knots) == 1:
        return np.repeat(values, len(times), axis=0)
    i = np.clip(np.searchsorted(knots, times, side="right") - 1, 0, len(knots) - 2)
    u = ((times - knots[i]) / (knots[i + 1] - knots[i]))[:, *(None,) * (values.ndim - 1)]
    return np.asarray((1 - u) * values[i] + u * values[i + 1])


def linear_rows(motion: Motion, time: Array, values: Array) -> Array:
    """Any recorded values (n, ...) at the frames, as rows (k, frames), with what is not finite as zero."""
    rows = np.nan_to_num(_linear(np.minimum(motion.times, time[-1]), time, values), posinf=0.0, neginf=0.0)
    return np.asarray(rows.reshape(len(rows), -1).T)
