"""simulate_to_file(): runs of any length, in bounded memory and with nothing lost when they stop."""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.errors import FileFormatError, SceneError
from seacrane.files.state import state_from_bytes, state_to_bytes
from seacrane.inputs.checked import number_of
from seacrane.result.result import checked_stats
from seacrane.result.stream import DIGEST, Left, ResultFile, difference, rows_of_piece
from seacrane.run.interrupts import Interrupts
from seacrane.run.sampled_controller import SampledController, checked_controllers
from seacrane.run.simulation import Run, drive
from seacrane.validity.range import Finding, as_text, warn_of
from seacrane.version import __version__

if TYPE_CHECKING:
    from seacrane.result import Result
    from seacrane.scene.scene import Scene

CAPACITY = 1024  # outputs to take memory for at first
NOT_STREAMED = ("start", "outputs_from", "capacity", "model", "accuracy")


@dataclass(frozen=True, kw_only=True)
class StreamedResult:
    """What `simulate_to_file` left on disk.

    Attributes
    ----------
    path : Path
        Where the outputs are, with the state where the run stopped: a NetCDF file, as `Result.save` writes
        it; or <name>.partial, if the run stopped before its end and an older result has the name.
    outputs : int
        Outputs in the file.
    stats : mapping
        As `Result.stats`; counters are those of all calls that wrote the file.
    interrupted : bool
        True if Ctrl-C stopped the run.
    """

    path: Path
    outputs: int
    stats: Mapping[str, Any]
    interrupted: bool

    def load(self, channels: Sequence[str] | None = None) -> Result:
        """All of it, or those channels, in memory."""
        from seacrane.result import Result

        return Result.load(self.path, channels=channels)


def simulate_to_file(
    scene: Scene,
    path: str | os.PathLike[str],
    *,
    t_end: float = 100.0,
    checkpoint_every: float | None = None,
    resume: bool = False,
    overwrite: bool = False,
    controllers: Sequence[SampledController] = (),
    progress: bool = False,
    **settings: Any,
) -> StreamedResult:
    """Simulate a scene and write its outputs to a file while the run goes on.

    Outputs leave memory in pieces, each with the state where it ends. Until the run ends, they are added to
    <name>.partial, which `Result.load` reads at any time and which is whole whenever the process is killed.
    The result's own file is made of it when the run ends, or is stopped by Ctrl-C or an error.
    ``resume=True`` goes on from either: the file then holds, bit for bit, the outputs of a run that was not
    stopped (methods of SUNDIALS restart there).

    Parameters
    ----------
    scene : Scene
    path : path
        NetCDF file. An older one is replaced when the run has reached its end, if it is of the same scene,
        method and outputs and does not end later.
    t_end : float
        End time, s.
    checkpoint_every : float, optional
        Simulated time between two pieces, s, for runs that may be killed; default: where a piece has 2 MiB
        or 4096 outputs.
    resume : bool
        Go on with what an earlier call left, with its scene and its settings; `t_end` may be later.
    overwrite : bool
        Replace whatever has the name, and drop what a killed run left.
    controllers : sequence of SampledController
        As `simulate`. A run that goes on calls them anew from there.
    progress : bool
        Show a progress bar.
    **settings
        As `simulate`; not `start` and `accuracy`.

    Returns
    -------
    StreamedResult

    Raises
    ------
    SceneError, SimulationError
        As `simulate`; the file holds the outputs until then.
    FileFormatError
        If what is to be gone on from is damaged, or of another scene or other settings.
    FileExistsError
        If another run writes this file, or left something that `overwrite` would have to allow to replace.
    OSError
        If the disk is full, or the folder is missing; the message says where the outputs until then are.
    """
    for name in NOT_STREAMED:
        if name in settings:
            raise SceneError(f"{name} cannot be given to a run that is written to a file; leave it out")
    every = math.inf if checkpoint_every is None else number_of("checkpoint_every", checkpoint_every)
    if not every > 0.0:
        raise SceneError(f"checkpoint_every is {every} s; make it positive")
    given = checked_controllers(controllers)
    chosen = {name: value for name, value in settings.items() if value is not None}
    file = ResultFile(Path(path))
    with Interrupts() as interrupts:
        file.claim()
        try:
            unlike = "" if overwrite else _unlike(scene, given)
            run = _FileRun(scene, file, every, resume, overwrite, unlike, {"t_end": t_end, **chosen})
            try:
                drive(run, given, interrupts, progress=progress)
            except BaseException:
                run.interrupted = True
                with contextlib.suppress(OSError):  # the error at hand tells more
                    run.close()
                raise
            where = run.close()
        finally:
            file.release()
    warn_of(run.found)
    return StreamedResult(path=where, outputs=file.outputs, stats=file.stats, interrupted=run.interrupted)


