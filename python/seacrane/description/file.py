"""Scene files: a scene as JSON. Data only; reading one runs no code and takes bounded memory.

A file is an object with "format", "version" and one entry per field of `Scene`; elements are lists of
objects with the arguments of the core's classes, in the order in which they were added. SI units, radians,
the frames of `Scene`. Numbers are written with as many digits as it takes to read back the same double.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from seacrane import _core
from seacrane.description.bodies import add_body
from seacrane.description.drives import add_actuator, add_driver
from seacrane.description.file_origin import provenance_from_node, roles_from_node, roles_to_data
from seacrane.description.file_waves import waves_from_node, waves_to_data
from seacrane.description.forces import add_force_table, add_load, add_point_force, add_spring
from seacrane.description.hydrodynamics import add_hydrodynamics
from seacrane.description.joints import add_joint
from seacrane.description.loads import load_from_node, load_to_data
from seacrane.description.old_files import provenance_from_notes, roles_by_name
from seacrane.description.recorded import add_range, record_coordinate
from seacrane.description.scene import Description
from seacrane.errors import FileFormatError, SceneError
from seacrane.files.atomic import atomic_write
from seacrane.files.node import Node
from seacrane.files.plain_data import notes_from_node, plain_data
from seacrane.files.whole_file import read_whole
from seacrane.inputs.shown import shown

FORMAT = "seacrane scene"
VERSION = 1
LARGEST_FILE = 32 * 2**20  # bytes; JSON takes up to 40 times its size in memory when it is parsed

_FRAME = {"point": (3,), "axes": (3, 3)}
_ARRAYS: dict[str, dict[str, tuple[int, ...]]] = {
    "bodies": {
        "inertia": (3, 3),
        "center_of_mass": (3,),
        "position": (3,),
        "quaternion": (4,),
        "velocity": (3,),
        "angular_velocity": (3,),
    },
    "point_forces": {"point": (3,), "force": (3,)},
    "springs": {"first_point": (3,), "second_point": (3,), "lengths": (-1,), "forces": (-1,)},
    "force_tables": {"point": (3,), "times": (-1,), "wrenches": (-1, 6)},
    "vessels": {
        "added_mass": (6, 6),
        "linear_damping": (6, 6),
        "quadratic_damping": (6,),
        "restoring": (6, 6),
        "mooring_stiffness": (3,),
        "mooring_damping": (3,),
    },
}
_NUMBERS = {
    "bodies": ("mass",),
    "joints": ("length",),
    "actuators": ("stiffness", "damping"),
    "springs": ("stiffness", "damping", "natural_length"),
}
_TEXTS = {
    "bodies": ("name",),
    "joints": ("name", "kind", "first", "second"),
    "drivers": ("name", "joint", "coordinate"),
    "actuators": ("name", "joint", "coordinate"),
    "point_forces": ("name", "body"),
    "springs": ("name", "first", "second"),
    "force_tables": ("name", "body"),
    "vessels": ("name", "body", "kinematics"),
}
_FLAGS = {"bodies": ("gravity",), "point_forces": ("body_axes",)}
_CURVES = {"drivers": ("curve",), "actuators": ("feed_forward", "reference")}
_FRAMES = {"joints": ("first_frame", "second_frame")}
_ADD: dict[str, Callable[..., Any]] = {
    "bodies": add_body,
    "joints": add_joint,
    "drivers": add_driver,
    "actuators": add_actuator,
    "point_forces": add_point_force,
    "springs": add_spring,
    "force_tables": add_force_table,
    "vessels": add_hydrodynamics,
}
_ADDED_LATER: dict[str, Any] = {
    "loads": [],
    "ranges": [],
    "roles": None,
    "provenance": None,
}  # what older files of this version lack
_STARTS = {
    b"\x89HDF": "a NetCDF file (Result.load or load_database)",
    b"CDF": "a NetCDF file (load_database)",
    b"ISO-10303-21": "a STEP model",
    b"seacrane state": "a state (load_state)",
    b"<": "XML, such as a URDF model",
    b"[": "a JSON list",
}
_SUFFIXES = {
    ".toml": "TOML, as of a crane (KnuckleBoomCrane.load)",
    ".py": "a Python script (seacrane run)",
    ".yml": "YAML, as of an OrcaFlex model (load_database)",
    ".yaml": "YAML, as of an OrcaFlex model (load_database)",
    ".stl": "a surface (Hull.from_stl)",
}
_SETTINGS = ("gravity", "baumgarte", "length_scale")
Some = TypeVar("Some", bound=Description)


def save_scene(scene: Description, path: str | os.PathLike[str]) -> None:
    """Write a scene to a file, complete or not at all.

    Parameters
    ----------
    scene : Scene
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
        _scene(Node(json.loads(text), f"scene {scene.name!r}"), Description())
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
    scene : Scene
        Empty.

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
    place = Path(path).name
    root = Node(_parse(Path(path)), place)
    if not isinstance(root.value, dict) or root.value.get("format") != FORMAT:
        raise FileFormatError(f'{place}: is not a scene file; it has no "format": "{FORMAT}" at its top')
    version = root.at("version").whole()
    if version != VERSION:
        raise FileFormatError(f"{place}: is of version {version}; this seacrane reads version {VERSION}")
    root = Node({**_ADDED_LATER, **root.value}, place)
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
        "roles",
        "provenance",
        "notes",
    )
    root.expect(fields)
    return _scene(root, scene)


