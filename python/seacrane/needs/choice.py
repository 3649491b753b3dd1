"""One choice of modelling in a scene, and the scene without it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from seacrane.scene.scene import Scene


@dataclass(frozen=True, kw_only=True)
class Choice:
    """A change of a scene to what is simpler, or to what it leaves out.

    Attributes
    ----------
    name : What the scene is after it, such as "no air drag on load".
    script : str
        Lines of Python that do the same to a described `scene`; `needs` is `seacrane.needs`.
    made : callable
        The changed copy of a scene. What it changes may have gone by another choice: it then does nothing.
    of : str
        What it is about: of choices about the same, one at most is taken.
    """

    name: str
    script: str
    made: Callable[[Scene], Scene]
    of: str


Call = tuple[str, tuple[Any, ...], dict[str, Any]]  # a method of a scene, and what it is given


def call(method: str, *given: Any, **named: Any) -> Call:
    """A call of a scene's method, as `by_calls` takes it."""
    return method, given, named


def by_calls(name: str, *calls: Call, of: str) -> Choice:
    """The choice that such calls make, which are its script; nothing, where a load that they name is gone."""
    lines = []
    for method, given, named in calls:
        told = [*map(repr, given), *(f"{key}={value!r}" for key, value in named.items())]
        lines.append(f"scene.{method}({', '.join(told)})")
    return Choice(name=name, script="\n".join(lines), made=partial(_called, calls=calls), of=of)


def _called(scene: Scene, *, calls: Sequence[Call]) -> Scene:
    loads = [given[0] for _, given, named in calls if named.get("kind") == "load"]
    if not scene.loads.keys() >= {*loads}:
        return scene
    out = scene.copy()
    for method, given, named in calls:
        getattr(out, method)(*given, **named)
    return out
