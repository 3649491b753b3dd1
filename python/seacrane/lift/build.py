"""A scene from the tables of a lift: each table makes its call, in the order of the tables."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from seacrane._core import Curve
from seacrane.analysis.inverse import Balance
from seacrane.analysis.weight_balance import balance_by_force
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.caller import untold
from seacrane.lift.calls import Caller, Keywords, keywords
from seacrane.lift.check_keys import Entry, plain
from seacrane.lift.control import feed_forward_of, gains_of
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
        for entry in self.entries:
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
            return balance_by_force(scene, body=balanced.values["body"])

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
            words = f"(?:{re.escape(key.name)}|{re.escape(spelling)})"
            if spelling not in values:
                continue
            if re.search(rf"\b{words}(?:\[\d+\])? {ABOUT}\b", message):
                return (*path, spelling)
            if key.type == "table" and f"{key.name}: " in message:
                inside = _about((*path, spelling), key.keys, values[spelling], message)
                if inside is not None:
                    return inside
    return None


def _curve(value: float | Curve) -> Curve:
    return value if isinstance(value, Curve) else Curve.constant(value=value)
