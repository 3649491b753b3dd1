"""A lift carried out stage by stage."""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from seacrane import _core
from seacrane.analysis.after_run import Finding, as_text, warn_of
from seacrane.analysis.implausible import check_contact_connected, warn_of_description
from seacrane.analysis.line_checks import warn_of_connected
from seacrane.description.channels import COUNTED_ON, OWN
from seacrane.description.compilation import compiled_in_sea
from seacrane.description.description import LOADS
from seacrane.description.given import in_calm_water
from seacrane.description.holding import decided
from seacrane.description.loads import lines_of
from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.caller import keeping, silently
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.result.about import Event, StageSpan
from seacrane.result.result import Result
from seacrane.run.carried_state import carried
from seacrane.run.carry import (
    MOST_RUNS,
    AlikeStages,
    Begin,
    Key,
    There,
    compiled_there,
    lifted_seats,
    redescribed,
    rest_after,
)
from seacrane.run.channel_names import all_names, require_channels
from seacrane.run.commands import commanded
from seacrane.run.interrupts import Interrupts
from seacrane.run.joined import Piece, counted, joined
from seacrane.run.locate import Course, to_its_end
from seacrane.run.method import (
    REST,
    Method,
    Shorthand,
    Start,
    core_options,
    formulation_of,
    settled,
    start_state,
)
from seacrane.run.outputs import Outputs
from seacrane.run.plan import check_limits, checked_stages, waiting, without
from seacrane.run.run import Run
from seacrane.run.sampled_controller import Calls, SampledController, checked_controllers
from seacrane.run.stage import Level, Stage
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack

LARGEST_GAP = 0.01  # m times the scene's length scale, or rad: joints that open wider do not connect


