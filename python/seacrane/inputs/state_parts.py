"""What a state is of, by its parts."""

from __future__ import annotations

from pathlib import Path

from seacrane import _core
from seacrane.errors import FileFormatError


def require_parts(path: Path, parts: list[str], model: _core.Model) -> None:
    """Raise FileFormatError where a file's `State.parts` are those of another model; none: not known."""
    own = _core.initial_state(model).parts
    if not parts or parts == own:
        return
    count = max(len(parts), len(own))
    padded = [[*some, *["nothing more"] * (count - len(some))] for some in (parts, own)]
    there, here = next(pair for pair in zip(*padded, strict=True) if pair[0] != pair[1])
    raise FileFormatError(
        f"{path}: is the state of another scene: it holds {there[:80]} where the scene has {here}; give a "
        "state of this scene"
    )
