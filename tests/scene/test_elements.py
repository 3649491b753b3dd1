"""What every kind of joint and load brings with it, for kinds that no test knows by name."""

from __future__ import annotations

import copy
import json
import pickle
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from joint_examples import KINDS
from multibody_runs import record
from numpy.testing import assert_allclose
from test_scene_file import every_kind

from seacrane import Scene, SceneError, _core
from seacrane.description.description import all_loads
from seacrane.description.loads import LOAD_KINDS, bodies_of
from seacrane.errors import FileFormatError
from seacrane.inputs.plain_data import INFINITE
from seacrane.scene.file import described as written
from seacrane.scene.file import scene_from_bytes

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

LOADS = {kind: type_ for kind, type_ in LOAD_KINDS.items() if hasattr(type_, "example")}
FORCELESS = ("heave compensator",)  # only its states are for others
OTHERS = ("body", "vessel", "point", "driver")
SAVED = [kind for kind, type_ in LOADS.items() if all(field.type != "function" for field in type_.FIELDS)]


def entries(element: Any) -> dict[str, Any]:
    return {field.name: getattr(element, field.name) for field in type(element).FIELDS}


def three_bodies(joint: str = "revolute", seed: int = 5) -> Scene:
    """Bodies "first" and "second" at one pose on a joint of a kind, and "third" beside them."""
    scene = Scene(name=joint)
    for i, name in enumerate(("first", "second", "third")):
        scene.add_body(name, mass=1.0 + i, inertia=(0.5, 0.6, 0.7),
                       position=(3.0 * (i == 2), 0.3 * (i == 2), 0.0),
                       angular_velocity=(0.3, -0.2 * i, 0.1))  # fmt: skip
    scene.joints["joint"] = KINDS[joint].example(seed)
    return scene


def loaded_scene(kind: str) -> Scene:
    scene = three_bodies()
    scene.add_load(LOADS[kind].example())
    if kind == "entrapped water":  # which asks for parts around it
        around = LOADS["immersed part"].example()
        scene.add_load(type(around)(**entries(around) | {"name": "around", "point": (0.2, -0.1, -0.5)}))
    return scene


def reloaded(scene: Scene, tmp_path: Path) -> Scene:
    scene.save(tmp_path / "scene.json")
    return Scene.load(tmp_path / "scene.json")


@pytest.mark.parametrize("kind", KINDS)
def test_a_joint_is_saved_reported_and_stepped_in_both_formulations(kind: str, tmp_path: Path) -> None:
    scene = three_bodies(kind)
    joint = scene.joints["joint"]
    assert reloaded(scene, tmp_path) == scene and pickle.loads(pickle.dumps(joint)) == joint
    assert dict(scene.report()["elements"])[f"{kind} joints"] == ["joint (first to second)"]
    assert all(getattr(joint, name) == value for name, value in joint.parameters.items())
    bare = _core.Joint(**entries(joint))
    for field in KINDS[kind].parameters:
        assert field.required or getattr(bare, field.name) == field.default
    if not KINDS[kind].branch:
        return
    one, two = (record(scene, 0.5, rtol=1e-10, formulation=name) for name in ("redundant", "recursive"))
    assert_allclose(one["position"], two["position"], atol=1e-7)
    assert np.max(two["constraint_error"]) < 1e-9


@pytest.mark.parametrize("kind", [kind for kind in KINDS if KINDS[kind].parameters])
def test_a_joints_own_numbers_are_checked(kind: str) -> None:
    joint = three_bodies(kind).joints["joint"]
    for field in KINDS[kind].parameters:
        with pytest.raises(SceneError, match=f"joint 'joint': {field.name} is 'long'; give a number"):
            _core.Joint(**entries(joint) | joint.parameters | {field.name: "long"})
        scene = three_bodies(kind)
        scene.joints["joint"] = _core.Joint(**entries(joint) | joint.parameters | {field.name: np.nan})
        with pytest.raises(SceneError, match=f"joint 'joint': {field.name} is nan"):
            scene.compile()
        with pytest.raises(SceneError, match=f"{field.name} belongs to a .*{kind}.* joint, this one is free"):
            scene.add_joint("j", kind="free", first="first", second="third", **{field.name: 1.0})


