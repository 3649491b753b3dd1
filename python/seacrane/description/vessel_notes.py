"""Notes that a scene keeps on each of its vessels: one value with one vessel, by its body with several."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from seacrane.description.scene import Scene


def note_on(scene: Scene, body: str, **notes: Any) -> None:
    """Keep notes on the vessel that is added last."""
    others = [vessel.body for vessel in scene.vessels.values() if vessel.body != body]
    for key, value in notes.items():
        by_body = {other: noted(scene, key, other) for other in others}
        scene.notes[key] = {**by_body, body: value} if by_body else value


def noted(scene: Scene, key: str, body: str) -> Any:
    """What is noted on a vessel, or None."""
    value = scene.notes.get(key)
    return value.get(body) if isinstance(value, Mapping) else value