def scene_digest(scene: Description) -> str:
    """SHA-256 of what a scene describes: equal for scenes that move alike. Notes and provenance do not count,
    and of C functions only their names."""
    data = described(scene.copy(notes={}, provenance={}))
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
    waves = root.at("waves")
    if waves.value is not None:
        scene.waves = waves_from_node(waves)
    scene.notes = notes_from_node(root.at("notes"))
    _origin(root, scene)
    return scene


def _origin(root: Node, scene: Description) -> None:
    """Roles and provenance; of files without them, what their names and notes tell."""
    roles, provenance = root.at("roles"), root.at("provenance")
    if roles.value is None:
        roles_by_name(scene)
    else:
        roles_from_node(roles, scene)
    if provenance.value is None:
        provenance_from_notes(scene)
    else:
        provenance_from_node(provenance, scene)


def _parse(path: Path) -> Any:
    data = read_whole(path, LARGEST_FILE, "no scene file is")
    if not re.match(rb"\s*\{", data):
        raise FileFormatError(
            f"{path.name}: is {_kind(path, data)}, no scene file, which is JSON as Scene.save writes it"
        )
    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=_unique, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        raise FileFormatError(
            f"{path.name} line {error.lineno}, column {error.colno}: {error.msg}; truncated or malformed JSON"
        ) from error
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise FileFormatError(f"{path.name} line {line}: byte {error.start} is not UTF-8 text") from error
    except RecursionError as error:
        raise FileFormatError(f"{path.name}: is nested too deeply to be a scene file") from error
    except ValueError as error:
        raise FileFormatError(f"{path.name}: {error}") from error


def _kind(path: Path, data: bytes) -> str:
    """What a file that is no JSON object seems to be, by its first bytes, else by its suffix."""
    if not data.strip():
        return "empty"
    for start, kind in _STARTS.items():
        if data.startswith(start):
            return kind
    return _SUFFIXES.get(path.suffix.lower(), "something else")


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    out = dict(pairs)
    if len(out) != len(pairs):
        counts = Counter(key for key, _ in pairs)
        twice = next(key for key, count in counts.items() if count > 1)
        raise ValueError(f"key {shown(twice)} occurs twice in one object; remove one")
    return out


def _no_constant(name: str) -> Any:
    raise ValueError(f"{name} is not a number; give a finite one")


def described(scene: Description) -> dict[str, Any]:
    """The scene as plain data."""
    out: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "name": scene.name,
        "orientation": scene.orientation,
    }
    out |= {key: float(getattr(scene, key)) for key in _SETTINGS}
    for kind in _ADD:
        out[kind] = [_element(kind, element) for element in getattr(scene, kind).values()]
    out["loads"] = [load_to_data(element) for element in scene.loads.values()]
    out["waves"] = None if scene.waves is None else waves_to_data(scene.waves)
    out["recorded"] = [
        {"name": name, "joint": joint, "coordinate": coordinate}
        for name, (joint, coordinate) in scene.recorded.items()
    ]
    out["ranges"] = [asdict(limit) for limit in scene.ranges.values()]
    out["roles"] = [roles_to_data(roles) for roles in scene.roles.values()]
    out["provenance"] = [{"name": name, **asdict(known)} for name, known in scene.provenance.items()]
    out["notes"] = plain_data(f"scene {scene.name!r}: notes", scene.notes)
    return out


