"""Result files that grow while a run goes on."""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import shutil
import signal
import threading
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.result.atomic import atomic_write, space_left
from seacrane.result.channels import attributes
from seacrane.result.netcdf import add_events
from seacrane.result.result import checked_stats

if TYPE_CHECKING:
    from seacrane.result.events import Event
    from seacrane.result.result import Result

Array = NDArray[np.float64]
LARGEST_PIECE = 2**21  # bytes: what Ctrl-C may have to wait for
MOST_ROWS, LEAST_ROWS = 4096, 16
MARGIN = 2**18  # bytes, beyond the numbers themselves, for what the NetCDF library writes about them
TURNING = "slew_angle"  # counted on over whole turns, which one piece does not know of
COUNTERS = ("wall_s", "evaluations", "fast_evaluations", "steps", "rejected_steps", "jacobians",
            "newton_iterations", "projections", "restarts", "dense_solves")  # fmt: skip


def partial_path(path: Path) -> Path:
    """Where a result is while its run goes on."""
    return path.with_name(f"{path.stem}.partial{path.suffix}")


class ResultFile:
    """A result on disk to which outputs are added; between two additions it is closed and whole.

    It has the name of `partial_path` until `finish` gives it its own.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.draft = partial_path(path)
        self.outputs = 0
        self.rows = MOST_ROWS
        self._last_angle: float | None = None
        self._events = self._events_of_run = 0
        self._before: Mapping[str, Any] = {}
        self.stats: dict[str, Any] = {}

    def create(self) -> None:
        """Take the place of the file; raises FileExistsError if a run that was killed left one there."""
        if not self.path.parent.is_dir():
            raise OSError(
                f"could not write {self.path}: there is no folder {self.path.parent}; create it first"
            )
        if self.draft.exists():
            raise FileExistsError(
                f"{self.draft} is there from a run that was killed, or still goes on: resume it, or move it"
            )

    def first_output(self) -> float:
        """Time of the first output of what a run that stopped left, s."""
        return float(self._left()[0][0])

    def reopen(self, until: float, settings: Mapping[str, Any]) -> None:
        """Go on in the file of a run that stopped, after its outputs until a time (s).

        Raises
        ------
        FileFormatError
            If it is the file of a run with other settings (of a result's `stats`; t_end may differ).
        """
        times, self._before, angles, events = self._left()
        old, new = (
            json.loads(stats["settings"]) for stats in (self._before, {"settings": json.dumps(settings)})
        )
        for name in sorted({*old, *new} - {"t_end"}):
            if old.get(name) != new.get(name):
                raise FileFormatError(
                    f"{self.path} has {name} {old.get(name)!r}, this run {new.get(name)!r}: give the "
                    "settings of the run that stopped"
                )
        self.outputs = int(np.searchsorted(times, until, "right"))
        self._events = int(np.searchsorted(events, until, "right"))
        if angles is not None and self.outputs:
            self._last_angle = float(angles[self.outputs - 1])
        if not self.draft.exists():
            self.path.replace(self.draft)

    def _left(self) -> tuple[Array, dict[str, Any], Array | None, Array]:
        """Times, attributes, turning angle and times of events in what a run left."""
        import netCDF4

        source = self.draft if self.draft.exists() else self.path
        if not source.is_file():
            raise FileNotFoundError(f"no result file {self.path} to go on with")
        try:
            with netCDF4.Dataset(source, "r") as file:
                file.set_auto_mask(False)
                times = np.asarray(file["time"][:])
                attributes = {name: file.getncattr(name) for name in file.ncattrs()}
                attributes["settings"]
                if not file.dimensions["time"].isunlimited():
                    raise ValueError("its outputs were written all at once")
                self.rows = int(file["time"].chunking()[0])
                angles = file[TURNING][:] if TURNING in file.variables else None
                events = file["event_time"][:] if "event_time" in file.variables else np.empty(0)
        except (OSError, RuntimeError, LookupError, TypeError, ValueError) as error:
            raise FileFormatError(f"{source} is not a result that a run left: {error}") from error
        times = times[np.isfinite(times)]
        if not times.size:
            raise FileFormatError(f"{source} holds no outputs; start the run anew")
        return times, attributes, angles, events

    def append(self, piece: Result, *, interrupted: bool) -> None:
        """Add the outputs of a result.

        Raises
        ------
        OSError
            If the disk has no room for them; the file then is as it was before.
        """
        with _whole(), self._named_errors():
            if not self.draft.exists():
                self._define(piece)
            else:
                _reserve(self.draft, 8 * sum(array.size for array in piece.channels.values()))
            with _dataset(self.draft) as file:
                rows = slice(self.outputs, self.outputs + piece.time.size)
                for name, values in piece.channels.items():
                    file[name][rows] = self._continued(values) if name == TURNING else values
                file["time"][rows] = piece.time  # last: outputs without a time do not count
                self._add_events(file, piece.events)
                file.setncatts(self._stats(piece.stats, interrupted))
        if TURNING in piece.channels:
            self._last_angle = float(self._continued(piece.channels[TURNING])[-1])
        self.outputs += piece.time.size

    def describe(self, stats: Mapping[str, Any], events: Sequence[Event], *, interrupted: bool) -> None:
        """Bring counters and events up to date."""
        with _whole(), self._named_errors():
            _reserve(self.draft, 0)
            with _dataset(self.draft) as file:
                self._add_events(file, events)
                file.setncatts(self._stats(checked_stats(stats), interrupted))

    def sync(self) -> None:
        """Have the disk hold what has been written."""
        with self.draft.open("rb+") as file:
            os.fsync(file.fileno())

    def finish(self) -> None:
        """Give the file its own name; nothing if there is none."""
        if self.draft.exists():
            self.sync()
            self.draft.replace(self.path)

    def _define(self, piece: Result) -> None:
        import netCDF4

        width = sum(array[0].size for array in piece.channels.values())
        self.rows = max(LEAST_ROWS, min(MOST_ROWS, LARGEST_PIECE // (8 * max(width, 1))))
        try:
            with netCDF4.Dataset(self.draft, "w", format="NETCDF4") as file:
                file.createDimension("time", None)
                file.createVariable("time", "f8", ("time",), chunksizes=(self.rows,), fill_value=np.nan)
                for dim, names in piece.coords.items():
                    file.createDimension(dim, len(names))
                    file.createVariable(dim, str, (dim,))[:] = np.array(names, dtype=object)
                for name, array in piece.channels.items():
                    chunks = (self.rows, *array.shape[1:])
                    file.createVariable(name, "f8", piece.dims[name], compression="zlib", complevel=1,
                                        chunksizes=chunks, fill_value=np.nan)  # fmt: skip
                for name in ("time", *piece.channels):
                    file[name].setncatts(attributes(name))
            _reserve(self.draft, 8 * (width + 1) * piece.time.size)
        except BaseException:
            self.draft.unlink(missing_ok=True)
            raise

    def _add_events(self, file: Any, events: Sequence[Event]) -> None:
        """Those of this run's events that are not in the file yet."""
        new = events[self._events_of_run :]
        if new:
            add_events(file, new, self._events)
            self._events += len(new)
            self._events_of_run = len(events)

    def _stats(self, stats: Mapping[str, Any], interrupted: bool) -> dict[str, Any]:
        """Of all pieces of the run: counters and simulated time of the one before are added."""
        out = {**stats, "interrupted": int(interrupted)}
        for name in ("simulated_s", *COUNTERS):
            if name in self._before and name in stats:
                out[name] = stats[name] + self._before[name]
        lines = [*self._before.get("validity", "").splitlines(), *stats.get("validity", "").splitlines()]
        if lines:
            out["validity"] = "\n".join(dict.fromkeys(lines))
        if "events" in stats:
            out["events"] = self._events
        self.stats = {name: value for name, value in out.items() if name != "interrupted"}
        return out

    def _continued(self, angle: Array) -> Array:
        if self._last_angle is None:
            return angle
        turn = 2.0 * np.pi
        continued: Array = angle + turn * np.round((self._last_angle - angle[0]) / turn)
        return continued

    @contextlib.contextmanager
    def _named_errors(self) -> Iterator[None]:
        try:
            yield
        except (
            OSError,
            RuntimeError,
        ) as error:  # the HDF5 library's failures to write arrive as RuntimeError
            raise OSError(
                f"could not write {self.path}: {error}{space_left(self.path.parent)}; the outputs until then "
                "are kept there"
            ) from error


@contextlib.contextmanager
def _dataset(path: Path) -> Iterator[Any]:
    import netCDF4

    for attempts_left in reversed(range(5)):
        _leave_to_readers(path)
        try:
            file = netCDF4.Dataset(path, "a")
            break
        except OSError:
            if not attempts_left:
                raise
    with file:
        yield file


def _leave_to_readers(path: Path) -> None:
    """A program that reads a NetCDF file locks it: it keeps that file, and the run goes on in a copy."""
    with path.open("rb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            with atomic_write(path) as draft:
                shutil.copyfile(path, draft)


def _reserve(path: Path, size: int) -> None:
    """Have the disk promise room for so many bytes more: without, the NetCDF library leaves a torn file."""
    if not hasattr(os, "posix_fallocate"):
        return
    with path.open("rb+") as file:
        end = file.seek(0, os.SEEK_END)
        try:
            os.posix_fallocate(file.fileno(), end, size + MARGIN)
        except OSError:
            file.truncate(end)
            raise


@contextlib.contextmanager
def _whole() -> Iterator[None]:
    """Holds Ctrl-C back until the block is done."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    pressed: list[int] = []
    before = signal.getsignal(signal.SIGINT)
    if before is None:  # set by another program: not ours to replace
        yield
        return
    signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if pressed:
            signal.raise_signal(signal.SIGINT)
