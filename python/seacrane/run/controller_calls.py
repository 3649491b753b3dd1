"""Calls of Python controllers in a run, or in runs that follow each other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from seacrane.run.interrupts import Interrupts
from seacrane.run.run import Run
from seacrane.run.sampled_controller import SampledController, called_at, next_call, only_setter

Inputs = Mapping[str, Any]
ROUNDING = 1e-9  # of a period


class Calls:
    """Which controllers are due when, and what they set.

    Parameters
    ----------
    controllers : sequence of SampledController
    begin : float
        Time from which their periods count, s.
    start : float, optional
        Of the run, s: none is called before; default: `begin`.
    kept : callable, optional
        What of the inputs that they return is set in a run; default: all.
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
        if now not in self._made:
            self._ask(run, now, interrupts)
        inputs = self._made.get(now, {})
        if inputs:
            run.set_inputs(inputs if self._kept is None else self._kept(run, inputs))
        if not self._replayed:
            self._made.clear()

    def next(self, now: float) -> float:
        """The time of the next call after `now`, s; infinity without controllers."""
        return min([*self._due, *(time for time in self._made if time > now)], default=float("inf"))

    def _ask(self, run: Run, now: float, interrupts: Interrupts) -> None:
        called: dict[str, Any] = {}
        for i, controller in enumerate(self.controllers):
            if self._due[i] <= now:
                with interrupts.at_once():
                    inputs = called_at(controller, now, run.measure)
                only_setter(inputs, controller, self._setters)
                called.update(inputs)
                self._due[i] = next_call(controller, now, self._begin)
        if called:
            self._made[now] = called