def _element(kind: str, element: Any) -> dict[str, Any]:
    keys = [key for group in (_TEXTS, _NUMBERS, _FLAGS) for key in group.get(kind, ())]
    out = {key: getattr(element, key) for key in keys}
    out |= {key: np.asarray(getattr(element, key)).tolist() for key in _ARRAYS.get(kind, {})}
    out |= {key: getattr(element, key).to_pieces() for key in _CURVES.get(kind, ())}
    for key in _FRAMES.get(kind, ()):
        frame = getattr(element, key)
        out[key] = {part: getattr(frame, part).tolist() for part in _FRAME}
    if kind == "vessels":
        out["memory"] = _memory(element.memory)
    return out


def _memory(memory: list[_core.StateSpaceBlock] | _core.RetardationFunctions) -> Any:
    if isinstance(memory, _core.RetardationFunctions):
        return {"step": memory.step, "kernel": memory.kernel.tolist()}
    return [_block(block) for block in memory]


def _block(block: _core.StateSpaceBlock) -> dict[str, Any]:
    matrices = {key: getattr(block, key).tolist() for key in ("a", "b", "c", "d", "state_scale")}
    return {"inputs": list(block.inputs), "outputs": list(block.outputs), **matrices}


def _add(scene: Description, kind: str, node: Node) -> None:
    """Check one element's entries, then add it as a script would."""
    arrays, curves, frames = _ARRAYS.get(kind, {}), _CURVES.get(kind, ()), _FRAMES.get(kind, ())
    numbers, texts, flags = _NUMBERS.get(kind, ()), _TEXTS[kind], _FLAGS.get(kind, ())
    memory = ("memory",) if kind == "vessels" else ()
    node.expect((*texts, *numbers, *flags, *arrays, *curves, *frames, *memory))
    arguments: dict[str, Any] = {key: node.at(key).text() for key in texts}
    arguments |= {key: node.at(key).number() for key in numbers}
    arguments |= {key: node.at(key).flag() for key in flags}
    arguments |= {key: node.at(key).array(shape) for key, shape in arrays.items()}
    arguments |= {key: node.at(key).curve() for key in curves}
    arguments |= {key: _frame(node.at(key)) for key in frames}
    if memory:
        arguments["memory"] = _memory_back(node.at("memory"))
    if kind == "force_tables":
        arguments["loads"] = arguments.pop("wrenches")
    if kind == "joints" and arguments["kind"] != "distance" and arguments["length"] == 0.0:
        del arguments["length"]
    with node.scene_errors():
        _ADD[kind](scene, **arguments)


def _frame(node: Node) -> _core.Frame:
    node.expect(tuple(_FRAME))
    return _core.Frame(**{key: node.at(key).array(shape) for key, shape in _FRAME.items()})


def _memory_back(node: Node) -> list[_core.StateSpaceBlock] | _core.RetardationFunctions:
    if not isinstance(node.value, dict):
        return [_block_back(block) for block in node.items()]
    node.expect(("step", "kernel"))
    step, kernel = node.at("step").number(), node.at("kernel").array((-1, 6, 6))
    return _core.RetardationFunctions(step=step, kernel=kernel)


def _block_back(node: Node) -> _core.StateSpaceBlock:
    node.expect(("inputs", "outputs", "a", "b", "c", "d", "state_scale"))
    inputs = [item.whole() for item in node.at("inputs").items()]
    outputs = [item.whole() for item in node.at("outputs").items()]
    states = len(node.at("a").values())
    return _core.StateSpaceBlock(
        inputs=inputs,
        outputs=outputs,
        a=node.at("a").array((states, states)),
        b=node.at("b").array((states, len(inputs))),
        c=node.at("c").array((len(outputs), states)),
        d=node.at("d").array((len(outputs), len(inputs))),
        state_scale=node.at("state_scale").array((-1,)),
    )
