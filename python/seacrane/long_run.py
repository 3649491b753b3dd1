"""simulate_to_file(): runs of any length, in bounded memory and with nothing lost when they stop."""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seacrane import _core
from seacrane.checked import number_of
from seacrane.errors import FileFormatError, SceneError, SeacraneError
from seacrane.result.stream import ResultFile
from seacrane.sampled_controller import SampledController, checked_controllers
from seacrane.simulation import Run, drive
from seacrane.validity import Finding, as_text, warn_of

if TYPE_CHECKING:
    from seacrane.result import Result
    from seacrane.scene import Scene

CAPACITY = 1024  # outputs to take memory for at first
NOT_STREAMED = ("start", "outputs_from", "capacity", "model", "accuracy")


@dataclass(frozen=True, kw_only=True)
class StreamedResult:
    """What `simulate_to_file` left on disk.

    Attributes
    ----------
    path : Path
        NetCDF file, as `Result.save` writes it.
    checkpoint : Path
        State file, to go on from.
    outputs : int
        Outputs in the file.
    stats : mapping
        As `Result.stats`; counters are those of all calls that wrote the file.
    interrupted : bool
        True if Ctrl-C stopped the run.
    """

    path: Path
    checkpoint: Path
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
    controllers: Sequence[SampledController] = (),
    progress: bool = False,
    **settings: Any,
) -> StreamedResult:
    """Simulate a scene and write its outputs to a file while the run goes on.

    Outputs leave memory in pieces. Until the run ends, or is stopped by Ctrl-C or an error, the file is
    called <name>.partial.nc, which other programs may read. Beside it goes <name>.state, from which
    ``resume=True`` goes on: the file then holds, bit for bit, the outputs of a run that was not stopped
    (methods of SUNDIALS restart there).

    Parameters
    ----------
    scene : Scene
    path : path
        NetCDF file; an older one of that name is replaced when the run ends.
    t_end : float
        End time, s.
    checkpoint_every : float, optional
        Simulated time between two states on disk, s, for runs that may be killed; default: only where the
        run stops.
    resume : bool
        Go on from the state and the outputs that an earlier call left, with its settings; `t_end` may be
        later.
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
    OSError
        If the disk is full, or the folder is missing; the file holds what there was room for.
    """
    for name in NOT_STREAMED:
        if name in settings:
            raise SceneError(f"{name} cannot be given to a run that is written to a file; leave it out")
    every = math.inf if checkpoint_every is None else number_of("checkpoint_every", checkpoint_every)
    if not every > 0.0:
        raise SceneError(f"checkpoint_every is {every} s; make it positive")
    given = checked_controllers(controllers)
    chosen = {name: value for name, value in settings.items() if value is not None}
    run = _FileRun(scene, Path(path), every, resume, {"t_end": t_end, **chosen})
    try:
        drive(run, given, progress=progress)
    except BaseException:
        run.interrupted = True
        with contextlib.suppress(OSError):  # the disk is full: the file holds what there was room for
            run.close()
        raise
    run.close()
    warn_of(run.found)
    return StreamedResult(
        path=run.file.path, checkpoint=run.checkpoint, outputs=run.file.outputs, stats=run.file.stats,
        interrupted=run.interrupted,
    )  # fmt: skip


class _FileRun(Run):
    """A run whose outputs leave it for a file."""

    def __init__(
        self, scene: Scene, path: Path, every: float, resume: bool, settings: Mapping[str, Any]
    ) -> None:
        self.file = ResultFile(path)
        self.checkpoint = path.with_suffix(".state")
        self.every = every
        if not resume:
            self.file.create()
            super().__init__(scene, capacity=CAPACITY, **settings)
        else:
            state = _core.State.load(self.checkpoint, scene=scene)
            first = self.file.first_output()
            super().__init__(scene, capacity=CAPACITY, start=state, outputs_from=first, **settings)
            self._go_on(state)
        self._due = self.start.time + every

    def _go_on(self, state: _core.State) -> None:
        steps = state.steps
        if (steps.formulation, steps.integrator) != (self.formulation, self.integrator):
            raise FileFormatError(
                f"{self.checkpoint} was left by {steps.integrator!r}, {steps.formulation!r}, this run takes "
                f"{self.integrator!r}, {self.formulation!r}: give the settings of the run that stopped"
            )
        self.file.reopen(state.time, self.settings)
        # What was recorded at the very start of this piece is in the file.
        self.core.drop(int((self.core.channels()["time"] <= state.time).sum()))

    def advance(self, t_end: float, progress: Callable[[float], None] | None = None) -> bool:
        """As `Run.advance`; outputs leave memory meanwhile."""

        def look(now: float) -> None:
            self._keep_whole_pieces()
            if now >= self._due:
                self._save_state()
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
        """As `Run.stats`, with what has been out of range."""
        validity = {"validity": as_text(self.found)} if self.found else {}
        return {**super().stats(), **validity}

    def explain(self, error: SeacraneError) -> None:
        """The file explains."""

    def close(self) -> None:
        """Write what is left, and the state where the run stopped."""
        try:
            self._save_state()
        finally:
            self.file.finish()

    def _keep_whole_pieces(self) -> None:
        # They end where the file's chunks do: those are compressed once.
        count = self.core.recorded - (self.file.outputs + self.core.recorded) % self.file.rows
        if count > 0:
            self._keep(count)

    def _keep(self, count: int) -> None:
        self.file.append(self.result(count), interrupted=True)
        self.core.drop(count)

    def _save_state(self) -> None:
        """All outputs, then the state: it never is ahead of them."""
        if self.core.recorded:
            self._keep(self.core.recorded)
        self.file.describe(
            self.stats(), self.events(), interrupted=self.interrupted or self.core.time < self.t_end
        )
        state = self.last_state()
        if state is not None:
            self.file.sync()
            state.save(self.checkpoint)
        self._due = self.core.time + self.every
