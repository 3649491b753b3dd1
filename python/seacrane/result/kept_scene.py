"""The scene that a result is of: as it was run, or the text of a file, which is read once it is asked for."""

from __future__ import annotations

import json

from seacrane.errors import SeacraneError
from seacrane.scene.file import LARGEST_FILE, described, scene_from_bytes
from seacrane.scene.scene import Scene

NOT_KEPT = "scene_not_kept"  # among the stats of a result: what of the scene its file does not hold, and why


class KeptScene:
    """A scene of the process that ran it, or the text that `written` made, found at a place."""

    def __init__(self, scene: Scene | None, text: bytes = b"", place: str = "") -> None:
        self._live, self._text, self._place = scene, text, place

    @property
    def scene(self) -> Scene:
        """The scene, always the same one; FileFormatError where the text is none."""
        if self._live is None:
            self._live = scene_from_bytes(self._text, self._place, Scene())
        return self._live

    def written(self) -> tuple[bytes, str]:
        """The text of a scene file, and in words what it lacks; empty where nothing, or all, is lost."""
        if self._live is None:
            return self._text, ""
        functions = ", ".join(f"function force {name!r}" for name in self._live.function_forces)
        lacks = f"{functions}: a file holds data only" if functions else ""
        try:
            data = described(self._live.copy(notes={}, function_forces={}))
            text = json.dumps(data, allow_nan=False, separators=(",", ":")).encode("ascii")
        except (SeacraneError, ValueError) as error:
            return b"", f"the scene: {error}"
        if len(text) > LARGEST_FILE:
            return b"", f"the scene: takes {len(text)} bytes, above {LARGEST_FILE}"
        return text, lacks
