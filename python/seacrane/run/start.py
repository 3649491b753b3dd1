"""Where a run begins: a state, or the word for the scene's own state at rest."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from seacrane import _core
from seacrane.analysis.rest_state import equilibrium
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.scene.scene import Scene

REST: Literal["rest"] = "rest"
Start: TypeAlias = _core.State | Literal["rest"] | None


def start_state(scene: Scene, start: Any, *, time: float = 0.0) -> _core.State | None:
    """The state that is meant; None for the assembled start.

    Raises SceneError for something else, and where the scene has no state at rest.
    """
    if start is None or isinstance(start, _core.State):
        return start
    if isinstance(start, str) and start == REST:
        return equilibrium(scene, time=time)
    raise SceneError(f"start is {shown(start)}; give a seacrane.State, or {REST!r} for the state at rest")
