"""Scene files: a scene as JSON. Data only; reading one runs no code and takes bounded memory.

A file is an object with "format", "version" and one entry per field of `Scene`; elements are lists of
objects with the FIELDS of the core's classes, in the order in which they were added. Every entry is there:
one that is missing is refused. SI units, radians, the frames of `Scene`. Numbers are written with as many
digits as it takes to read back the same double.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeVar

from seacrane import _core
from seacrane.description.bodies import add_body
from seacrane.description.clearances import clearances_from_node, clearances_to_data
from seacrane.description.databases import databases_from_node, databases_to_data
from seacrane.description.description import Description
from seacrane.description.drives import add_actuator, add_driver
from seacrane.description.file_elements import (
    element_from_node,
    element_to_data,
    load_from_node,
    load_to_data,
)
from seacrane.description.file_origin import (
    provenance_from_node,
    roles_from_node,
    roles_to_data,
)
from seacrane.description.file_text import LARGEST_FILE, parsed, read_scene_file
from seacrane.description.file_waves import waves_from_node, waves_to_data
from seacrane.description.forces import add_force_table, add_load, add_point_force, add_spring
from seacrane.description.holding import free_drives
from seacrane.description.hydrodynamics import add_group, add_hydrodynamics
from seacrane.description.joints import add_joint
from seacrane.description.lift_factors import lift_factors_from_node, lift_factors_to_data
from seacrane.description.limit_states import limit_states_from_node, limit_states_to_data
from seacrane.description.meshes import mesh_from_node, mesh_to_data
from seacrane.description.own_channels import own_channels_from_node, own_channels_to_data
from seacrane.description.ratings import ratings_from_node, ratings_to_data
from seacrane.description.recorded import add_point, add_range, record_coordinate
from seacrane.description.relatives import relatives_from_node, relatives_to_data
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.file_version import FILE_VERSION, require_file_version
from seacrane.inputs.node import Node
from seacrane.inputs.plain_data import notes_from_node, plain_data

FORMAT = "seacrane scene"

_CLASSES: dict[str, type] = {
    "bodies": _core.Body,
    "joints": _core.Joint,
    "drivers": _core.Driver,
    "actuators": _core.Actuator,
    "point_forces": _core.PointForce,
    "springs": _core.Spring,
    "force_tables": _core.ForceTable,
    "vessels": VesselHydrodynamics,
    "groups": _core.GroupHydrodynamics,
    "points": _core.Point,
}
_ADD: dict[str, Callable[..., Any]] = {
    "bodies": add_body,
    "joints": add_joint,
    "drivers": add_driver,
    "actuators": add_actuator,
    "point_forces": add_point_force,
    "springs": add_spring,
    "force_tables": add_force_table,
    "vessels": add_hydrodynamics,
    "groups": add_group,
    "points": add_point,
}
UNMOVING = (
    "notes", "provenance", "limit_states", "clearances", "ratings", "lift_factors", "meshes",
)  # tables  # fmt: skip
_SETTINGS = ("gravity", "baumgarte", "length_scale")
Some = TypeVar("Some", bound=Description)


def save_scene(scene: Description, path: str | os.PathLike[str]) -> None:
    """Write a scene to a file, complete or not at all.

    Parameters
    ----------
    path : path-like
        Replaced if it exists; its folder must exist.

    Raises
    ------
    SceneError
        If the scene holds a C function, a number that is not finite or a note that is not plain data, or is
        too large to be read back.
    OSError
        If the file cannot be written.
    """
    if scene.function_forces:
        raise SceneError(
            f"function force {next(iter(scene.function_forces))!r}: a scene file holds data only; add "
            "C functions in the script that loads the scene"
        )
    try:
        text = json.dumps(described(scene), indent=1, allow_nan=False)
        written = json.loads(text) | {"databases": []}  # checked when they were made
        _scene(Node(written, f"scene {scene.name!r}"), Description())
    except SceneError:
        raise
    except FileFormatError as error:
        raise SceneError(str(error)) from error
    except RecursionError as error:
        raise SceneError(f"scene {scene.name!r}: its notes contain themselves; give plain data") from error
    except ValueError as error:
        raise SceneError(f"scene {scene.name!r}: {error}; every number must be finite") from error
    data = (text + "\n").encode("ascii")
    if len(data) > LARGEST_FILE:
        raise SceneError(
            f"scene {scene.name!r}: takes {len(data)} bytes, above {LARGEST_FILE}; shorten its tables"
        )
    with atomic_write(Path(path)) as draft:
        draft.write_bytes(data)


def load_scene(path: str | os.PathLike[str], scene: Some) -> Some:
    """Read what `save_scene` wrote into an empty scene; values and names are as they were, to the last bit.

    Parameters
    ----------
    path : path-like
    scene : Empty.

    Returns
    -------
    Scene
        The same. Not compiled: what only the whole scene shows (loops that do not close) comes with
        `Scene.compile`.

    Raises
    ------
    FileFormatError
        Naming the file and the line (malformed JSON) or the entry (a value that is missing, unknown, of the
        wrong type or out of range).
    OSError
        If the file cannot be read.
    """
    return scene_from_bytes(read_scene_file(Path(path)), Path(path).name, scene)


def scene_from_bytes(data: bytes, place: str, scene: Some) -> Some:
    """What `load_scene` reads, from the bytes of a scene file; errors begin with the place."""
    root = Node(parsed(data, place), place)
    if not isinstance(root.value, dict) or root.value.get("format") != FORMAT:
        raise FileFormatError(f'{place}: is not a scene file; it has no "format": "{FORMAT}" at its top')
    require_file_version(place, root.value.get("version"))
    fields = (
        "format",
        "version",
        "name",
        "orientation",
        *_SETTINGS,
        *_ADD,
        "loads",
        "waves",
        "recorded",
        "ranges",
        "limit_states",
        "clearances",
        "relatives",
        "channels",
        "ratings",
        "lift_factors",
        "roles",
        "provenance",
        "meshes",
        "notes",
        "databases",
    )
    root.expect(fields)
    return _scene(root, scene)


def scene_digest(scene: Description) -> str:
    """SHA-256 of what a scene describes: equal for scenes that move alike.

    Notes, provenance, databases, limit states, clearances, ratings, lift factors and meshes do not count,
    and of C functions only their names. Relatives and channels of one's own do: a file goes on with those
    that it has begun with.
    """
    data = _elements(scene.copy(**{key: {} for key in UNMOVING}))
    for roles in data["roles"]:
        if not free_drives(scene, scene.roles[roles["prefix"]]):
            roles.pop("held", None)  # nothing is, whether it would be or not
    data["function_forces"] = [[force.name, force.body] for force in scene.function_forces.values()]
    return hashlib.sha256(json.dumps(data).encode("ascii")).hexdigest()


def _scene(root: Node, scene: Some) -> Some:
    scene.name, scene.orientation = root.at("name").text(), root.at("orientation").text()
    scene.gravity, scene.baumgarte, scene.length_scale = (root.at(key).number() for key in _SETTINGS)
    for kind in _ADD:
        for node in root.at(kind).items():
            _add(scene, kind, node)
    for node in root.at("loads").items():
        element = load_from_node(node)
        with node.scene_errors():
            add_load(scene, element)
    for node in root.at("recorded").items():
        node.expect(("name", "joint", "coordinate"))
        with node.scene_errors():
            texts = {key: node.at(key).text() for key in ("name", "joint", "coordinate")}
            record_coordinate(scene, **texts)
    for node in root.at("ranges").items():
        node.expect(("name", "joint", "coordinate", "minimum", "maximum"))
        limits: dict[str, Any] = {key: node.at(key).text() for key in ("name", "joint", "coordinate")}
        limits |= {key: node.at(key).number() for key in ("minimum", "maximum")}
        with node.scene_errors():
            add_range(scene, **limits)
    limit_states_from_node(root.at("limit_states"), scene)
    clearances_from_node(root.at("clearances"), scene)
    relatives_from_node(root.at("relatives"), scene)
    own_channels_from_node(root.at("channels"), scene)
    ratings_from_node(root.at("ratings"), scene)
    lift_factors_from_node(root.at("lift_factors"), scene)
    waves = root.at("waves")
    if waves.value is not None:
        scene.waves = waves_from_node(waves)
    for node in root.at("meshes").items():
        mesh_from_node(node, scene)
    scene.notes = notes_from_node(root.at("notes"))
    roles_from_node(root.at("roles"), scene)
    provenance_from_node(root.at("provenance"), scene)
    databases_from_node(root.at("databases"), scene)
    return scene


def described(scene: Description) -> dict[str, Any]:
    """The scene as plain data."""
    return _elements(scene) | {"databases": databases_to_data(scene)}


def _elements(scene: Description) -> dict[str, Any]:
    """All but the databases of its vessels, on which no motion depends."""
    out: dict[str, Any] = {
        "format": FORMAT,
        "version": FILE_VERSION,
        "name": scene.name,
        "orientation": scene.orientation,
    }
    out |= {key: float(getattr(scene, key)) for key in _SETTINGS}
    out |= {kind: [element_to_data(one) for one in getattr(scene, kind).values()] for kind in _CLASSES}
    for data, joint in zip(out["joints"], scene.joints.values(), strict=True):
        data["parameters"] = joint.parameters
    out["loads"] = [load_to_data(element) for element in scene.loads.values()]
    out["waves"] = None if scene.waves is None else waves_to_data(scene.waves)
    out["recorded"] = [
        {"name": name, "joint": joint, "coordinate": coordinate}
        for name, (joint, coordinate) in scene.recorded.items()
    ]
    out["ranges"] = [asdict(limit) for limit in scene.ranges.values()]
    out["limit_states"] = limit_states_to_data(scene)
    out["clearances"] = clearances_to_data(scene)
    out["relatives"] = relatives_to_data(scene)
    out["channels"] = own_channels_to_data(scene)
    out["ratings"] = ratings_to_data(scene)
    out["lift_factors"] = lift_factors_to_data(scene)
    out["roles"] = [roles_to_data(roles) for roles in scene.roles.values()]
    out["provenance"] = [{"name": name, **asdict(known)} for name, known in scene.provenance.items()]
    out["meshes"] = [mesh_to_data(mesh) for mesh in scene.meshes.values()]
    out["notes"] = plain_data(f"scene {scene.name!r}: notes", scene.notes)
    return out


def _add(scene: Description, kind: str, node: Node) -> None:
    """Check one element's entries, then add it as a script would."""
    entries = dict(node.value) if isinstance(node.value, dict) else node.value
    parameters = _parameters(node, entries) if kind == "joints" and isinstance(entries, dict) else {}
    arguments = element_from_node(_CLASSES[kind], Node(entries, node.path)) | parameters
    if kind == "force_tables":
        arguments["loads"] = arguments.pop("wrenches")
    with node.scene_errors():
        _ADD[kind](scene, **arguments)


def _parameters(node: Node, entries: dict[str, Any]) -> dict[str, float]:
    """Takes a joint's own numbers out of its entries."""
    given = node.at("parameters")
    del entries["parameters"]
    if not isinstance(given.value, dict):
        given.fail("give an object with numbers")
    return {key: given.at(key).number() for key in given.value}
