"""Scenes whose elastic lines are taken on another rung: rigid links, a quasi-static stretch, or elastic."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from seacrane.description.loads import lines_of, path_of
from seacrane.description.places import place_of
from seacrane.description.rungs import AUTO, ELASTIC, QUASI_STATIC, with_rungs
from seacrane.errors import SceneError
from seacrane.scene.scene import Scene

RIGID_LINES = "lines rigid"
LINE_RUNGS = (RIGID_LINES, f"lines {QUASI_STATIC}", f"lines {ELASTIC}")


def line_variants(scene: Scene) -> Iterator[tuple[str, Callable[[], Scene]]]:
    """The rungs that the lines of a scene do not have already, each with what makes the scene."""
    lines = lines_of(scene.loads)
    own = {ELASTIC if line.rung == AUTO else line.rung for line in lines.values()}
    if not lines:
        return
    yield RIGID_LINES, partial(with_rigid_lines, scene)
    for rung, title in ((QUASI_STATIC, LINE_RUNGS[1]), (ELASTIC, LINE_RUNGS[2])):
        if own != {rung}:
            yield title, partial(with_rungs, scene, dict.fromkeys(lines, rung))


def with_rigid_lines(scene: Scene) -> Scene:
    """Every line replaced by a link as long as its path is described, which also pushes.

    Raises SceneError for a line over more than two points, or whose length changes.
    """
    out = scene.copy()
    for name, line in lines_of(scene.loads).items():
        if len(line.bodies) > 2:
            raise SceneError(f"line {name!r}: runs over {len(line.bodies)} points, and a rigid link over two")
        pieces = np.asarray(line.length.to_pieces()["coefficients"])
        if line.winch or pieces.reshape(-1, 6)[:, 1:].any() or len(pieces) > 1:
            raise SceneError(f"line {name!r}: its length changes, and that of a rigid link does not")
        (first, start), (second, end) = path_of(line)
        out.remove(name)
        out.add_joint(
            kind="distance", name=name, first=first, second=second,
            point=place_of(scene, body=first, point=start),
            second_point=place_of(scene, body=second, point=end),
        )  # fmt: skip
    return out
