"""A line with mass of a scene, in another number of segments."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.loads import lines_of, whole_of
from seacrane.errors import SceneError
from seacrane.scene.heavy_line import chain_of_segments, on_a_winch, scaled
from seacrane.scene.line_fluid import Fluid
from seacrane.scene.scene import Scene

OF_THE_LINE = (
    "name", "bodies", "points", "EA", "length", "damping_ratio", "mass", "rung", "settling", "paid_out_by",
    "share",
)  # fmt: skip
MADE = ("winding", "water", "drag")  # of each segment, with the line: after its name


def with_segments(scene: Scene, name: str, segments: int) -> Scene:
    """The scene with a line with mass in so many segments, from its rest shape between the same ends.

    Raises SceneError for a line that is none with mass, and one at whose masses there is something else, such
    as a seabed.
    """
    chain = segments_of(scene, name)
    if not chain:
        raise SceneError(f"line {name!r}: is no line with mass of scene {scene.name!r}")
    first, length = chain[0], chain[0].length
    start = float(length.evaluate([0.0])[0, 0])
    wound = not first.paid_out_by and f"{name}.1 winding" in scene.loads
    ends = [_end(scene, chain[0], 0, f"{name}.first"), _end(scene, chain[-1], 1, f"{name}.last")]
    fluid = Fluid.of(scene.loads.get(f"{name}.1 water", scene.loads.get(f"{name}.1 drag")))
    out = scene.copy()
    _remove(out, name, chain)
    chain_of_segments(
        out, name, [body for body, _ in ends], [point for _, point in ends], EA=first.EA,
        length=scaled(length, len(chain)) if wound else start * len(chain),
        mass_per_length=first.mass / start, segments=segments, damping_ratio=first.damping_ratio,
        rung=first.rung, settling=first.settling, fluid=fluid, seabed=None,
    )  # fmt: skip
    if first.paid_out_by:
        on_a_winch(out, name, _winch(first))
    return out


def segments_of(scene: Description, name: str) -> list[_core.Line]:
    """The segments of a line with mass in their order; none of another line."""
    return [line for own, line in lines_of(scene.loads).items() if own != name == whole_of(own, line)]


def _end(scene: Description, segment: _core.Line, side: int, tied: str) -> tuple[str, Any]:
    """The body that an end of the line is on, and where in its coordinates, m."""
    if segment.bodies[side] != tied:
        return segment.bodies[side], segment.points[side]
    return scene.joints[tied].first, scene.joints[tied].first_frame.point


def _winch(segment: _core.Line) -> dict[str, Any]:
    """What the first segment has of the line's winch."""
    return {key: value for key, value in segment.__getstate__().items() if key not in OF_THE_LINE}


def _remove(scene: Scene, name: str, chain: list[_core.Line]) -> None:
    for one in chain:
        for load in (*(f"{one.name} {kind}" for kind in MADE), one.name):
            if load in scene.loads:
                scene.remove(load, kind="load")
    for body in (f"{name}.first", f"{name}.last", *(one.name for one in chain[:-1])):
        if body in scene.joints:
            scene.remove(body, kind="joint")
        if body in scene.bodies:
            scene.remove(body, kind="body")
