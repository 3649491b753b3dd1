"""Meshes of users: drawn as they are, kept in files, without effect on motions; hostile files are refused."""

from __future__ import annotations

import base64
import copy
import json
import os
import pickle
import random
import re
import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fuzz.limits import bounded
from fuzz.mutate import mutate_json
from scipy.spatial.transform import Rotation
from test_view import Page

from seacrane import FileFormatError, Frame, Lift, Result, Scene, SceneError, cases, simulate, view
from seacrane.description import meshes
from seacrane.description.file import scene_digest
from seacrane.description.meshes import MOST_TRIANGLES
from seacrane.inputs.gltf import read_gltf
from seacrane.pictures.drawn_bodies import looks
from seacrane.pictures.shapes import HullShape, MeshShape

CORNERS = np.array([[x, y, z] for x in (0, 2) for y in (0, 3) for z in (0, 1)], dtype=float)
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
     [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
LITTLE = 64 * 2**20  # bytes


def pendulum() -> Scene:
    scene = Scene(name="pendulum")
    scene.add_body(
        name="ball", mass=1.0, inertia=(0.1, 0.1, 0.1), position=(0.3, 0, -1.0), center_of_mass=(0, 0, 0.5)
    )
    scene.add_joint(
        kind="revolute", name="pivot", first="ground", second="ball", point=(0, 0, 0), axis=(0, 1, 0)
    )
    return scene


def binary_stl(path: Path, soup: np.ndarray) -> Path:
    facets = np.zeros(len(soup), dtype=[("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("more", "<u2")])
    facets["vertices"] = soup
    path.write_bytes(b"box".ljust(80) + struct.pack("<I", len(soup)) + facets.tobytes())
    return path


def ascii_stl(path: Path, soup: np.ndarray) -> Path:
    lines = ["solid box"]
    for triangle in soup:
        lines += [
            "facet normal 0 0 0",
            "outer loop",
            *("vertex {} {} {}".format(*corner) for corner in triangle),
        ]
        lines += ["endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid box"]))
    return path


def gltf_of_box(**node: Any) -> dict[str, Any]:
    """The box in glTF's axes, y up, with its numbers inside."""
    data = np.column_stack([CORNERS[:, 0], CORNERS[:, 2], -CORNERS[:, 1]]).astype("<f4").tobytes()
    data += FACES.astype("<u2").tobytes()
    return {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, **node}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 72},
        ],
        "buffers": [
            {"byteLength": len(data),
             "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}
        ],
    }  # fmt: skip


def written(path: Path, document: Any) -> Path:
    path.write_text(json.dumps(document))
    return path


def glb(path: Path, document: dict[str, Any]) -> Path:
    """The same as one binary file."""
    document = copy.deepcopy(document)
    data = base64.b64decode(document["buffers"][0].pop("uri").partition(",")[2])
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)
    return path


def sorted_triangles(soup: np.ndarray) -> np.ndarray:
    """Each from its smallest corner, all in order: independent of how they were stored."""
    turned = [min(np.roll(one, k, axis=0).round(4).tolist() for k in range(3)) for one in soup]
    return np.array(sorted(turned))


