"""Elements of a scene replaced and removed by name; what others refer to stays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from seacrane import _core
from seacrane.description.databases import require_alike
from seacrane.description.description import ELEMENTS, KINDS, Description
from seacrane.description.loads import named
from seacrane.errors import SceneError
from seacrane.inputs.checked import curve_of
from seacrane.inputs.shown import shown
from seacrane.scene.recorded import picks

UNNAMED = ("roles", "provenance", "ratings", "lift_factors")  # tables by the names of other elements
REFERRING: Mapping[str, tuple[tuple[str, str], ...]] = {  # who names one, and in which word
    "bodies": (("meshes", "body"), ("clearances", "body")),
    "points": (("clearances", "points"),),
    "joints": (("ranges", "joint"),),
    "vessels": (("groups", "vessels"),),
}
EDITED = tuple(key for key in KINDS if key not in UNNAMED)


def replace_element(scene: Description, name: str, /, *, kind: str | None = None, **changes: Any) -> Any:
    """Put a changed element in the place of one that is there.

    Parameters
    ----------
    name : str
    kind : str, optional
        "body", "joint", "driver", "actuator", "point force", "spring", "force table", "function force",
        "load", "vessel" or "group"; needed where elements of several kinds have this name.
    **changes
        Arguments that differ, named as the attributes of the element, such as ``mass=12e3``.

    Returns
    -------
    The new element.

    Raises
    ------
    SceneError
        For a name that is not there or is of several kinds, a name that would change, arguments that this
        kind does not have, or a database that the vessel is not from; values are checked at compile().
    """
    key = _table_of(scene, name, kind)
    table = getattr(scene, key)
    what, old = f"{KINDS[key]} {name!r}", table[name]
    if key not in ELEMENTS:
        raise SceneError(f"{what}: is not replaced; remove it, and add another")
    arguments = old.__getstate__()
    unknown = [argument for argument in changes if argument not in arguments]
    if unknown or "name" in changes:
        known = ", ".join(argument for argument in arguments if argument != "name")
        first = [*unknown, "name"][0]
        raise SceneError(f"{what}: cannot change {first!r}; it has {known}")
    if changes.get("database") is not None:
        require_alike(scene, old, changes["database"])
    for argument, value in changes.items():
        if isinstance(arguments[argument], _core.Curve):
            changes[argument] = curve_of(f"{what}: {argument}", value)
    try:
        table[name] = type(old)(**{**arguments, **changes})
    except SceneError:
        raise
    except (TypeError, ValueError) as error:
        told = ", ".join(f"{argument}={shown(value)}" for argument, value in changes.items())
        raise SceneError(f"{what}: cannot be made with {told}; give values as its attributes have") from error
    return table[name]


def remove_element(scene: Description, name: str, /, *, kind: str | None = None) -> None:
    """Take an element out of the scene.

    Parameters
    ----------
    name : str
    kind : str, optional
        As for `replace`, or "recorded coordinate", "range", "limit state", "clearance", "channel"
        or "mesh"; needed where elements of several kinds have this name.

    Raises
    ------
    SceneError
        For a name that is not there or is of several kinds, and where something still refers to the element;
        the message names what does.
    """
    key = _table_of(scene, name, kind)
    users = list(_users(scene, key, name))
    if users:
        raise SceneError(f"{KINDS[key]} {name!r}: {', '.join(users)} refer to it; remove these first")
    del getattr(scene, key)[name]
    if key == "vessels":
        scene.provenance.pop(name, None)


def _table_of(scene: Description, name: str, kind: str | None) -> str:
    """The one table that holds an element of this name, and of this kind where it is given."""
    known = {KINDS[key]: key for key in EDITED}
    if kind is not None and kind not in known:
        raise SceneError(f"kind {kind!r} is unknown; choose {', '.join(known)}")
    found = [key for key in EDITED if name in getattr(scene, key) and kind in (None, KINDS[key])]
    if not found:
        raise SceneError(f"scene {scene.name!r}: there is no {kind or 'element'} {name!r}")
    if len(found) > 1:
        kinds = [repr(KINDS[key]) for key in found]
        raise SceneError(f"{name!r} is the name of several elements; pass kind={' or '.join(kinds)}")
    return found[0]


def _users(scene: Description, key: str, name: str) -> Iterator[str]:
    """What refers to a body, a joint or a vessel, such as "joint 'link'"."""
    role = {"bodies": "body", "joints": "joint"}.get(key, "nothing")
    for table in ELEMENTS:
        of_table = getattr(scene, table).items()
        yield from (f"{KINDS[table]} {other!r}" for other, one in of_table if name in named(one, role))
    for table, word in REFERRING.get(key, ()):
        for other, one in getattr(scene, table).items():
            held = getattr(one, word)
            if name in ([held] if isinstance(held, str) else held):
                yield f"{KINDS[table]} {other!r}"
    if key == "joints":
        yield from (f"recorded coordinate {r!r}" for r, (joint, _) in scene.recorded.items() if joint == name)
    dim = {"bodies": "body", "points": "point"}.get(key)
    for channel, curves in picks(scene).items():
        if dim and any(pick.names.get(dim) == name for pick in curves):
            yield f"channel {channel!r}"
    body = {"bodies": name, "vessels": getattr(scene.vessels.get(name), "body", None)}.get(key)
    if scene.waves is not None and body in scene.waves.hulls:
        yield "the waves on it (scene.waves)"
