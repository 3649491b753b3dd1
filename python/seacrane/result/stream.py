"""Results that grow on disk during a run."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, channel_of
from seacrane.errors import FileFormatError
from seacrane.inputs.atomic import atomic_write, require_replaceable, space_left
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.inputs.state import state_to_bytes
from seacrane.result.about import About, parted
from seacrane.result.events import Event
from seacrane.result.partial_file import PartialFile, Piece, partial_path
from seacrane.result.result import Result
from seacrane.result.result_file import rows_of_chunk, write_netcdf

Array = NDArray[np.float64]
LARGEST_PIECE = 2**21  # bytes
LARGEST = 2**50  # bytes: a file without end is read piece by piece
MOST_ROWS, LEAST_ROWS = 4096, 16
COUNTERS = ("wall_s", "evaluations", "steps", "rejected_steps", "jacobians",
            "newton_iterations", "projections", "restarts", "dense_solves")  # fmt: skip
ANOTHER_SCENE = "is of another scene"
DIGEST = "scene_digest"  # of a scene's description, among the stats of a result
METHOD = (DIGEST, "formulation", "integrator")
SETTINGS = ("dt_out", "rtol", "dt", "maximum_step", "spectral_radius", "energy_limit", "baumgarte")


def rows_of_piece(width: int) -> int:
    """Outputs of so many numbers that are written at once."""
    return max(LEAST_ROWS, min(MOST_ROWS, LARGEST_PIECE // (8 * max(width, 1))))


@dataclass(frozen=True, kw_only=True)
class Left:
    """What a run that stopped left to continue from: its outputs until a state.

    Attributes
    ----------
    source : Where it is.
    piece : The last outputs, and the state where they end.
    first : Time of the first output, s.
    outputs : All outputs until the state.
    events : All events until the state.
    end : Where the piece ends in a partial file; 0 where it is of a result's file.
    """

    source: Path
    piece: Piece = field(repr=False)
    first: float
    outputs: int
    events: int
    end: int


class ResultFile:
    """A result on disk to which outputs are added.

    They are in the file of `partial_path` until `finish` makes the result's own.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.outputs = 0
        self.scene = b""  # what is run, as a scene file
        self.stats: dict[str, Any] = {}
        self.about = About()
        self._partial = PartialFile(partial_path(path))
        self._source: Path | None = None
        self._nothing: Mapping[str, Array] = {}
        self._coords: Mapping[str, Sequence[str]] = {}
        self._last_time = -np.inf
        self._last_angles: dict[str, Array] = {}
        self._events = self._events_of_run = 0
        self._begun = False
        self._before: Mapping[str, Any] = {}

    def claim(self) -> None:
        """Keep other writers away until `release`; OSError if there is one, or if nothing can be written."""
        try:
            require_replaceable(self.path)
            self._partial.claim()
        except FileExistsError:
            raise
        except OSError as error:
            raise OSError(f"could not write {self.path}: {error.strerror or error}") from error

    def release(self) -> None:
        """Give the files up to others."""
        self._partial.release()

    def begin(self) -> None:
        """Start anew; what a killed run left is dropped."""
        self._partial.keep_until(0)

    def require_no_partial(self) -> None:
        """Raise FileExistsError if a run that was killed left outputs."""
        for piece, _ in self._partial.pieces():
            advice = "resume=True (--resume) goes on with it, " if piece.state else ""
            raise FileExistsError(
                f"{self._partial.path} holds the outputs of a run that was stopped or killed: {advice}"
                "overwrite=True (--overwrite) drops it"
            )

    def require_same(self, new: Piece, unlike: str) -> None:
        """Raise FileExistsError unless the result of that name may be replaced by one that tells this.

        It may where it is of the same scene, method and outputs, and does not end later. `unlike` says why
        that cannot be told; empty: it can.
        """
        if not self.path.exists():
            return
        try:
            old = _told(self.path)
            reason = unlike or difference(old, new)
            ends = [some.about.settings["t_end"] for some in (old, new)]
            if not reason and ends[0] > ends[1]:
                reason = f"has t_end {ends[0]!r}, this run {ends[1]!r}"
        except NETCDF_ERRORS:
            reason = "was not written by a run to a file"
        if reason:
            raise FileExistsError(
                f"{self.path} is there and {reason}: overwrite=True (--overwrite) replaces it; or give "
                "another name"
            )

    def left(self) -> Left:
        """What an earlier run left to continue from.

        Raises
        ------
        FileNotFoundError
            If there is nothing.
        FileFormatError
            If there is no state, or the files are damaged.
        """
        found: Left | None = None
        outputs = events = 0
        first: float | None = None
        for piece, end in self._partial.pieces():
            first = float(piece.arrays["time"][0]) if first is None else first
            outputs, events = outputs + piece.outputs, events + len(piece.events)
            if piece.state:
                found = Left(source=self._partial.path, piece=piece, first=first, outputs=outputs,
                             events=events, end=end)  # fmt: skip
        if found is not None:
            return found
        if not self.path.is_file():
            if first is not None:
                raise FileFormatError(
                    f"{self._partial.path} holds no state to go on from: overwrite=True starts the run anew"
                )
            raise FileNotFoundError(f"no result file {self.path} to go on with")
        return self._left_in_result()

    def _left_in_result(self) -> Left:
        try:
            told = _told(self.path)
            result = Result.load(self.path, channels=[], largest=LARGEST)
            if DIGEST not in told.stats:
                raise ValueError("it does not tell its scene")
        except NETCDF_ERRORS as error:
            raise FileFormatError(f"{self.path} is not a result that a run left: {error}") from error
        if result.state is None:
            raise FileFormatError(
                f"{self.path} holds no state to go on from: overwrite=True starts the run anew"
            )
        until = result.state.time
        piece = dataclasses.replace(
            told, events=[event for event in result.events if event.time <= until],
            state=state_to_bytes(result.state),
        )  # fmt: skip
        return Left(source=self.path, piece=piece, first=float(result.time[0]),
                    outputs=int(np.searchsorted(result.time, until, "right")),
                    events=len(piece.events), end=0)  # fmt: skip

    def go_on(self, left: Left) -> None:
        """Add to what a run left from now on."""
        if left.end:
            self._partial.keep_until(left.end)
            self._count(left.piece)
        else:
            self._copy_result(left)
            self._source = left.source
        self._coords, self._before = left.piece.coords, left.piece.stats
        self.outputs, self._events = left.outputs, left.events
        self._begun = True

    def _copy_result(self, left: Left) -> None:
        """A state is with the last piece alone: until it is there, the result is where to continue."""
        self._partial.keep_until(0)
        with open_netcdf(left.source, LARGEST) as file:
            names = list(left.piece.arrays)
            rows = rows_of_piece(sum(int(np.prod(file[name].shape[1:])) for name in names))
            for at in range(0, left.outputs, rows):
                last = at + rows >= left.outputs
                piece = dataclasses.replace(
                    left.piece,
                    arrays={name: file[name][at : min(at + rows, left.outputs)] for name in names},
                    events=left.piece.events if last else (),
                    state=left.piece.state if last else b"",
                    scene=self.scene if at == 0 else b"",
                )
                self._partial.append(piece)
                self._count(piece)

    def append(
        self,
        result: Result | None,
        *,
        stats: Mapping[str, Any],
        about: About,
        events: Sequence[Event],
        state: bytes,
        interrupted: bool,
    ) -> None:
        """Add the outputs of a result that are not there yet, and the state where they end.

        Parameters
        ----------
        result : None: there are no new outputs.
        stats, about, events
            Of the run until now, as a result has them.
        state : As `state_to_bytes` gives it.
        interrupted : False at the end of the run.

        Raises OSError if the disk has no room for them; the files then are as they were before.
        """
        if result is not None:
            new = slice(int(np.searchsorted(result.time, self._last_time, "right")), None)
            arrays = {name: array[new] for name, array in {"time": result.time, **result.arrays}.items()}
            self._coords = result.coords
        else:
            arrays = dict(self._nothing)
        for name, array in arrays.items():
            if name in self._last_angles and array.size:
                arrays[name] = _continued(array, self._last_angles[name])
        new_events = events[self._events_of_run :]
        stats = self._stats(stats, self._events + len(new_events))
        scene = b"" if self._begun else self.scene
        piece = Piece(arrays=arrays, coords=self._coords, stats=stats, about=about, events=new_events,
                      interrupted=interrupted, state=state, scene=scene)  # fmt: skip
        try:
            self._partial.append(piece)
        except OSError as error:
            kept = (
                f"the outputs until {self._last_time:.6g} s are kept in {self._partial.path}"
                if self.outputs
                else "nothing was written"
            )
            why = f"{error.strerror or error}{space_left(self.path.parent)}"
            raise OSError(f"could not write {self.path}: {why}; {kept}") from error
        self._count(piece)
        self._begun = True
        self._events_of_run = len(events)

    def _count(self, piece: Piece) -> None:
        if piece.outputs:
            self._last_time = float(piece.arrays["time"][-1])
            self._last_angles = {
                name: np.array(array[-1])
                for name, array in piece.arrays.items()
                if name in CHANNELS and CHANNELS[name].turns
            }
        self._nothing = {name: array[:0] for name, array in piece.arrays.items()}
        self.outputs, self._events = self.outputs + piece.outputs, self._events + len(piece.events)
        self.stats, self.about = dict(piece.stats), piece.about

    def finish(self, *, reached_end: bool) -> Path:
        """Make the result's file, and return where the outputs are.

        A run that stopped before its end leaves an older result alone, unless it has gone on with it.

        Raises OSError if there is no room; the partial file then holds everything.
        """
        if not reached_end and self.path.exists() and self._source is None:
            return self._partial.path
        try:
            with atomic_write(self.path) as draft:
                self._write(draft)
        except (OSError, RuntimeError) as error:  # failures of the HDF5 library arrive as RuntimeError
            where = (
                f"all outputs are in {self._partial.path}, and resume=True makes the file of them once it can"
                if self._partial.is_there()
                else f"the outputs were in {self._partial.path}, which somebody has removed"
            )
            raise OSError(f"{error}; {where}") from error
        self._partial.release(remove=True)
        return self.path

    def _write(self, draft: Path) -> None:
        events: list[Event] = []
        outputs, last, state = 0, None, b""
        for piece, _ in self._partial.pieces():
            outputs += piece.outputs
            events += piece.events
            last, state = piece, piece.state or state
        assert last is not None
        told = dataclasses.replace(last, events=events, state=state, scene=self.scene)
        blocks = _blocks((piece for piece, _ in self._partial.pieces()), rows_of_chunk(told, outputs))
        write_netcdf(draft, told, blocks, outputs)

    def _stats(self, stats: Mapping[str, Any], events: int) -> dict[str, Any]:
        """The stats of all pieces of the run: counters and simulated time of the one before are added."""
        out = dict(stats)
        for name in ("simulated_s", *COUNTERS):
            if name in self._before and name in stats:
                out[name] = stats[name] + self._before[name]
        for key in ("described", "validity"):
            lines = [*self._before.get(key, "").splitlines(), *stats.get(key, "").splitlines()]
            if lines:
                out[key] = "\n".join(dict.fromkeys(lines))
        if "events" in stats or "events" in self._before:
            out["events"] = events
        return out


