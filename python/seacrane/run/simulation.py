"""simulate(): compile a scene, run the C++ loop, return a Result."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.linearise import fastest_mode
from seacrane.description.file_origin import roles_to_data
from seacrane.description.joint_coordinates import ANGLES
from seacrane.description.origin import origin_settings
from seacrane.description.references import check_references
from seacrane.errors import SceneError, SeacraneError, SimulationError
from seacrane.files.plain_data import plain_notes
from seacrane.inputs.checked import number_of, numbers_of
from seacrane.run.channel_names import core_channels, hanging_bodies, named_channels, names_along
from seacrane.run.formulation_cost import recursive_pays
from seacrane.run.interrupts import Interrupts
from seacrane.run.output_times import output_times
from seacrane.run.sampled_controller import (
    SampledController,
    called_at,
    checked_controllers,
    next_call,
    only_setter,
)
from seacrane.run.step_advice import step_advice
from seacrane.run.stiffness import stiffness
from seacrane.scene.scene import Scene
from seacrane.validity.plausible import warn_of_description
from seacrane.validity.range import Finding, as_text, findings, warn_of
from seacrane.version import __version__

if TYPE_CHECKING:
    from seacrane.result import Event, Result

Array = NDArray[np.float64]
DEFAULT_INTEGRATOR, DEFAULT_RTOL = "dopri5", 1e-6
FORMULATIONS = ("auto", "recursive", "redundant")
BAUMGARTE = 5.0  # 1/s, of methods that cannot project


def _step(name: str, value: Any) -> float:
    """A step length in s, 0 for the default."""
    step = number_of(name, value)
    if not (np.isfinite(step) and step >= 0.0):
        raise SceneError(f"{name} is {step} s; give a finite positive number, or 0 for the default")
    return step


def _slots(scene: Scene) -> dict[str, slice]:
    """Places of the inputs, in the order in which the core numbers them."""
    out: dict[str, slice] = {}
    at = 0
    for name in scene.actuators:
        out[f"{name}.force"], out[f"{name}.reference"] = slice(at, at + 1), slice(at + 1, at + 2)
        at += 2
    for name in scene.point_forces:
        out[f"{name}.force"] = slice(at, at + 3)
        at += 3
    return out


def _steered(scene: Scene, inputs: Array) -> set[str]:
    """Actuators whose inputs are not zero."""
    pairs = np.reshape(np.asarray(inputs)[: 2 * len(scene.actuators)], (-1, 2))
    return {name for name, pair in zip(scene.actuators, pairs, strict=True) if np.any(pair != 0.0)}


class Run:
    """One run of a compiled scene, to be advanced piece by piece.

    Parameters
    ----------
    scene : Scene
    model : Model, optional
        The compiled scene, to save compiling it again.
    t_end, dt_out, integrator, rtol, dt, max_step, spectral_radius, energy_limit, formulation, channels, start
        As `simulate`.
    outputs_from : float, optional
        Time from which output times are counted, s, not after the start; default: the start. A run that goes
        on from a `start` so records at the times at which the run before it would have.
    capacity : int
        Outputs to take memory for; 0: all.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        t_end: float,
        dt_out: float = 0.1,
        integrator: str = DEFAULT_INTEGRATOR,
        rtol: float = DEFAULT_RTOL,
        dt: float = 0.0,
        max_step: float = 0.0,
        spectral_radius: float | None = None,
        energy_limit: float | None = None,
        formulation: str = "auto",
        channels: Sequence[str] | None = None,
        start: _core.State | None = None,
        outputs_from: float | None = None,
        capacity: int = 0,
        model: _core.Model | None = None,
    ) -> None:
        model = scene.compile() if model is None else model
        if not isinstance(integrator, str):
            raise SceneError(
                f"integrator is {integrator!r}; choose one of {', '.join(_core.integrator_names())}"
            )
        method = _core.integrator(integrator)
        self.formulation = _formulation(formulation, model, method)
        if (
            not method.projects
            and self.formulation == "redundant"
            and scene.baumgarte == 0.0
            and scene.joints
        ):
            scene = scene.copy(baumgarte=BAUMGARTE)
            model = scene.compile()
        if integrator == "ida":
            _refuse_redundant_joints(model)
        self.scene = scene
        self.model = model
        known = self.model.channel_names(defaults_only=False)
        if channels is not None and (isinstance(channels, str) or not isinstance(channels, Iterable)):
            raise SceneError(f"channels is {channels!r}; give a list of channel names")
        wanted = self.model.channel_names() if channels is None else list(channels)
        self._wanted = None if channels is None else set(wanted)
        self.start = _core.initial_state(self.model) if start is None else start
        if not isinstance(self.start, _core.State):
            raise SceneError(f"start is {start!r}; give a seacrane.State")
        t_end, dt_out, rtol = number_of("t_end", t_end), number_of("dt_out", dt_out), number_of("rtol", rtol)
        dt, max_step = _step("dt", dt), _step("max_step", max_step)
        if spectral_radius is not None:
            spectral_radius = number_of("spectral_radius", spectral_radius)
        self.t_end = t_end
        self.first = self.start.time if outputs_from is None else number_of("outputs_from", outputs_from)
        self.settings: dict[str, Any] = {
            "t_end": float(t_end), "dt_out": float(dt_out), "rtol": float(rtol), "dt": float(dt),
            "max_step": float(max_step), "orientation": scene.orientation, "baumgarte": scene.baumgarte,
        }  # fmt: skip
        self.settings |= origin_settings(scene)
        if scene.notes:
            self.settings["notes"] = plain_notes(scene.name, scene.notes)
        if spectral_radius is not None:
            self.settings["spectral_radius"] = spectral_radius
        if energy_limit is not None:
            self.settings["energy_limit"] = energy_limit = number_of("energy_limit", energy_limit)
            if not energy_limit > 0.0:
                raise SceneError(f"energy_limit is {energy_limit}; give a positive number, such as 1e-3")
        described = start is None
        check_references(scene, model, start=self.start.time, end=t_end, described=described)
        warn_of_description(scene, start=self.start.time, end=t_end, described=described)
        made_of = core_channels(wanted, known)
        values = self.model.channel_values(made_of)
        outputs = output_times(
            self.start.time, self.t_end, float(dt_out), first=self.first, values=0 if capacity else values
        )
        self.integrator = integrator
        self.core = _core.Simulation(
            model=self.model, start=self.start, integrator=integrator, rtol=float(rtol), dt=float(dt),
            max_step=float(max_step), output_times=outputs, channels=made_of, formulation=self.formulation,
            spectral_radius=spectral_radius, energy_limit=energy_limit or 0.0, capacity=capacity,
        )  # fmt: skip
        if scene.waves is not None:
            scene.waves.warn_of_repeats(self.t_end - self.start.time)
        self.interrupted = False
        self.steered = _steered(scene, self.start.inputs)
        self.found: list[Finding] = []  # out of range, as the last result tells
        self.slow: list[Finding] = []  # what made the run slow, known at its end
        self._require_plain_stats()

    def __repr__(self) -> str:
        return f"<Run of {self.scene.name!r}: {self.formulation}, {self.integrator}, at {self.core.time:g} s>"

    def advance(self, t_end: float, progress: Callable[[float], None] | None = None) -> bool:
        """Step to t_end (s); False when Ctrl-C stopped it."""
        if not self.core.advance(float(t_end), progress):
            self.interrupted = True
        return not self.interrupted

    @property
    def state(self) -> _core.State:
        """The present state: a copy, to go on from by ``Run(scene, start=...)``."""
        return self.core.state

    def measure(self) -> dict[str, Array]:
        """All channels at the present instant, by the names of a result."""
        arrays = self.core.snapshot()
        named = self._channels(arrays)
        return {name: values[0] for name, values in named.items()}

    def set_inputs(self, values: Mapping[str, Any]) -> None:
        """Set inputs by name from now on; see `SampledController`."""
        places = _slots(self.scene)
        with self.core:
            self._set_inputs(values, places)

    def _set_inputs(self, values: Mapping[str, Any], places: Mapping[str, slice]) -> None:
        slots = np.array(self.core.state.inputs)
        for name, value in values.items():
            if name not in places:
                raise SceneError(f"input {name!r} is unknown; this scene has: {', '.join(places) or 'none'}")
            new = np.atleast_1d(numbers_of(f"input {name!r}", value))
            if new.shape != slots[places[name]].shape or not np.isfinite(new).all():
                raise SceneError(
                    f"input {name!r} is {value!r}; give {slots[places[name]].size} finite number(s)"
                )
            self._check_turn(name, float(new[0] - slots[places[name]][0]))
            slots[places[name]] = new
        self.core.set_inputs(slots)
        self.steered |= _steered(self.scene, slots)

    def _check_turn(self, name: str, jump: float) -> None:
        """An actuator takes the turn of an angle that is nearest to its reference."""
        owner, _, kind = name.rpartition(".")
        if kind == "reference" and self.scene.actuators[owner].coordinate in ANGLES and abs(jump) >= np.pi:
            raise SceneError(
                f"input {name!r} jumps by {np.degrees(jump):.6g} deg, half a turn or more: it would turn the "
                "short way; lead it there in smaller steps"
            )

    def _channels(self, arrays: dict[str, Array]) -> dict[str, Array]:
        return named_channels(self.scene, {k: v for k, v in arrays.items() if k != "time"})

    def stats(self) -> dict[str, Any]:
        """Version, settings and counters so far: `Result.stats`."""
        statistics = self.core.statistics()
        scene, model, tree = self.scene, self.model, self.model.tree
        recursive = self.formulation == "recursive"
        sea = {} if scene.waves is None else scene.waves.provenance.stats()
        return {
            "seacrane_version": __version__,
            "scene": scene.name,
            "payload": "\n".join(hanging_bodies(scene)) or None,
            "cranes": json.dumps([roles_to_data(roles) for roles in scene.roles.values()])
            if scene.roles
            else None,
            "formulation": self.formulation,
            "integrator": self.integrator,
            "settings": self.settings,
            "simulated_s": self.core.time - self.start.time,
            "coordinates": model.coordinates,
            "constraints": model.constraints,
            "degrees_of_freedom": model.degrees_of_freedom,
            "compiled_coordinates": tree["speeds"] if recursive else model.merge["coordinates"],
            "compiled_constraints": tree["loop_rows"] if recursive else model.merge["constraints"],
            "memory_states": model.memory_states,
            "history_samples": model.history_samples,
            **statistics,
            **sea,
        }

    def _require_plain_stats(self) -> None:
        """What a result could not hold is refused now, not when the run is over."""
        from seacrane.result.result import checked_stats

        try:
            checked_stats(self.stats())
        except ValueError as error:
            raise SceneError(f"scene {self.scene.name!r}: {error}") from error

    def events(self) -> list[Event]:
        """What limits did so far."""
        from seacrane.result import Event

        return [
            Event(time=time, name=name, kind=kind, speed=speed, impulse=impulse, energy_lost=lost)
            for time, name, kind, speed, impulse, lost in self.core.events()
        ]

    def judged(self, found: list[Finding]) -> list[Finding]:
        """What is out of range in all of the run, of what is in the outputs at hand."""
        return found

    def result(self, most: int | None = None) -> Result:
        """What has been recorded so far; with `most`, no more than its first outputs, and no state."""
        with self.core:
            return self._result(most)

    def _result(self, most: int | None) -> Result:
        from seacrane.result import Result

        arrays = self.core.channels() if most is None else self.core.channels(most)
        channels = self._channels(arrays)
        if self._wanted is not None:
            channels = {name: values for name, values in channels.items() if name in self._wanted}
        scene, stats = self.scene, self.stats()
        found = findings(scene, arrays["time"], channels, stats, self.steered)
        self.found = self.judged(found + self.slow)
        if self.found:
            stats["validity"] = as_text(self.found)
        return Result.from_arrays(
            time=arrays["time"],
            arrays=channels,
            **names_along(scene, self.model),
            events=self.events(),
            stats=stats,
            interrupted=self.interrupted,
            state=self.last_state() if most is None else None,
        )

    def look_for_stiffness(self) -> None:
        """Find what made the run slow, where one mode did."""
        last = self.last_state()
        states = [self.start] if last is None else [self.start, last]
        self.slow = stiffness(self.model, list(self.scene.bodies), states, self.stats())
        self.found = self.judged(self.slow)

    def last_state(self) -> _core.State | None:
        """The present state, or None where its rate cannot be found."""
        try:
            return self.core.state
        except SeacraneError:
            return None

    def _steps(self) -> int:
        return int(self.core.statistics()["steps"])

    def explain(self, error: BaseException) -> None:
        """Hang what has been recorded on an error that ends the run, and what its fixed step could be."""
        self.interrupted = True
        advice = ""
        if isinstance(error, SimulationError) and _core.integrator(self.integrator).stable_up_to:
            step = self.settings["dt"] or (self.core.time - self.start.time) / max(self._steps(), 1)
            advice = step_advice(self.integrator, step, fastest_mode(self.model))
        if advice:
            error.args = (f"{error}. {advice}",)
        with contextlib.suppress(MemoryError, AttributeError):  # errors of others that take no attributes
            error.result = self.result()  # type: ignore[attr-defined]


