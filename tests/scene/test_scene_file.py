"""Scene files: exact round trip of every kind of element, and a clear refusal of everything else."""

from __future__ import annotations

import json
import math
import pickle
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seacrane import Curve, FileFormatError, Frame, Scene, SceneError, cases, simulate
from seacrane.description.file import save_scene
from seacrane.hydro import StateSpaceBlock
from seacrane.scene import HullLoads, SeaProvenance, VesselProvenance, Waves

THIRD = 1.0 / 3.0
WITH_FOLDER = settings(
    max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def waves(body: str) -> Waves:
    generator = np.random.default_rng(3)
    return Waves(
        omega=np.array([0.5, 0.7, 1.1]),
        amplitude=generator.uniform(0.01, 0.02, 3),
        phase=generator.uniform(0.0, 6.0, 3),
        direction=generator.uniform(-3.0, 3.0, 3),
        hulls={
            body: HullLoads(
                transfer=generator.normal(size=(3, 6)) + 1j * generator.normal(size=(3, 6)),
                position=(THIRD, -0.0),
                heading=-THIRD,
            )
        },
        evaluation="exact",
        provenance=SeaProvenance(seed=3, repeat_period_s=math.inf, realised_hs=np.float64(THIRD)),
    )


def every_kind() -> Scene:
    """One of each element that a file can hold, with numbers that have no short decimal form."""
    scene = Scene(name="every kind", gravity=9.8 + THIRD / 100, baumgarte=THIRD, length_scale=1.1)
    inertia = np.array([[2.0, 0.1, 0.0], [0.1, 3.0, THIRD], [0.0, THIRD, 2.5]])
    half = math.sqrt(0.5)
    scene.add_body(name="hull", mass=1e7 * THIRD, inertia=inertia * 1e6, center_of_mass=(0.1, -0.2, THIRD))
    scene.add_body(
        name="arm",
        mass=5e-4,
        inertia=inertia * 1e-4,
        position=(1.0, THIRD, -2.0),
        quaternion=(half, 0.0, half, 0.0),
        velocity=(0.0, -0.0, 1e-300),
        angular_velocity=(5e-324, 0.0, 0.0),
        gravity=False,
    )
    for i, name in enumerate(("bob", "kite")):
        scene.add_body(name=name, mass=1.0, inertia=[1.0, 1.0, 1.0], position=(4.0, i, 0.0))
    scene.add_joint(kind="revolute", name="pin", first="hull", second="arm", axis=(THIRD, 1.0, 0.2))
    scene.add_joint(
        kind="universal", name="cross", first="hull", second="bob", axis=(1, 0, 0), second_axis=(0, THIRD, 1)
    )
    scene.add_joint(
        kind="distance", name="wire", first="bob", second="kite", point=(4, 0, 0), second_point=(4, 1, THIRD)
    )
    scene.add_joint(
        kind="cylindrical", name="sleeve", first="ground", second="kite",
        first_frame=Frame(point=(4.0, 1.0, 0.0)), second_frame=Frame(),
    )  # fmt: skip
    swing = Curve.harmonic(offset=0.0, amplitude=0.01, omega=THIRD, phase=-math.pi / 2.0)
    scene.add_driver(joint="sleeve", curve=swing, name="shaker")
    move = Curve.quintic(start_time=0.1, end_time=7.0, start=0.0, end=THIRD)
    scene.add_actuator(
        name="motor",
        joint="pin",
        stiffness=THIRD,
        damping=0.2,
        feed_forward=1e-3,
        reference=move.then(time=9.0, curve=swing),
    )
    scene.add_point_force(name="push", body="arm", force=(THIRD, 0, 0), point=(0, THIRD, 0), body_axes=True)
    scene.add_spring(
        name="soft", first="ground", second="bob", stiffness=THIRD, damping=0.1, natural_length=0.3
    )
    scene.add_spring(
        name="table",
        first="hull",
        second="kite",
        first_point=(0, 0, THIRD),
        lengths=[1, 2.5],
        forces=[0, THIRD],
    )
    scene.add_force_table(
        name="gust", body="kite", times=[0.0, THIRD], loads=np.arange(12.0).reshape(2, 6) / 7
    )
    matrix = np.diag([1e6, 2e6, 3e6, 4e6, 5e6, 6e6]) * THIRD
    restoring = np.zeros((6, 6))
    restoring[2:5, 2:5] = np.diag([1e6, 2e6, 3e6])
    pair = StateSpaceBlock(
        inputs=[2, 4], outputs=[4], a=[[-1.0, THIRD], [0.0, -2.0]], b=np.eye(2), c=[[THIRD, 1.0]],
        d=[[0.0, 1e-9]], state_scale=[0.5, THIRD],
    )  # fmt: skip
    stateless = StateSpaceBlock(
        inputs=[0], outputs=[0], a=np.zeros((0, 0)), b=np.zeros((0, 1)), c=np.zeros((1, 0)), d=[[3.0]]
    )
    scene.add_vessel(
        body="hull", name="water", added_mass=matrix, linear_damping=matrix / 10, restoring=restoring,
        quadratic_damping=np.arange(6.0), mooring_stiffness=(1e4, 2e4, 3e4), mooring_damping=(1, 2, THIRD),
        memory=[pair, stateless],
    )  # fmt: skip
    scene.waves = waves("hull")
    scene.record_coordinate(joint="pin", name="angle of the arm")
    scene.record_coordinate(joint="sleeve", coordinate="angle", name="turn")
    scene.add_roles(prefix="aft ", slew="pin", cylinders={"luff": "sleeve"}, link="wire")
    scene.provenance["water"] = VesselProvenance(database="hull", omega=(0.1, THIRD * 10), memory="passive")
    scene.notes.update(author="someone", hs=THIRD, tries=[1, 2.5, None, True], nested={"limit": -math.inf})
    scene.add_mesh(body="arm", name="look", vertices=np.eye(3) * THIRD, faces=[[0, 1, 2]])
    return scene


def plain(value: Any) -> Any:
    """Everything a scene holds, as nested lists with each float as its eight bytes."""
    if isinstance(value, (float, np.floating)):
        return struct.pack("<d", value)
    if isinstance(value, (complex, np.complexfloating)):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, np.integer):
        return int(value)
    if isinstance(value, Curve):
        return plain(value.to_pieces())
    if isinstance(value, np.ndarray):
        return [plain(item) for item in value]
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return [[key, plain(item)] for key, item in value.items()]
    if isinstance(value, (str, int, bool, type(None))):
        return value
    names = [name for name in dir(value) if not name.startswith("_") and not callable(getattr(value, name))]
    assert names, f"{value!r} shows nothing to compare"
    return [[name, plain(getattr(value, name))] for name in names]


