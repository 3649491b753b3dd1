"""What a joint of any kind takes beside its bodies, point and axis: fixtures know no kind by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from seacrane import _core

KINDS = _core.joint_kinds()


def own_arguments(
    kind: str, second_axis: Callable[[], Any], second_point: Callable[[], Any]
) -> dict[str, Any]:
    """Arguments of `Scene.add_joint` that belong to the kind; a length follows from the points."""
    about, out = KINDS[kind], dict[str, Any]()
    if about.own_axis:
        out["second_axis"] = second_axis()
    if about.own_point:
        out["second_point"] = second_point()
    return out | own_numbers(kind)


def own_numbers(kind: str) -> dict[str, float]:
    """What the kind cannot do without, but for lengths between its points: a joint of frames that agree is
    closed then."""
    numbers, own = KINDS[kind].example(1).parameters, KINDS[kind].parameters
    return {field.name: numbers[field.name] for field in own if field.required and field.role != "distance"}
