"""Runs and lifts of any length to a file, with nothing lost when they stop."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.analysis.after_run import Finding, as_text, warn_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.inputs.state import state_from_bytes, state_to_bytes
from seacrane.result.about import NOT_KEPT, About, KeptScene, checked_stats
from seacrane.result.partial_file import Piece
from seacrane.result.result import Result
from seacrane.result.result_file import rows_of_piece
from seacrane.result.stream import ANOTHER_SCENE, DIGEST, Left, ResultFile, difference
from seacrane.run.advance import drive
from seacrane.run.interrupts import Interrupts
from seacrane.run.method import REST, Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.sampled_controller import Calls, SampledController
from seacrane.run.staged_run import StagedRun
from seacrane.scene.file import scene_digest
from seacrane.scene.scene import Scene

CAPACITY = 1024  # outputs to take memory for at first


@dataclass(frozen=True, kw_only=True)
class StreamedResult:
    """What `simulate` left on disk.

    Attributes
    ----------
    path : Path
        Where the outputs are, with the state where the run stopped: a NetCDF file, as `Result.save` writes
        it; or <name>.partial, if the run stopped before its end and an older result has the name.
    outputs : int
        Outputs in the file.
    stats : mapping
        As `Result.stats`; counters are those of all calls that wrote the file.
    about : About
        As `Result.about`.
    interrupted : bool
        True if Ctrl-C stopped the run.
    """

    path: Path
    outputs: int
    stats: Mapping[str, Any]
    about: About
    interrupted: bool

    def load(self, channels: Sequence[str] | None = None) -> Result:
        """All of it, or those channels, in memory."""
        return Result.load(self.path, channels=channels)

    @classmethod
    def saved(cls, result: Result, path: Path) -> StreamedResult:
        """Of a result that is written as a whole."""
        result.save(path)
        return cls(
            path=path, outputs=int(result.time.size), stats=result.stats, about=result.about,
            interrupted=result.interrupted,
        )  # fmt: skip


def run_to_file(
    scene: Scene,
    path: Path,
    t_end: float,
    *,
    start: Any,
    method: Method,
    outputs: Outputs,
    checkpoint_every: float | None,
    resume: bool,
    overwrite: bool,
    controllers: Sequence[SampledController],
    progress: bool,
) -> StreamedResult:
    """`simulate` with `to`, to a time."""
    if start not in (None, REST):
        raise SceneError(
            f"start is {shown(start)}; a run that is written to a file begins as its scene, or at {REST!r}"
        )
    every = math.inf if checkpoint_every is None else number_of("checkpoint_every", checkpoint_every)
    if not every > 0.0:
        raise SceneError(f"checkpoint_every is {every} s; make it positive")
    file = ResultFile(path)
    with Interrupts() as interrupts:
        file.claim()
        try:
            left = file.left() if resume else None
            if left is None and not overwrite:
                file.require_no_partial()
            digest, begin = scene_digest(scene), start
            if left is not None:
                _refuse(left, ANOTHER_SCENE if left.piece.stats.get(DIGEST) != digest else "")
                begin = state_from_bytes(left.piece.state, left.source)
            run = Run(
                scene, t_end, method=method, outputs=outputs, capacity=CAPACITY, start=begin,
                outputs_from=None if left is None else left.first,
            )  # fmt: skip
            writer = _Writer(run, digest, file, every)
            unlike = "this scene has C functions, which cannot be compared" if scene.function_forces else ""
            if controllers:
                unlike = "this run has controllers, whose code cannot be compared"
            writer.begin(left, overwrite=overwrite, unlike=unlike)
            try:
                drive(
                    run, Calls(controllers, run.start.time), interrupts, progress=progress, watch=writer.look
                )
            except BaseException:
                with contextlib.suppress(OSError):  # the error at hand tells more
                    writer.close()
                raise
            where = writer.close()
        finally:
            file.release()
    warn_of(writer.found)
    return StreamedResult(
        path=where, outputs=file.outputs, stats=file.told.stats, about=file.told.about,
        interrupted=run.interrupted,
    )  # fmt: skip


def _refuse(left: Left, reason: str) -> None:
    if reason:
        raise FileFormatError(
            f"{left.source} {reason}: give the scene and the settings of the run that stopped, or leave "
            "resume out"
        )


class _Writer:
    """Moves the outputs of a run from memory to its file, and notes what was out of range in them.

    Of each object the first that was `found`.
    """

    def __init__(self, run: Run, digest: str, file: ResultFile, every: float) -> None:
        self.found: list[Finding] = []
        self._run, self._file, self._every, self._digest = run, file, every, digest
        self._scene, self._lacks = KeptScene(run.scene).written()
        self._nothing = run.wanted(run.core.channels(0))
        self._rows = rows_of_piece(sum(int(np.prod(one.shape[1:])) for one in self._nothing.values()))
        self._due = run.start.time + every

    def begin(self, left: Left | None, *, overwrite: bool, unlike: str) -> None:
        """Begin the file, or continue it; FileFormatError or FileExistsError where it is of another run."""
        new = Piece(arrays=self._nothing, coords={}, stats=self._stats(), about=self._run.about)
        if left is not None:
            _refuse(left, difference(left.piece, new))
        if not (overwrite or (left is not None and not left.end)):
            self._file.require_same(new, unlike)
        if left is None:
            self._file.begin()
            self._keep()
        else:
            self._file.go_on(left)
            # What was recorded at the very start of this piece is in the file.
            core = self._run.core
            core.drop(int((core.channels()["time"] <= self._run.start.time).sum()))

    def look(self, now: float) -> None:
        """Write a piece where one is due at this time, s."""
        if now >= self._due or self._run.core.recorded >= self._rows:
            self._keep()

    def close(self) -> Path:
        """Write what is left, make the result's file, and return where the outputs are."""
        run = self._run
        reached_end = not run.interrupted and run.core.time >= run.t_end
        self._keep(interrupted=not reached_end)
        return self._file.finish(reached_end=reached_end)

    def _keep(self, *, interrupted: bool = True) -> None:
        """Write all outputs with the state where they end, and drop them."""
        run = self._run
        with run.core:
            count = run.core.recorded
            result, found = run.judged_result(count) if count else (None, run.slow)
            first: dict[tuple[type[Warning], str], Finding] = {}
            for category, message in (*self.found, *found):
                first.setdefault((category, message.partition(":")[0]), (category, message))
            self.found = list(first.values())
            state = run.last_state()
            piece = Piece(
                arrays={} if result is None else {"time": result.time, **result.arrays},
                coords={} if result is None else result.coords, stats=self._stats(), about=run.about,
                events=run.events(), interrupted=interrupted, scene=self._scene,
                state=b"" if state is None else state_to_bytes(state),
            )  # fmt: skip
            self._file.append(piece)
            run.core.drop(count)
        self._due = run.core.time + self._every

    def _stats(self) -> dict[str, Any]:
        """As `Run.stats`, with the scene, and with what has been out of range."""
        validity = {"validity": as_text(self.found)} if self.found else {}
        lacks = {NOT_KEPT: self._lacks} if self._lacks else {}
        return checked_stats({**self._run.stats(), DIGEST: self._digest, **lacks, **validity})


def require_free(path: Path, *, overwrite: bool) -> None:
    """FileExistsError for a name that is taken, FileNotFoundError without its folder."""
    if path.exists() and not overwrite:
        raise FileExistsError(f"{path.name} is there already; give another name, or overwrite=True")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path}: there is no folder {path.parent}; make it first")


def stages_to_file(run: StagedRun, path: Path, *, overwrite: bool) -> StreamedResult:
    """Carry out a lift, and write its result after each stage.

    The file is whole whenever the process is killed: it then holds the stages that were over, with
    `interrupted` set. Ctrl-C and errors keep the stage that they end, too. The outputs stay in memory.
    """
    require_free(path, overwrite=overwrite)
    try:
        while run.advance():
            run.result().save(path)
    except BaseException as error:
        recorded = getattr(error, "result", None)
        if isinstance(recorded, Result):
            with contextlib.suppress(OSError):  # the error at hand tells more
                recorded.save(path)
        raise
    run.warn()
    return StreamedResult.saved(run.result(), path)
