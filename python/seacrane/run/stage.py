"""Stage: one part of a lift, as a value."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, positive_of, texts_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.run.commands import Command
from seacrane.run.until import Condition, Contact, Level


@named
@dataclass(frozen=True, kw_only=True)
class Stage:
    """One part of a lift: what is connected and released as it begins, commanded during it, and ends it.

    Attributes
    ----------
    name : str
        Differs from those of other stages.
    duration : float, optional
        s; or else `until` and `maximum_duration`.
    until : condition or sequence of them, optional
        Made by `Until`; the first that is met ends the stage.
    maximum_duration : float, optional
        s; a stage whose conditions are not met by then ends the run with an error that names it.
    commands : mapping of str to Move, Curve or float
        By what is commanded: "<line>.rate" of a winch, "<line>.length" of a line without one,
        "<actuator>.reference", "<actuator>.force", or a driver's name. A curve has the stage's clock, 0 where
        it begins. A number is a rate or force reached within 1 s. What is not commanded goes on as it is.
    connect : sequence of str
        Elements of the scene that are absent until now: joints with what acts on them, lines, springs and
        other loads.
    release : sequence of str
        Elements that are absent from now on.

    Raises
    ------
    SceneError
        For what contradicts itself, such as a stage that could go on for ever.
    """

    name: str
    duration: float | None = None
    until: Condition | Sequence[Condition] = ()
    maximum_duration: float | None = None
    commands: Mapping[str, Command] = field(default_factory=dict)
    connect: Sequence[str] = ()
    release: Sequence[str] = ()

    def __post_init__(self) -> None:
        name_of("stage", self.name)
        self._set("until", _conditions(self.title, self.until))
        for key in ("duration", "maximum_duration"):
            value = getattr(self, key)
            self._set(key, None if value is None else positive_of(f"{self.title}: {key}", value, "s"))
        if not isinstance(self.commands, Mapping):
            raise SceneError(f"{self.title}: commands is {shown(self.commands)}; give {{name: command}}")
        self._set("commands", MappingProxyType(dict(self.commands)))
        for key in ("connect", "release"):
            self._set(key, tuple(texts_of(f"{self.title}: {key}", getattr(self, key))))
        self._check_end()

    @property
    def title(self) -> str:
        """The stage by its name, as messages begin."""
        return f"stage {self.name!r}"

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """`until` as a tuple."""
        assert isinstance(self.until, tuple)
        return self.until

    def _set(self, key: str, value: Any) -> None:
        object.__setattr__(self, key, value)

    def _check_end(self) -> None:
        if self.duration is None and not self.until:
            raise SceneError(
                f"{self.title}: nothing ends it; give its duration, or until and maximum_duration"
            )
        if self.duration is not None and self.until:
            raise SceneError(f"{self.title}: has a duration and until; leave one out")
        if self.until and self.maximum_duration is None:
            met = " or ".join(condition.text for condition in self.until)  # type: ignore[union-attr]
            raise SceneError(
                f"{self.title}: ends when {met}, and would never end where that is not met; give "
                "maximum_duration, the seconds that it may take at most"
            )
        if self.maximum_duration is not None and not self.until:
            raise SceneError(f"{self.title}: maximum_duration goes with until; leave it out")

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled itself
        parts = {
            "name": self.name, "duration": self.duration, "until": self.until,
            "maximum_duration": self.maximum_duration, "commands": dict(self.commands),
            "connect": self.connect, "release": self.release,
        }  # fmt: skip
        return _made, (parts,)


def _made(parts: dict[str, Any]) -> Stage:
    return Stage(**parts)


def _conditions(what: str, given: Any) -> tuple[Condition, ...]:
    conditions = tuple(given) if isinstance(given, Iterable) else (given,)
    for one in conditions:
        if not isinstance(one, (Level, Contact)):
            raise SceneError(f"{what}: until is {shown(one)}; give conditions that Until makes")
    return conditions
