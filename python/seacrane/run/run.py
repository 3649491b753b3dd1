"""Run: one run of a compiled scene, to be advanced piece by piece."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane._core import integrator
from seacrane.description.channels import CHANNELS, DERIVED, OWN
from seacrane.description.compilation import compiled, compiled_in_sea
from seacrane.description.holding import with_holds
from seacrane.description.once import forgetting
from seacrane.description.references import check_references
from seacrane.description.rungs import QUASI_STATIC, automatic, with_rungs
from seacrane.description.waves import Waves
from seacrane.description.wet_parts import immersed_parts
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.caller import keeping
from seacrane.inputs.checked import finite_of, number_of
from seacrane.inputs.keywords import named
from seacrane.result.about import About, plain_stats
from seacrane.result.events import Event
from seacrane.result.result import Result
from seacrane.result.traces import Extremes, as_arrays
from seacrane.run.carried_state import carried, changed_inputs, steered
from seacrane.run.channel_names import (
    all_names,
    recorded_channels,
    require_limited_channels,
    require_names,
    with_sources,
)
from seacrane.run.derived import named_channels, own_values
from seacrane.run.extremes import derived_extremes, followed, followed_extremes, wanted_extremes
from seacrane.run.line_rungs import (
    COMPILED,
    LineRung,
    all_elastic,
    as_told,
    line_rungs,
    warn_of_quasi_static,
)
from seacrane.run.method import REST, Method, Shorthand, Start, core_options, settled, start_state, stepped
from seacrane.run.modes import Modes
from seacrane.run.outputs import Outputs, output_times
from seacrane.run.stats import (
    about_of,
    boiled,
    fallen_through,
    lasting_stats,
    require_plain,
    ruptures,
    settings_in_sea,
    settings_of,
)
from seacrane.scene.scene import Scene
from seacrane.validity.after_run import NOT_FINITE, Finding, as_text, not_finite, tried
from seacrane.validity.implausible import warn_of_description
from seacrane.validity.left_range import findings
from seacrane.validity.line_checks import bound_findings
from seacrane.warnings import LineRungWarning

if TYPE_CHECKING:
    from typing_extensions import Unpack

Array = NDArray[np.float64]


@named
class Run:
    """One run of a compiled scene, to be advanced piece by piece.

    Parameters
    ----------
    scene : Scene
    t_end : float
        End time, s.
    method : Method, optional
        How it is stepped.
    outputs : Outputs, optional
        What is recorded, and how often.
    start : State or "rest", optional
        Where to begin, or the word for the state at rest, see `equilibrium`; default: the assembled start of
        the scene.
    outputs_from : float, optional
        Time from which output times are counted, s, not after the start; default: the start. A run that goes
        on from a `start` so records at the times at which the run before it would have.
    capacity : int, optional
        Outputs to take memory for at first; default: all.
    model : Model, optional
        The compiled scene, to save compiling it again.
    controlled : bool
        Whether inputs will be set during the run, see `set_inputs`: lines with rung "auto" are then elastic.
    **shorthand
        As `simulate`.

    Attributes
    ----------
    scene, model, formulation
        What is stepped: the scene with stabilised joints where the method cannot project.
    method, outputs, start, t_end
        As given, or their defaults.
    settings : dict
        Method and outputs by the words of `simulate`, as results record them.
    start_modes : Modes or None
        At the start that runs made by `in_sea` have in common; None for a run by itself.
    rungs : mapping of str to LineRung
        What lines with rung "auto" are in this run, and why.
    core : Simulation
        The run in the core: time, counters, recorded channels by the core's names.
    interrupted : bool
        Whether something stopped it before its end.
    described : bool
        Whether it begins in the pose that the scene describes, and not in a state.
    """

    def __init__(
        self,
        scene: Scene,
        t_end: float,
        *,
        method: Method | None = None,
        outputs: Outputs | None = None,
        start: Start = None,
        outputs_from: float | None = None,
        capacity: int | None = None,
        model: _core.Model | None = None,
        controlled: bool = False,
        **shorthand: Unpack[Shorthand],
    ) -> None:
        self.method, self.outputs = settled(method, outputs, shorthand)
        self.t_end = finite_of("t_end", t_end, "s")
        scene = with_holds(scene)
        self._given = scene.copy() if automatic(scene) else scene
        self._given_start, self._capacity, self._controlled = start_state(scene, start), capacity, controlled
        self.described, begins = start is None, start is None or (isinstance(start, str) and start == REST)
        self.rungs = self._chosen_rungs(model)
        self._step(model)
        self.first = self.start.time if outputs_from is None else number_of("outputs_from", outputs_from)
        begin, end, described = self.start.time, self.t_end, self.described
        self._warned = dict(self.scene.warned)
        with keeping(self._warned):
            check_references(self.scene, self.model, start=begin, end=end, described=described)
            warn_of_description(self.scene, start=begin, end=end, described=described, begins=begins)
            if begin == 0.0:
                warn_of_quasi_static(self._given, self.model, end=end)
        self.settings = settings_of(self.scene, self.t_end, self.method, self.outputs)
        require_limited_channels(self.scene, self.model)
        require_names(self.scene, self.outputs.channels or ())
        self._own_modes = Modes(self.model, list(self.scene.bodies), [self.start])
        self.start_modes: Modes | None = None
        self._lasting = _Lasting.of(self)
        self._prepare()
        self._require_plain_stats()

    def in_sea(self, waves: Waves) -> Run:
        """A run of the same scene in another sea, by the same method, with the same outputs.

        It is the run that ``Run(scene.copy(waves=waves), ...)`` makes, to the bit, at a small part of its
        cost: what does not depend on the sea is neither checked nor compiled again. Modes that make a run
        slow, or that grow, are sought once, at the start that all such runs share. A run's own modes are
        sought only if those come near a limit.

        Parameters
        ----------
        waves : Waves
            On the same vessels, at the same kind of position.

        Raises
        ------
        SceneError
            For a sea on other vessels, or a scene without a sea.
        """
        if self.scene.waves is None:
            raise SceneError(f"scene {self.scene.name!r}: has no sea to be replaced; make a run of its own")
        given = self._given.copy(waves=waves)
        if self.rungs:  # which depend on the sea
            return Run(
                given, self.t_end, method=self.method, outputs=self.outputs, start=self._given_start,
                outputs_from=self.first, capacity=self._capacity, controlled=self._controlled,
            )  # fmt: skip
        out = copy(self)
        out.scene = given if self.scene is self._given else self.scene.copy(waves=waves)
        out._given = given
        out.model = compiled_in_sea(out.scene, self.model)
        out.start = out._started()
        out.settings = settings_in_sea(self.settings, out.scene)
        out.start_modes = self.start_modes or self._own_modes
        out._prepare()
        return out

    def from_there(self, start: _core.State, t_end: float, capacity: int | None = None) -> Run:
        """A run of the same scene from another state to another end, with outputs at the same times.

        What was checked and warned of is not checked again.
        """
        out = copy(self)
        out._given_start, out._capacity = start, capacity
        out.t_end = number_of("t_end", t_end)
        out.described = False
        out.start = out._started()
        out.settings = {**self.settings, "t_end": out.t_end}
        out._own_modes, out.start_modes = Modes(out.model, list(out.scene.bodies), [out.start]), None
        inputs = frozenset(steered(out.scene, out.model, out.start.inputs))
        out._lasting = replace(self._lasting, options=_options(out, self._lasting.followed), steered=inputs)
        out._prepare()
        return out

    def _prepare(self) -> None:
        """What changes while it runs."""
        self.core = self._simulation()
        if self.scene.waves is not None:
            self.scene.waves.warn_of_repeats(self.t_end - self.start.time)
        self.interrupted = False
        self.steered = set(self._lasting.steered)
        self.slow: list[Finding] = []  # what made the run slow, or a mode of it grow, known at its end
        self.lanes: dict[str, Any] = {}  # how it was stepped beside others, where that was asked for

    def _simulation(self) -> _core.Simulation:
        return _core.Simulation(model=self.model, start=self.start, options=self._lasting.options)

    def _chosen_rungs(self, model: _core.Model | None) -> Mapping[str, LineRung]:
        if model is not None:
            return all_elastic(automatic(self._given), COMPILED)
        return line_rungs(
            self._given, integrator(self.method.integrator), end=self.t_end, start=self._given_start,
            controlled=self._controlled,
        )  # fmt: skip

    def _step(self, model: _core.Model | None) -> None:
        """What is stepped, from where, with the rungs that its lines have."""
        scene = with_rungs(self._given, {name: rung.name for name, rung in self.rungs.items()})
        self.scene, self.model, self.formulation = stepped(scene, model, self.method)
        self.start = self._started()

    def _started(self) -> _core.State:
        """The state at the start."""
        if self._given_start is None:
            return _core.initial_state(self.model)
        if self._differs_by_rungs(self._given_start):
            return carried(self._given_start, compiled(self._given, merge=True), self.model)
        return self._given_start

    def _differs_by_rungs(self, start: _core.State) -> bool:
        """Whether a state holds what the model has but for what the rungs of lines add."""
        own = {f"{name}.strain_rate" for name in self.rungs}
        there = {name for name, *_ in self.model.load_states}
        return bool(there ^ start.load_states.keys()) and there ^ start.load_states.keys() <= own

    @property
    def settled(self) -> list[str]:
        """Lines that rung "auto" made quasi-static."""
        return [name for name, rung in self.rungs.items() if rung.name == QUASI_STATIC]

    def _struck(self) -> list[Finding]:
        """Whether water struck what hangs on a line that "auto" settled, as it had not as the run began."""
        parts = {f"{name}.touch": name for name in immersed_parts(self.scene)} if self.settled else {}
        for time, name, *_ in self.core.events():
            if name in parts and time > self.start.time:
                lines = ", ".join(map(repr, self.settled))
                text = (
                    f"immersed part {parts[name]!r}: met water at t = {time:.6g} s, and slam is fast; 'auto' "
                    f"had made {lines} quasi-static, whose peaks are then too small. Give rung='elastic'"
                )
                return [(LineRungWarning, text)]
        return []

    def __repr__(self) -> str:
        method = f"{self.formulation}, {self.method.integrator}"
        return f"<Run of {self.scene.name!r}: {method}, at {self.core.time:g} s>"

    def advance(self, t_end: float, progress: Callable[[float], None] | None = None) -> bool:
        """Step to t_end (s); False when Ctrl-C stopped it.

        Raises
        ------
        LineSlackError
            Where a line of rung "quasi-static", also one that "auto" made so, cannot go on.
        """
        reached = self.core.advance(float(t_end), progress)
        if not reached:
            self.interrupted = True
        return not self.interrupted

    @property
    def state(self) -> _core.State:
        """The present state: a copy, to continue from by ``Run(scene, start=...)``."""
        return self.core.state

    def last_state(self) -> _core.State | None:
        """The present state, or None where its rate cannot be found."""
        try:
            return self.core.state
        except SeacraneError:
            return None

    def measure(self) -> dict[str, Array]:
        """All channels at the present instant, by the names of a result."""
        arrays = self.core.snapshot()
        named = self.named(arrays, set(self.outputs.channels or ()))
        return {name: values[0] for name, values in named.items()}

    def named(self, arrays: Mapping[str, Array], asked: Collection[str] | None = None) -> dict[str, Array]:
        """Channels of the core by the names of a result; of those that cost much the ones asked for."""
        scene, known = self.scene, {name: values for name, values in arrays.items() if name != "time"}
        wanted = None if asked is None else with_sources(scene, asked)
        out = named_channels(scene, known, wanted)
        if scene.channels and (asked is None or OWN in asked):
            own = own_values(scene, out, all_names(scene, self.model), len(arrays["time"]))
            out |= {} if own is None else {OWN: own}
        return out

    def wanted(self, arrays: Mapping[str, Array]) -> dict[str, Array]:
        """As `named`, those that the outputs ask for."""
        asked = self.outputs.channels
        if asked is not None and not DERIVED.keys() & set(asked):
            return {name: values for name, values in arrays.items() if name in asked}
        if asked is None:
            limited = {state.channel for state in self.scene.limit_states.values()}
            kept = {name for name in DERIVED if DERIVED[name].by_default or name in limited}
            kept |= {*arrays.keys() - {"time"}, *with_sources(self.scene, [OWN])}
        else:
            kept = set(asked)
        named = self.named(arrays, kept)
        return {name: values for name, values in named.items() if name in kept}

    def set_inputs(self, values: Mapping[str, Any]) -> None:
        """Set inputs by name from now on; see `SampledController`."""
        if self.settled:
            lines = ", ".join(self.settled)
            raise SceneError(
                f"inputs: set at t = {self.core.time:.6g} s in a run whose lines {lines} 'auto' made "
                "quasi-static, and inputs that jump make a line ring; give the Run controlled=True, or the "
                "lines rung 'elastic' (or 'quasi-static', where the inputs are smooth)"
            )
        with self.core:
            slots = changed_inputs(self.scene, self.model, np.array(self.core.state.inputs), values)
            self.core.set_inputs(slots)
            self.steered |= steered(self.scene, self.model, slots)

    def events(self) -> list[Event]:
        """What limits did so far, and which hoses burst."""
        met = [
            Event(time=time, name=name, kind=kind, speed=speed, impulse=impulse, energy_lost=lost)
            for time, name, kind, speed, impulse, lost in self.core.events()
        ]
        burst = ruptures(self.scene, self.start.time, self.core.time)
        return sorted([*met, *burst], key=lambda event: event.time)

    def stats(self) -> dict[str, Any]:
        """Version, method, counters so far, and warnings of the description: `Result.stats`."""
        return self._stats({"simulated_s": self.core.time - self.start.time, **self.core.statistics()})

    def _stats(self, counted: Mapping[str, Any]) -> dict[str, Any]:
        told = {"line_rungs": as_told(self.rungs)} if self.rungs else {}
        warned = {"described": "\n".join(self._warned)} if self._warned else {}
        sea = {} if self.scene.waves is None else self.scene.waves.provenance.stats()
        return {**told, **self._lasting.stats, **counted, **sea, **warned, **self.lanes}

    @property
    def about(self) -> About:
        """What is structured: `Result.about`."""
        return replace(self._lasting.about, settings=self.settings)

    def result(self) -> Result:
        """What has been recorded so far, with what is out of range in its stats."""
        return self.judged_result()[0]

    def judged_result(self, most: int | None = None) -> tuple[Result, list[Finding]]:
        """What has been recorded so far, and what is out of range in it.

        Parameters
        ----------
        most : int, optional
            No more than the first outputs, and no state.
        """
        with self.core:
            every = () if most is None else (most,)
            arrays, extremes = self.core.channels(*every), self.core.extremes(*every)
            scene, met, stats = self.scene, self.events(), self.stats()
            found: list[Finding] = []
            recorded = {name: values for name, values in arrays.items() if name in CHANNELS}
            channels = tried("making derived channels", lambda: self.wanted(arrays), recorded, found)
            found += findings(scene, arrays["time"], channels, stats, self.steered, described=self.described)
            reached = [(time, name) for time, name, *_ in self.core.events()]
            for what, look in (
                ("looking at oil", lambda: list(boiled(scene, met, channels))),
                ("looking at seats", lambda: list(fallen_through(scene, met))),
                ("looking at bounds", lambda: list(bound_findings(scene, reached))),
            ):
                found += tried(what, look, [], found)
            found += self.slow + self._struck()
            if not self.interrupted and (wrong := not_finite(channels)):
                stats[NOT_FINITE] = ", ".join(wrong)
                found += wrong.values()
            if found:
                stats["validity"] = as_text(found)
            result = Result.from_arrays(
                time=arrays["time"], coords=self._lasting.coords, events=met, stats=stats, about=self.about,
                arrays={**channels, **as_arrays(self._reached(arrays, extremes, channels))},
                interrupted=self.interrupted, state=self.last_state() if most is None else None,
                scene=forgetting(scene.copy(notes={})),
            )  # fmt: skip
        return result, found

    def _reached(
        self, arrays: Mapping[str, Array], extremes: Extremes, channels: Mapping[str, Array]
    ) -> dict[str, tuple[Array, Array]]:
        """Least and largest values of the channels, as far as the core has kept them."""
        derived = derived_extremes(self.scene, arrays, extremes, channels)
        if self._lasting.followed and len(arrays["time"]):
            outputs = {**channels, "time": arrays["time"]}
            derived |= followed_extremes(self.core.trail(), outputs, self._lasting.followed, self.named)
        return {name: both for name, both in {**extremes, **derived}.items() if name in channels}

    def _require_plain_stats(self) -> None:
        """What a result could not hold is refused now, not when the run is over."""
        try:
            plain_stats(self._stats({}))
            require_plain(self.scene)
            About(settings=self.settings).to_attributes()
        except ValueError as error:
            raise SceneError(f"scene {self.scene.name!r}: {error}") from error


@dataclass(frozen=True, kw_only=True)
class _Lasting:
    """What holds for a run from its start to its end, and for those of the same scene in other seas.

    Attributes
    ----------
    options : Of the core.
    coords : Names along the dimensions of channels.
    followed : Channels that are made anew at every step, and of what.
    steered : Actuators whose inputs are not zero at the start.
    stats : Of `lasting_stats`.
    about : Of the scene; the settings differ by sea.
    """

    options: _core.RunOptions
    coords: Mapping[str, Sequence[str]]
    followed: Mapping[str, set[str]]
    steered: frozenset[str]
    stats: Mapping[str, Any]
    about: About

    @classmethod
    def of(cls, run: Run) -> _Lasting:
        scene, model = run.scene, run.model
        asked = None if run.outputs.channels is None else tuple(run.outputs.channels)
        made_of = followed(scene, recorded_channels(scene, model, asked), asked)
        return cls(
            options=_options(run, made_of), followed=made_of, coords=all_names(scene, model),
            steered=frozenset(steered(scene, model, run.start.inputs)),
            stats=lasting_stats(scene, model, run.formulation, run.method), about=about_of(scene),
        )  # fmt: skip


def _options(run: Run, followed: Mapping[str, set[str]]) -> _core.RunOptions:
    """How the core steps a run, and what it records; `followed`: see `_Lasting`."""
    model, method, outputs, capacity = run.model, run.method, run.outputs, run._capacity
    asked = None if outputs.channels is None else tuple(outputs.channels)
    channels = recorded_channels(run.scene, model, asked)
    times = output_times(
        run.start.time, run.t_end, outputs.dt_out, first=run.first,
        values=model.channel_values(channels) if capacity is None else 0,
    )  # fmt: skip
    return core_options(
        method, run.formulation, channels=channels, times=times, capacity=capacity,
        extremes=wanted_extremes(run.scene, channels, asked), trail=set().union(*followed.values()),
    )  # fmt: skip