FILES: dict[str, Callable[[Path], Path]] = {
    "box.stl": lambda path: binary_stl(path, CORNERS[FACES]),
    "ascii.STL": lambda path: ascii_stl(path, CORNERS[FACES]),
    "box.gltf": lambda path: written(path, gltf_of_box()),
    "box.glb": lambda path: glb(path, gltf_of_box()),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_gives_the_triangles_that_arrays_give(name: str, tmp_path: Path) -> None:
    mesh = pendulum().add_mesh(body="ball", file=FILES[name](tmp_path / name))
    assert (mesh.name, mesh.body, len(mesh.vertices)) == ("ball", "ball", 8)
    arrays = pendulum().add_mesh(body="ball", vertices=CORNERS, faces=FACES)
    expected = sorted_triangles(arrays.vertices[arrays.faces])
    np.testing.assert_allclose(sorted_triangles(mesh.vertices[mesh.faces]), expected)
    with pytest.raises(ValueError, match="read-only"):
        mesh.vertices[0] = 0.0


def test_scale_and_frame_place_a_mesh() -> None:
    axes = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    mesh = pendulum().add_mesh(
        body="ball", vertices=1e3 * CORNERS, faces=FACES, scale=1e-3, frame=Frame(point=(5, 0, 0), axes=axes)
    )
    expected = np.column_stack([5.0 - CORNERS[:, 1], CORNERS[:, 0], CORNERS[:, 2]])
    np.testing.assert_allclose(mesh.vertices, expected, atol=1e-6)


def test_nodes_of_a_model_are_followed(tmp_path: Path) -> None:
    turn = Rotation.from_euler("xyz", [20, -50, 130], degrees=True)
    inner = {"translation": [1.0, 2.0, 3.0], "rotation": turn.as_quat().tolist(), "scale": [2.0, 1.0, 0.5]}
    document = gltf_of_box(**inner)
    outer = np.eye(4)
    outer[:3, :3], outer[:3, 3] = Rotation.from_euler("y", 30, degrees=True).as_matrix(), (7.0, 0.0, -1.0)
    document["nodes"].append({"children": [0], "matrix": outer.T.ravel().tolist()})
    document["scenes"][0]["nodes"] = [1]
    found = read_gltf(written(tmp_path / "box.gltf", document), most=100)
    y_up = np.column_stack([CORNERS[:, 0], CORNERS[:, 2], -CORNERS[:, 1]])
    placed = turn.apply(y_up * inner["scale"]) + inner["translation"]
    placed = placed @ outer[:3, :3].T + outer[:3, 3]
    z_up = np.column_stack([placed[:, 0], -placed[:, 2], placed[:, 1]])
    np.testing.assert_allclose(sorted_triangles(found), sorted_triangles(z_up[FACES]), atol=2e-4)


def test_our_own_model_comes_back_where_it_stands(tmp_path: Path) -> None:
    scene = cases.case2()
    shown = view(scene)
    found = read_gltf(shown.save_gltf(tmp_path / "lift.glb"), most=MOST_TRIANGLES).reshape(-1, 3)
    low, high = shown.drawing.box
    wire = shown.drawing.wire_radius
    np.testing.assert_allclose(found.min(axis=0), low, atol=2 * wire)
    np.testing.assert_allclose(found.max(axis=0), high, atol=2 * wire)


def test_a_mesh_moves_nothing() -> None:
    plain, drawn = pendulum(), pendulum()
    drawn.add_mesh(body="ball", vertices=CORNERS, faces=FACES)
    assert scene_digest(plain) == scene_digest(drawn)
    first, second = simulate(plain, 1.0), simulate(drawn, 1.0)
    for channel in first:
        np.testing.assert_array_equal(first[channel], second[channel])


def test_a_body_is_drawn_by_its_meshes_alone(tmp_path: Path) -> None:
    scene = pendulum()
    scene.add_mesh(body="ball", vertices=CORNERS, faces=FACES)
    scene.add_mesh(body="ball", name="lug", vertices=0.1 * CORNERS, faces=FACES[:4])
    box, lug = looks(scene)["ball"].shapes
    assert isinstance(box, MeshShape)
    np.testing.assert_allclose(box.vertices, CORNERS - (0, 0, 0.5))
    assert len(lug.faces) == 4  # type: ignore[union-attr]
    page = Page(view(Result.load(simulate(scene, 0.5).save(tmp_path / "run.nc"))).html)
    (body,) = page.data["bodies"]
    assert [shape["kind"] for shape in body["shapes"]] == ["mesh", "mesh"]
    assert body["shapes"][0]["vertices"]["shape"] == [8, 3]
    assert body["shapes"][0]["colour"].startswith("#")


def test_a_vessel_s_mesh_is_painted_by_the_water() -> None:
    scene = cases.vessel()
    scene.add_mesh(body="vessel", vertices=CORNERS, faces=FACES)
    (hull,) = looks(scene)["vessel"].shapes
    assert isinstance(hull, HullShape)
    assert hull.waterline == -scene.bodies["vessel"].center_of_mass[2]


def test_scene_files_hold_the_triangles(tmp_path: Path) -> None:
    scene = pendulum()
    stl = binary_stl(tmp_path / "box.stl", CORNERS[FACES] / 3.0)
    mesh = scene.add_mesh(body="ball", file=stl)
    stl.unlink()
    scene.save(tmp_path / "scene.json")
    loaded = Scene.load(tmp_path / "scene.json")
    assert loaded == scene
    np.testing.assert_array_equal(loaded.meshes["ball"].vertices, mesh.vertices)
    np.testing.assert_array_equal(loaded.meshes["ball"].faces, mesh.faces)
    assert "meshes" in str(scene)
    twin = pickle.loads(pickle.dumps(mesh))
    assert twin == mesh and hash(twin) == hash(mesh)
    assert not twin.vertices.flags.writeable
    assert copy.deepcopy(scene) == scene
    assert mesh != pendulum().add_mesh(body="ball", vertices=CORNERS, faces=FACES)


def test_a_lift_names_the_file(tmp_path: Path) -> None:
    binary_stl(tmp_path / "box.stl", 1e3 * CORNERS[FACES])
    (tmp_path / "lift.toml").write_text(
        'format = "seacrane lift"\nversion = 2\n'
        '[[body]]\nname = "ball"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n'
        '[[mesh]]\nbody = "ball"\nfile = "box.stl"\nscale = 1e-3\nframe = { point_m = [0, 0, 5] }\n'
    )
    mesh = Lift.load(tmp_path / "lift.toml").scene().meshes["ball"]
    np.testing.assert_allclose(np.sort(mesh.vertices, axis=0)[[0, -1]], [[0, 0, 5], [2, 3, 6]], atol=1e-6)
    (tmp_path / "box.stl").write_bytes(b"solid")
    with pytest.raises(FileFormatError, match=r"lift\.toml line 9: \[\[mesh\]\] 1: .*box\.stl: ends before"):
        Lift.load(tmp_path / "lift.toml").scene()


def test_a_mesh_is_removed_and_keeps_its_body() -> None:
    scene = pendulum()
    scene.remove("pivot")
    scene.add_mesh(body="ball", name="look", vertices=CORNERS, faces=FACES)
    with pytest.raises(SceneError, match="body 'ball': mesh 'look' refer to it; remove these first"):
        scene.remove("ball")
    with pytest.raises(SceneError, match="mesh 'look': is not replaced; remove it, and add another"):
        scene.replace("look", body="ball")
    scene.remove("look")
    scene.remove("ball")


def test_an_open_mesh_is_drawn() -> None:
    assert len(pendulum().add_mesh(body="ball", vertices=CORNERS, faces=FACES[:3]).faces) == 3


BOX = {"vertices": CORNERS, "faces": FACES}
WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "body": ({**BOX, "body": "bal"}, "body is 'bal'; the scene has 'ball'"),
    "neither": ({}, "give file, or vertices and faces"),
    "both": ({**BOX, "file": "box.stl"}, "give file, or vertices and faces"),
    "no faces": ({"vertices": CORNERS}, "give file, or vertices and faces"),
    "suffix": ({"file": "box.step"}, "file is 'box.step'; give .stl, .glb, .gltf"),
    "path": ({"file": 3}, "file is 3; give a path"),
    "millimetres": (
        {**BOX, "vertices": 1e3 * CORNERS},
        "is 3000 m large, above 1000 m; if it is in mm give scale=0.001",
    ),
    "scale": ({**BOX, "scale": -1.0}, "scale is -1; give a positive number"),
    "scale text": ({**BOX, "scale": "mm"}, "scale is 'mm'; give a number"),
    "huge scale": ({**BOX, "scale": 1e308}, "inf m large, above 1000 m"),
    "frame": ({**BOX, "frame": (1, 2, 3)}, "frame is (1, 2, 3); give a seacrane.Frame"),
    "far": ({**BOX, "frame": Frame(point=(1e6, 0, 0))}, "more than 100000 m from its body"),
    "not finite": ({**BOX, "vertices": CORNERS * np.nan}, "not finite; repair it"),
    "a point": ({**BOX, "vertices": 0.0 * CORNERS}, "all its vertices are one point"),
    "vanishing": ({**BOX, "scale": 1e-60}, "all its vertices are one point"),
    "shape": ({**BOX, "vertices": CORNERS[:, :2]}, "vertices has shape (8, 2); give (n, 3), m"),
    "faces": ({**BOX, "faces": FACES[:, :2]}, "faces has shape (12, 2)"),
    "fractions": ({**BOX, "faces": 0.5 * FACES}, "give (m, 3) whole numbers"),
    "from one": ({**BOX, "faces": FACES + 1}, "none of its 8; count from 0"),
    "no triangles": ({**BOX, "faces": FACES[:0]}, "none of its 8; count from 0"),
    "too many": (
        {**BOX, "faces": np.tile(FACES, (20_000, 1))},
        "brings body 'ball' to 240000 triangles, above 200000; decimate it",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_makes_no_sense_is_refused_by_name(case: str) -> None:
    given, message = WRONG[case]
    scene = pendulum()
    with pytest.raises(SceneError, match=re.escape(message)):
        scene.add_mesh(**{"body": "ball", **given})
    assert not scene.meshes


def test_meshes_of_a_body_count_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(meshes, "MOST_TRIANGLES", 20)
    scene = pendulum()
    scene.add_mesh(body="ball", **BOX)
    with pytest.raises(SceneError, match="mesh 'ball': the name is used twice"):
        scene.add_mesh(body="ball", vertices=CORNERS, faces=FACES[:2])
    with pytest.raises(SceneError, match="brings body 'ball' to 24 triangles, above 20"):
        scene.add_mesh(body="ball", name="more", **BOX)


def refused(path: Path, message: str) -> None:
    """By name, with little memory."""
    tracemalloc.start()
    try:
        with pytest.raises(FileFormatError, match=message) as caught:
            pendulum().add_mesh(body="ball", file=path)
        assert tracemalloc.get_traced_memory()[1] < LITTLE
        assert len(str(caught.value)) < 500 + len(str(path))
        assert path.stem in str(caught.value)
    finally:
        tracemalloc.stop()


@pytest.mark.slow("ten million triangles")
def test_ten_million_triangles_are_refused_by_their_number(tmp_path: Path) -> None:
    """Before the 500 MB are read."""
    path = tmp_path / "scan.stl"
    path.write_bytes(b"scan".ljust(80) + struct.pack("<I", 10_000_000))
    os.truncate(path, 84 + 50 * 10_000_000)
    refused(path, "has 10000000 triangles, above 200000; decimate the mesh in the program that made it")
    document = gltf_of_box()
    document["accessors"][1]["count"] = 30_000_000
    refused(written(tmp_path / "scan.gltf", document), "has 10000000 triangles, above 200000; decimate")
    document = gltf_of_box()
    document["scenes"][0]["nodes"] = [0] * 19_000
    refused(written(tmp_path / "many.gltf", document), "triangles, above")


def test_many_triangles_of_an_ascii_file_are_counted_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(meshes, "MOST_TRIANGLES", 11)
    refused(ascii_stl(tmp_path / "box.stl", CORNERS[FACES]), "has 12 triangles, above 11; decimate")


def changed(**changes: Any) -> dict[str, Any]:
    """The box with other entries; "accessors.1.count" names one."""
    document = gltf_of_box()
    for path, value in changes.items():
        *parts, last = (int(part) if part.isdigit() else part for part in path.split("__"))
        place: Any = document
        for part in parts:
            place = place[part]
        place[last] = value
    return document


HOSTILE: dict[str, tuple[Any, str]] = {
    "a list": ([], "is no glTF 2.0 model"),
    "version 1": (changed(asset={"version": "1.0"}), "is no glTF 2.0 model"),
    "compressed": (
        changed(extensionsRequired=["KHR_draco_mesh_compression"]),
        "needs the extension KHR_draco_mesh_compression; export it without compression",
    ),
    "sparse": (changed(accessors__0__sparse={}), "give plain VEC3 numbers"),
    "another type": (changed(accessors__0__componentType=5120), "give plain VEC3 numbers"),
    "another file": (changed(buffers__0__uri="/etc/passwd"), "has a buffer in another file; export it as"),
    "no base64": (changed(buffers__0__uri="data:x;base64,?"), "export it as .glb"),
    "count": (changed(accessors__0__count=9), "leads beyond the 168 bytes of its buffer"),
    "negative count": (changed(accessors__1__count=-3), "leads beyond the 168 bytes of its buffer"),
    "offset": (changed(bufferViews__1__byteOffset=2**30), "leads beyond the 168 bytes of its buffer"),
    "negative offset": (changed(bufferViews__1__byteOffset=-8), "leads beyond the 168 bytes"),
    "stride": (changed(bufferViews__0__byteStride=1), "leads beyond the 168 bytes of its buffer"),
    "index": (changed(accessors__0__count=7), "are no triangles of its vertices"),
    "no triangle": (changed(accessors__1__count=35), "are no triangles of its vertices"),
    "strip": (changed(meshes__0__primitives__0__mode=5), "is a strip or fan; export separate triangles"),
    "lines": (changed(meshes__0__primitives__0__mode=1), "holds no triangles; export the mesh again"),
    "circle": (changed(nodes__0__children=[0]), "has more than 20000 nodes, or nodes 64 deep in each other"),
    "missing node": (changed(scenes__0__nodes=[7]), r"there is no nodes\[7\], of 1"),
    "missing mesh": (changed(nodes__0__mesh=-1), r"there is no meshes\[-1\], of 1"),
    "no object": (changed(nodes__0=3), r"nodes\[0\] is 3; give an object"),
    "turned away": (changed(nodes__0__scale=[1e308] * 3), "turn the mesh into no finite one"),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_models_are_refused(case: str, tmp_path: Path) -> None:
    document, message = HOSTILE[case]
    with np.errstate(all="ignore"):
        refused(written(tmp_path / "box.gltf", document), message)


def test_not_finite_coordinates_are_refused(tmp_path: Path) -> None:
    document = gltf_of_box()
    data = bytearray(base64.b64decode(document["buffers"][0]["uri"].partition(",")[2]))
    data[0:4] = struct.pack("<f", np.nan)
    document["buffers"][0]["uri"] = "data:;base64," + base64.b64encode(data).decode()
    refused(written(tmp_path / "box.gltf", document), "has a coordinate that is not finite; repair it")


def test_text_of_no_end_and_of_no_sense(tmp_path: Path) -> None:
    path = tmp_path / "box.gltf"
    for text in ("[" * 100_000, "", "\x00", '{"asset":' + "1" * 10_000 + "}"):
        path.write_text(text)
        refused(path, "is no glTF")
    with pytest.raises(FileFormatError, match="cannot be read"):
        pendulum().add_mesh(body="ball", file=tmp_path / "absent.glb")


def test_a_cut_file_is_refused_wherever_it_is_cut(tmp_path: Path) -> None:
    path = glb(tmp_path / "box.glb", gltf_of_box())
    whole = path.read_bytes()
    for end in range(0, len(whole), 17):
        path.write_bytes(whole[:end])
        refused(path, "truncated or damaged|is no glTF")
    path.write_bytes(whole[:12] + struct.pack("<I4s", 2**31, b"JSON") + whole[20:])
    refused(path, "a chunk of 2147483648 bytes leads beyond its end")


def test_mutated_models_are_read_or_refused(tmp_path: Path) -> None:
    """Within the limits of the other readers; nothing but a FileFormatError."""
    rng, path = random.Random(5), tmp_path / "box.gltf"
    sound = json.dumps(gltf_of_box(translation=[0, 0, 1])).encode()
    outcomes = {True: 0, False: 0}
    for _ in range(300):
        path.write_bytes(mutate_json(sound, rng))
        try:
            with bounded(path.stat().st_size), np.errstate(all="ignore"):
                found = read_gltf(path, most=1000)
        except FileFormatError as error:
            assert path.stem in str(error)
            assert len(str(error)) < 1000
            outcomes[False] += 1
            continue
        assert np.isfinite(found).all()
        outcomes[True] += 1
    assert min(outcomes.values()) > 10


IN_SCENES: dict[str, tuple[dict[str, Any], str]] = {
    "no base64": ({"vertices": "?"}, "meshes[0].vertices: "),
    "rows": ({"vertices": base64.b64encode(bytes(16)).decode()}, "has 16 bytes; give rows of 12"),
    "empty": ({"faces": ""}, "has 0 bytes; give rows of 12"),
    "far index": (
        {"faces": base64.b64encode(b"\xff" * 12).decode()},
        "meshes[0]: mesh 'ball': faces name vertices that are none of its 8",
    ),
    "not finite": (
        {"vertices": base64.b64encode(np.full((8, 3), np.inf, "<f4").tobytes()).decode()},
        "meshes[0]: mesh 'ball': has a vertex more than 100000 m",
    ),
    "large": (
        {"vertices": base64.b64encode((1e3 * CORNERS).astype("<f4").tobytes()).decode()},
        "is 3000 m large, above 1000 m",
    ),
    "body": ({"body": "cube"}, "meshes[0].body is 'cube'; give a body of the scene"),
    "number": ({"vertices": 3}, "meshes[0].vertices is 3; give a text"),
    "unknown": ({"colour": "red"}, "has an unknown entry 'colour'"),
}


@pytest.mark.parametrize("case", IN_SCENES)
def test_hostile_meshes_of_scene_files_are_refused(case: str, tmp_path: Path) -> None:
    changes, message = IN_SCENES[case]
    scene = pendulum()
    scene.add_mesh(body="ball", **BOX)
    path = tmp_path / "scene.json"
    scene.save(path)
    data = json.loads(path.read_text())
    data["meshes"][0] |= changes
    path.write_text(json.dumps(data))
    with pytest.raises(FileFormatError, match=re.escape(message)):
        Scene.load(path)
