"""A scene from the tables of a lift: each table makes its call, in the order of the tables."""

from __future__ import annotations

import contextlib
import re
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
from seacrane.lift.check_keys import Entry, plain
from seacrane.lift.document import Document
from seacrane.lift.keys import Key
from seacrane.lift.text_lines import Place
from seacrane.scene.scene import Scene

LAST = ("heave_compensation",)  # what refers to commands
NO_CALLS = (
    "scene", "run", "method", "outputs", "ballast", "balance", "control", "command", "stage", "notes", *LAST
)  # fmt: skip
GAINS = ("stiffness", "damping")
ABOUT = "(?:is|are|has|have|holds)"  # follows the name of what a message is about
Made = TypeVar("Made")
MOST_TIMES = 10_000  # each takes a rest state
WHOLE = 1e-6  # of an interval


def scene_of(document: Document, entries: Sequence[Entry]) -> Scene:
    """The scene that the tables of a lift describe.

    Raises
    ------
    FileFormatError
        With the line of the table that the scene refuses, or of the key where that is clear.
    """
    return _Build(document, entries).scene()


def made(document: Document, entries: Sequence[Entry], table: str, make: Callable[..., Made]) -> Made:
    """What a table that occurs once describes; with defaults where it does not. Raises FileFormatError."""
    one = _only(entries, table)
    if one is None:
        return make()
    with refused_at(document, one):
        return make(**keywords(one.table.keys, one.values))


def _only(entries: Sequence[Entry], table: str) -> Entry | None:
    return next((entry for entry in entries if entry.table.name == table), None)


class _Build:
    """Builds one lift: first without control, which takes a scene to compute, then with it."""

    def __init__(self, document: Document, entries: Sequence[Entry]) -> None:
        self.document, self.entries, self.caller = document, entries, Caller()

    def scene(self) -> Scene:
        """With every command controlled."""
        scene, start = self._started()
        commands = [entry for entry in self.entries if entry.table.name == "command"]
        control = _only(self.entries, "control")
        if commands and control is None:
            self.document.fail(commands[0].path, f"{commands[0].title} has no [control] to follow; add it")
        if control is not None:
            self._control(scene, control, commands, start)
        return scene

    @untold()
    def _started(self, *, at_rest: bool = False) -> tuple[Scene, Balance | None]:
        """The scene with its commands not yet controlled, and what balances it where [balance] says so."""
        scene = made(self.document, self.entries, "scene", Scene)
        for entry in _in_order(self.entries):
            if entry.table.name not in NO_CALLS:
                with refused_at(self.document, entry):
                    self.caller.call(scene, entry.table, entry.values, at_rest=at_rest)
        for entry in self.entries:
            if entry.table.name == "command":
                with refused_at(self.document, entry):
                    given = keywords(entry.table.keys, entry.values, scene)
                    scene.add_actuator(**{key: value for key, value in given.items() if key != "reference"})
        for entry in self.entries:
            if entry.table.name in LAST:
                with refused_at(self.document, entry):
                    self.caller.call(scene, entry.table, entry.values, at_rest=at_rest)
        for entry in self.entries:
            if entry.table.name == "notes":
                scene.notes.update(plain(entry.values))
        return scene, self._ballasted(scene, at_rest=at_rest)

    def _ballasted(self, scene: Scene, *, at_rest: bool) -> Balance | None:
        """Add ballast, once drives hold the scene; what [balance] balances."""
        balanced = _only(self.entries, "balance")
        for entry in self.entries:
            if entry.table.name != "ballast":
                continue
            if balanced is not None:
                self.document.fail(balanced.path, "[balance] stands beside [ballast]; leave one out")
            with refused_at(self.document, entry):
                self.caller.call(scene, entry.table, entry.values, at_rest=at_rest)
        if balanced is None:
            return None
        with refused_at(self.document, balanced):
            return balance_by_force(scene, body=balanced.values["vessel"])

    def _control(
        self, scene: Scene, control: Entry, commands: Sequence[Entry], start: Balance | None
    ) -> None:
        """Give every command gains and feed-forward, in place of an actuator without."""
        if not commands:
            self.document.fail(
                control.path, "[control] has no [[command]] to control; add one, or leave it out"
            )
        given = [keywords(entry.table.keys, entry.values, scene) for entry in commands]
        references = {str(one.get("name", one["joint"])): _curve(one.get("reference", 0.0)) for one in given}
        with refused_at(self.document, control):
            settings = keywords(control.table.keys, control.values)
            tuned_at = settings.pop("tuned_at", None)
            tuning = scene if tuned_at is None else self._tuning(tuned_at, given)
            gains = gains_of(tuning, settings)
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
                with refused_at(self.document, entry):
                    self.caller.crane(scene, entry.table, entry.values, {"base": "ground"} | pose)
        for given in commands:
            scene.add_actuator(**{key: value for key, value in given.items() if key != "reference"})
        return scene


