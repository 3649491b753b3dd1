"""The stages before the one that a lift begins with, carried out in calm water."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from seacrane import _core
from seacrane.analysis.rest_state import equilibrium, led
from seacrane.description.given import given_drivers, led_by
from seacrane.errors import SceneError, SimulationError
from seacrane.inputs.caller import silently
from seacrane.run.carried_state import carried
from seacrane.run.carry import compiled_there, lifted_seats
from seacrane.run.commands import taken_up
from seacrane.run.connections import without
from seacrane.run.move import Move
from seacrane.run.plan import waiting
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from seacrane.run.staged_run import StagedRun

LEAD = 5.0  # s of a way along which a given ship is led to where its motion has it


@dataclass(frozen=True)
class Begin:
    """Where a stage began, to run it again from: what was there just before its connections and commands.

    Attributes
    ----------
    scene : With the commands of the stages before, and with what later stages connect.
    """

    scene: Scene
    state: _core.State


def rest_after(calm: StagedRun, count: int, scene: Scene, start: _core.State | None) -> Begin:
    """Where a lift stands still after so many of its stages, in the sea of a scene.

    What the last of them left moving is at rest, and takes its way up from there. Seats that let go stay
    open.

    Parameters
    ----------
    calm : StagedRun
        The lift in calm water, nothing of it carried out.
    start : State, optional
        The state there, where it is known.

    Raises
    ------
    SceneError
        For a stage that is not over in calm water, and where nothing rests there.
    """
    _carry_out(calm, count)
    time, later = calm.state.time, calm.stages[count:]
    gone = (calm.absent | lifted_seats(calm.scene, calm.state)) - waiting(later)
    still = taken_up(without(calm.whole, gone), time)
    moving = _in_sea(still, scene, time)
    if start is not None:
        return Begin(moving, start)
    there = without(still, waiting(later))
    state = equilibrium(there, state=carried(calm.state, calm.model, compiled_there(there)))
    if given_drivers(scene):
        state = _aboard(there, without(moving, waiting(later)), state)
    return Begin(moving, state)


def _carry_out(calm: StagedRun, count: int) -> None:
    first = calm.stages[count].name
    with silently():
        for stage in calm.stages[:count]:
            try:
                calm.advance()
            except (SceneError, SimulationError) as error:
                raise SceneError(
                    f"first is {first!r}, and {stage.title} before it is carried out in calm water, where it "
                    f"fails: {error}. Or give start=, the state in which {first!r} begins"
                ) from error
            if calm.interrupted:
                raise KeyboardInterrupt


def _in_sea(still: Scene, scene: Scene, time: float) -> Scene:
    """The sea and the motion of given ships from a time on, s."""
    curves = {
        name: still.drivers[name].curve.then(time=time, curve=scene.drivers[name].curve)
        for name in given_drivers(scene)
    }
    return led_by(still, curves).copy(waves=scene.waves)


def _aboard(still: Scene, moving: Scene, state: _core.State) -> _core.State:
    """The state at rest on given ships that stand where they are at that time."""
    time, curves = state.time, {}
    for name in given_drivers(moving):
        place = float(moving.drivers[name].curve.evaluate([time])[0, 0])
        way = Move(to=place, over=LEAD).from_where_it_is(still.drivers[name].curve, time)
        curves[name] = way
    there = led(led_by(still, curves), state, time=time + LEAD)
    return equilibrium(moving, state=there)
