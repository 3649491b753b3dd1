"""A scene from the tables of a lift: each table makes its call, in the order of the tables."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from seacrane._core import Curve
from seacrane.analysis.inverse import reflected_inertia, tuned_gains
from seacrane.analysis.quasi_static import feed_forward
from seacrane.analysis.weight_balance import Balance, balance, balance_by_force
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import untold
from seacrane.lift.calls import Caller, Keywords, keywords
from seacrane.lift.check_keys import Entry, only, plain, titled
from seacrane.lift.keys import Key
from seacrane.lift.text_lines import Place
from seacrane.scene.scene import Scene

NO_CALLS = ("scene", "run", "method", "outputs", "balance", "control", "stage", "study")
LATER = ("command", "heave_compensation", "ballast", "notes")  # in this order, after what they act on
GAINS = ("stiffness", "damping")
Made = TypeVar("Made")
MOST_TIMES = 10_000  # each takes a rest state
WHOLE = 1e-6  # of an interval


def made(entries: Sequence[Entry], table: str, make: Callable[..., Made]) -> Made:
    """What a table that occurs once describes; with defaults where it does not. Raises FileFormatError."""
    one = only(entries, table)
    if one is None:
        return make()
    with refused_at(one):
        return make(**keywords(one.table.keys, one.values))


class SceneBuild:
    """Builds one scene: first without control, which takes a scene to compute, then with it."""

    def __init__(self, entries: Sequence[Entry]) -> None:
        self.entries, self.caller = entries, Caller()

    def scene(self) -> Scene:
        """The scene that the tables describe, with every command controlled.

        Raises FileFormatError with the line of the table that the scene refuses, or of the key where that is
        known.
        """
        scene, start = self._started()
        commands = [entry for entry in self.entries if entry.table.name == "command"]
        control = only(self.entries, "control")
        if commands and control is None:
            commands[0].fail(f"{commands[0].title} has no [control] to follow; add it")
        if control is not None:
            self._control(scene, control, commands, start)
        return scene

    def _started(self, *, at_rest: bool = False) -> tuple[Scene, Balance | None]:
        """The scene with its commands not yet controlled, and what balances it where [balance] says so."""
        scene = made(self.entries, "scene", Scene)
        for entry in _in_order(self.entries):
            with untold(), refused_at(entry):
                match entry.table.name:
                    case "command":
                        given = keywords(entry.table.keys, entry.values, scene)
                        scene.add_actuator(**{key: one for key, one in given.items() if key != "reference"})
                    case "notes":
                        scene.notes.update(plain(entry.values))
                    case _:
                        self.caller.call(scene, entry.table, entry.values, at_rest=at_rest)
        balanced = only(self.entries, "balance")
        if balanced is None:
            return scene, None
        if only(self.entries, "ballast"):
            balanced.fail("[balance] stands beside [ballast]; leave one out")
        with refused_at(balanced):
            return scene, balance_by_force(scene, body=balanced.values["vessel"])

    def _control(
        self, scene: Scene, control: Entry, commands: Sequence[Entry], start: Balance | None
    ) -> None:
        """Give every command gains and feed-forward, in place of an actuator without."""
        if not commands:
            control.fail("[control] has no [[command]] to control; add one, or leave it out")
        given = [keywords(entry.table.keys, entry.values, scene) for entry in commands]
        references = {str(one.get("name", one["joint"])): _curve(one.get("reference", 0.0)) for one in given}
        with refused_at(control):
            settings = keywords(control.table.keys, control.values)
            tuned_at = settings.pop("tuned_at", None)
            tuning = scene if tuned_at is None else self._tuning(tuned_at, given)
            for key in ("natural_frequency", "damping_ratio"):
                if not settings[key] > 0.0:
                    raise SceneError.of(key, f"is {settings[key]:g}; give a number above zero")
            inertia, omega = reflected_inertia(tuning), 2.0 * np.pi * settings["natural_frequency"]
            gains = tuned_gains(inertia, natural_frequency=omega, damping_ratio=settings["damping_ratio"])
            loads = feed_forward_of(
                scene, start, references, settings, at_rest=lambda: self._started(at_rest=True)[0]
            )
            for name in references:
                del scene.actuators[name]
            for name, one in zip(references, given, strict=True):
                chosen = dict(zip(GAINS, gains[name], strict=True))
                scene.add_actuator(**one | chosen, feed_forward=loads.get(name, 0.0))

    def _tuning(self, pose: Keywords, commands: Sequence[Keywords]) -> Scene:
        """The cranes alone on a fixed base, in the pose at which the inertia of their drives is taken."""
        scene = Scene(name="tuning")
        for entry in self.entries:
            if entry.table.name == "crane":
                with refused_at(entry):
                    self.caller.crane(scene, entry.table, entry.values, {"base": "ground"} | pose)
        for given in commands:
            scene.add_actuator(**{key: value for key, value in given.items() if key != "reference"})
        return scene


def _in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Those that make calls; bodies that are placed below a crane's tip follow the cranes."""
    calls = [entry for entry in entries if entry.table.name not in NO_CALLS]
    below = [entry for entry in calls if entry.table.name == "body" and "below" in entry.values]
    later = sorted(
        (entry for entry in calls if entry.table.name in LATER),
        key=lambda entry: LATER.index(entry.table.name),
    )
    rest = [entry for entry in calls if entry not in [*below, *later]]
    last = max((i for i, entry in enumerate(rest) if entry.table.name == "crane"), default=-1) + 1
    return [*rest[:last], *below, *rest[last:], *later]