def _unlike(scene: Scene, controllers: Sequence[SampledController]) -> str:
    """Why nobody can tell whether another run is the same."""
    if controllers:
        return "this run has controllers, whose code cannot be compared"
    if scene.function_forces:
        return "this scene has C functions, which cannot be compared"
    return ""


class _FileRun(Run):
    """A run whose outputs leave it for a file."""

    def __init__(
        self,
        scene: Scene,
        file: ResultFile,
        every: float,
        resume: bool,
        overwrite: bool,
        unlike: str,
        settings: Mapping[str, Any],
    ) -> None:
        from seacrane.description.file import scene_digest

        self.file = file
        self.every = every
        self.digest = scene_digest(scene)
        left = file.left() if resume else None
        if left is None:
            if not overwrite:
                file.require_no_partial()
            super().__init__(scene, capacity=CAPACITY, **settings)
        else:
            if left.piece.stats.get(DIGEST) != self.digest:
                self._refuse(left, difference(left.piece.stats, (), {**left.piece.stats, **self._own()}, ()))
            state = state_from_bytes(left.piece.state, left.source)
            super().__init__(scene, capacity=CAPACITY, start=state, outputs_from=left.first, **settings)
        arrays = self._channels(self.core.channels(0))
        widths = {name: int(np.prod(values.shape[1:])) for name, values in arrays.items()
                  if self._wanted is None or name in self._wanted}  # fmt: skip
        channels = list(widths)
        stats = checked_stats(self.stats())
        if left is not None:
            old_channels = [name for name in left.piece.arrays if name != "time"]
            self._refuse(left, difference(left.piece.stats, old_channels, stats, channels))
        if not (overwrite or (left is not None and not left.end)):
            file.require_same(stats, channels, unlike)
        self._rows = rows_of_piece(sum(widths.values()))
        if left is None:
            file.begin()
            self._keep()
        else:
            file.go_on(left)
            # What was recorded at the very start of this piece is in the file.
            self.core.drop(int((self.core.channels()["time"] <= self.start.time).sum()))
        self._due = self.start.time + every

    def _own(self) -> dict[str, Any]:
        return {DIGEST: self.digest, "seacrane_version": __version__}

    def _refuse(self, left: Left, reason: str) -> None:
        if reason:
            raise FileFormatError(
                f"{left.source} {reason}: give the scene and the settings of the run that stopped, or leave "
                "resume out"
            )

    def advance(self, t_end: float, progress: Callable[[float], None] | None = None) -> bool:
        """As `Run.advance`; outputs leave memory meanwhile."""

        def look(now: float) -> None:
            if now >= self._due or self.core.recorded >= self._rows:
                self._keep()
            if progress is not None:
                progress(now)

        reached = super().advance(t_end, look)
        look(self.core.time)
        return reached

    def judged(self, found: list[Finding]) -> list[Finding]:
        """As `Run.judged`: what the first piece of outputs out of range tells of each object."""
        first: dict[tuple[type[Warning], str], Finding] = {}
        for category, message in (*self.found, *found):
            first.setdefault((category, message.partition(":")[0]), (category, message))
        return list(first.values())

    def stats(self) -> dict[str, Any]:
        """As `Run.stats`, with the scene, and with what has been out of range."""
        validity = {"validity": as_text(self.found)} if self.found else {}
        return {**super().stats(), DIGEST: self.digest, **validity}

    def explain(self, error: BaseException) -> None:
        """The file explains."""

    def close(self) -> Path:
        """Write what is left, make the result's file, and return where the outputs are."""
        reached_end = not self.interrupted and self.core.time >= self.t_end
        self._keep(interrupted=not reached_end)
        return self.file.finish(reached_end=reached_end)

    def _keep(self, *, interrupted: bool = True) -> None:
        """Write all outputs with the state where they end, and drop them."""
        with self.core:
            count = self.core.recorded
            result = self.result(count) if count else None
            state = self.last_state()
            self.file.append(
                result, stats=checked_stats(self.stats()), events=self.events(), interrupted=interrupted,
                state=b"" if state is None else state_to_bytes(state),
            )  # fmt: skip
            self.core.drop(count)
        self._due = self.core.time + self.every