def _in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Bodies that are placed below a crane's tip follow the cranes; all else is as the tables are."""
    later = [entry for entry in entries if entry.table.name == "body" and "below" in entry.values]
    rest = [entry for entry in entries if entry not in later]
    last = max((i for i, entry in enumerate(rest) if entry.table.name == "crane"), default=-1) + 1
    return [*rest[:last], *later, *rest[last:]]


@contextlib.contextmanager
def refused_at(document: Document, entry: Entry) -> Iterator[None]:
    """What is refused inside the block is refused at this table of the file."""
    try:
        yield
    except (SceneError, FileFormatError, TypeError) as error:
        if isinstance(error, FileFormatError) and error.placed:
            raise
        about = _about(entry.path, entry.table.keys, entry.values, str(error))
        document.fail(entry.path if about is None else about, f"{entry.title}: {error}")


def _about(path: Place, keys: Iterable[Key], values: Mapping[str, Any], message: str) -> Place | None:
    """The path of the key that a message is about; None where it names none."""
    for key in keys:
        for spelling in key.spellings:
            words = key.entry or f"(?:{re.escape(key.name)}|{re.escape(spelling)})"
            if spelling not in values:
                continue
            if re.search(rf"\b{words}(?:\[\d+\])? {ABOUT}\b", message):
                return (*path, spelling)
            if key.type == "table" and (f"{key.name}: " in message or any(one.entry for one in key.keys)):
                inside = _about((*path, spelling), key.keys, values[spelling], message)
                if inside is not None:
                    return inside
    return None


def _curve(value: float | Curve) -> Curve:
    return value if isinstance(value, Curve) else Curve.constant(value=value)


def gains_of(tuning: Scene, settings: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Stiffness and damping of every actuator of a scene, by [control]."""
    for key in ("natural_frequency", "damping_ratio"):
        if not settings[key] > 0.0:
            raise SceneError(f"{key} is {settings[key]:g}; give a number above zero")
    return tuned_gains(
        reflected_inertia(tuning),
        natural_frequency=2.0 * np.pi * settings["natural_frequency"],
        damping_ratio=settings["damping_ratio"],
    )


def feed_forward_of(
    scene: Scene,
    start: Balance | None,
    references: Mapping[str, Curve],
    settings: Mapping[str, Any],
    *,
    at_rest: Callable[[], Scene],
) -> dict[str, Curve]:
    """Loads that hold the coordinates at rest, by [control].

    Parameters
    ----------
    start : Of the scene, where it is known.
    references : mapping of str to Curve
        By command.
    settings : Keywords of [control].
    at_rest : Makes the scene without waves and fluid memory.
    """
    kind = settings.get("feed_forward", "references")
    if kind != "references":
        for key in ("times", "period"):
            if key in settings:
                raise SceneError(
                    f"{key} is given, which feed_forward = {kind!r} has no use for; leave it out"
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
            raise SceneError(
                f"times is wrong from {begin:g} s until {until:g} s every {every:g} s; the part must begin "
                f"before its end, hold its interval a whole number of times, and all parts {MOST_TIMES} times"
            )
        times += (begin + every * np.arange(1, count + 1)).tolist()
    return times
