"""Scene files: exact round trip of every kind of element, and a clear refusal of everything else."""

from __future__ import annotations

import ctypes
import dataclasses
import json
import math
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seacrane import Curve, FileFormatError, Frame, Scene, SceneError, cases, simulate
from seacrane.hydro import StateSpaceBlock
from seacrane.scene import HullLoads, SeaProvenance, VesselProvenance, Waves

THIRD = 1.0 / 3.0


def every_kind() -> Scene:
    """One of each element that a file can hold, with numbers that have no short decimal form."""
    scene = Scene(name="every kind", gravity=9.8 + THIRD / 100, baumgarte=THIRD, length_scale=1.1)
    inertia, half = np.array([[2.0, 0.1, 0.0], [0.1, 3.0, THIRD], [0.0, THIRD, 2.5]]), math.sqrt(0.5)
    scene.add_body("hull", mass=1e7 * THIRD, inertia=inertia * 1e6, center_of_mass=(0.1, -0.2, THIRD))
    scene.add_body("arm", mass=5e-4, inertia=inertia * 1e-4, position=(1.0, THIRD, -2.0),
                   quaternion=(half, 0, half, 0), velocity=(0.0, -0.0, 1e-300),
                   angular_velocity=(5e-324, 0.0, 0.0), gravity=False)  # fmt: skip
    for i, name in enumerate(("bob", "kite")):
        scene.add_body(name, mass=1.0, inertia=[1.0, 1.0, 1.0], position=(4.0, i, 0.0))
    pair = {"kind": "universal", "axis": (1, 0, 0), "second_axis": (0, THIRD, 1)}
    wire = {"kind": "distance", "point": (4, 0, 0), "second_point": (4, 1, THIRD)}
    frames = {"first_frame": Frame(point=(4, 1, 0)), "second_frame": Frame()}
    scene.add_joint("pin", kind="revolute", first="hull", second="arm", axis=(THIRD, 1.0, 0.2))
    scene.add_joint("cross", first="hull", second="bob", **pair)
    scene.add_joint("wire", first="bob", second="kite", **wire)
    scene.add_joint("sleeve", kind="cylindrical", first="ground", second="kite", **frames)
    swing = Curve.harmonic(offset=0.0, amplitude=0.01, omega=THIRD, phase=-math.pi / 2.0)
    scene.add_driver("sleeve", curve=swing, name="shaker")
    move = Curve.quintic(start_time=0.1, end_time=7.0, start=0.0, end=THIRD)
    scene.add_actuator(name="motor", joint="pin", stiffness=THIRD, damping=0.2, feed_forward=1e-3,
                       reference=move.then(time=9.0, curve=swing))  # fmt: skip
    scene.add_force("arm", name="push", force=(THIRD, 0, 0), point=(0, THIRD, 0), body_axes=True)
    soft = {"stiffness": THIRD, "damping": 0.1, "natural_length": 0.3}
    table = {"first_point": (0, 0, THIRD), "lengths": [1, 2.5], "forces": [0, THIRD]}
    scene.add_spring("soft", first="ground", second="bob", **soft)
    scene.add_spring("table", first="hull", second="kite", **table)
    loads = np.arange(12.0).reshape(2, 6) / 7
    scene.add_force("kite", name="gust", times=[0.0, THIRD], force=loads)
    matrix, restoring = np.diag([1e6, 2e6, 3e6, 4e6, 5e6, 6e6]) * THIRD, np.diag([0, 0, 1e6, 2e6, 3e6, 0])
    memory = [StateSpaceBlock(inputs=[2, 4], outputs=[4], a=[[-1.0, THIRD], [0.0, -2.0]], b=np.eye(2),
                              c=[[THIRD, 1.0]], d=[[0.0, 1e-9]], state_scale=[0.5, THIRD]),
              StateSpaceBlock(inputs=[0], outputs=[0], a=np.zeros((0, 0)), b=np.zeros((0, 1)),
                              c=np.zeros((1, 0)), d=[[3.0]])]  # fmt: skip
    scene.add_vessel(body="hull", name="water", added_mass=matrix, linear_damping=matrix / 10,
                     restoring=restoring, quadratic_damping=np.arange(6.0), mooring_stiffness=(1e4, 2e4, 3e4),
                     mooring_damping=(1, 2, THIRD), memory=memory)  # fmt: skip
    draw = np.random.default_rng(3)
    omega, amplitude = np.array([0.5, 0.7, 1.1]), draw.uniform(0.01, 0.02, 3)
    phase, direction = draw.uniform(0.0, 6.0, 3), draw.uniform(-3.0, 3.0, 3)
    transfer = draw.normal(size=(3, 6)) + 1j * draw.normal(size=(3, 6))
    hull = HullLoads(transfer=transfer, position=(THIRD, -0.0), heading=-THIRD)
    told = SeaProvenance(seed=3, repeat_period_s=math.inf, realised_hs=np.float64(THIRD))
    scene.waves = Waves(omega=omega, amplitude=amplitude, phase=phase, direction=direction,
                        hulls={"hull": hull}, provenance=told, evaluation="exact")  # fmt: skip
    scene.add_channel(joint="pin", name="angle of the arm")
    scene.add_channel(joint="sleeve", coordinate="angle", name="turn")
    scene.add_roles(prefix="aft ", slew="pin", cylinders={"luff": "sleeve"}, link="wire")
    scene.provenance["water"] = VesselProvenance(database="hull", omega=(0.1, THIRD * 10), memory="by-motion")
    scene.notes.update(author="someone", hs=THIRD, tries=[1, 2.5, None, True], nested={"limit": -math.inf})
    scene.add_mesh(body="arm", name="look", vertices=np.eye(3) * THIRD, faces=[[0, 1, 2]])
    return scene


