"""Which elements of a scene are there in a stage: not those that wait to be connected or were released."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

from seacrane.description.channels import NAMED
from seacrane.description.description import KINDS, LOADS, Some
from seacrane.description.loads import named
from seacrane.description.pick import Pick
from seacrane.errors import SceneError
from seacrane.run.channel_names import missing_names
from seacrane.scene.own_channels import picks
from seacrane.scene.scene import Scene

TABLES = ("joints", "drivers", *LOADS)


def table_of(scene: Scene, what: str, name: str) -> str:
    """The table of a connection; a joint goes before what acts on it and bears its name.

    Raises SceneError for a name that is not there, or is that of several elements.
    """
    found = [table for table in TABLES if name in getattr(scene, table)]
    if "joints" in found:
        return "joints"
    if not found:
        known = [key for table in TABLES for key in getattr(scene, table)]
        raise SceneError(
            f"{what}: the scene has no {name!r}; it has {', '.join(known) or 'nothing to connect'}"
        )
    if len(found) > 1:
        kinds = " and ".join(f"a {KINDS[table]}" for table in found)
        raise SceneError(f"{what}: {name!r} is {kinds}; give one of them another name")
    return found[0]


def without(scene: Some, names: Collection[str]) -> Some:
    """The scene without these connections, and without what acts on, records or limits them alone."""
    out = scene.copy()
    for name in names:
        joint = name in out.joints
        for table in TABLES:
            elements = getattr(out, table)
            if not joint or table == "joints":
                elements.pop(name, None)
                continue
            for other in [key for key, one in elements.items() if name in named(one, "joint")]:
                del elements[other]
        if joint:
            _forget(out, name)
        for channel in [key for key, curves in picks(out).items() if _told_of(curves, name)]:
            del out.channels[channel]
    states = out.limit_states
    for one in missing_names(out, [state.channel for state in states.values()]) if names else ():
        for state in [key for key, state in states.items() if state.channel == one]:
            del states[state]
    return out


def _told_of(curves: Iterable[Pick], name: str) -> bool:
    """Whether one of the curves is of an element of this name."""
    return any(name == one for pick in curves for dim, one in pick.names.items() if dim in NAMED)


def _forget(scene: Any, joint: str) -> None:
    for key in [key for key, (on, _) in scene.recorded.items() if on == joint]:
        del scene.recorded[key]
    for key in [key for key, limit in scene.ranges.items() if limit.joint == joint]:
        del scene.ranges[key]
