"""simulate(): a scene run to a time or through the stages of a lift, kept in memory or written to a file."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, overload

from seacrane.accuracy.case import Case
from seacrane.accuracy.choice import run_to_accuracy
from seacrane.errors import SceneError
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.result.result import Result
from seacrane.run.advance import finished
from seacrane.run.method import Method, Shorthand, Start, settled
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.sampled_controller import SampledController, checked_controllers
from seacrane.run.stage import Stage
from seacrane.run.staged_run import StagedRun
from seacrane.run.to_file import StreamedResult, require_free, run_to_file, stages_to_file
from seacrane.scene.scene import Scene

UNWRITTEN = "nothing is written; give the file by to="

if TYPE_CHECKING:
    from typing_extensions import TypeIs, Unpack

    class _Kept(Shorthand, total=False):
        method: Method | None
        outputs: Outputs | None
        start: Start
        first: str | None
        controllers: Sequence[SampledController]
        accuracy: Mapping[str, float] | None
        progress: bool

    class _Written(_Kept, total=False):
        checkpoint_every: float | None
        resume: bool
        overwrite: bool


@overload
def simulate(
    scene: Scene, t_end: float | Sequence[Stage] = 100.0, *, to: None = None, **how: Unpack[_Kept]
) -> Result: ...


@overload
def simulate(
    scene: Scene, t_end: float | Sequence[Stage] = 100.0, *, to: str | os.PathLike[str],
    **how: Unpack[_Written],
) -> StreamedResult: ...  # fmt: skip


@named
def simulate(
    scene: Scene, t_end: float | Sequence[Stage] = 100.0, *, to: str | os.PathLike[str] | None = None,
    method: Method | None = None, outputs: Outputs | None = None, start: Start = None,
    first: str | None = None, controllers: Sequence[SampledController] = (),
    accuracy: Mapping[str, float] | None = None, checkpoint_every: float | None = None,
    resume: bool = False, overwrite: bool = False, progress: bool = False, **shorthand: Unpack[Shorthand],
) -> Result | StreamedResult:  # fmt: skip
    """Simulate a scene, to a time or through the stages of a lift, and return its recorded channels.

    Through stages the clock and the waves go on; an element that a stage connects is absent until then. In
    stages without an element, its forces and powers are 0 and its other channels are NaN. See docs/stages.md.

    To a file (`to`) outputs leave memory in pieces, each with the state where it ends. Until the run ends,
    they are added to <name>.partial, which `Result.load` reads at any time and which is whole whenever the
    process is killed. The result's own file is made of it when the run ends, or is stopped by Ctrl-C or an
    error. ``resume=True`` continues from either: the file then holds, bit for bit, the outputs of a run that
    was not stopped (methods of SUNDIALS restart there). Stages are written one by one, as they are over;
    what an accuracy asks for is run more than once, and written at its end.

    Parameters
    ----------
    scene : Scene
        With everything that is ever connected.
    t_end : float or sequence of Stage
        End time, s; or the stages, in their order.
    to : path, optional
        NetCDF file, in a folder that exists. An older one is replaced when the run has reached its end, if it
        is of the same scene, method and outputs and does not end later; of stages by `overwrite` alone.
    method : Method, optional
        How it is stepped: integrator, tolerance or step, formulation, guards.
    outputs : Outputs, optional
        What is recorded, and how often; channels in the stages that have them.
    start : State or "rest", optional
        Where to continue from, or the word for the state at rest, see `equilibrium`; default: the assembled
        start of the scene. Of a run to a file the word alone.
    first : str, optional
        Name of a stage to begin with. Those before it are carried out in calm water, and it starts from the
        static state there, unless a state is given as `start`.
    controllers : sequence of SampledController
        Called at their periods from the first start on; a run that is resumed calls them anew from there.
        Inputs of elements that are absent in a stage are left out there.
    accuracy : mapping of str to float, optional
        Largest error over the outputs by quantity, such as ``{"payload_position": 0.01}``, in its unit; the
        quantities are those of `seacrane.trade`, extremes such as "hook_load.max", "event_times" (s), and
        of stages their times, such as "stage[lift].end". Curves are compared at equal phase of a stage.
        Integrator and tolerance are then chosen, and a second, cheap run tells the error: leave integrator,
        rtol, dt and controllers out. The estimate of what is left of the integration error is in `stats`, as
        "error_estimate_<quantity>"; docs/trade.md says what is promised.
    checkpoint_every : float, optional
        Simulated time between two pieces of a file, s, for runs that may be killed; default: where a piece
        has 2 MiB or 4096 outputs.
    resume : bool
        Go on with what an earlier call left in the file, with its scene and its settings; `t_end` may be
        later.
    overwrite : bool
        Replace whatever has the name, and drop what a killed run left.
    progress : bool
        Show a progress bar; stages have none.
    **shorthand
        Attributes of `Method` and `Outputs` by name, for calls that name few of them. One that contradicts
        the object is refused.

    Returns
    -------
    Result or StreamedResult
        With `interrupted` set, and the outputs until then, when Ctrl-C stopped the run. Of stages with
        `stages`, and an event for each stage, connection and release. To a file, what was left there.

    Raises
    ------
    SceneError
        For a scene or setting that makes no sense; for stages that do not fit the scene or one another, by
        their names, or one before `first` that is not over in calm water.
    SimulationError
        When the integration cannot continue, a stage is not over within its `maximum_duration`, a controller
        raises, or memory runs out; it says where, when and what to try. Its `result`, or the file, holds the
        outputs until then.
    FileFormatError
        If what is to be gone on from is damaged, or of another scene or other settings.
    FileExistsError
        If another run writes this file, or left something that `overwrite` would have to allow to replace.
    OSError
        If the disk is full, or the folder is missing; the message says where the outputs until then are.

    Warns
    -----
    SeacraneWarning
        Before it, when the description most likely does not say what was meant (docs/mistakes.md). After it,
        when its motions left the range in which the models hold, one fast mode set its steps, its method fed
        an oscillation, or water struck what hangs on a quasi-static line; also in `stats`, as "validity"
        (docs/troubleshooting.md).
    """
    if "stages" in shorthand:
        raise SceneError("there is no 'stages'; give them in the place of `t_end`: simulate(scene, stages)")
    end, stages = (math.nan, t_end) if _several(t_end) else (t_end, None)
    written = {"checkpoint_every": checkpoint_every, "resume": resume, "overwrite": overwrite}
    _require_use(stages, to, accuracy, first=first, **written)
    called = checked_controllers(controllers)
    if accuracy is not None:
        if to is not None:
            require_free(Path(to), overwrite=overwrite)
        case = Case(
            scene=scene, t_end=end, start=start, stages=None if stages is None else tuple(stages), first=first
        )  # fmt: skip
        result = run_to_accuracy(
            case, accuracy, method=method, outputs=outputs, shorthand=shorthand, controllers=called,
            progress=progress,
        )  # fmt: skip
        return result if to is None else StreamedResult.saved(result, Path(to))
    method, outputs = settled(method, outputs, shorthand)
    if stages is not None:
        lift = StagedRun(
            scene, stages, start=start, first=first, method=method, outputs=outputs, controllers=called
        )
        if to is not None:
            return stages_to_file(lift, Path(to), overwrite=overwrite)
        while lift.advance():
            pass
        lift.warn()
        return lift.result()
    if to is None:
        run = Run(scene, end, method=method, outputs=outputs, start=start, controlled=bool(called))
        return finished(run, called, progress=progress)
    return run_to_file(
        scene, Path(to), end, start=start, method=method, outputs=outputs, controllers=called,
        checkpoint_every=checkpoint_every, resume=resume, overwrite=overwrite, progress=progress,
    )  # fmt: skip


def _several(t_end: float | Sequence[Stage]) -> TypeIs[Sequence[Stage]]:
    return isinstance(t_end, Sequence) and not isinstance(t_end, str)


def _require_use(
    stages: Sequence[Stage] | None, to: str | os.PathLike[str] | None, accuracy: Mapping[str, float] | None,
    **given: object,
) -> None:  # fmt: skip
    """Refuse words that this kind of run has no use for, and what is no path."""
    if to is not None and not isinstance(to, (str, os.PathLike)):
        raise SceneError(f"to is {shown(to)}; give the path of a NetCDF file")
    whole = UNWRITTEN if to is None else ""
    if to is not None and accuracy is not None:
        whole = "what an accuracy asks for is run more than once, and written at its end"
    elif to is not None and stages is not None:
        whole = "stages are written one by one"
    reasons = {
        "first": "it names a stage, and no stages are given" if stages is None else "",
        "checkpoint_every": whole, "resume": whole, "overwrite": UNWRITTEN if to is None else "",
    }  # fmt: skip
    for word, reason in reasons.items():
        if given[word] not in (None, False) and reason:
            raise SceneError(f"{word} is {shown(given[word])}: {reason}; leave it out")
