"""simulate(): one call that runs a scene with a method, or with what an accuracy asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from seacrane.accuracy.case import case_of_run
from seacrane.accuracy.choice import run_to_accuracy
from seacrane.inputs.keywords import named
from seacrane.result.result import Result
from seacrane.run.advance import finished
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.sampled_controller import SampledController, checked_controllers
from seacrane.run.shorthand import Shorthand
from seacrane.run.start import Start
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack


@named
def simulate(
    scene: Scene,
    t_end: float = 100.0,
    *,
    method: Method | None = None,
    outputs: Outputs | None = None,
    start: Start = None,
    controllers: Sequence[SampledController] = (),
    accuracy: Mapping[str, float] | None = None,
    progress: bool = False,
    **shorthand: Unpack[Shorthand],
) -> Result:
    """Simulate a scene and return its recorded channels.

    Parameters
    ----------
    scene : Scene
    t_end : float
        End time, s.
    method : Method, optional
        How it is stepped: integrator, tolerance or step, formulation, guards.
    outputs : Outputs, optional
        What is recorded, and how often.
    start : State or "rest", optional
        Where to continue from, or the word for the state at rest, see `equilibrium`; default: the assembled
        start of the scene.
    controllers : sequence of SampledController
        Called at their periods from the start on.
    accuracy : mapping of str to float, optional
        Largest error over the outputs by quantity, such as ``{"payload_position": 0.01}``, in its unit; the
        quantities are those of `seacrane.trade`, extremes such as "hook_load.max", and "event_times" (s).
        Integrator and tolerance are then chosen, and a second,
        cheap run tells the error: leave integrator, rtol, dt and controllers out. The estimate of what is
        left of the integration error is in `stats`, as "error_estimate_<quantity>".
    progress : bool
        Show a progress bar.
    **shorthand
        Attributes of `Method` and `Outputs` by name, for calls that name few of them. One that contradicts
        the object is refused.

    Returns
    -------
    Result
        With `interrupted` set, and the outputs until then, when Ctrl-C stopped the run.

    Raises
    ------
    SceneError
        For a scene or setting that makes no sense.
    SimulationError
        When the integration cannot continue, a controller raises, or memory runs out; it says where, when and
        what to try. Its `result` holds the outputs until then.

    Warns
    -----
    LargeHeelWarning, MeanPositionWarning, MeanHeadingWarning, ForwardSpeedWarning, MooringTurnWarning,
    NoWaveLoadsWarning, OutsideDatabaseWarning, PushingLinkWarning, LineLengthWarning, LineTableWarning,
    FleetAngleWarning, PushingLineWarning, WinchLimitWarning, FullTurnWarning, OutsideRangeWarning,
    SoftGainsWarning, EnergyErrorWarning, NearSingularWarning, LargeSwingWarning, OverloadWarning,
    CurrentInWavesWarning
        After the run, when its motions left the range in which the models hold; also in `stats`, as
        "validity". See docs/troubleshooting.md.
    StiffWarning
        After a slow run, when one fast mode set the steps of its explicit method; in `stats` likewise.
    GrowingModeWarning
        After a long run, when its method fed an oscillation with little damping; in `stats` likewise.
    LineRungWarning
        After a second run, with elastic lines, in the place of one in which a line with rung="auto" went
        slack; in `stats` likewise.
    DriverImpulseWarning, AngleUnitWarning, CompassDirectionWarning, MassUnitWarning, BallastWarning,
    LoadInHullWarning, FreeCraneWarning, ContactStartWarning, LiftedStartWarning, QuasiStaticLineWarning,
    ScatteredWavesWarning, DragAxesWarning
        Before it, when the description most likely does not say what was meant. See docs/mistakes.md.
    """
    called = checked_controllers(controllers)
    if accuracy is not None:
        return run_to_accuracy(
            lambda recorded: case_of_run(
                scene, t_end, accuracy, outputs=recorded, start=start, progress=progress
            ),
            method=method, outputs=outputs, shorthand=shorthand, controllers=called,
        )  # fmt: skip
    run = Run(scene, t_end, method=method, outputs=outputs, start=start, controlled=bool(called), **shorthand)
    return finished(run, called, progress=progress)
