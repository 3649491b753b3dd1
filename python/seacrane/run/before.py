"""The stages before the one that a lift begins with, carried out in calm water."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from seacrane import _core
from seacrane.analysis.rest_state import equilibrium, led
from seacrane.description.given import given_drivers, led_by
from seacrane.errors import SceneError
from seacrane.run.carried_state import carried
from seacrane.run.carry import compiled_there, lifted_seats
from seacrane.run.commands import taken_up
from seacrane.run.connections import without
from seacrane.run.move import Move
from seacrane.run.plan import waiting
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene

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


@dataclass(frozen=True, kw_only=True)
class There:
    """Where a lift is between two stages.

    Attributes
    ----------
    whole : With all commands until then, and with what is absent.
    absent : Names.
    scene, model
        What is there.
    """

    whole: Scene
    absent: frozenset[str]
    scene: Scene
    model: _core.Model
    state: _core.State


def rest_after(calm: There, later: Sequence[Stage], scene: Scene, start: _core.State | None) -> Begin:
    """Where a lift stands still that was carried out in calm water until then, in the sea of a scene.

    What still moved is at rest, and takes its way up from there. Seats that let go stay open. From a state
    that is known there, all goes on as it was.

    Parameters
    ----------
    later : sequence of Stage
        That are left.
    start : State, optional
        The state there, where it is known.

    Raises
    ------
    SceneError
        Where nothing rests there.
    """
    time = calm.state.time
    if start is not None:
        return Begin(_in_sea(without(calm.whole, calm.absent - waiting(later)), scene, time), start)
    gone = (calm.absent | lifted_seats(calm.scene, calm.state)) - waiting(later)
    still = taken_up(without(calm.whole, gone), time)
    moving = _in_sea(still, scene, time)
    there = without(still, waiting(later))
    try:
        state = equilibrium(there, state=carried(calm.state, calm.model, compiled_there(there)))
        if given_drivers(scene):
            state = _aboard(there, without(moving, waiting(later)), state)
    except SceneError as error:
        first = later[0].name
        raise SceneError(
            f"first is {first!r}, and nothing rests where the stages before it lead: {error}. Begin with an "
            f"earlier one, or give start=, the state in which {first!r} begins"
        ) from error
    return Begin(moving, state)


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
