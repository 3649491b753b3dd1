"""Python controllers, called between integration steps, in a run or in runs that follow each other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.checked import positive_of
from seacrane.inputs.keywords import named
from seacrane.run.interrupts import Interrupts
from seacrane.run.run import Run

Snapshot = Mapping[str, Array]
Inputs = Mapping[str, Any]
ROUNDING = 1e-9  # of a period


@named
@dataclass(frozen=True, kw_only=True)
class SampledController:
    """A Python controller called at its own period, between integration steps.

    Attributes
    ----------
    period : float
        s.
    function : callable
        function(time, measured) -> {input: value}: `measured` maps channel names to arrays of the present
        instant, inputs are "<actuator>.force" (N or N m), "<actuator>.reference" (m or rad),
        "<actuator>.reference_rate" (m/s or rad/s; 0 unless set: then damping holds against a reference that
        moves), "<line>.rate" of a winch (m/s) and "<point force>.force" (3 values, N). Inputs are held until
        the next call.
    """

    period: float
    function: Callable[[float, Snapshot], Mapping[str, Any]]

    def __post_init__(self) -> None:
        positive_of("controller: period", self.period, "s")
        if not callable(self.function):
            raise SceneError(f"controller: function is {self.function!r}; give a function(time, measured)")


def checked_controllers(controllers: Any) -> list[SampledController]:
    """The controllers as a list."""
    given = list(controllers) if isinstance(controllers, Iterable) else [controllers]
    for controller in given:
        if not isinstance(controller, SampledController):
            raise SceneError(f"controllers holds {controller!r}; give a list of seacrane.SampledController")
    return given


def _called(controller: SampledController) -> str:
    return repr(getattr(controller.function, "__qualname__", controller.function))


class Calls:
    """Which controllers are due when, and what they set.

    Their periods count from `begin` (s), and none is called before the `start` of the run. `kept` tells what
    of the inputs that they return is set in a run; default: all.
    """

    def __init__(
        self,
        controllers: Sequence[SampledController],
        begin: float,
        *,
        start: float | None = None,
        kept: Callable[[Run, Inputs], Inputs] | None = None,
    ) -> None:
        self.controllers, self._begin, self._kept = controllers, begin, kept
        past = 0.0 if start is None else start - begin
        self._due = [begin + one.period * np.ceil(past / one.period - ROUNDING) for one in controllers]
        self._setters: dict[str, SampledController] = {}
        self._made: dict[float, dict[str, Any]] = {}
        self._replayed = False

    def begin(self, now: float, *, replayed: bool) -> None:
        """Begin a piece of the run, at a time (s).

        Where it is replayed, runs over times at which controllers were called already set what they returned
        then, and call none.
        """
        self._made = {time: inputs for time, inputs in self._made.items() if time >= now}
        self._replayed = replayed

    def call(self, run: Run, interrupts: Interrupts) -> None:
        """Set what the controllers that are due now return."""
        now = run.core.time
        if now >= run.t_end or not self.controllers:
            return
        due = [i for i, time in enumerate(self._due) if time <= now]
        if now not in self._made:
            made: dict[str, Any] = {}
            for i in due:
                made.update(self._returned(self.controllers[i], run, interrupts))
                self._due[i] = self._next_call(self.controllers[i], now)
            if made:
                self._made[now] = made
        inputs = self._made.get(now, {})
        if inputs:
            run.set_inputs(inputs if self._kept is None else self._kept(run, inputs))
        if not self._replayed:
            self._made.clear()

    def next(self, now: float) -> float:
        """The time of the next call after `now`, s; infinity without controllers."""
        return min([*self._due, *(time for time in self._made if time > now)], default=float("inf"))

    def _returned(self, controller: SampledController, run: Run, interrupts: Interrupts) -> Inputs:
        """The inputs it returns, which no other one sets; SimulationError when it raises, or for others."""
        now = run.core.time
        try:
            with interrupts.at_once():
                inputs = controller.function(now, run.measure())
        except (Exception, SystemExit) as error:  # sys.exit() would take the outputs along
            raise SimulationError(
                f"controller: raised {type(error).__name__} at t = {now:.6g} s: {error}"
            ) from error
        if not isinstance(inputs, Mapping):
            raise SimulationError(
                f"controller: returned {inputs!r} at t = {now:.6g} s; return {{input: value}}"
            )
        for name in inputs:
            other = self._setters.setdefault(name, controller)
            if other is not controller:
                raise SimulationError(
                    f"controller: {_called(controller)} sets input {name!r}, which {_called(other)} sets "
                    "too: the last would win; let one controller return their sum, or give each an actuator "
                    "of its own"
                )
        return inputs

    def _next_call(self, controller: SampledController, now: float) -> float:
        """When it is due after `now`, s."""
        with np.errstate(over="ignore"):
            calls = np.round((now - self._begin) / controller.period) + 1.0
            after = float(self._begin + controller.period * calls)
        if not after > now:
            raise SceneError(
                f"controller: period is {controller.period} s, below the resolution of time; make it longer"
            )
        return after
