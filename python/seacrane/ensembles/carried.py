"""Where lifts in stages begin in one long sea: a run that is carried from one start to the next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from threading import Lock

from seacrane import _core
from seacrane.ensembles.stage_values import START_TIME
from seacrane.errors import SceneError
from seacrane.run.advance import ended
from seacrane.run.interrupts import Interrupts
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.plan import first_scene
from seacrane.run.run import Run
from seacrane.run.stage import Stage
from seacrane.run.staged_run import StagedRun
from seacrane.scene.scene import Scene
from seacrane.validity.left_range import Finding


def stepped(run: Run | StagedRun) -> Run | StagedRun:
    """The run at its end. Raises KeyboardInterrupt where Ctrl-C stopped it."""
    if isinstance(run, StagedRun):
        while run.advance():
            pass
        if run.interrupted:
            raise KeyboardInterrupt
        return run
    with Interrupts() as interrupts:
        run = ended(run, (), interrupts)
    interrupts.take()  # pressed as the run ended: the members after it are not to be run
    if run.interrupted:
        raise KeyboardInterrupt
    return run


class Carried:
    """The states of a scene that waits for its lift, at the times at which one may begin.

    It lands on each of them on its way to a later one, so that every state is the same to the bit whichever
    were asked for before. Threads may share it.

    Parameters
    ----------
    scene, stages
        Of the lift: what waits is the scene before its first stage.
    start : State, optional
        Default: the assembled start.
    times : sequence of float
        s, ascending.
    method, outputs
        Of the lift; nothing is recorded.
    """

    def __init__(
        self,
        scene: Scene,
        stages: Sequence[Stage],
        *,
        start: _core.State | None,
        times: Sequence[float],
        method: Method,
        outputs: Outputs,
    ) -> None:
        self._scene = first_scene(scene, stages)
        self._model = self._scene.compile()
        self._state = _core.initial_state(self._model) if start is None else start
        self._left = list(times)
        if self._left[0] < self._state.time:
            raise SceneError(
                f"{START_TIME} is {self._left[0]:g} s, and the run that waits for it begins at "
                f"{self._state.time:g} s; give later ones"
            )
        self._method, self._outputs = method, replace(outputs, channels=())
        self._states: dict[float, _core.State] = {}
        self._found: list[Finding] = []
        self._found_by: dict[float, tuple[Finding, ...]] = {}
        self._lock = Lock()

    def at(self, time: float) -> _core.State:
        """The state at one of the times."""
        with self._lock:
            while time not in self._states:
                self._states[self._left[0]] = self._next(self._left[0])
                self._state = self._states[self._left.pop(0)]
                self._found_by[self._state.time] = tuple(self._found)
            return self._states[time]

    def found(self, time: float) -> tuple[Finding, ...]:
        """What was out of range until one of the times that were asked for, such as a load through a deck."""
        return self._found_by[time]

    def _next(self, time: float) -> _core.State:
        if time == self._state.time:
            return self._state
        run = Run(
            self._scene, time, start=self._state, method=self._method, outputs=self._outputs,
            model=self._model,
        )  # fmt: skip
        ended_run = stepped(run)
        assert isinstance(ended_run, Run)
        known = {kind for kind, _ in self._found}
        self._found += [one for one in ended_run.judged_result()[1] if one[0] not in known]
        return ended_run.state
