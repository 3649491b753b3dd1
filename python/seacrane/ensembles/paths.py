"""Parameters of a scene by paths such as "bodies.payload.mass"."""

from __future__ import annotations

import difflib
from collections.abc import Collection, Mapping
from typing import Any

from seacrane.description.description import ELEMENTS, KINDS
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.scene.scene import Scene

SETTINGS = ("gravity", "baumgarte", "length_scale")


def require_paths(
    scene: Scene, names: list[str], words: tuple[str, ...], others: Collection[str] = ()
) -> None:
    """Raise SceneError for a name that is no path into the scene, no word of its sea and none of others."""
    known = [*words, *SETTINGS, *_paths(scene), *others]
    for name in names:
        if name not in known:
            near = difflib.get_close_matches(name, known, n=1, cutoff=0.3)
            raise SceneError(
                f"over: scene {scene.name!r} has no parameter {name!r}"
                + (f"; nearest: {near[0]!r}" if near else "")
                + ". Give a path such as 'bodies.<name>.mass', or a word of the sea: "
                + ", ".join(words)
            )


def with_values(scene: Scene, values: Mapping[str, Any]) -> Scene:
    """A copy of the scene with values at paths."""
    out = scene.copy()
    for path, value in values.items():
        if path in SETTINGS:
            setattr(out, path, number_of(path, value))
            continue
        table, rest = path.split(".", 1)
        name, attribute = rest.rsplit(".", 1)
        out.replace(name, kind=KINDS[table], **{attribute: value})
    return out


def _paths(scene: Scene) -> list[str]:
    return [
        f"{table}.{name}.{attribute}"
        for table in ELEMENTS
        for name, element in getattr(scene, table).items()
        for attribute in element.__getstate__()
        if attribute not in ("name", "database")
    ]