def _refuse_redundant_joints(model: _core.Model) -> None:
    """SceneError where joints that are stepped depend on each other: `ida` solves for each multiplier."""
    stepped = [name for name in model.redundant if name not in model.merge["dropped"]]
    if stepped:
        raise SceneError(
            f"integrator 'ida' is not available here: the joints {', '.join(stepped)} are redundant, and it "
            "solves for every reaction; give one of them more freedom, or choose a method that projects, as "
            "'cvode-bdf' does"
        )


def _formulation(asked: str, model: _core.Model, method: _core.Integrator) -> str:
    """The formulation to step; SceneError for a combination that does not exist."""
    if asked not in FORMULATIONS:
        raise SceneError(f"formulation {asked!r} is unknown; choose {', '.join(FORMULATIONS)}")
    reason = None
    if method.residual_form:
        reason = f"integrator {method.name!r} solves the redundant equations"
    elif model.paper_kinematics:
        reason = "kinematics 'paper' has no symmetric mass matrix"
    elif model.baumgarte > 0.0:
        reason = "Baumgarte stabilisation belongs to the redundant equations"
    elif model.euler_angles:
        reason = "orientation 'euler_xyz' is a choice of the redundant state"
    elif not method.projects and (model.tree["loop_rows"] or model.limits):
        reason = f"integrator {method.name!r} cannot project, and this scene keeps constraints or limits"
    elif model.tree["speeds"] == 0:
        reason = "the joints of this scene leave nothing to move"
    if asked == "recursive" and reason:
        raise SceneError(f"formulation 'recursive' is not available here: {reason}; choose 'redundant'")
    if asked == "auto":
        if reason:
            return "redundant"
        return "recursive" if model.tree["loop_rows"] == 0 or recursive_pays(model) else "redundant"
    return asked


