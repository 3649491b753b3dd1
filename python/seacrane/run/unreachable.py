"""Conditions that a stage can never meet, told before it is run."""

from __future__ import annotations

import numpy as np

from seacrane import _core
from seacrane.description.loads import lines_of, on_winch, winch_of, winches_of
from seacrane.errors import SceneError
from seacrane.run.commands import Command
from seacrane.run.move import Move
from seacrane.run.stage import Stage
from seacrane.run.until import Contact, Level
from seacrane.scene.scene import Scene

SAMPLES = 4001


def check_limits(stage: Stage, scene: Scene) -> None:
    """Raise SceneError for conditions on limits that the stage does not have, or that never take hold."""
    limits = {name: load for name, load in scene.loads.items() if isinstance(load, _core.Limit)}
    for condition in stage.conditions:
        if not isinstance(condition, Contact):
            continue
        name = condition.limit
        limit = limits.get(name) or limits.get(name.removesuffix(".minimum").removesuffix(".maximum"))
        if limit is None:
            has = ", ".join(limits) or "none"
            raise SceneError(
                f"{stage.title}: waits for {name!r}, and there is no such limit; there are {has}"
            )
        if limit.kind == "seat" and condition.holds:
            raise SceneError(
                f"{stage.title}: would never end: seat {name!r} lets go and never takes hold again; set the "
                "load down on an end stop of a free joint"
            )


def check_bounds(stage: Stage, scene: Scene) -> None:
    """Raise SceneError for what no line or winch of the stage does, whatever it is commanded.

    A line does not push, and a winch stops at its `minimum_length`. Commands stay within its `maximum_rate`.
    What is lowered stops above the seabed.
    """
    lines = lines_of(scene.loads)
    bottom = np.inf if scene.waves is None else scene.waves.depth
    for condition in stage.conditions:
        if not isinstance(condition, Level) or not condition.above:
            continue
        if condition.channel == "line_tension" and condition.value <= 0.0:
            raise SceneError(
                f"{stage.title}: would end at once: it waits for {condition.text}, which every line has; "
                "give a tension above 0 N for a line that is taut, or maximum=0 for one that is slack"
            )
        if condition.channel != "immersed_depth":
            continue
        if condition.value > bottom:
            raise SceneError(
                f"{stage.title}: waits for {condition.text}, and the sea is {bottom:g} m deep; wait for "
                "less, or give the sea the depth of the place (SeaState)"
            )
    for condition in stage.conditions if len(stage.conditions) == 1 else ():
        if not isinstance(condition, Level) or condition.above:
            continue
        line = lines.get(dict(condition.names).get("line", ""))
        if line is None:
            continue
        if condition.channel == "line_tension" and condition.value < 0.0:
            raise SceneError(
                f"{stage.title}: would never end: it waits for {condition.text}, and a line does not push; "
                "slack is a tension below 0"
            )
        wound = on_winch(lines, line)
        if condition.channel != "line_unstretched_length" or wound is None:
            continue
        if condition.value < line.share * wound.minimum_length:
            raise SceneError(
                f"{stage.title}: would never end: it waits for {condition.text}, and the winch stops at its "
                f"minimum_length of {wound.minimum_length:g} m; wait for more, or give it a smaller one"
            )
    winches = winches_of(scene.loads)
    for name, value in stage.commands.items():
        if name.endswith(".rate") and name.removesuffix(".rate") in winches:
            _check_rate(stage, name, winches[name.removesuffix(".rate")], value)


def _check_rate(stage: Stage, name: str, line: _core.Line, command: Command) -> None:
    if isinstance(command, Move):
        fastest = 0.0 if command.to is None else abs(command.to)
    elif isinstance(command, _core.Curve):
        longest = stage.duration if stage.duration is not None else stage.maximum_duration
        assert longest is not None
        fastest = float(np.abs(command.evaluate(np.linspace(0.0, longest, SAMPLES))[:, 0]).max())
    else:
        fastest = abs(float(command))
    if fastest > line.maximum_rate:
        raise SceneError(
            f"{stage.title}: command {name!r} reaches {fastest:.6g} m/s, beyond the winch's maximum_rate of "
            f"{line.maximum_rate:g} m/s; command less, or give a larger maximum_rate"
        )


def check_lengths(stage: Stage, scene: Scene, lengths: dict[str, float], begin: float) -> None:
    """Raise SceneError for a length of line that no command of the stage leads to.

    Parameters
    ----------
    lengths : dict of str to float
        Unstretched, by line, m, as the stage begins.
    begin : s.
    """
    lines = lines_of(scene.loads)
    for condition in stage.conditions:
        if not isinstance(condition, Level) or condition.channel != "line_unstretched_length":
            continue
        name = dict(condition.names).get("line", "")
        if len(stage.conditions) > 1 or name not in lines:
            continue  # another condition may end it; a line that is not there is told by its channel
        wound = on_winch(lines, lines[name])
        if wound is not None and (wound.tension_gain > 0.0 or wound.drum_inertia > 0.0):
            continue  # its tension, motor or brake may lead it there
        assert stage.maximum_duration is not None
        share = lines[name].share
        reached = _reached(wound or lines[name], lengths[name] / share, begin, stage.maximum_duration)
        least, most = (share * length for length in reached)
        if float(condition.excess(np.array([least, most])).max()) >= -1e-9 * lengths[name]:
            continue
        what = f"{name}.length" if wound is None else f"{winch_of(wound)}.rate"
        raise SceneError(
            f"{stage.title}: would never end: it waits for {condition.text}, and line {name!r} goes from "
            f"{lengths[name]:.6g} m to {least:.6g} m at the least and {most:.6g} m at the most within its "
            f"maximum_duration of {stage.maximum_duration:g} s. Command {what!r} towards it, or give more"
        )


def _reached(line: _core.Line, length: float, begin: float, longest: float) -> tuple[float, float]:
    """The least and the most length that a stage's commands lead to; a lag only delays them."""
    time = np.linspace(begin, begin + longest, SAMPLES)
    if not line.winch:
        lengths = line.length.evaluate(time)[:, 0]
        return float(lengths.min()), float(lengths.max())
    rate = np.clip(line.rate.evaluate(time)[:, 0], -line.maximum_rate, line.maximum_rate)
    paid = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])
    slack = line.lag * float(np.abs(rate).max())  # what the drum goes on by while its rate dies out
    least = max(line.minimum_length, length + float(paid.min()) - slack)
    return least, length + float(paid.max()) + slack