def test_every_kind_of_element_comes_back_bit_for_bit(tmp_path: Path) -> None:
    scene = every_kind()
    save_scene(scene, tmp_path / "scene.json")
    back = Scene.load(tmp_path / "scene.json")
    for name in Scene.__dataclass_fields__:
        assert plain(getattr(back, name)) == plain(getattr(scene, name)), name
    np.testing.assert_array_equal(back.compile().initial_state, scene.compile().initial_state)


def test_comparison_of_scenes_notices_the_last_bit() -> None:
    scene, other = every_kind(), every_kind()
    assert plain(other.springs) == plain(scene.springs)
    del other.springs["soft"]
    other.add_spring(
        name="soft",
        first="ground",
        second="bob",
        stiffness=np.nextafter(THIRD, 1.0),
        damping=0.1,
        natural_length=0.3,
    )
    assert plain(list(other.springs.values())[-1]) != plain(scene.springs["soft"])


def test_a_loaded_case_runs_to_the_same_bits(tmp_path: Path) -> None:
    scene = cases.case2(count=20)
    scene.save(tmp_path / "case2.json")
    back = Scene.load(tmp_path / "case2.json")
    first, second = (simulate(each, t_end=2.0) for each in (scene, back))
    for name, values in first.channels.items():
        np.testing.assert_array_equal(second[name], values, err_msg=name)
    assert back.provenance == scene.provenance and back.roles == scene.roles
    assert back.waves is not None and scene.waves is not None
    assert back.waves.provenance == scene.waves.provenance