def _progress(
    t_start: float, t_end: float, wanted: bool
) -> tuple[Callable[[float], None] | None, Callable[[], None]]:
    if not wanted:
        return None, lambda: None
    from tqdm.auto import tqdm

    bar = tqdm(total=round(t_end - t_start, 3), unit="s", desc="simulated")
    return (lambda time: bar.update(round(time - t_start - bar.n, 3)) and None), bar.close


def simulate(
    scene: Scene,
    *,
    t_end: float = 100.0,
    dt_out: float = 0.1,
    integrator: str | None = None,
    rtol: float | None = None,
    dt: float | None = None,
    max_step: float = 0.0,
    spectral_radius: float | None = None,
    energy_limit: float | None = None,
    formulation: str = "auto",
    channels: Sequence[str] | None = None,
    controllers: Sequence[SampledController] = (),
    start: _core.State | None = None,
    accuracy: Mapping[str, float] | None = None,
    progress: bool = False,
) -> Result:
    """Simulate a scene and return its recorded channels.

    Parameters
    ----------
    scene : Scene
    t_end : float
        End time, s.
    dt_out : float
        Output interval, s. Outputs are interpolated, projected, then evaluated; they never shorten steps.
    integrator : str, optional
        Default "dopri5"; or any other of `seacrane.integrator_names()`; the table in docs/integrators.md
        tells them apart.
    rtol : float, optional
        Local error per step over the scale of each state (0.1 m, 0.01 rad, 0.1 m/s, 0.01 rad/s; lengths
        times `scene.length_scale`): absolute, so that results do not depend on where the origin is. Default
        1e-6.
    dt : float, optional
        Step of fixed-step methods, s; default, or 0: the method's own.
    max_step : float
        Longest step, s; 0 sets no limit.
    spectral_radius : float, optional
        What is left after a step of "generalized-alpha" of a motion far too fast for it: 1 damps nothing,
        0 all in one step; default 0.8. Other integrators have none.
    energy_limit : float, optional
        Stops the run at the first output where `energy_balance` exceeds this share of the absolute work and
        the largest kinetic energy until then; default: never. Not for the paper's kinematics.
    formulation : str
        "redundant": six velocities per body and multipliers, the paper's. "recursive": the same motion in
        the coordinates of a tree of bodies, cylinder loops in closed form, other loops by a small block of
        constraints; several times faster. "auto" (default) takes it where it leaves no constraints, or where
        the redundant one would be solved densely at far more cost, and the integrator allows.
    channels : sequence of str, optional
        What to record; default: all default channels of the scene.
    controllers : sequence of SampledController
        Called at their periods from the start on.
    start : State, optional
        Where to go on from; default: the assembled start of the scene.
    accuracy : mapping of str to float, optional
        Largest error over the outputs by quantity, such as ``{"payload_position": 0.01}``, in its unit; the
        quantities are those of `seacrane.trade`. Integrator and tolerance are then chosen, and a second,
        cheap run tells the error: leave integrator, rtol, dt and controllers out. The estimate of what is
        left of the integration error is in `stats`, as "error_estimate_<quantity>".
    progress : bool
        Show a progress bar.

    Returns
    -------
    Result
        With `interrupted` set, and the outputs until then, when Ctrl-C stopped the run.

    Raises
    ------
    SceneError
        For a scene or setting that makes no sense.
    SimulationError
        When the integration cannot go on, a controller raises, or memory runs out; it says where, when and
        what to try. Its `result` holds the outputs until then.

    Warns
    -----
    LargeHeelWarning, MeanPositionWarning, MeanHeadingWarning, ForwardSpeedWarning, MooringTurnWarning,
    NoWaveLoadsWarning, OutsideDatabaseWarning, PushingLinkWarning, FullTurnWarning, OutsideRangeWarning,
    SoftGainsWarning, NearSingularWarning
        After the run, when its motions left the range in which the models hold; also in `stats`, as
        "validity". See docs/troubleshooting.md.
    StiffWarning
        After a slow run, when one fast mode set the steps of its explicit method; in `stats` likewise.
    DriverImpulseWarning, AngleUnitWarning, CompassDirectionWarning, MassUnitWarning, BallastWarning
        Before it, when the description most likely does not say what was meant. See docs/mistakes.md.
    """
    controllers = checked_controllers(controllers)
    given = {"integrator": integrator, "rtol": rtol, "dt": dt, "spectral_radius": spectral_radius}
    chosen: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if accuracy is not None:
        from seacrane.trading.accuracy import simulate_to_accuracy

        _refuse_beside_accuracy(chosen, controllers)
        return simulate_to_accuracy(
            scene, accuracy, channels=channels, progress=progress, t_end=t_end, dt_out=dt_out,
            max_step=max_step, formulation=formulation, start=start, energy_limit=energy_limit,
        )  # fmt: skip
    run = Run(
        scene, t_end=t_end, dt_out=dt_out, max_step=max_step, formulation=formulation, channels=channels,
        start=start, energy_limit=energy_limit, **chosen,
    )  # fmt: skip
    return finished(run, controllers, progress=progress)


