"""What hangs on elastic lines, by the bodies that they reach last."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

from seacrane.description.given import floating_bodies
from seacrane.description.loads import lines_of

if TYPE_CHECKING:
    from seacrane.description.description import Description


def line_weights(scene: Description) -> dict[str, tuple[float, int]]:
    """Weight (N) that hangs on one line and on nothing else, and on how many of its falls, by the line.

    A seat or a free joint does not carry it for good, and does not count.
    """
    lines = lines_of(scene.loads)
    seats = {load.joint for load in scene.loads.values() if getattr(load, "kind", None) == "seat"}
    joints = [one for name, one in scene.joints.items() if name not in seats and one.kind != "free"]
    carried = {body for one in joints for body in (one.first, one.second)}
    carried |= floating_bodies(scene)
    carried |= {body for spring in scene.springs.values() for body in (spring.first, spring.second)}
    hung = {name: hooked_body(line) for name, line in lines.items()}
    on_lines = [body for line in lines.values() for body in set(line.bodies)]
    return {
        name: (scene.bodies[body].mass * scene.gravity, _falls_of(lines[name], body))
        for name, body in hung.items()
        if body in scene.bodies
        and body not in carried
        and on_lines.count(body) == 1
        and scene.bodies[body].gravity
    }


def hooked_body(line: Any) -> str:
    """The body that a line reaches last."""
    return str(list(dict.fromkeys(line.bodies))[-1])


def _falls_of(line: Any, hooked: str) -> int:
    return sum((first == hooked) != (second == hooked) for first, second in pairwise(line.bodies))