def test_saving_a_loaded_scene_gives_the_same_file(tmp_path: Path) -> None:
    save_scene(every_kind(), tmp_path / "a.json")
    save_scene(Scene.load(tmp_path / "a.json"), tmp_path / "b.json")
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_water_depth(tmp_path: Path) -> None:
    for depth in (math.inf, 40.0):
        scene = every_kind()
        scene.waves = Waves(
            **{**{k: getattr(scene.waves, k) for k in Waves.__dataclass_fields__}, "depth": depth}
        )
        save_scene(scene, tmp_path / "scene.json")
        loaded = Scene.load(tmp_path / "scene.json").waves
        assert loaded is not None and loaded.depth == depth


@WITH_FOLDER
@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=6, max_size=6))
def test_any_finite_number_comes_back(tmp_path: Path, values: list[float]) -> None:
    scene = Scene()
    scene.add_body(name="b", mass=1.0, inertia=[1, 1, 1], velocity=values[:3])
    scene.add_point_force(name="f", body="b", force=values[3:])
    scene.notes["values"] = values
    save_scene(scene, tmp_path / "scene.json")
    back = Scene.load(tmp_path / "scene.json")
    assert plain([back.bodies, back.point_forces, back.notes]) == plain(
        [scene.bodies, scene.point_forces, scene.notes]
    )


# what a file cannot hold


def test_c_functions_are_refused_by_name(tmp_path: Path) -> None:
    scene = every_kind()
    scene.add_function_force(name="wind", body="arm", address=4096)
    with pytest.raises(SceneError, match=r"function force 'wind'.*script"):
        scene.save(tmp_path / "scene.json")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("bad", [math.nan, {1, 2}, object(), b"raw", 1j, {"deep": [math.nan]}])
def test_notes_that_are_not_plain_data_leave_the_older_file(tmp_path: Path, bad: Any) -> None:
    scene, path = every_kind(), tmp_path / "scene.json"
    scene.save(path)
    before = path.read_bytes()
    scene.notes["odd"] = bad
    with pytest.raises(SceneError):
        scene.save(path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_notes_that_hold_themselves(tmp_path: Path) -> None:
    scene = every_kind()
    scene.notes["self"] = scene.notes
    with pytest.raises(SceneError, match="contain themselves"):
        scene.save(tmp_path / "scene.json")


def test_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="absent"):
        every_kind().save(tmp_path / "absent" / "scene.json")


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.json"):
        Scene.load(tmp_path / "none.json")


# malformed files