@pytest.mark.parametrize("kind", SAVED)
def test_a_load_is_saved_pickled_and_reported(kind: str, tmp_path: Path) -> None:
    scene = loaded_scene(kind)
    load = all_loads(scene)[0]
    assert reloaded(scene, tmp_path) == scene and pickle.loads(pickle.dumps(load)) == load
    assert copy.deepcopy(load) == load and f"<{type(load).__name__} 'load'" in repr(load)
    again = three_bodies()
    assert again.add_load(kind=kind, **entries(load)) == load
    assert any("load (" in str(names) for _, names in scene.report()["elements"])


@pytest.mark.parametrize("kind", LOADS)
def test_a_load_tells_its_bodies_and_moves_no_other(kind: str) -> None:
    scene = loaded_scene(kind)
    concerned = bodies_of(all_loads(scene)[0], scene.joints)
    assert concerned and set(concerned) <= set(scene.bodies)
    if kind in FORCELESS:
        concerned = []
    load, bare = np.zeros((3, 6)), three_bodies().compile(merge=False)
    for held, sign in ((scene, 1.0), (three_bodies(), -1.0)):
        model = held.compile(merge=False)
        state = np.array(model.initial_state)
        moving = bare.twist_index(3)  # poses and twists: what closes joints depends on masses
        state[:moving] = bare.initial_state[:moving]
        load += sign * _core.Evaluator(model).terms(0.5, state)["load"].reshape(3, 6)
    assert {name for name, row in zip(scene.bodies, load, strict=True) if np.any(row)} == set(concerned)


def described(kind: str) -> tuple[Scene, Any]:
    scene = loaded_scene(kind) if kind in LOADS else three_bodies()
    make = {"vessel": lambda: scene.add_vessel(body="third", name="load"),
            "point": lambda: scene.add_point(name="load", body="third"),
            "driver": lambda: scene.add_driver("joint", curve=0.0, name="load"),
            "body": lambda: scene.add_body("load", mass=1e3, inertia=(1e3,) * 3, size=(1, 1, 1))}  # fmt: skip
    return scene, make[kind]() if kind in make else all_loads(scene)[0]


@pytest.mark.parametrize("kind", [*SAVED, *OTHERS])
def test_every_entry_of_an_element_is_checked_and_named(kind: str) -> None:
    scene, element = described(kind)
    type_, given = type(element), entries(element)
    for field in type_.FIELDS:
        wrong: list[Any] = [{"a": 1}]
        if field.type in ("number", "curve"):
            wrong += ["1", None]
        if field.type == "array":
            wrong += [np.ones((2, 2, 2)), np.full(np.shape(given[field.name]), "1"), [[1.0], [1.0, 2.0]]]
        for value in wrong:
            told = f"(?s){kind}( 'load')?: {field.name} (is|has shape) .*; give "
            with pytest.raises(SceneError, match=told):
                type_(**given | {field.name: value})
        if field.required:
            with pytest.raises((SceneError, TypeError), match=f"{kind}( 'load')?: (has no )?{field.name}"):
                type_(**{name: value for name, value in given.items() if name != field.name})
        if field.role in ("body", "joint"):
            lost, name = scene.copy(), "lost" if field.type == "text" else ["lost", *given[field.name][1:]]
            lost.replace("load", kind=None if kind in LOADS else kind, **{field.name: name})
            with pytest.raises(SceneError, match=f"{kind} 'load'.*'lost'"):
                lost.compile()
    with pytest.raises(TypeError, match="has no entry 'colour'; it takes "):
        type_(**given, colour="red")


@pytest.mark.parametrize("kind", [kind for kind in LOADS if kind not in SAVED])
def test_entries_that_no_file_holds_are_checked(kind: str) -> None:
    type_, given = LOADS[kind], {"name": "load", "body": "first", "address": 1}
    for field in (field for field in type_.FIELDS if field.type == "function"):
        for wrong in ({"a": 1}, 0, -8, len):
            with pytest.raises(SceneError, match=f"{kind} 'load': {field.name} is "):
                type_(**given | {field.name: wrong})