def _refuse_beside_accuracy(chosen: Mapping[str, Any], controllers: Sequence[SampledController]) -> None:
    if chosen:
        named = ", ".join(f"{name}={value!r}" for name, value in chosen.items())
        raise SceneError(
            f"accuracy chooses integrator, rtol and dt itself, and {named} is given too: leave one out"
        )
    if controllers:
        raise SceneError(
            "accuracy runs the scene more than once, which a sampled controller may not allow: leave out "
            "controllers or accuracy"
        )


def finished(run: Run, controllers: Sequence[SampledController] = (), *, progress: bool = False) -> Result:
    """Advance a run to its end, or to where Ctrl-C stops it, and return its result."""
    with Interrupts() as interrupts:
        drive(run, controllers, interrupts, progress=progress)
        result = run.result()
    warn_of(run.found)
    return result


def drive(
    run: Run, controllers: Sequence[SampledController], interrupts: Interrupts, *, progress: bool = False
) -> None:
    """Advance a run to its end, or to where Ctrl-C stops it.

    What ends it otherwise is raised as by `simulate`, and carries what `Run.explain` hangs on it.
    """
    report, close = _progress(run.start.time, run.t_end, progress)
    try:
        _advance(run, run.t_end, controllers, interrupts, report)
    except KeyboardInterrupt:  # between two pieces of the loop, or inside a controller
        run.interrupted = True
    except MemoryError as error:
        stopped = SimulationError(
            f"run: memory ran out at t = {run.core.time:.6g} s; record fewer channels, or a longer dt_out"
        )
        run.explain(stopped)
        raise stopped from error
    except BaseException as error:  # also what another signal's handler raises
        run.explain(error)
        raise
    finally:
        close()
    if not run.interrupted:
        run.look_for_stiffness()


def _advance(
    run: Run,
    t_end: float,
    controllers: Sequence[SampledController],
    interrupts: Interrupts,
    report: Callable[[float], None] | None,
) -> None:
    def look(now: float) -> None:
        if report is not None:
            report(now)
        interrupts.take()

    due = [run.start.time for _ in controllers]
    setters: dict[str, SampledController] = {}
    while True:
        interrupts.take()
        now = run.core.time
        called: dict[str, Any] = {}
        for i, controller in enumerate(controllers):
            if due[i] <= now and now < t_end:
                with interrupts.at_once():
                    inputs = called_at(controller, now, run.measure)
                only_setter(inputs, controller, setters)
                called.update(inputs)
                due[i] = next_call(controller, now, run.start.time)
        if called:
            run.set_inputs(called)
        stop = min([t_end, *due])
        if not run.advance(stop, look) or stop >= t_end:
            return