class StagedRun:
    """A lift to be carried out stage by stage; see `simulate`.

    Parameters
    ----------
    scene : Scene
    stages : sequence of Stage
    start, first, method, outputs, controllers, **shorthand
        As `simulate`.
    outputs_from, peaks
        As of `Run`: the time from which output times are counted, s, and whose peaks are asked for.
    before : sequence of (warning, str)
        What was out of range before the start; it is told with what is in the stages.
    alike : AlikeStages, optional
        Of lifts that differ in their seas alone: what one of them found is not looked for again.

    Attributes
    ----------
    stages : tuple of Stage
        Those that are carried out.
    state, scene, model
        The present state, and what is there at present.
    begun : dict of str to Begin
        Scene and state in which each stage began.
    interrupted : bool
        Whether Ctrl-C stopped it.
    """

    def __init__(
        self,
        scene: Scene,
        stages: Sequence[Stage],
        *,
        start: Start = None,
        first: str | None = None,
        outputs_from: float | None = None,
        peaks: Collection[str] | None = None,
        before: Sequence[Finding] = (),
        alike: AlikeStages | None = None,
        method: Method | None = None,
        outputs: Outputs | None = None,
        controllers: Sequence[SampledController] = (),
        **shorthand: Unpack[Shorthand],
    ) -> None:
        self.method, self.outputs = settled(method, outputs, shorthand)
        scene = decided(scene)
        every = checked_stages(scene, stages)
        names = [stage.name for stage in every]
        if first is not None and first not in names:
            raise SceneError(f"first is {shown(first)}; the stages are {', '.join(names)}")
        count = 0 if first is None else names.index(first)
        self.stages, self._given, self._whole = every[count:], scene, scene.copy()
        begin: Start = REST if start is None and first is not None else start
        if count:
            there = start if isinstance(start, _core.State) else None
            with silently():  # of what the lift itself tells
                calm = StagedRun(
                    in_calm_water(scene), every, start=start if there is None else None, method=self.method,
                    outputs=Outputs(dt_out=self.outputs.dt_out, channels=()), controllers=controllers,
                )  # fmt: skip
            rest = rest_after(calm.carried_to(count), self.stages, scene, there)
            self._whole, begin = rest.scene, rest.state
        require_channels(self._whole, self.outputs.channels or ())
        self._absent = waiting(self.stages)
        self.scene = without(self._whole, self._absent)
        self._alike = AlikeStages() if alike is None else alike
        self._shares = alike is not None and scene.waves is not None
        if not self._shares or self._alike.model is None:
            time = begin.time if isinstance(begin, _core.State) else 0.0
            self._warn_of_description(time, start, begins=first is None)
        if count:
            self.model = compiled_there(self.scene)
        elif self._shares and self._alike.model is not None:
            self.model = compiled_in_sea(self.scene, self._alike.model)
        else:
            self.model = self._alike.model = self.scene.compile()
        begin = start_state(self.scene, begin)
        self.state = _core.initial_state(self.model) if begin is None else begin
        self._described = begin is None
        self._reached = self._counted()
        self._first = self.state.time if outputs_from is None else number_of("outputs_from", outputs_from)
        self._calls = Calls(
            checked_controllers(controllers), self._first, start=self.state.time, kept=self._kept
        )
        self._peaks = peaks
        self._pieces: list[Piece] = []
        self._changes: list[Event] = []
        self._open: tuple[Run, dict[str, Any]] | None = None
        self._found, self._before = list(before), tuple(before)
        self._spans: list[StageSpan] = []
        self.begun: dict[str, Begin] = {}
        self.interrupted = False

    def _warn_of_description(self, begin: float, start: Any, *, begins: bool) -> None:
        """What `simulate` tells of a scene: what is said of the pose is of what is there then."""
        end = begin + sum(one.duration or one.maximum_duration or 0.0 for one in self.stages)
        whole, there = self._whole, without(self._whole, self._absent)
        begins = begins and (start is None or (isinstance(start, str) and start == REST))
        with keeping(whole.warned):
            warn_of_description(whole, start=begin, end=end, described=False, begins=begins)
            warn_of_description(there, start=begin, end=end, described=begins and start is None, begins=False)

    def __repr__(self) -> str:
        done = f"{len(self._spans)} of {len(self.stages)} stages"
        return f"<StagedRun of {self._given.name!r}: {done}, at {self.state.time:g} s>"

    def advance(self) -> bool:
        """Carry out the next stage; False when none is left, or Ctrl-C stopped it.

        Raises
        ------
        SceneError
            For a connection, command or condition that does not fit; the message names the stage.
        SimulationError
            As `simulate`, and for a stage that is not over within its `maximum_duration`. Either has
            as its `result` what was recorded until then.
        """
        with Interrupts() as interrupts:
            for _ in self.carry_out(interrupts):
                pass
        return not self._over

    def carried_to(self, count: int) -> There:
        """Carry out so many stages, and tell where that leads; SceneError for one that fails."""
        first = self.stages[count].name
        for stage in self.stages[:count]:
            try:
                with silently():
                    self.advance()
            except (SceneError, SimulationError) as error:
                raise SceneError(
                    f"first is {first!r}, and {stage.title} before it is carried out in calm water, where it "
                    f"fails: {error}. Or give start=, the state in which {first!r} begins"
                ) from error
            if self.interrupted:
                raise KeyboardInterrupt
        return There(
            whole=self._whole, absent=frozenset(self._absent), scene=self.scene, model=self.model,
            state=self.state,
        )  # fmt: skip

    @property
    def _over(self) -> bool:
        return self.interrupted or len(self._spans) == len(self.stages)

    def runs(self, interrupts: Interrupts) -> Iterator[Run]:
        """Carry out all stages that are left, as `advance` does; KeyboardInterrupt where Ctrl-C stopped it.

        Each run is told before it is stepped, so that it can be stepped beside those of other lifts.
        """
        while not self._over:
            yield from self.carry_out(interrupts)
        if self.interrupted:
            raise KeyboardInterrupt

    def carry_out(self, interrupts: Interrupts) -> Iterator[Run]:
        """The runs of the next stage, each before it is stepped; none where none is left."""
        if self._over:
            return
        stage, begin = self.stages[len(self._spans)], self.state.time
        later = waiting(self.stages[len(self._spans) :])
        self.begun[stage.name] = Begin(without(self._whole, self._absent - later), self.state)
        try:
            self._changes.append(Event(time=begin, name=stage.name, kind="stage"))
            self._connect(stage)
            # The run of the same stage of an alike lift that began at the same time, in this sea.
            known = self._alike.runs.get(self._key(stage)) if self._shares else None
            like = None if known is None or self.scene.waves is None else known.in_sea(self.scene.waves)
            if stage.commands:
                self._whole = commanded(self._whole, stage.title, stage.commands, begin)
                self.scene = without(self._whole, self._absent)
                self.model = compiled_there(self.scene) if like is None else like.model
            check_limits(stage, self.scene)
            try:
                course = self._course(stage, interrupts, like)
                ended = yield from to_its_end(course, stage, self.state)
            except SceneError as error:
                error.args = (f"{stage.title}: {error}", *error.args[1:])
                raise
            if not self._pieces:  # met at once, or stopped before anything was stepped
                run = course.run(self.state, self.state.time)
                self._began(run)
                self._done(run)
        except GeneratorExit:  # nobody asks for the rest
            self.interrupted = True
            raise
        except BaseException as error:
            now = self.state.time if self._open is None else self._open[0].core.time
            self._spans.append(StageSpan(name=stage.name, start=begin, end=now, ended_by=""))
            self.interrupted = True
            with contextlib.suppress(MemoryError, AttributeError):  # errors of others take no attributes
                if self._open is not None and self._open[0].core.recorded:
                    self._open[0].interrupted = True
                    self._done(self._open[0])
                error.result = self.result() if self._pieces else None  # type: ignore[attr-defined]
            raise
        self._spans.append(StageSpan(name=stage.name, start=begin, end=self.state.time, ended_by=ended))
        self.interrupted = not ended

    def result(self) -> Result:
        """All that has been recorded so far; `interrupted` until the last stage is over.

        Raises
        ------
        SceneError
            Before anything was.
        """
        if not self._pieces:
            raise SceneError("stages: nothing has been recorded yet; advance() them first")
        return joined(
            self._pieces, scene=self._given, spans=self._spans,
            interrupted=self.interrupted or len(self._spans) < len(self.stages), after=self._changes,
            before=as_text(self._before),
        )  # fmt: skip

    def warn(self) -> None:
        """Warn, at the user's line, of what was out of range in the stages, each kind once."""
        warn_of({kind: (kind, text) for kind, text in reversed(self._found)}.values())

    def _counted(self) -> dict[str, Any]:
        """Energy balance and losses at the present state, from the start that its record tells of."""
        record = self.state.record
        if record is None:
            return dict.fromkeys(COUNTED_ON, 0.0)
        model = self.scene.compile() if self.model is None else self.model
        formulation = formulation_of(model, self.method)
        options = core_options(self.method, formulation, channels=set(), output_times=[])
        core = _core.Simulation(model=model, start=self.state, options=options)
        now = counted(self.scene, model, core.snapshot())
        return {"energy_balance": 0.0, "impact_loss": record.impact_loss} | {
            name: value for name, value in now.items() if name in COUNTED_ON
        }

    def _connect(self, stage: Stage) -> None:
        for name in stage.release:
            self._absent.add(name)
            self._change(stage, name, "release")
        for name in stage.connect:
            self._absent.discard(name)
            if name in self._whole.joints:
                self._shares = False
                self._absent |= lifted_seats(self.scene, self.state)
                still = self._still(self.scene, self.model, self.state)
                self._whole = redescribed(self._whole, still.measure(), self.state)
            self._change(stage, name, "connection")

    def _still(self, scene: Scene, model: _core.Model, state: _core.State) -> Run:
        """A run that stands at a state: on its joints, with the limits that hold there."""
        return Run(scene, state.time, method=self.method, start=state, model=model)

    def _change(self, stage: Stage, name: str, kind: str) -> None:
        """Go over to the scene with a connection made or released, and note the energy that it took."""
        scene = without(self._whole, self._absent)
        model = compiled_there(scene)
        start, speed = carried(self.state, self.model, model), 0.0
        if kind == "connection" and name in scene.joints:
            gap, speed = _core.Evaluator(model).residual(start.time, start.values)
            if gap > LARGEST_GAP * self.scene.length_scale:
                raise SceneError(
                    f"{stage.title}: joint {name!r} is open by {gap:.4g} (m or rad) at t = {start.time:.6g} "
                    f"s and would jump; end the stage before where it closes to {LARGEST_GAP:g}, correct its "
                    "frames, or connect a line, which needs not be closed"
                )
        before = _core.Evaluator(self.model).energy(start.time, self.state.values)
        run = self._still(scene, model, start)
        met, state = run.events(), run.state
        if kind == "connection" and name in lines_of(scene.loads):
            warn_of_connected(stage.title, scene, name, run.measure(), start.time)
        if kind == "connection" and isinstance(scene.loads.get(name), _core.Contact):
            check_contact_connected(stage.title, scene, name, run.measure(), start.time)
        lost = (
            before - _core.Evaluator(model).energy(start.time, state.values) - sum(e.energy_lost for e in met)
        )
        self.scene, self.model, self.state = scene, model, state
        event = Event(time=start.time, name=name, kind=kind, speed=speed, energy_lost=lost)
        self._changes += [event, *met]

    def _course(self, stage: Stage, interrupts: Interrupts, like: Run | None) -> Course:
        wanted = self._channels()
        if wanted is not None:
            looked_at = [c.channel for c in stage.conditions if isinstance(c, Level)]
            wanted = [*wanted, *(name for name in looked_at if name not in wanted)]
        course = Course(
            scene=self.scene, model=self.model, method=self.method, first=self._first, peaks=self._peaks,
            outputs=Outputs(dt_out=self.outputs.dt_out, channels=wanted), first_run=like,
            interrupts=interrupts, calls=self._calls, began=self._began, done=self._done,
        )  # fmt: skip
        if self._shares and like is None and len(self._alike.runs) < MOST_RUNS:
            longest = stage.duration or stage.maximum_duration or 0.0
            known = course.run(self.state, self.state.time + longest, capacity=1)
            if not known.rungs:
                self._alike.runs[self._key(stage)] = known
        return course

    def _key(self, stage: Stage) -> Key:
        return stage.name, self.state.time, frozenset(self._absent)

    def _kept(self, run: Run, inputs: Mapping[str, Any]) -> dict[str, Any]:
        """Inputs without those of elements that are absent in this stage."""
        every, there = (
            {name for table in LOADS for name in getattr(scene, table)} for scene in (self._given, run.scene)
        )
        return {name: value for name, value in inputs.items() if name.rpartition(".")[0] not in every - there}

    def _channels(self) -> list[str] | None:
        """Channels that were asked for, as far as this stage has them."""
        if self.outputs.channels is None:
            return None
        absent, known = frozenset(self._absent), self._alike.channels
        if absent not in known:
            still = self._still(self.scene, self.model, self.state)
            names = still.model.channel_names(defaults_only=False)
            known[absent] = {*still.named(still.core.snapshot()), OWN, *names}
        return [name for name in self.outputs.channels if name in known[absent]]

    def _began(self, run: Run) -> None:
        run.described = self._described and not self._pieces
        self._open = (run, counted(run.scene, run.model, run.core.snapshot()))

    def _done(self, run: Run) -> None:
        """Keep what a run recorded, and go on from where it stopped."""
        assert self._open is not None
        result, found = run.judged_result()
        piece = Piece(
            result=result, names=all_names(run.scene, run.model), start=self._open[1],
            end=counted(run.scene, run.model, run.core.snapshot()), reached=self._reached,
            lost=float(sum(event.energy_lost for event in self._changes)), before=self._changes,
        )  # fmt: skip
        self._pieces.append(piece)
        self._changes, self._open = [], None
        self._found += [one for one in found if one not in self._found]
        state = piece.counting_on()
        if state is not None:
            self.state = state
            self._reached = self._counted()