def _continued(angle: Array, last: Array) -> Array:
    """An angle by whole turns nearest to where the outputs before it ended, which one piece does not know."""
    turn = 2.0 * np.pi
    continued: Array = angle + turn * np.round((last - angle[0]) / turn)
    return continued


def difference(old: Piece, new: Piece) -> str:
    """What tells the runs of two pieces apart, in words; empty: they are the same but for their ends."""
    if old.stats.get(DIGEST) != new.stats[DIGEST]:
        return ANOTHER_SCENE
    settings = [some.about.settings for some in (old, new)]
    pairs = {name: (old.stats.get(name), new.stats.get(name)) for name in METHOD}
    pairs |= {name: (settings[0].get(name), settings[1].get(name)) for name in SETTINGS}
    held = [sorted({channel_of(name) for name in some.arrays if name != "time"}) for some in (old, new)]
    pairs["channels"] = (", ".join(held[0]), ", ".join(held[1]))
    for name, (there, here) in pairs.items():
        if there != here:
            return f"has {name} {there!r}, this run {here!r}"
    return ""


def _told(path: Path) -> Piece:
    """What a result's file tells, without outputs."""
    with open_netcdf(path, LARGEST) as file:
        attributes = {name: file.getncattr(name) for name in file.ncattrs() if name != "interrupted"}
        stats, about = parted(path, attributes)
        stats = {
            name: value.item() if isinstance(value, np.generic) else value for name, value in stats.items()
        }
        names = [name for name, variable in file.variables.items() if variable.dimensions[:1] == ("time",)]
        dims = {dim for name in names for dim in file[name].dimensions[1:]}
        coords = {dim: [str(name) for name in file[dim][:]] for dim in sorted(dims)}
        return Piece(arrays=dict.fromkeys(names, np.empty(0)), coords=coords, stats=stats, about=about)


def _blocks(pieces: Iterator[Piece], rows: int) -> Iterator[dict[str, Array]]:
    """Arrays of the pieces, cut anew to so many outputs each."""
    held: list[Mapping[str, Array]] = []
    count = 0
    for piece in pieces:
        held.append(piece.arrays)
        count += piece.outputs
        if count < rows:
            continue
        joined = {name: np.concatenate([arrays[name] for arrays in held]) for name in held[0]}
        whole = count - count % rows
        yield {name: array[:whole] for name, array in joined.items()}
        held, count = [{name: array[whole:] for name, array in joined.items()}], count - whole
    if count:
        yield {name: np.concatenate([arrays[name] for arrays in held]) for name in held[0]}
