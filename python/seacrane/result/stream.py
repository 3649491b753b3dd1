"""Results that grow on disk during a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, channel_of
from seacrane.errors import FileFormatError
from seacrane.inputs.atomic import atomic_write, require_replaceable, space_left
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS
from seacrane.inputs.state import state_from_bytes
from seacrane.result.about import Event, added_stats, checked_time
from seacrane.result.partial_file import PartialFile, Piece, partial_path
from seacrane.result.result_file import read_netcdf, rows_of_chunk, rows_of_piece, write_netcdf

LARGEST = 2**50  # bytes: a file without end is read piece by piece
NO_OUTPUTS = slice(0, 0)
ANOTHER_SCENE = "is of another scene"
NO_STATE = "holds no state to go on from: overwrite=True starts the run anew"
DIGEST = "scene_digest"  # of a scene's description, among the stats of a result
METHOD = (DIGEST, "formulation", "integrator")
SETTINGS = ("dt_out", "rtol", "dt", "maximum_step", "spectral_radius", "energy_limit", "baumgarte")


@dataclass(frozen=True, kw_only=True)
class Left:
    """What a run that stopped left to continue from: its outputs until a state.

    Attributes
    ----------
    source : Where it is.
    piece : The last outputs, or none, all events, and the state where they end.
    first : Time of the first output, s.
    outputs : All outputs until the state.
    end : Where the piece ends in a partial file; 0 where it is of a result's file.
    """

    source: Path
    piece: Piece = field(repr=False)
    first: float
    outputs: int
    end: int


class ResultFile:
    """A result on disk to which outputs are added.

    They are in the file of `partial_path` until `finish` makes the result's own.

    Attributes
    ----------
    outputs : How many there are.
    told : All but the outputs, as the last piece has it.
    """

    def __init__(self, path: Path) -> None:
        self.path, self.outputs = path, 0
        self.told = Piece(arrays={}, coords={}, stats={})
        self._partial = PartialFile(partial_path(path))
        self._goes_on = self._begun = False
        self._last_time = -np.inf
        self._last_angles: dict[str, Array] = {}
        self._events = self._events_of_run = 0
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
            old = read_netcdf(self.path, LARGEST, rows=NO_OUTPUTS)
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
        first: float | None = None
        outputs, events = 0, list[Event]()
        for piece, end in self._partial.pieces():
            first = float(piece.arrays["time"][0]) if first is None else first
            outputs += piece.outputs
            events += piece.events
            if piece.state:
                whole = replace(piece, events=tuple(events))
                found = Left(source=self._partial.path, piece=whole, first=first, outputs=outputs, end=end)
        if found is not None:
            return found
        if self.path.is_file():
            return self._left_in_result()
        if first is not None:
            raise FileFormatError(f"{self._partial.path} {NO_STATE}")
        raise FileNotFoundError(f"no result file {self.path} to go on with")

    def _left_in_result(self) -> Left:
        try:
            told = read_netcdf(self.path, LARGEST, rows=NO_OUTPUTS)
            times = checked_time(read_netcdf(self.path, LARGEST, channels=()).arrays["time"])
            until = state_from_bytes(told.state, self.path).time if told.state else np.nan
            if DIGEST not in told.stats:
                raise ValueError("it does not tell its scene")
        except NETCDF_ERRORS as error:
            raise FileFormatError(f"{self.path} is not a result that a run left: {error}") from error
        if not told.state:
            raise FileFormatError(f"{self.path} {NO_STATE}")
        events = [event for event in told.events if event.time <= until]
        return Left(
            source=self.path, piece=replace(told, events=events, interrupted=True), first=float(times[0]),
            outputs=int(np.searchsorted(times, until, "right")), end=0,
        )  # fmt: skip

    def go_on(self, left: Left) -> None:
        """Add to what a run left from now on."""
        self._partial.keep_until(left.end)
        if left.end:
            self._count(left.piece)
        else:
            self._copy_result(left)
        self._goes_on = not left.end
        self._before, self._begun = left.piece.stats, True
        self.outputs, self._events = left.outputs, len(left.piece.events)

    def _copy_result(self, left: Left) -> None:
        """A state is with the last piece alone: until it is there, the result is where to continue."""
        rows = rows_of_piece(sum(int(np.prod(one.shape[1:])) for one in left.piece.arrays.values()))
        for at in range(0, left.outputs, rows):
            until = min(at + rows, left.outputs)
            arrays = read_netcdf(left.source, LARGEST, rows=slice(at, until)).arrays
            piece = replace(left.piece, arrays=arrays, scene=left.piece.scene if at == 0 else b"")
            if until < left.outputs:
                piece = replace(piece, events=(), state=b"")
            self._partial.append(piece)
            self._count(piece)

    def append(self, piece: Piece) -> None:
        """Add what is not there yet of outputs and events of the run, and the state where they end.

        Parameters
        ----------
        piece : With the stats and events of the run until now; without arrays: there are no new outputs.

        Raises OSError if the disk has no room for them; the files then are as they were before.
        """
        if not piece.arrays:
            piece = replace(piece, arrays=self.told.arrays, coords=self.told.coords)
        new = int(np.searchsorted(piece.arrays["time"], self._last_time, "right"))
        arrays = {name: array[new:] for name, array in piece.arrays.items()}
        for name, last in self._last_angles.items():
            if name in arrays and arrays[name].size:
                angle, turn = arrays[name], 2.0 * np.pi  # by whole turns nearest to where those before ended
                arrays[name] = angle + turn * np.round((last - angle[0]) / turn)
        events, stats = piece.events[self._events_of_run :], added_stats(self._before, piece.stats)
        if "events" in stats:
            stats["events"] = self._events + len(events)
        scene = b"" if self._begun else piece.scene
        own = replace(piece, arrays=arrays, events=events, stats=stats, scene=scene)
        try:
            self._partial.append(own)
        except OSError as error:
            kept = (
                f"the outputs until {self._last_time:.6g} s are kept in {self._partial.path}"
                if self.outputs
                else "nothing was written"
            )
            why = f"{error.strerror or error}{space_left(self.path.parent)}"
            raise OSError(f"could not write {self.path}: {why}; {kept}") from error
        self._count(own)
        self._begun, self._events_of_run = True, len(piece.events)

    def _count(self, piece: Piece) -> None:
        if piece.outputs:
            self._last_time = float(piece.arrays["time"][-1])
            self._last_angles = {
                name: np.array(array[-1])
                for name, array in piece.arrays.items()
                if name in CHANNELS and CHANNELS[name].turns
            }
        self.outputs, self._events = self.outputs + piece.outputs, self._events + len(piece.events)
        nothing = {name: array[:0] for name, array in piece.arrays.items()}
        self.told = replace(piece, arrays=nothing, events=(), state=b"", scene=b"")

    def finish(self, *, reached_end: bool) -> Path:
        """Make the result's file, and return where the outputs are.

        A run that stopped before its end leaves an older result alone, unless it has gone on with it.

        Raises OSError if there is no room; the partial file then holds everything.
        """
        if not reached_end and self.path.exists() and not self._goes_on:
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
        state = scene = b""
        for piece, _ in self._partial.pieces():
            events += piece.events
            state, scene = piece.state or state, piece.scene or scene
        told = replace(self.told, events=events, state=state, scene=scene)
        blocks = _blocks((piece for piece, _ in self._partial.pieces()), rows_of_chunk(told, self.outputs))
        write_netcdf(draft, told, blocks, self.outputs)


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
