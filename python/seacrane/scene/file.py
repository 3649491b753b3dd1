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
import re
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

from seacrane import _core
from seacrane.description.databases import databases_from_node, databases_to_data
from seacrane.description.description import SETTINGS, Description
from seacrane.description.elements import add_actuator, add_driver, add_joint, add_load
from seacrane.description.holding import free_drives
from seacrane.description.limit_state import LimitState, Range
from seacrane.description.loads import LOAD_KINDS, kind_of
from seacrane.description.provenance import VesselProvenance
from seacrane.description.roles import CraneRoles
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.description.waves import Waves
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.file_version import FILE_VERSION, require_file_version
from seacrane.inputs.json_text import json_of
from seacrane.inputs.looks_like import looks_like
from seacrane.inputs.node import Node
from seacrane.inputs.plain_data import arguments, notes_from_node, plain_data, value_of
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole
from seacrane.scene import recorded
from seacrane.scene.afloat import add_group, add_hydrodynamics
from seacrane.scene.bodies import add_body, mesh_from_node, mesh_to_data
from seacrane.scene.lift_factors import LiftFactors, Rating, add_lift_factors, note_rating, rating_of
from seacrane.scene.roles import add_roles

LARGEST_FILE = 32 * 2**20  # bytes
FORMAT = "seacrane scene"
UNMOVING = (
    "notes", "provenance", "limit_states", "clearances", "ratings", "lift_factors", "meshes",
)  # tables  # fmt: skip
_FIELDS = tuple(one.name for one in fields(Description) if one.name != "function_forces")
Some = TypeVar("Some", bound=Description)


def parsed(data: bytes, place: str) -> Any:
    """The document in the bytes of a scene file; raises FileFormatError with the line."""
    if len(data) > LARGEST_FILE:
        raise FileFormatError(f"{place}: has {len(data)} bytes, above {LARGEST_FILE}; no scene has")
    return json_of(data, place, object_pairs_hook=_unique, parse_constant=_no_constant)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    out = dict(pairs)
    if len(out) != len(pairs):
        counts = Counter(key for key, _ in pairs)
        twice = next(key for key, count in counts.items() if count > 1)
        raise ValueError(f"key {shown(twice)} occurs twice in one object; remove one")
    return out


def _no_constant(name: str) -> Any:
    raise ValueError(f"{name} is not a number; give a finite one")


_ADD: Mapping[str, tuple[type, Callable[..., Any]]] = {  # of each table: what it holds, and how it is added
    "bodies": (_core.Body, add_body),
    "joints": (_core.Joint, add_joint),
    "drivers": (_core.Driver, add_driver),
    "actuators": (_core.Actuator, add_actuator),
    "point_forces": (_core.PointForce, add_load),
    "springs": (_core.Spring, add_load),
    "force_tables": (_core.ForceTable, add_load),
    "vessels": (VesselHydrodynamics, add_hydrodynamics),
    "groups": (_core.GroupHydrodynamics, add_group),
    "points": (_core.Point, recorded.add_point),
    "loads": (object, add_load),  # of any kind
    "ranges": (Range, recorded.add_range),
    "limit_states": (LimitState, recorded.add_limit_state),
    "clearances": (recorded.Clearance, recorded.add_clearance),
    "channels": (recorded.OwnChannel, recorded.add_channel),
    "ratings": (Rating, lambda scene, **entries: note_rating(scene, rating_of(**entries))),
    "lift_factors": (LiftFactors, add_lift_factors),
}


