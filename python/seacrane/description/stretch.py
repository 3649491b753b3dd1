"""Lines whose stretch="auto" a run settles; everywhere else they are elastic."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from seacrane import _core
from seacrane.description.loads import lines_of
from seacrane.description.scene import Description, Some

AUTO, ELASTIC, QUASI_STATIC = "auto", "elastic", "quasi-static"


def automatic(scene: Description) -> dict[str, _core.Line]:
    """The lines with stretch="auto"."""
    return {name: line for name, line in lines_of(scene.loads).items() if line.stretch == AUTO}


def with_stretch(scene: Some, stretches: Mapping[str, str]) -> Some:
    """The scene with the stretch of these lines; itself where none is named."""
    if not stretches:
        return scene
    out = scene.copy()
    for name, stretch in stretches.items():
        out.loads[name] = _stretched(out.loads[name], stretch)
    return out


def compiled_loads(loads: Iterable[Any]) -> list[Any]:
    """Loads as the core takes them: it knows no "auto"."""
    return [
        _stretched(load, ELASTIC) if isinstance(load, _core.Line) and load.stretch == AUTO else load
        for load in loads
    ]


def _stretched(line: _core.Line, stretch: str) -> _core.Line:
    return _core.Line(**line.__getstate__() | {"stretch": stretch})
