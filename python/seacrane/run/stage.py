"""Stage: one part of a lift, as a value, and the conditions that end it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, unit_of
from seacrane.description.pick import pick_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, positive_of, texts_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.run.channel_names import all_names
from seacrane.run.commands import Command
from seacrane.run.run import Run

TOUCHING = 1e-9  # m: points so near a surface have not left it


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
        until = tuple(self.until) if isinstance(self.until, Iterable) else (self.until,)
        for one in until:
            if not isinstance(one, (Level, Contact)):
                raise SceneError(f"{self.title}: until is {shown(one)}; give conditions that Until makes")
        if not isinstance(self.commands, Mapping):
            raise SceneError(f"{self.title}: commands is {shown(self.commands)}; give {{name: command}}")
        checked: dict[str, Any] = {"until": until, "commands": MappingProxyType(dict(self.commands))}
        for key in ("duration", "maximum_duration"):
            value = getattr(self, key)
            checked[key] = None if value is None else positive_of(f"{self.title}: {key}", value, "s")
        for key in ("connect", "release"):
            checked[key] = tuple(texts_of(f"{self.title}: {key}", getattr(self, key)))
        for key, value in checked.items():
            object.__setattr__(self, key, value)
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

    def _check_end(self) -> None:
        if self.duration is None and not self.until:
            raise SceneError(
                f"{self.title}: nothing ends it; give its duration, or until and maximum_duration"
            )
        if self.duration is not None and self.until:
            raise SceneError(
                f"{self.title}: has a duration and until; leave one out; maximum_duration bounds a wait"
            )
        if self.until and self.maximum_duration is None:
            met = " or ".join(condition.text for condition in self.until)  # type: ignore[union-attr]
            raise SceneError(
                f"{self.title}: ends when {met}, and would never end where that is not met; give "
                "maximum_duration, the seconds that it may take at most"
            )
        if self.maximum_duration is not None and not self.until:
            raise SceneError(f"{self.title}: maximum_duration goes with until; leave it out")

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled itself
        return partial(Stage, **vars(self) | {"commands": dict(self.commands)}), ()


@dataclass(frozen=True)
class Level:
    """A channel above or below a value; made by `Until`."""

    channel: str
    names: tuple[tuple[str, str], ...]  # dimension and name that pick one series of the channel
    value: float  # in the channel's unit
    above: bool  # met at and above the value, else at and below it

    @property
    def text(self) -> str:
        """The condition in words."""
        of = "".join(f" of {name!r}" for _, name in self.names)
        unit = unit_of(self.channel, [name for _, name in self.names])
        return f"{self.channel}{of} {'above' if self.above else 'below'} {self.value:.6g} {unit}"

    def excess(self, series: Any) -> Any:
        """By how much values are beyond the bound: it is met where this is not negative."""
        return series - self.value if self.above else self.value - series

    def series(self, run: Run, arrays: Mapping[str, Array]) -> Array:
        """Its numbers in channels of a run, by the names of a result.

        Raises SceneError where the scene has no such channel, or no such name along it.
        """
        if self.channel not in arrays:
            raise SceneError(f"until {self.text}: this scene has no channel {self.channel!r}; it has "
                             f"{', '.join(arrays)}")  # fmt: skip
        array, names = arrays[self.channel], dict(self.names)
        for dim in reversed(CHANNELS[self.channel].dims_of(array.ndim)[1:]):
            known = all_names(run.scene, run.model)[dim]
            if names.get(dim) not in known:
                raise SceneError(
                    f"until {self.text}: {dim} is {names.get(dim)!r}; this stage has "
                    f"{', '.join(known) or 'none'}"
                )
            array = array[..., known.index(names[dim])]
        return array


@dataclass(frozen=True)
class Contact:
    """A limit that holds, or holds no more; made by `Until`."""

    limit: str  # a wire, stop, seat or contact; with ".minimum" or ".maximum" where a stop has both
    holds: bool

    @property
    def text(self) -> str:
        """The condition in words."""
        return f"{self.limit!r} {'holds' if self.holds else 'lets go'}"


Condition = Level | Contact


def of_contact(condition: Condition, contacts: Collection[str]) -> Condition:
    """A condition on a limit that is a contact by name as one on its least gap; others as they are."""
    if not isinstance(condition, Contact) or condition.limit not in contacts:
        return condition
    names = (("contact", condition.limit),)
    return Level("contact_least_gap", names, 0.0 if condition.holds else TOUCHING, not condition.holds)


@named
class Until:
    """What ends a stage. Each of these makes a condition for `Stage(until=...)`.

    A condition is met as soon as its channel is at its value or beyond, also where the stage begins so. One
    at whose value a stage begins, and which it leaves at once, is met when it comes back.
    """

    @staticmethod
    def channel(
        channel: str, *, minimum: float | None = None, maximum: float | None = None, **names: str
    ) -> Level:
        """Any channel at or above, or at or below, a value in its unit.

        Parameters
        ----------
        channel : str
            Such as "position".
        minimum, maximum : float
            One of them.
        **names : str
            One name for each dimension but time, such as ``body="load", axis="z"``.

        Raises
        ------
        SceneError
        """
        pick = pick_of("until", channel, names)
        if pick.parts:
            raise SceneError(f"until {pick}: a stage begins at its own time; leave {pick.parts} out")
        channel, names = pick.channel, dict(pick.names)
        missing = [dim for dim in CHANNELS[channel].dims[1:] if dim not in names]
        if missing:
            raise SceneError(f"until {channel}: says not which {missing[0]}; give {missing[0]}=...")
        if (minimum is None) == (maximum is None):
            raise SceneError(
                f"until {channel}: minimum is {minimum} and maximum is {maximum}; give one of them"
            )
        value = number_of(f"until {channel}", maximum if minimum is None else minimum)
        if not np.isfinite(value):
            raise SceneError(
                f"until {channel}: is to pass {value}, which it never does; give a finite number"
            )
        return Level(channel, tuple(sorted(names.items())), value, minimum is not None)

    @staticmethod
    def tension(line: str, *, minimum: float | None = None, maximum: float | None = None) -> Level:
        """The tension of an elastic line, N. For a rigid link: ``Until.channel("tension", link=...)``."""
        return Until.channel(
            "line_tension", minimum=minimum, maximum=maximum, line=name_of("until: line", line)
        )

    @staticmethod
    def length(line: str, *, minimum: float | None = None, maximum: float | None = None) -> Level:
        """The unstretched length of an elastic line, m: what its winch has paid out."""
        return Until.channel(
            "line_unstretched_length", minimum=minimum, maximum=maximum, line=name_of("until: line", line)
        )

    @staticmethod
    def depth(part: str, *, minimum: float | None = None, maximum: float | None = None) -> Level:
        """The depth of a lowest point below still water, m: of a body with parts in water, or of one part.

        Waves neither end a stage early nor hold it up. Above the water the depth is negative.
        """
        return Until.channel(
            "immersed_depth", minimum=minimum, maximum=maximum, immersed=name_of("until: part", part)
        )

    @staticmethod
    def clear(contact: str, *, minimum: float) -> Level:
        """All points of a contact are at least so far from the surface, m."""
        return Until.channel("contact_least_gap", minimum=minimum, contact=name_of("until: contact", contact))

    @staticmethod
    def contact(limit: str) -> Contact:
        """A limit takes hold: a stop is touched, a wire is taut; or the first point of a contact touches."""
        return Contact(name_of("until: limit", limit), True)

    @staticmethod
    def release(limit: str) -> Contact:
        """A limit lets go: a load leaves its seat, a wire is slack; or all points of a contact are off."""
        return Contact(name_of("until: limit", limit), False)