def plain(value: Any) -> Any:
    """Everything a scene holds, as nested lists with each number as its bytes."""
    if isinstance(value, (float, complex, np.number)):
        return np.asarray(value, dtype=complex).tobytes()
    if isinstance(value, Curve):
        return plain(value.to_pieces())
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(item) for item in value]
    if isinstance(value, dict):
        return [[key, plain(item)] for key, item in value.items()]
    if isinstance(value, (str, int, type(None))):
        return value
    names = [name for name in dir(value) if not name.startswith("_") and not callable(getattr(value, name))]
    assert names, f"{value!r} shows nothing to compare"
    return [[name, plain(getattr(value, name))] for name in names]


@pytest.mark.parametrize("depth", [math.inf, 40.0])
def test_every_kind_of_element_comes_back_bit_for_bit(depth: float, tmp_path: Path) -> None:
    """What is compared by sees the last bit."""
    scene = every_kind()
    scene.waves = dataclasses.replace(scene.waves, depth=depth)  # type: ignore[type-var]
    scene.save(tmp_path / "scene.json")
    back = Scene.load(tmp_path / "scene.json")
    for name in Scene.__dataclass_fields__:
        assert plain(getattr(back, name)) == plain(getattr(scene, name)), name
    np.testing.assert_array_equal(back.compile().initial_state, scene.compile().initial_state)
    back.save(tmp_path / "again.json")
    assert (tmp_path / "again.json").read_bytes() == (tmp_path / "scene.json").read_bytes()
    back.replace("soft", stiffness=np.nextafter(THIRD, 1.0))
    assert plain(back.springs) != plain(scene.springs)


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


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=6, max_size=6))
def test_any_finite_number_comes_back(tmp_path: Path, values: list[float]) -> None:
    scene = Scene()
    scene.add_body("b", mass=1.0, inertia=[1, 1, 1], velocity=values[:3])
    scene.add_force("b", name="f", force=values[3:])
    scene.notes["values"] = values
    scene.save(tmp_path / "scene.json")
    back = Scene.load(tmp_path / "scene.json")
    for name in ("bodies", "point_forces", "notes"):
        assert plain(getattr(back, name)) == plain(getattr(scene, name))


def test_what_a_file_cannot_hold_leaves_the_older_file(tmp_path: Path) -> None:
    scene, path = every_kind(), tmp_path / "scene.json"
    scene.save(path)
    before = path.read_bytes()
    for bad in (math.nan, {1, 2}, object(), b"raw", 1j, {"deep": [math.nan]}, scene.notes):
        scene.notes["odd"] = bad
        with pytest.raises(SceneError, match="contain themselves" if bad is scene.notes else "odd"):
            scene.save(path)
    del scene.notes["odd"]
    scene.add_force("arm", name="wind", force=ctypes.CFUNCTYPE(None)(4096))
    with pytest.raises(SceneError, match=r"function force 'wind'.*script"):
        scene.save(path)
    assert path.read_bytes() == before and list(tmp_path.iterdir()) == [path]
    with pytest.raises(OSError, match="absent"):
        every_kind().save(tmp_path / "absent" / "scene.json")
    with pytest.raises(FileNotFoundError, match=r"none\.json"):
        Scene.load(tmp_path / "none.json")