@pytest.fixture(scope="module")
def text(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("scene") / "scene.json"
    every_kind().save(path)
    return path.read_text()


def refused(tmp_path: Path, content: str | bytes, *parts: str) -> None:
    path = tmp_path / "lift.json"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(FileFormatError) as caught:
        Scene.load(path)
    assert "lift.json" in str(caught.value)
    for part in parts:
        assert part in str(caught.value)


def test_a_truncated_file_names_its_line(tmp_path: Path, text: str) -> None:
    for length in np.linspace(1, len(text) - 3, 97).astype(int).tolist():
        last_line = text[:length].count("\n") + 1
        path = tmp_path / "lift.json"
        path.write_text(text[:length])
        with pytest.raises(FileFormatError, match=r"lift\.json line (\d+), column") as caught:
            Scene.load(path)
        named = int(str(caught.value).split("line ")[1].split(",")[0])
        assert last_line - 1 <= named <= last_line


BROKEN: list[tuple[str, Callable[[dict[str, Any]], Any], tuple[str, ...]]] = [
    ("not a scene", lambda d: d.pop("format"), ("is not a scene file",)),
    ("another version", lambda d: d.update(version="0.5"), ("file version '0.5'", "version '0.4'; make")),
    ("version a number", lambda d: d.update(version=1), ("is of file version 1", "file version '0.4'")),
    ("missing section", lambda d: d.pop("springs"), ("has no 'springs'",)),
    ("unknown section", lambda d: d.update(sprngs=[]), ("unknown entry 'sprngs'", "springs")),
    ("section not a list", lambda d: d.update(bodies={}), ("bodies is {}", "give a list")),
    ("name a number", lambda d: d.update(name=3), ("name is 3", "give a text")),
    ("gravity a text", lambda d: d.update(gravity="9"), ("gravity is '9'", "give a number")),
    ("body a number", lambda d: d["bodies"].__setitem__(1, 7), ("bodies[1] is 7", "object with name, mass")),
    ("mass missing", lambda d: d["bodies"][1].pop("mass"), ("bodies[1]: has no 'mass'",)),
    ("mass true", lambda d: d["bodies"][0].update(mass=True), ("bodies[0].mass is True",)),
    ("mass beyond doubles", lambda d: d["bodies"][0].update(mass=10**400), ("bodies[0].mass", "1.8e308")),
    ("flag a number", lambda d: d["bodies"][0].update(gravity=1), ("bodies[0].gravity is 1", "true")),
    ("misspelt entry", lambda d: d["bodies"][0].update(masss=1), ("bodies[0]: has an unknown", "masss")),
    ("short vector", lambda d: d["bodies"][0].update(position=[0, 0]), ("position: has 2 entries; give 3",)),
    ("long row", lambda d: d["bodies"][0]["inertia"][1].append(0), ("inertia[1]: has 4 entries; give 3",)),
    ("null in a vector", lambda d: d["bodies"][2]["position"].append(None), ("position: has 4 entries",)),
    ("null as a number", lambda d: d["bodies"][2].update(velocity=[0, 0, None]), ("bodies[2].velocity[2]",)),
    ("body twice", lambda d: d["bodies"].append(d["bodies"][0]), ("bodies[4]", "body 'hull'", "twice")),
    ("unknown body", lambda d: d["joints"][0].update(second=["arm"]), ("joints[0].second is ['arm']",)),
    ("frame a text", lambda d: d["joints"][0].update(first_frame="x"), ("joints[0].first_frame is 'x'",)),
    ("frame axes", lambda d: d["joints"][0]["first_frame"].update(axis=1), ("first_frame: has an unknown",)),
    ("curve empty", lambda d: d["drivers"][0]["curve"].update(starts=[], coefficients=[], cosines=[]),
     ("drivers[0].curve", "no pieces")),
    ("curve ragged", lambda d: d["actuators"][0]["reference"]["coefficients"][0].pop(),
     ("actuators[0].reference.coefficients[0]: has 5 entries; give 6",)),
    ("driver on nothing", lambda d: d["drivers"][0].update(joint="x"), ("drivers[0]", "no joint 'x'")),
    ("memory motion", lambda d: d["vessels"][0]["memory"][0].update(inputs=[1.5, 2]),
     ("vessels[0].memory[0].inputs[0] is 1.5", "whole number")),
    ("memory shape", lambda d: d["vessels"][0]["memory"][0]["b"].pop(), ("memory[0].b: has 1 entries",)),
    ("kinematics", lambda d: d["vessels"][0].update(kinematics="x"), ("vessels[0]", "kinematics 'x'")),
    ("waves cut", lambda d: d["waves"]["phase"].pop(), ("waves.phase: has 2 entries; give 3",)),
    ("transfer cut", lambda d: d["waves"]["hulls"][0]["transfer_imaginary"][1].pop(),
     ("hulls[0].transfer_imaginary[1]: has 5",)),
    ("hull twice", lambda d: d["waves"].update(hulls=2 * d["waves"]["hulls"]),
     ("waves.hulls[1].body is 'hull'", "every vessel once")),
    ("waves a list", lambda d: d.update(waves=[]), ("waves is []",)),
    ("recorded joint", lambda d: d["recorded"][0].update(joint="x"), ("recorded[0]", "no joint 'x'")),
    ("notes a list", lambda d: d.update(notes=[]), ("notes is []", "give an object")),
]  # fmt: skip


@pytest.mark.parametrize(("change", "parts"), [pytest.param(c, p, id=name) for name, c, p in BROKEN])
def test_a_wrong_entry_is_named(
    tmp_path: Path, text: str, change: Callable[[dict[str, Any]], Any], parts: tuple[str, ...]
) -> None:
    data = json.loads(text)
    change(data)
    refused(tmp_path, json.dumps(data), *parts)


@pytest.mark.parametrize("entry", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_none(tmp_path: Path, text: str, entry: str) -> None:
    broken = text.replace('"baumgarte": 0.3333333333333333', f'"baumgarte": {entry}')
    assert broken != text
    refused(tmp_path, broken, "finite")


def test_a_key_given_twice(tmp_path: Path, text: str) -> None:
    refused(
        tmp_path,
        text.replace('"version": "0.4",', '"version": "0.4", "version": "0.4",'),
        "'version' occurs twice",
    )


@pytest.mark.parametrize(
    "content",
    [
        pytest.param(b"", id="empty"),
        pytest.param(b"\xff\xfe\x00", id="not text"),
        pytest.param(b"[]", id="a list"),
        pytest.param(b"null", id="null"),
        pytest.param(b"[" * 200_000, id="nested in the parser"),
        pytest.param(b'{"a":' * 200_000, id="nested objects"),
        pytest.param(b'{"format": ' + b"9" * 100_000 + b"}", id="digits"),
        pytest.param(pickle.dumps(every_kind), id="a pickle"),
        pytest.param(b"import os\nos.abort()\n", id="a script"),
    ],
)
def test_what_is_no_scene_file(tmp_path: Path, content: bytes) -> None:
    refused(tmp_path, content)


def test_nested_notes(tmp_path: Path, text: str) -> None:
    deep = "[" * 900 + "]" * 900
    data = text.replace('"author": "someone"', f'"author": {deep}')
    assert data != text
    path = tmp_path / "lift.json"
    path.write_text(data)
    try:
        assert isinstance(Scene.load(path).notes["author"], list)
    except FileFormatError as error:  # depends on how deep the caller stands
        assert "nested" in str(error)


def test_a_file_larger_than_the_bound_is_not_parsed(
    tmp_path: Path, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for place in ("file", "file_text"):
        monkeypatch.setattr(f"seacrane.description.{place}.LARGEST_FILE", len(text) - 1)
    refused(tmp_path, text, "larger than")
    with pytest.raises(SceneError, match="above"):
        every_kind().save(tmp_path / "other.json")
    assert not (tmp_path / "other.json").exists()


@WITH_FOLDER
@given(st.data())
def test_a_file_with_any_stretch_replaced_loads_or_is_refused(
    tmp_path: Path, text: str, data: st.DataObject
) -> None:
    raw = text.encode()
    start = data.draw(st.integers(0, len(raw) - 1))
    length = data.draw(st.integers(0, 40))
    patch = data.draw(
        st.binary(max_size=20) | st.sampled_from([b"null", b"[]", b"{}", b"-1", b"1e308", b'"x"'])
    )
    path = tmp_path / "lift.json"
    path.write_bytes(raw[:start] + patch + raw[start + length :])
    try:
        assert isinstance(Scene.load(path), Scene)
    except FileFormatError as error:
        assert str(error).startswith("lift.json")


OTHERS = {
    "crane.toml": (b"name = 'crane'\n", "TOML, as of a crane"),
    "crane.urdf": (b'<?xml version="1.0"?>\n<robot name="crane"/>\n', "XML, such as a URDF model"),
    "hook.step": (b"ISO-10303-21;\nHEADER;\n", "a STEP model"),
    "run.nc": (b"\x89HDF\r\n\x1a\n", "a NetCDF file"),
    "lift.py": (b"import seacrane\n", "a Python script"),
    "ship.yml": (b"General:\n  Units: SI\n", "YAML, as of an OrcaFlex model"),
    "empty.json": (b" \n", "empty"),
    "list.json": (b"[1, 2]", "a JSON list"),
    "run.state": (b"seacrane state\n{}", "a state"),
    "notes.txt": (b"hello", "something else"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_a_file_of_another_kind_is_named_as_what_it_is(name: str, tmp_path: Path) -> None:
    """Not as malformed JSON."""
    content, kind = OTHERS[name]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(FileFormatError, match=f"{name}: is {kind}.*no scene file.*Scene.save"):
        Scene.load(tmp_path / name)
