"""simulate(), simulate_stages(): a scene or a lift run by a method, or by what an accuracy asks for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from seacrane.accuracy.case import case_of_run, case_of_stages
from seacrane.accuracy.choice import run_to_accuracy
from seacrane.inputs.keywords import named
from seacrane.result.result import Result
from seacrane.run.advance import finished
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.run.sampled_controller import SampledController, checked_controllers
from seacrane.run.shorthand import Shorthand
from seacrane.run.stage import Stage
from seacrane.run.staged_run import StagedRun
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


@named
def simulate_stages(
    scene: Scene,
    stages: Sequence[Stage],
    *,
    start: Start = None,
    first: str | None = None,
    method: Method | None = None,
    outputs: Outputs | None = None,
    controllers: Sequence[SampledController] = (),
    accuracy: Mapping[str, float] | None = None,
    **shorthand: Unpack[Shorthand],
) -> Result:
    """Carry out a lift stage by stage and return one result.

    The clock and the waves go on through the stages. An element that a stage connects is absent until then.
    See docs/stages.md.

    Parameters
    ----------
    scene : Scene
        With everything that is ever connected.
    stages : sequence of Stage
        In their order.
    start : State or "rest", optional
        Where the first of them begins, or the word for the state at rest; default: the assembled start of the
        scene.
    first : str, optional
        Name of a stage to begin with. Those before it are carried out in calm water, and it starts from the
        static state there, unless a state is given as `start`.
    method, outputs, **shorthand
        As `simulate`. Channels are recorded in the stages that have them.
    controllers : sequence of SampledController
        As `simulate`; their periods count from the first start, through all stages. Inputs of elements that
        are absent in a stage are left out there.
    accuracy : mapping of str to float, optional
        As `simulate`; also the times of a stage, such as ``{"stage[lift].end": 0.01}``, s. Curves are
        compared at equal phase of a stage, and "error_estimate_event_times" in `stats` tells how far events
        are off in time; docs/trade.md says what is promised.

    Returns
    -------
    Result
        With `stages`, an event for each stage, connection and release, and `interrupted` set when Ctrl-C
        stopped it. In stages without an element, its forces and powers are 0 and its other channels
        are NaN.

    Raises
    ------
    SceneError
        For stages that do not fit the scene or one another, by their names; for one before `first` that is
        not over in calm water.
    SimulationError
        As `simulate`, and for a stage that is not over within its `maximum_duration`. Its `result`
        holds the outputs until then.

    Warns
    -----
    As `simulate`, each kind once.
    """
    if accuracy is not None:
        return run_to_accuracy(
            lambda recorded: case_of_stages(
                scene, stages, accuracy, outputs=recorded, start=start, first=first
            ),
            method=method, outputs=outputs, shorthand=shorthand, controllers=controllers,
        )  # fmt: skip
    run = StagedRun(
        scene, stages, start=start, first=first, method=method, outputs=outputs, controllers=controllers,
        **shorthand,
    )  # fmt: skip
    while run.advance():
        pass
    run.warn()
    return run.result()