@pytest.fixture(scope="module")
def text(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("scene") / "scene.json"
    every_kind().save(path)
    return path.read_text()


def refused(tmp_path: Path, content: str | bytes, told: str = "") -> None:
    path = tmp_path / "lift.json"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(FileFormatError, match=rf"lift\.json.*{told}"):
        Scene.load(path)


def test_a_truncated_file_names_its_line(tmp_path: Path, text: str) -> None:
    path = tmp_path / "lift.json"
    for length in np.linspace(1, len(text) - 3, 97).astype(int).tolist():
        last_line = text[:length].count("\n") + 1
        path.write_text(text[:length])
        with pytest.raises(FileFormatError, match=r"lift\.json line (\d+), column") as caught:
            Scene.load(path)
        named = int(str(caught.value).split("line ")[1].split(",")[0])
        assert last_line - 1 <= named <= last_line


BROKEN: list[tuple[str, Any, str]] = [  # the entry, what it becomes, and what is told
    ("version", "0.5", r"file version '0\.5'.*version '0\.4'; make"), ("gravity", "9", "gravity is '9'"),
    ("sprngs", [], "unknown entry 'sprngs'.*springs"), ("bodies", {}, "bodies is {}.*list"),
    ("bodies 1", 7, r"bodies\[1\] is 7.*object with name, mass"),
    ("bodies 0 mass", True, r"bodies\[0\].mass is True"), ("bodies 0 gravity", 1, "gravity is 1.*true"),
    ("bodies 0 mass", 10**400, r"bodies\[0\].mass.*1.8e308"),
    ("bodies 0 masss", 1, r"bodies\[0\].*unknown.*masss"),
    ("bodies 0 inertia 1", [0.0] * 4, r"inertia\[1\]: has 4 entries; give 3"),
    ("bodies 2 velocity", [0, 0, None], r"bodies\[2\].velocity\[2\]"),
    ("bodies 3 name", "hull", "body 'hull'.*twice"),
    ("joints 0 first_frame axis", 1, "first_frame: has an unknown"),
    ("drivers 0 curve", {"starts": [], "coefficients": [], "cosines": []}, r"drivers\[0\].curve.*no pieces"),
    ("actuators 0 reference coefficients 0", [0.0] * 5, r"actuators\[0\].*coefficients\[0\].*5.*give 6"),
    ("drivers 0 joint", "x", r"drivers\[0\].*no joint 'x'"),
    ("vessels 0 memory 0 inputs", [1.5, 2], r"vessels\[0\].memory\[0\].inputs\[0\] is 1.5.*whole number"),
    ("vessels 0 memory 0 b", [[1.0, 0.0]], r"memory\[0\].b: has 1 entries"),
    ("waves phase", [0.0, 1.0], "waves.*phase.*3"),
    ("waves depth", {"$infinite": "deep"}, "waves.depth is .*number"),
    ("waves hulls hull transfer imaginary 1", [0.0] * 5, r"hulls.hull.transfer.imaginary.*lengths"),
    ("waves hulls hull transfer real", [[0.0] * 6], r"hulls.hull.transfer: real.*imaginary"),
    ("recorded turn 0", "x", r"recorded.turn.*no joint 'x'"),
]  # fmt: skip


@pytest.mark.parametrize(("entry", "value", "told"), BROKEN, ids=[row[2] for row in BROKEN])
def test_a_wrong_entry_is_named(entry: str, value: Any, told: str, tmp_path: Path, text: str) -> None:
    data = json.loads(text)
    *path, last = (int(key) if key.isdigit() else key for key in entry.split())
    inside = data
    for key in path:
        inside = inside[key]
    inside[last] = value
    refused(tmp_path, json.dumps(data), told)


def test_numbers_and_keys_that_are_none(tmp_path: Path, text: str) -> None:
    number, key = '"baumgarte": 0.3333333333333333', '"version": "0.4",'
    assert number in text and key in text
    for none in ("NaN", "Infinity", "-Infinity", "1e999"):
        refused(tmp_path, text.replace(number, f'"baumgarte": {none}'), "finite")
    refused(tmp_path, text.replace(key, key + key), "'version' occurs twice")


OTHERS: dict[str, tuple[bytes, str]] = {
    "crane.toml": (b"name = 'crane'\n", "TOML, as of a crane"), "lift.py": (b"import a\n", "a Python script"),
    "run.nc": (b"\x89HDF\r\n\x1a\n", "a NetCDF file"), "run.state": (b"seacrane state\n{}", "a state"),
    "notes.txt": (b"hello", "something else"),
}  # fmt: skip


def test_a_file_of_another_kind_is_named_as_what_it_is(tmp_path: Path, text: str) -> None:
    for name, (content, kind) in OTHERS.items():
        (tmp_path / name).write_bytes(content)
        with pytest.raises(FileFormatError, match=f"{name}: is {kind}.*no scene file.*Scene.save"):
            Scene.load(tmp_path / name)
    lost = text.replace('"format"', '"kind"')
    none: tuple[str | bytes, ...] = (b"\xff\xfe\x00", b"null", b'{"format": ' + b"9" * 100_000 + b"}", lost)
    for data in (*none, pickle.dumps(every_kind)):
        refused(tmp_path, data)
