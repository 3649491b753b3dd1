"""A phase of an operation: what it is, how long it takes, and where the load lies safe again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of, flag_of, name_of, not_negative_of, positive_of, texts_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.scene.scene import Scene


@named
@dataclass(frozen=True, kw_only=True)
class Phase:
    """A part of an operation, which is held to seas of its own.

    A stationary phase lasts: its criteria are statistics of its planned hours. A passage, such as lift-off,
    the splash zone or landing, happens once: its criteria are the P90 of what seeds reach in it.

    Attributes
    ----------
    name : str
    hours : float
        Planned, h.
    contingency_hours : float
        For what goes wrong, h, beside the planned hours; default 0.
    passage : bool
        Whether it happens once: it is run in stages of the lift. Default: it is stationary.
    stages : sequence of str
        Of a passage: names of the stages that it is; default: the one of its own name.
    scene : Scene or callable, optional
        Of a stationary phase: its own scene, with or without a hook, or a function that makes it of the scene
        of the load case. Default: the scene of the load case.
    time : float
        Of a stationary phase: at which the references of the scene are held, s.
    safe : bool
        Whether the operation may wait after it, for another forecast: a point of safe return. Default: it
        goes on at once. The last phase ends safe.

    Raises
    ------
    SceneError
        For values that make no sense, or do not go together.
    """

    name: str
    hours: float
    contingency_hours: float = 0.0
    passage: bool = False
    stages: Sequence[str] = ()
    scene: Scene | Callable[[Scene], Scene] | None = None
    time: float = 0.0
    safe: bool = False

    def __post_init__(self) -> None:
        title = f"phase {shown(name_of('phase', self.name))}"
        positive_of(f"{title}: hours", self.hours, "h")
        not_negative_of(f"{title}: contingency_hours", self.contingency_hours, "h")
        finite_of(f"{title}: time", self.time, "s")
        flag_of(f"{title}: safe", self.safe)
        listed = tuple(texts_of(f"{title}: stages", self.stages))
        if flag_of(f"{title}: passage", self.passage):
            given = [word for word, one in (("scene", self.scene), ("time", self.time)) if one]
            if given:
                raise SceneError(f"{title}: {given[0]} is of stationary phases; a passage has its stages")
            listed = listed or (self.name,)
        elif listed:
            raise SceneError(f"{title}: stages are of a passage; give passage=True")
        object.__setattr__(self, "stages", listed)

    @property
    def reference(self) -> float:
        """Planned hours and contingency, h."""
        return self.hours + self.contingency_hours

    def scene_of(self, case: Scene) -> Scene:
        """Of a stationary phase in a load case."""
        made: Any = self.scene(case) if callable(self.scene) else self.scene
        return case if made is None else made


@dataclass(frozen=True, kw_only=True)
class Span:
    """When a phase is under way: hours from the start of its leg, which begins where it is safe to wait."""

    phase: Phase
    begin: float
    end: float


def legs_of(phases: Sequence[Phase]) -> list[list[Span]]:
    """Phases in series, up to each point of safe return; each takes its planned hours and contingency."""
    legs: list[list[Span]] = [[]]
    for phase in phases:
        begin = legs[-1][-1].end if legs[-1] else 0.0
        legs[-1].append(Span(phase=phase, begin=begin, end=begin + phase.reference))
        if phase.safe and phase is not phases[-1]:
            legs.append([])
    return legs
