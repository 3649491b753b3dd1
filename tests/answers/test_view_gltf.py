"""glTF models: what an independent reader finds in them is what the run did."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation, Slerp
from view_scenes import angle_between, case2

from seacrane import cases, view
from seacrane.pictures.animated_gltf import surfaces_of
from seacrane.pictures.drawing import drawing_of

pygltflib = pytest.importorskip("pygltflib", reason="the extra dev holds pygltflib")
COMPONENTS, WIDTH = {5126: "<f4", 5125: "<u4"}, {"SCALAR": 1, "VEC3": 3, "VEC4": 4}


class Model:
    """A .glb file as pygltflib reads it."""

    def __init__(self, path: Path) -> None:
        self.gltf = pygltflib.GLTF2().load(str(path))
        self.blob = self.gltf.binary_blob()
        self.nodes = {node.name: i for i, node in enumerate(self.gltf.nodes)}

    def numbers(self, index: int) -> np.ndarray:
        accessor = self.gltf.accessors[index]
        part = self.gltf.bufferViews[accessor.bufferView]
        width = WIDTH[accessor.type]
        kind = np.dtype(COMPONENTS[accessor.componentType])
        assert part.byteLength == kind.itemsize * width * accessor.count and part.byteOffset % 4 == 0
        values = np.frombuffer(self.blob, kind, width * accessor.count, part.byteOffset)
        return values.reshape(accessor.count, width)

    def track(self, node: str, path: str) -> tuple[np.ndarray, np.ndarray, str]:
        """Times, outputs and interpolation of what moves a node."""
        (animation,) = self.gltf.animations
        (channel,) = (
            one for one in animation.channels
            if one.target.node == self.nodes[node] and one.target.path == path
        )  # fmt: skip
        sampler = animation.samplers[channel.sampler]
        return self.numbers(sampler.input)[:, 0], self.numbers(sampler.output), sampler.interpolation

    def cubic(self, node: str, path: str, times: np.ndarray) -> np.ndarray:
        """As the specification interpolates CUBICSPLINE."""
        knots, outputs, kind = self.track(node, path)
        assert kind == "CUBICSPLINE"
        before, value, after = np.moveaxis(outputs.reshape(len(knots), 3, -1), 1, 0).astype(float)
        np.testing.assert_array_equal(before, after)
        return CubicHermiteSpline(knots.astype(float), value, after)(times)


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Model:
    return Model(view(case2()).save_gltf(tmp_path_factory.mktemp("gltf") / "lift.glb"))


def test_nodes_are_where_the_run_had_its_bodies(model: Model) -> None:
    result = case2()
    times = np.minimum(result.time, model.track("payload", "translation")[0][-1])
    for body in result.coords["body"]:
        place = model.cubic(body, "translation", times)
        np.testing.assert_allclose(place, result.select("position", body=body), rtol=0.0, atol=1e-3)
        turn = model.cubic(body, "rotation", times)
        turn /= np.linalg.norm(turn, axis=1, keepdims=True)
        assert angle_between(np.roll(turn, 1, axis=1), result.select("quaternion", body=body)) < 1e-3


def test_up_is_up_and_nodes_stand_at_their_first_pose(model: Model, tmp_path: Path) -> None:
    (root,) = model.gltf.scenes[model.gltf.scene].nodes
    turn = Rotation.from_quat(model.gltf.nodes[root].rotation)
    np.testing.assert_allclose(turn.apply([[1, 0, 0], [0, 0, 1]]), [[1, 0, 0], [0, 1, 0]], atol=1e-12)
    start = case2().select("position", body="main_jib")[0]
    np.testing.assert_allclose(model.gltf.nodes[model.nodes["main_jib"]].translation, start, atol=1e-4)
    still = Model(view(cases.vessel()).save_gltf(tmp_path / "vessel.glb")).gltf
    assert still.animations == [] and [one.name for one in still.nodes][1:] == ["vessel"]


def test_a_link_reaches_from_tip_to_payload(model: Model) -> None:
    scene, result = cases.case2(), case2()
    knots, start, kind = model.track("link", "translation")
    assert kind == "LINEAR"
    turn, scale = model.track("link", "rotation")[1], model.track("link", "scale")[1]
    np.testing.assert_allclose(scale[:, 2], 8.0, atol=2e-3)
    end = start + scale[:, 2:] * Rotation.from_quat(turn).apply([0.0, 0.0, 1.0])
    joint, load = scene.joints["link"], scene.bodies["payload"]
    hook = np.asarray(joint.second_frame.point) - np.asarray(load.center_of_mass)
    quaternion = np.roll(result.select("quaternion", body="payload")[::2], -1, axis=1)
    expected = result.select("position", body="payload")[::2] + Rotation.from_quat(quaternion).apply(hook)
    np.testing.assert_allclose(end, expected, atol=2e-3)
    assert np.sum(turn[1:] * turn[:-1], axis=1).min() > 0.9
    Slerp(knots, Rotation.from_quat(turn))  # refuses times that do not increase


def test_the_hull_has_its_length(model: Model) -> None:
    primitives = model.gltf.meshes[model.gltf.nodes[model.nodes["vessel"]].mesh].primitives
    vertices = [model.numbers(one.attributes.POSITION) for one in primitives]
    np.testing.assert_allclose(np.ptp(np.concatenate(vertices), axis=0)[:2], (115.0, 25.0), rtol=1e-3)
    for one, corners in zip(primitives, vertices, strict=True):
        told = model.gltf.accessors[one.attributes.POSITION]
        np.testing.assert_array_equal([told.min, told.max], [corners.min(axis=0), corners.max(axis=0)])
        assert model.numbers(one.indices).max() == len(corners) - 1


def test_triangles_face_outwards_and_enclose_their_shape() -> None:
    drawing = drawing_of(cases.case2())
    for body in ("payload", "main_barrel"):
        shapes = drawing.looks[body].shapes
        for surface, shape in zip(surfaces_of(drawing.looks[body], 0), shapes, strict=True):
            a, b, c = np.moveaxis(surface.vertices[surface.faces], 1, 0)
            expected = 6.0 * 6.0 * 4.0
            if body == "main_barrel":  # a prism of eight edges
                length = float(np.linalg.norm(np.ptp(shape.points, axis=0)))
                expected = length * 8.0 * np.sin(np.pi / 8.0) * shape.radius**2  # type: ignore[union-attr]
            assert np.sum(a * np.cross(b, c)) / 6.0 == pytest.approx(expected)
