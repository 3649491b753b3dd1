"""Meshes of users: drawn as they are, kept in files, without effect on motions; hostile files are refused."""

from __future__ import annotations

import base64
import copy
import json
import re
import struct
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hull_shapes import ascii_stl, stl
from scipy.spatial.transform import Rotation
from test_view import Page

from seacrane import FileFormatError, Frame, Lift, Result, Scene, SceneError, cases, simulate, view
from seacrane.inputs.mesh_files import read_gltf
from seacrane.pictures.drawn_bodies import looks
from seacrane.pictures.shapes import HullShape, MeshShape
from seacrane.scene import bodies
from seacrane.scene.file import scene_digest

CORNERS = np.array([[x, y, z] for x in (0, 2) for y in (0, 3) for z in (0, 1)], dtype=float)
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
     [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
Y_UP = np.column_stack([CORNERS[:, 0], CORNERS[:, 2], -CORNERS[:, 1]])
BOX = {"vertices": CORNERS, "faces": FACES}


def pendulum(**mesh: Any) -> Scene:
    scene = Scene(name="pendulum")
    pose: dict[str, Any] = {"position": (0.3, 0, -1.0), "center_of_mass": (0, 0, 0.5)}
    scene.add_body(name="ball", mass=1.0, inertia=(0.1, 0.1, 0.1), **pose)
    ends: dict[str, Any] = {"first": "ground", "second": "ball", "point": (0, 0, 0), "axis": (0, 1, 0)}
    scene.add_joint(kind="revolute", name="pivot", **ends)
    if mesh:
        scene.add_mesh(body="ball", **mesh)
    return scene


def gltf_of_box(**node: Any) -> dict[str, Any]:
    """The box in glTF's axes, y up, with its numbers inside."""
    data = Y_UP.astype("<f4").tobytes() + FACES.astype("<u2").tobytes()
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
    path.write_text(document if isinstance(document, str) else json.dumps(document))
    return path


def glb(path: Path, document: dict[str, Any]) -> Path:
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
    "box.stl": lambda path: stl(path, CORNERS[FACES]),
    "ascii.STL": lambda path: written(path, ascii_stl(CORNERS[FACES])),
    "box.gltf": lambda path: written(path, gltf_of_box()),
    "box.glb": lambda path: glb(path, gltf_of_box()),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_gives_the_triangles_that_arrays_give(name: str, tmp_path: Path) -> None:
    mesh = pendulum().add_mesh(body="ball", file=FILES[name](tmp_path / name))
    assert (mesh.name, mesh.body, len(mesh.vertices)) == ("ball", "ball", 8)
    arrays = pendulum().add_mesh(body="ball", **BOX)
    expected = sorted_triangles(arrays.vertices[arrays.faces])
    np.testing.assert_allclose(sorted_triangles(mesh.vertices[mesh.faces]), expected)
    with pytest.raises(ValueError, match="read-only"):
        mesh.vertices[0] = 0.0


def test_scale_frame_and_nodes_place_a_mesh(tmp_path: Path) -> None:
    frame = Frame(point=(5, 0, 0), axes=Rotation.from_euler("z", 90, degrees=True).as_matrix())
    given: dict[str, Any] = {"vertices": 1e3 * CORNERS, "faces": FACES, "scale": 1e-3, "frame": frame}
    expected = np.column_stack([5.0 - CORNERS[:, 1], CORNERS[:, 0], CORNERS[:, 2]])
    np.testing.assert_allclose(pendulum().add_mesh(body="ball", **given).vertices, expected, atol=1e-6)
    turn = Rotation.from_euler("xyz", [20, -50, 130], degrees=True)
    inner = {"translation": [1.0, 2.0, 3.0], "rotation": turn.as_quat().tolist(), "scale": [2.0, 1.0, 0.5]}
    document = gltf_of_box(**inner)
    outer = np.eye(4)
    outer[:3, :3], outer[:3, 3] = Rotation.from_euler("y", 30, degrees=True).as_matrix(), (7.0, 0.0, -1.0)
    document["nodes"].append({"children": [0], "matrix": outer.T.ravel().tolist()})
    document["scenes"][0]["nodes"] = [1]
    found = read_gltf(written(tmp_path / "box.gltf", document), most=100)
    placed = turn.apply(Y_UP * inner["scale"]) + inner["translation"]
    placed = placed @ outer[:3, :3].T + outer[:3, 3]
    z_up = np.column_stack([placed[:, 0], -placed[:, 2], placed[:, 1]])
    np.testing.assert_allclose(sorted_triangles(found), sorted_triangles(z_up[FACES]), atol=2e-4)


def test_a_mesh_moves_nothing_and_is_what_its_body_is_drawn_by(tmp_path: Path) -> None:
    plain, drawn = pendulum(), pendulum(**BOX)
    assert scene_digest(plain) == scene_digest(drawn)
    first, second = simulate(plain, 1.0), simulate(drawn, 1.0)
    for channel in first:
        np.testing.assert_array_equal(first[channel], second[channel])
    (box,) = looks(drawn)["ball"].shapes
    assert isinstance(box, MeshShape)
    np.testing.assert_allclose(box.vertices, CORNERS - (0, 0, 0.5))
    page = Page(view(Result.load(second.save(tmp_path / "run.nc"))).html)
    assert [shape["kind"] for body in page.data["bodies"] for shape in body["shapes"]] == ["mesh"]
    scene = cases.vessel()
    scene.add_mesh(body="vessel", **BOX)
    (hull,) = looks(scene)["vessel"].shapes  # painted by the water
    assert isinstance(hull, HullShape)
    assert hull.waterline == -scene.bodies["vessel"].center_of_mass[2]


def test_a_lift_names_the_file(tmp_path: Path) -> None:
    stl(tmp_path / "box.stl", 1e3 * CORNERS[FACES])
    (tmp_path / "lift.toml").write_text(
        'format = "seacrane lift"\nversion = 2\n'
        '[[body]]\nname = "ball"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, 1]\n'
        '[[mesh]]\nbody = "ball"\nfile = "box.stl"\nscale = 1e-3\nframe = { point_m = [0, 0, 5] }\n'
    )
    mesh = Lift.load(tmp_path / "lift.toml").scene().meshes["ball"]
    np.testing.assert_allclose(np.sort(mesh.vertices, axis=0)[[0, -1]], [[0, 0, 5], [2, 3, 6]], atol=1e-6)


WRONG: list[tuple[dict[str, Any], str]] = [
    ({**BOX, "body": "bal"}, "body 'bal'"), ({**BOX, "file": "box.stl"}, "give file, or"),
    ({"file": "box.step"}, "'box.step'; give .stl"), ({**BOX, "scale": -1.0}, "scale is -1"),
    ({**BOX, "vertices": 1e3 * CORNERS}, "3000 m large, above 1000 m; if it is in mm give scale=0.001"),
    ({**BOX, "frame": Frame(point=(1e6, 0, 0))}, "100000"), ({**BOX, "vertices": CORNERS * np.nan}, "finite"),
    ({**BOX, "vertices": 0.0 * CORNERS}, "one point"), ({**BOX, "vertices": CORNERS[:, :2]}, "shape (8, 2)"),
    ({**BOX, "faces": 0.5 * FACES}, "whole numbers"), ({**BOX, "faces": FACES + 1}, "none of its 8"),
    ({**BOX, "faces": np.tile(FACES, (20_000, 1))}, "240000 triangles, above 200000"),
]  # fmt: skip


def test_a_mesh_keeps_its_body_and_what_makes_none_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    for given, message in WRONG:
        scene = pendulum()
        with pytest.raises(SceneError, match=re.escape(message)):
            scene.add_mesh(**{"body": "ball", **given})
        assert not scene.meshes
    scene.remove("pivot")
    scene.add_mesh(body="ball", name="look", **BOX)
    with pytest.raises(SceneError, match="body 'ball': mesh 'look'"):
        scene.remove("ball")
    monkeypatch.setattr(bodies, "MOST_TRIANGLES", 20)
    with pytest.raises(SceneError, match="body 'ball' to 24 triangles, above 20"):
        scene.add_mesh(body="ball", name="more", **BOX)
    scene.remove("look")
    scene.remove("ball")


def changed(**changes: Any) -> dict[str, Any]:
    """The box with other entries; "accessors__1__count" names one."""
    document = gltf_of_box()
    for path, value in changes.items():
        *parts, last = (int(part) if part.isdigit() else part for part in path.split("__"))
        place: Any = document
        for part in parts:
            place = place[part]
        place[last] = value
    return document


DAMAGED = "damaged or truncated"
HOSTILE: list[tuple[Any, str]] = [
    (changed(asset={"version": "1.0"}), "only GLTF 2"), ("[" * 100_000, DAMAGED),
    (changed(extensionsRequired=["KHR_draco_mesh_compression"]), "KHR_draco_mesh_compression"),
    (changed(accessors__0__count=9), DAMAGED), (changed(buffers__0__uri="/etc/passwd"), "another file"),
    (changed(bufferViews__1__byteOffset=-8), DAMAGED), (changed(accessors__1__count=35), DAMAGED),
    (changed(meshes__0__primitives__0__mode=6), "fan"), (changed(nodes__0__mesh=-1), "no triangles"),
    (changed(accessors__1__count=30_000_000), DAMAGED), (changed(accessors__0__sparse={}), "sparse"),
    (changed(nodes=[{"mesh": 0}] * 19_000, scenes__0__nodes=[*range(19_000)]), "228000 triangles, above"),
]  # fmt: skip


def test_hostile_and_cut_models_are_refused(tmp_path: Path) -> None:
    def refused(path: Path, message: str) -> None:
        with pytest.raises(FileFormatError, match=message) as caught:
            pendulum().add_mesh(body="ball", file=path)
        assert path.stem in str(caught.value)

    with np.errstate(all="ignore"):
        for document, message in HOSTILE:
            refused(written(tmp_path / "box.gltf", document), message)
    path = glb(tmp_path / "box.glb", gltf_of_box())
    whole = path.read_bytes()
    for end in range(0, len(whole), 17):
        path.write_bytes(whole[:end])
        refused(path, DAMAGED)


def test_without_trimesh_a_file_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "trimesh.exchange", None)
    for name, write in FILES.items():
        with pytest.raises(FileFormatError, match=rf"{name}.*pip install 'seacrane\[mesh\]'"):
            pendulum().add_mesh(body="ball", file=write(tmp_path / name))