def beyond(bounds: dict[str, float]) -> list[float]:
    below = {"minimum": -1e-9, "exclusiveMinimum": 0.0, "maximum": 1e-9, "exclusiveMaximum": 0.0}
    return [bound + below[word] for word, bound in bounds.items()] + [np.nan, np.inf]


@pytest.mark.parametrize("kind", [*SAVED, *OTHERS])
def test_every_number_of_an_element_is_held_to_its_bound(kind: str) -> None:
    scene, element = described(kind)
    for field in type(element).FIELDS:
        given = getattr(element, field.name)
        single = field.type in ("number", "curve")
        if not single and not (field.type == "array" and np.size(given) > 1):
            continue
        place = "" if single else r"(\[1\]| holds)?"
        for wrong in beyond(field.bounds):
            if field.type == "curve" and not np.isfinite(wrong):
                continue
            value = wrong if single else np.array(given, dtype=float)
            if not single:
                value.flat[1] = wrong
            other = scene.copy()
            other.replace("load", kind=None if kind in LOADS else kind, **{field.name: value})
            with pytest.raises(SceneError, match=f"{kind} 'load': {field.name}{place}.* {to_six(wrong)}"):
                other.compile()


def to_six(number: float) -> str:
    return re.escape(f"{number:.6g}")


def every_load() -> Scene:
    """Every kind of element with every load that a file can hold."""
    scene = every_kind()
    names = {"first": "hull", "second": "bob", "third": "arm", "joint": "pin", "load": "a load"}
    for kind in SAVED:
        told = entries(LOADS[kind].example())
        told |= {key: names.get(value, value) for key, value in told.items() if isinstance(value, str)}
        scene.add_load(kind=kind, **told | {"name": f"a {kind}"})
    scene.add_point(name="corner", body="hull", point=(1, 2, 3))
    scene.replace("water", kind="vessel", floats=False)
    for name in scene.bodies:
        scene.replace(name, kind="body", size=(1.0, 2.0, 3.0))
    scene.add_load(kind="limit", limit="stop", name="end", joint="pin", coordinate="angle", minimum=-1.0)
    return scene


BY_NAME = (  # objects whose entries the user names
    "names", "sources", "recorded", "provenance", "hulls", "cylinders", "areas", "luffs", "ropes",
    "spreading", "sea", "realised_hs_of_systems",
)  # fmt: skip


def objects(data: Any, path: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every object of a file whose entries the program names, with its place."""
    if isinstance(data, dict) and INFINITE not in data:
        yield path, data
    inside = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in inside:
        if key in BY_NAME and isinstance(value, dict):
            value = [*value.values()]
        if key not in ("notes", "parameters"):
            yield from objects(value, f"{path}[{key}]" if isinstance(key, int) else f"{path}.{key}")


@pytest.mark.warns("MassUnitWarning")
def test_a_file_without_one_of_its_entries_is_refused_by_its_name() -> None:
    """The first object of each kind, entry by entry."""
    data = json.loads(json.dumps(written(every_load())))
    seen = set()
    for path, one in objects(data):
        kind = (re.sub(r"\d+", "", path), one.get("kind"), *one)
        if kind in seen:
            continue
        seen.add(kind)
        for key in [*one]:
            kept = dict(one)
            del one[key]
            told = {"version": "names no version", "format": "is not a scene"}.get(
                key, f"has no {key!r}; add"
            )
            with pytest.raises(FileFormatError, match=told):
                scene_from_bytes(json.dumps(data).encode(), "scene.json", Scene())
            one.clear()
            one.update(kept)  # in their order
    assert len(seen) > 25
    assert scene_from_bytes(json.dumps(data).encode(), "scene.json", Scene()) == every_load()


def test_the_usual_coordinate_is_one_that_the_joint_offers() -> None:
    for kind, about in KINDS.items():
        assert about.usual in ["", *about.coordinates], kind
        assert about.rows + len(about.coordinates) <= 6 or about.parameters, kind