def save_scene(scene: Description, path: str | os.PathLike[str]) -> None:
    """Write a scene to a file, complete or not at all; an old one is replaced.

    Raises SceneError for a C function, a number that is not finite, a note that is no plain data, or a scene
    that is too large to be read back; OSError if the file cannot be written.
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
    """Read what `save_scene` wrote into an empty scene, which is returned; all is as it was, to the last bit.

    Raises FileFormatError with the line of malformed JSON, or the entry that is missing, unknown or makes no
    sense; OSError if the file cannot be read. What only the whole scene shows comes with `Scene.compile`.
    """
    file = Path(path)
    data = read_whole(file, LARGEST_FILE, "no scene file is")
    if not re.match(rb"\s*\{", data):
        raise FileFormatError(
            f"{file.name}: is {looks_like(file, data)}, no scene file, which is JSON as Scene.save writes it"
        )
    return scene_from_bytes(data, file.name, scene)


def scene_from_bytes(data: bytes, place: str, scene: Some) -> Some:
    """What `load_scene` reads, from the bytes of a scene file; errors begin with the place."""
    root = Node(parsed(data, place), place)
    if not isinstance(root.value, dict) or root.value.get("format") != FORMAT:
        raise FileFormatError(f'{place}: is not a scene file; it has no "format": "{FORMAT}" at its top')
    require_file_version(place, root.value.get("version"))
    root.expect(("format", "version", *_FIELDS, "databases"))
    return _scene(root, scene)


def scene_digest(scene: Description) -> str:
    """SHA-256 of what a scene describes: equal for scenes that move alike.

    Notes, provenance, databases, limit states, clearances, ratings, lift factors and meshes do not count,
    and of C functions only their names. Channels of one's own do: a file goes on with those that it has begun
    with.
    """
    data = _elements(scene.copy(**{key: {} for key in UNMOVING}))
    for roles in data["roles"]:
        if not free_drives(scene, scene.roles[roles["prefix"]]):
            roles.pop("held", None)  # nothing is, whether it would be or not
    data["function_forces"] = [[force.name, force.body] for force in scene.function_forces.values()]
    return hashlib.sha256(json.dumps(data).encode("ascii")).hexdigest()


def _scene(root: Node, scene: Some) -> Some:
    scene.name, scene.orientation = root.at("name").text(), root.at("orientation").text()
    scene.gravity, scene.baumgarte, scene.length_scale = (root.at(key).number() for key in SETTINGS)
    for kind in _ADD:
        for node in root.at(kind).items():
            _add(scene, kind, node)
    scene.waves = value_of(root.at("waves"), Waves | None)
    for name, (joint, coordinate) in _by_name(root, "recorded", tuple[str, str]).items():
        with root.at("recorded").at(name).scene_errors():
            recorded.record_coordinate(scene, joint, coordinate=coordinate, name=name)
    for node in root.at("roles").items():
        entries = arguments(CraneRoles, node)
        with node.scene_errors():
            add_roles(scene, **entries)
    scene.provenance.update(_by_name(root, "provenance", VesselProvenance))
    for node in root.at("meshes").items():
        mesh_from_node(node, scene)
    scene.notes = notes_from_node(root.at("notes"))
    databases_from_node(root.at("databases"), scene)
    return scene


def _by_name(root: Node, key: str, kind: Any) -> dict[str, Any]:
    found: dict[str, Any] = value_of(root.at(key), Mapping[str, kind])
    return found


def described(scene: Description) -> dict[str, Any]:
    """The scene as plain data."""
    return _elements(scene) | {"databases": databases_to_data(scene)}


def _elements(scene: Description) -> dict[str, Any]:
    """All but the databases of its vessels, on which no motion depends."""
    held = vars(scene) | {key: float(getattr(scene, key)) for key in SETTINGS}
    held |= {key: [*held[key].values()] for key in (*_ADD, "roles")}
    loads = [(kind_of(one), plain_data("load", one)) for one in held["loads"]]
    made = {  # an entry "kind" of a load's own goes by the kind's name
        "loads": [{"kind": kind} | {kind if key == "kind" else key: one for key, one in load.items()}
                  for kind, load in loads],
        "joints": [{**plain_data("joint", one), "parameters": one.parameters} for one in held["joints"]],
        "meshes": [mesh_to_data(mesh) for mesh in scene.meshes.values()],
    }  # fmt: skip
    what = f"scene {scene.name!r}"
    plain = {key: made[key] if key in made else plain_data(f"{what}: {key}", held[key]) for key in _FIELDS}
    return {"format": FORMAT, "version": FILE_VERSION, **plain}


def _add(scene: Description, kind: str, node: Node) -> None:
    """Check one element's entries, then add it as a script would."""
    described_as, add = _ADD[kind]
    if kind == "loads":
        given = {"element": _load(node)}
    else:
        rest, parameters = _parameters(node) if kind == "joints" else (node, {})
        given = arguments(described_as, rest) | parameters
    if kind == "lift_factors":
        given["load"] = given.pop("name")
    with node.scene_errors():
        if add is add_load and kind != "loads":
            given = {"element": described_as(**given)}
        add(scene, **given)


def _load(node: Node) -> Any:
    name = node.at("kind").text()
    if name not in LOAD_KINDS:
        node.at("kind").fail(f"give one of {', '.join(LOAD_KINDS)}")
    rest = {key: one for key, one in node.value.items() if key != "kind"}
    if any(field.name == "kind" for field in LOAD_KINDS[name].FIELDS):  # type: ignore[attr-defined]
        rest["kind"] = node.at(name).value
        del rest[name]
    given = arguments(LOAD_KINDS[name], Node(rest, node.path))
    with node.scene_errors():
        return LOAD_KINDS[name](**given)


def _parameters(node: Node) -> tuple[Node, dict[str, float]]:
    """A joint's entries without its own numbers, and these."""
    given = node.at("parameters")
    if not isinstance(given.value, dict):
        given.fail("give an object with numbers")
    rest = {key: one for key, one in node.value.items() if key != "parameters"}
    return Node(rest, node.path), {key: given.at(key).number() for key in given.value}