@contextlib.contextmanager
def refused_at(entry: Entry, *inside: str | int) -> Iterator[None]:
    """What is refused within the block is refused at this table of the file, or at what is inside."""
    try:
        yield
    except (SceneError, FileFormatError, TypeError) as error:
        if isinstance(error, FileFormatError) and error.placed:
            raise
        title = titled((*entry.path, *inside)) if inside else entry.title
        about = getattr(error, "about", ())
        path = inside or _about(entry.table.keys, entry.values, about)
        entry.fail(f"{title}: {error}", *path)


def _about(keys: Iterable[Key], values: Mapping[str, Any], about: Sequence[str]) -> Place:
    """The place in a table of the key that an error is about; none where it has no such key.

    Parameters
    ----------
    about : Of the error: an element's parts, and last the keyword.
    """
    for key in keys:
        for spelling in key.spellings:
            if spelling not in values or not about:
                continue
            if about[-1] in (key.entry or key.name, spelling):
                return (spelling,)
            if key.type == "table" and (key.name in about or any(one.entry for one in key.keys)):
                inside = _about(key.keys, values[spelling], about)
                if inside:
                    return (spelling, *inside)
    return ()


def _curve(value: float | Curve) -> Curve:
    return value if isinstance(value, Curve) else Curve.constant(value=value)


def feed_forward_of(
    scene: Scene,
    start: Balance | None,
    references: Mapping[str, Curve],
    settings: Mapping[str, Any],
    *,
    at_rest: Callable[[], Scene],
) -> dict[str, Curve]:
    """Loads that hold the coordinates at rest, by the settings of [control]; `references` are by command.

    `start` balances the scene, where it is known; `at_rest` makes it without waves and fluid memory.
    """
    kind = settings.get("feed_forward", "references")
    if kind != "references":
        for key in ("times", "period"):
            if key in settings:
                raise SceneError.of(
                    key, f"is given, which feed_forward = {kind!r} has no use for; leave it out"
                )
    if kind == "none":
        return {}
    if kind == "start":
        loads = (balance(scene) if start is None else start).loads
        return {name: Curve.constant(value=loads[name]) for name in references}
    if "times" not in settings:
        raise SceneError(
            "feed_forward along the references needs times, such as [{until_s = 45, every_s = 5}]"
        )
    times = times_of(settings["times"])
    return feed_forward(at_rest(), references=references, times=times, period=settings.get("period"))


def times_of(parts: Sequence[Mapping[str, float]]) -> list[float]:
    """From zero on, part after part, each at its own interval, s."""
    times = [0.0]
    for part in parts:
        begin, until, every = times[-1], part["until"], part["every"]
        steps = (until - begin) / every if every > 0.0 else 0.0
        count = round(min(steps, MOST_TIMES))
        if not 1 <= count < MOST_TIMES - len(times) or abs(steps - count) > WHOLE:
            raise SceneError.of(
                "times",
                f"is wrong from {begin:g} s until {until:g} s every {every:g} s; the part must begin before "
                f"its end, hold its interval a whole number of times, and all parts {MOST_TIMES} times",
            )
        times += (begin + every * np.arange(1, count + 1)).tolist()
    return times
