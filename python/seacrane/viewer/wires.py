"""Links, wires, springs and elastic lines: lines between points of bodies, slack ones with their length."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from seacrane.description.loads import lines_of, path_of
from seacrane.description.scene import Description
from seacrane.viewer.shapes import plain

GROUND = -1


def wires_of(scene: Description, bodies: Sequence[str]) -> list[dict[str, Any]]:
    """Distance joints, springs and the spans of elastic lines for the page.

    Of each: name, the element that it is of, kind ("link", "wire" or "spring"; a span is a link), both ends
    as the body's number (-1: the ground) and a point relative to its centre of mass, and the length (m) below
    which it hangs slack; 0 if it never does.
    """
    limits = {limit.joint for limit in scene.loads.values() if getattr(limit, "kind", None) == "wire"}
    found = []
    for name, joint in scene.joints.items():
        if joint.kind == "distance":
            pulls = name in limits
            found.append(
                {
                    "name": name,
                    "element": name,
                    "kind": "wire" if pulls else "link",
                    "from": end_of(scene, bodies, joint.first, joint.first_frame.point),
                    "to": end_of(scene, bodies, joint.second, joint.second_frame.point),
                    "length": float(joint.parameters["length"]) if pulls else 0.0,
                }
            )
    for name, spring in scene.springs.items():
        found.append(
            {
                "name": name,
                "element": name,
                "kind": "spring",
                "from": end_of(scene, bodies, spring.first, spring.first_point),
                "to": end_of(scene, bodies, spring.second, spring.second_point),
                "length": _free_length(spring),
            }
        )
    for name, line in lines_of(scene.loads).items():
        ends = [end_of(scene, bodies, body, point) for body, point in path_of(line)]
        found += [
            {
                "name": f"{name} {i + 1}",
                "element": name,
                "kind": "link",
                "from": start,
                "to": end,
                "length": 0.0,
            }
            for i, (start, end) in enumerate(pairwise(ends))
        ]
    return found


def end_of(scene: Description, bodies: Sequence[str], body: str, point: Any) -> list[float]:
    """Number of the body, and the point (m) relative to its centre of mass."""
    where = np.asarray(point, dtype=float).reshape(3)
    if body not in scene.bodies:
        return [GROUND, *plain(where)]
    return [
        list(bodies).index(body),
        *plain(where - np.asarray(scene.bodies[body].center_of_mass).reshape(3)),
    ]


def _free_length(spring: Any) -> float:
    """The longest length at which a table of tension is still zero; 0 for a spring that also pushes."""
    free = [length for length, force in zip(spring.lengths, spring.forces, strict=True) if force <= 0.0]
    return float(max(free)) if free and spring.forces[0] == 0.0 else 0.0
