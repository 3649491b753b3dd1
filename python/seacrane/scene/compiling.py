"""Scene.compile()."""

from __future__ import annotations

from seacrane import _core
from seacrane.description import compilation
from seacrane.description.description import Description
from seacrane.validity.unstable import warn_of_capsize


def compile_scene(scene: Description, *, merge: bool = True) -> _core.Model:
    """Check everything, close the joints and compile.

    Parameters
    ----------
    merge : bool
        Step bodies that never move relative to each other as one and leave out what adds nothing.

    Raises
    ------
    SceneError
        Names the element, the value and the fix; for loops that do not close, the loop and its gap.

    Warns
    -----
    AssemblyWarning : names bodies that closing the joints moved, by more than 0.01 m or 0.01 rad.
    UnstableRestWarning : names vessels whose roll restoring the weights on them outweigh.
    UserWarning : names joints that are redundant: their reactions are minimum-norm, not unique.
    """
    warn_of_capsize(scene)
    return compilation.compile_scene(scene, merge=merge)
