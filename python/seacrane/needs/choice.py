"""One choice of modelling in a scene, and the scene without it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

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
