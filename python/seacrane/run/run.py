"""Run: one run of a compiled scene, to be advanced piece by piece."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core
from seacrane._core import integrator
from seacrane.analysis.after_run import NOT_FINITE, Finding, as_text, not_finite, tried
from seacrane.analysis.implausible import warn_of_description
from seacrane.analysis.left_range import findings
from seacrane.analysis.line_checks import bound_findings
from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, DERIVED, OWN, channel_of
from seacrane.description.compilation import compiled, compiled_in_sea
from seacrane.description.holding import with_holds
from seacrane.description.once import forgetting, unchanged
from seacrane.description.references import check_references
from seacrane.description.rungs import QUASI_STATIC, automatic, with_rungs
from seacrane.description.waves import Waves
from seacrane.errors import SceneError, SeacraneError
from seacrane.inputs.alike import alike
from seacrane.inputs.caller import keeping
from seacrane.inputs.checked import finite_of, number_of
from seacrane.inputs.keywords import named
from seacrane.result.about import About, Event, checked_array, checked_stats, plain_stats
from seacrane.result.record import Record
from seacrane.result.result import Result
from seacrane.result.traces import as_arrays, parted
from seacrane.run.carried_state import carried, changed_inputs, steered
from seacrane.run.channel_names import (
    all_names,
    followed,
    kept_names,
    recorded_channels,
    require_limited_channels,
    require_names,
    sought_peaks,
    wanted_extremes,
    with_sources,
)
from seacrane.run.derived import CHEAP, Falls, derived_extremes, followed_extremes, named_channels, own_values
from seacrane.run.line_rungs import COMPILED, all_elastic, line_rungs, struck, warn_of_quasi_static
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
from seacrane.run.modes import Modes
from seacrane.run.outputs import Outputs, output_times
from seacrane.run.stats import (
    about_of,
    event_findings,
    lasting_stats,
    ruptures,
    sea_settings,
    settings_of,
    told_of,
)
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack


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
    peaks : collection of str, optional
        Of which channels largest and least values between outputs are asked for; default: of all.
    **shorthand
        As `simulate`.

    Attributes
    ----------
    scene, model, formulation
        What is stepped, its lines on the rungs that were chosen.
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
        peaks: Collection[str] | None = None,
        **shorthand: Unpack[Shorthand],
    ) -> None:
        self.method, self.outputs = settled(method, outputs, shorthand)
        self.t_end, self._peaks = finite_of("t_end", t_end, "s"), peaks
        scene = with_holds(scene)
        given = self._given = scene.copy() if automatic(scene) else scene
        self._given_start, self._capacity, self._controlled = start_state(scene, start), capacity, controlled
        self.described, begins = start is None, start is None or (isinstance(start, str) and start == REST)
        if model is None:
            known = integrator(self.method.integrator)
            self.rungs = line_rungs(
                given, known, end=self.t_end, start=self._given_start, controlled=controlled
            )
        else:
            self.rungs = all_elastic(automatic(given), COMPILED)
        self.scene = scene = with_rungs(given, {name: rung.name for name, rung in self.rungs.items()})
        with unchanged(scene):
            self.model = scene.compile() if model is None else model
            self._begin(outputs_from, begins=begins)

    def _begin(self, outputs_from: float | None, *, begins: bool) -> None:
        """Check and hold all that the scene and the method say, and start."""
        self.formulation = formulation_of(self.model, self.method)
        self.start = self._started()
        self.first = self.start.time if outputs_from is None else number_of("outputs_from", outputs_from)
        self._check(begins=begins)
        self.settings = settings_of(self.scene, self.t_end, self.method, self.outputs)
        require_limited_channels(self.scene, self.model)
        require_names(self.scene, self.outputs.channels or ())
        self._own_modes = Modes(self.model, list(self.scene.bodies), [self.start])
        self.start_modes: Modes | None = None
        self._coords = {dim: tuple(names) for dim, names in all_names(self.scene, self.model).items()}
        self._about = about_of(self.scene)
        self._lasting = lasting_stats(self.scene, self.model, self.formulation, self.method)
        self._hold()
        self._prepare()
        try:  # what a result could not hold is refused now, not when the run is over
            plain_stats(self._told())
            About(settings=self.settings).to_attributes()
        except ValueError as error:
            raise SceneError(f"scene {self.scene.name!r}: {error}") from error

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
                given, self.t_end, method=self.method, start=self._given_start, controlled=self._controlled,
                outputs=self.outputs, outputs_from=self.first, capacity=self._capacity, peaks=self._peaks,
            )  # fmt: skip
        out = alike(self)
        out.scene = given if self.scene is self._given else self.scene.copy(waves=waves)
        out._given = given
        out.model = compiled_in_sea(out.scene, self.model)
        out.start = out._started()
        if told_of(waves) != told_of(self.scene.waves):  # not its seed alone
            out.settings = sea_settings(out.scene, self.settings)
        out.start_modes = self.start_modes or self._own_modes
        out._prepare()
        return out

    def from_there(self, start: _core.State, t_end: float, capacity: int | None = None) -> Run:
        """A run of the same scene from another state to another end, with outputs at the same times.

        What was checked and warned of is not checked again.
        """
        out = alike(self)
        out._given_start, out._capacity = start, capacity
        out.t_end, out.described = number_of("t_end", t_end), False
        out.start = out._started()
        out.settings = {**self.settings, "t_end": out.t_end}
        out._own_modes, out.start_modes = Modes(out.model, list(out.scene.bodies), [out.start]), None
        out._hold()
        out._prepare()
        return out

    def _check(self, *, begins: bool) -> None:
        """What the description most likely does not mean; see `begins` of `warn_of_description`."""
        begin, end, described = self.start.time, self.t_end, self.described
        self._warned = dict(self.scene.warned)
        with keeping(self._warned):
            check_references(self.scene, self.model, start=begin, end=end, described=described)
            warn_of_description(self.scene, start=begin, end=end, described=described, begins=begins)
            if begin == 0.0:
                warn_of_quasi_static(self._given, self.model, end=end)

    def _hold(self) -> None:
        """What holds from the start to the end, in any sea."""
        scene, model, outputs = self.scene, self.model, self.outputs
        asked = None if outputs.channels is None else tuple(outputs.channels)
        channels = recorded_channels(scene, model, asked)
        sought = sought_peaks(asked, self._peaks)
        self._followed = followed(scene, channels, sought)  # made anew at every step, of what
        self._steered = frozenset(steered(scene, model, self.start.inputs))
        times = output_times(
            self.start.time, self.t_end, outputs.dt_out, first=self.first,
            values=model.channel_values(channels) if self._capacity is None else 0,
        )  # fmt: skip
        self._options = core_options(
            self.method, self.formulation, channels=channels, output_times=times,
            extremes=wanted_extremes(scene, channels, sought), trail=set().union(*self._followed.values()),
            capacity=self._capacity,
        )  # fmt: skip

    def _prepare(self) -> None:
        """What changes while it runs."""
        self.core = _core.Simulation(model=self.model, start=self.start, options=self._options)
        self.interrupted = False
        self.steered = set(self._steered)
        self.slow: list[Finding] = []  # what made the run slow, or a mode of it grow, known at its end
        self.lanes: dict[str, Any] = {}  # how it was formulation_of beside others, where that was asked for

    def _started(self) -> _core.State:
        """The state at the start; one of the model but for what rungs of lines add is carried over."""
        if self._given_start is None:
            return _core.initial_state(self.model)
        differ = {name for name, *_ in self.model.load_states} ^ self._given_start.load_states.keys()
        if differ and differ <= {f"{name}.strain_rate" for name in self.rungs}:
            return carried(self._given_start, compiled(self._given, merge=True), self.model)
        return self._given_start

    @property
    def settled(self) -> list[str]:
        """Lines that rung "auto" made quasi-static."""
        return [name for name, rung in self.rungs.items() if rung.name == QUASI_STATIC]

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
        if not self.core.advance(float(t_end), progress):
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
        """Channels at the present instant, by the names of a result: those asked for, and the cheap ones."""
        named = self.named(self.core.snapshot(), CHEAP.union(self.outputs.channels or ()))
        return {name: values[0] for name, values in named.items()}

    def named(
        self, arrays: Mapping[str, Array], asked: Collection[str] | None = None, falls: Falls | None = None
    ) -> dict[str, Array]:
        """Channels of the core by the names of a result; of those made of them the ones asked for, or all."""
        scene, known = self.scene, {name: values for name, values in arrays.items() if name != "time"}
        out = named_channels(scene, known, None if asked is None else with_sources(scene, asked), falls)
        if scene.channels and (asked is None or OWN in asked):
            own = own_values(scene, out, all_names(scene, self.model), len(arrays["time"]))
            out |= {} if own is None else {OWN: own}
        return out

    def wanted(self, arrays: Mapping[str, Array], falls: Falls | None = None) -> dict[str, Array]:
        """As `named`, those that the outputs ask for."""
        asked = self.outputs.channels
        if asked is not None and not DERIVED.keys() & set(asked):
            return {name: values for name, values in arrays.items() if name in asked}
        kept = kept_names(self.scene, arrays, asked)
        return {name: one for name, one in self.named(arrays, kept, falls).items() if name in kept}

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
        return sorted(met + ruptures(self.scene, self.start.time, self.core.time), key=lambda one: one.time)

    def stats(self) -> dict[str, Any]:
        """Version, method, counters so far, and warnings of the description: `Result.stats`."""
        return self._told(simulated_s=self.core.time - self.start.time, **self.core.statistics())

    def _told(self, **counted: Any) -> dict[str, Any]:
        """The same with these counters."""
        rungs = "\n".join(f"{name}: {rung.name}: {rung.reason}" for name, rung in self.rungs.items())
        warned = {"described": "\n".join(self._warned)} if self._warned else {}
        sea = {} if self.scene.waves is None else self.scene.waves.provenance.stats()
        return {"line_rungs": rungs or None, **self._lasting, **counted, **sea, **warned, **self.lanes}

    @property
    def about(self) -> About:
        """What is structured: `Result.about`."""
        return replace(self._about, settings=self.settings)

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
        with self.core, unchanged(self.scene):
            arrays, stats, met, found = self._recorded(most)
            result = Result.from_arrays(
                time=arrays.pop("time"), coords=self._coords, events=met, stats=stats, arrays=arrays,
                about=self.about, interrupted=self.interrupted,
                state=self.last_state() if most is None else None,
                scene=forgetting(self.scene.copy(notes={})),
            )  # fmt: skip
        return result, found

    def record(self) -> Record:
        """What has been recorded so far, for what reads curves and stats alone: its events and settings are
        left out."""
        with self.core, unchanged(self.scene):
            arrays, stats, _, _ = self._recorded(None)
        time = arrays.pop("time")
        channels, extremes = parted(arrays)
        gappy = str(stats.get(NOT_FINITE, "")).split(", ")
        for name, values in as_arrays(extremes).items():
            checked_array(name, values, values.shape, self.interrupted or channel_of(name) in gappy)
        return Record(
            time=time, channels=channels, extremes=extremes, coords=self._coords, stats=checked_stats(stats),
            interrupted=self.interrupted,
        )  # fmt: skip

    def _recorded(
        self, most: int | None
    ) -> tuple[dict[str, Array], dict[str, Any], list[Event], list[Finding]]:
        """Arrays, stats, events and what is out of range, of no more than the first outputs."""
        every = () if most is None else (most,)
        arrays, extremes = self.core.channels(*every), self.core.extremes(*every)
        scene, met, stats = self.scene, self.events(), self.stats()
        found, falls = list[Finding](), Falls()
        recorded = {name: values for name, values in arrays.items() if name in CHANNELS}
        channels = tried("making derived channels", lambda: self.wanted(arrays, falls), recorded, found)
        found += findings(scene, arrays["time"], channels, stats, self.steered, described=self.described)
        reached = [(time, name) for time, name, *_ in self.core.events()]
        found += tried("looking at events", lambda: [*event_findings(scene, met, channels)], [], found)
        found += tried("looking at bounds", lambda: list(bound_findings(scene, reached)), [], found)
        found += self.slow + struck(scene, self.settled, reached, self.start.time)
        if not self.interrupted and (wrong := not_finite(channels)):
            stats[NOT_FINITE] = ", ".join(wrong)
            found += wrong.values()
        if found:
            stats["validity"] = as_text(found)
        reach = {**extremes, **derived_extremes(scene, arrays, extremes, channels, falls)}
        if self._followed and len(arrays["time"]):
            outputs = {**channels, "time": arrays["time"]}
            reach |= followed_extremes(self.core.trail(), outputs, self._followed, self.named)
        kept = {name: both for name, both in reach.items() if name in channels}
        return {**channels, **as_arrays(kept), "time": arrays["time"]}, stats, met, found
